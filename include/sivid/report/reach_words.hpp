// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_REACH_WORDS_HPP
#define SIVID_REPORT_REACH_WORDS_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identification.hpp>

#include <string>
#include <vector>

namespace sivid::report {

/// Why little was excluded, and what to change: that what was proved inside stays, and a sentence
/// for each of the first experiments, from what the runs of `identification::reach` measured.
/// Empty where much was excluded.
[[nodiscard]] SIVID_DECL std::vector<std::string> reach_words(identification_problem const& problem,
                                                              identification const& found);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/reach_words.ipp>
#endif

#endif
