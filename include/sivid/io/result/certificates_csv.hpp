// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_RESULT_CERTIFICATES_CSV_HPP
#define SIVID_IO_RESULT_CERTIFICATES_CSV_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/text/csv_table.hpp>
#include <sivid/number/decimal.hpp>
#include <sivid/paving/search/exclusion_proof.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace sivid {

/// The text of `certificates.csv`: how what a search excluded is proved, one step a row, in the
/// order in which the search's tree is walked.
///   `run` (of an experiment), `cut` (of a side, at its lower or upper end), `empty`, `split` (of a
///   side), `leaf`; see `proof_step`. Experiments, sides and measurements are numbered from 0, the
///   latter in the order of time. Weights are `experiment:measurement:weight`, apart by spaces,
///   groups by bars.
/// @guarantee  faces read back as the very doubles; weights are rounded, which none of them minds
[[nodiscard]] SIVID_DECL std::string certificates_csv(exclusion_proof const& proof);

/// Reads such a table.
/// @throws input_error  for what cannot be read; that it proves anything is for others to check
[[nodiscard]] SIVID_DECL exclusion_proof read_certificates(csv_table const& table);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/result/impl/certificates_csv.ipp>
#endif

#endif
