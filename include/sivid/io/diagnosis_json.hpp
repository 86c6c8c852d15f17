// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DIAGNOSIS_JSON_HPP
#define SIVID_IO_DIAGNOSIS_JSON_HPP

#include <sivid/compiled.hpp>
#include <sivid/diagnosis/diagnosis.hpp>

#include <string>

namespace sivid {

/// The text of `diagnosis.json` in the format sivid-diagnosis-1.
/// @guarantee  bounds are printed outward; the witness's numbers read back as the doubles that were
///             verified
[[nodiscard]] SIVID_DECL std::string diagnosis_json(diagnosis const& d, std::string const& dataset);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/impl/diagnosis_json.ipp>
#endif

#endif
