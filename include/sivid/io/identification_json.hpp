// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IDENTIFICATION_JSON_HPP
#define SIVID_IO_IDENTIFICATION_JSON_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/identification_csv.hpp>
#include <sivid/io/result/detail/identifiability_json.hpp>
#include <sivid/io/result/journal_json.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/io/result/reach_json.hpp>
#include <sivid/io/text/json_writer.hpp>
#include <sivid/number/text/sha256.hpp>
#include <sivid/paving/identify.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sivid {

/// What a result file says beyond the identification itself.
struct identification_json_options {
    std::string dataset{};              ///< the id of the data set
    std::vector<std::string> effects{}; ///< joined to the data set's model, by name
    allowed_disturbances disturbances{};
    std::vector<std::string> further_assumptions{};
    std::string source_folder{}; ///< the data set, seen from the result's folder
    std::string source_digest{}; ///< of `dataset_digest`; without it no source is written
    sivid::identifiability const* identifiability = nullptr; ///< written where there is one
    std::string const* outputs = nullptr; ///< the text of outputs.csv beside it, if there is one
    explaining_motion const* motion = nullptr; ///< whose outputs that encloses; null: none
};

/// A share of the prior as an interval within [0, 1].
[[nodiscard]] inline interval share_of_whole(interval const& volume) {
    return intersect(volume, interval_traits<interval>::bounds(0, 1));
}

/// The text of `result.json` in the format sivid-identification-1, with the SHA-256 of the files
/// beside it and the digest of the problem.
/// @guarantee  bounds are printed outward; the witness's numbers read back as the very doubles
/// that were verified
[[nodiscard]] SIVID_DECL std::string
identification_json(identification_problem const& problem, identification const& found,
                    identification_json_options const& options);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/impl/identification_json.ipp>
#endif

#endif // SIVID_IO_IDENTIFICATION_JSON_HPP
