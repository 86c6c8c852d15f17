// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DETAIL_REACH_WORDS_HPP
#define SIVID_REPORT_DETAIL_REACH_WORDS_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/run/run_reach.hpp>

#include <string>
#include <vector>

namespace sivid::report {

/// Why runs over all that is left tell little, and what to change: a sentence for each of the first
/// experiments that say something, from what they measured.
/// @param ended_by_itself  the search did: more time would find the same
[[nodiscard]] SIVID_DECL std::vector<std::string> reach_words(std::vector<run_reach> const& reach,
                                                              bool ended_by_itself = false);

/// Why an identification excluded little: first that what was proved inside stays, then what its
/// runs tell. Empty where much was excluded.
[[nodiscard]] SIVID_DECL std::vector<std::string> reach_words(identification_problem const& problem,
                                                              identification const& found);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/reach_words.ipp>
#endif

#endif
