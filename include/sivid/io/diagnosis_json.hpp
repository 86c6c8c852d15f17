// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DIAGNOSIS_JSON_HPP
#define SIVID_IO_DIAGNOSIS_JSON_HPP

#include <sivid/compiled.hpp>
#include <sivid/diagnosis/diagnosis.hpp>

#include <string>

namespace sivid {

/// Which data and problem a diagnosis is of; empty texts are not written.
struct diagnosis_source {
    std::string folder{};  ///< the data set, seen from the folder of the diagnosis
    std::string digest{};  ///< of `dataset_digest`
    std::string problem{}; ///< of `problem_digest`, of the model as it is
};

/// The text of `diagnosis.json` in the format sivid-diagnosis-1.
/// @guarantee  bounds are printed outward; the witness's numbers read back as the doubles that were
///             verified
[[nodiscard]] SIVID_DECL std::string diagnosis_json(diagnosis const& d, std::string const& dataset,
                                                    diagnosis_source const& source = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/impl/diagnosis_json.ipp>
#endif

#endif
