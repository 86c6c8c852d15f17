// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IDENTIFIABILITY_WORDS_HPP
#define SIVID_REPORT_IDENTIFIABILITY_WORDS_HPP

#include <sivid/compiled.hpp>
#include <sivid/paving/identifiability.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

/// What data can tell about their unknowns, in sentences that keep what is proved apart from what
/// is computed in floating point.
namespace sivid::report {

/// One sentence a line: the ranks, what is free, what acts through which combinations, and the
/// directions that the data notice least.
/// @param directions  so many at most
[[nodiscard]] SIVID_DECL std::vector<std::string>
identifiability_words(identifiability const& found, std::size_t directions = 3);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/identifiability_words.ipp>
#endif

#endif
