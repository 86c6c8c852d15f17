// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_RANKING_PAGE_HPP
#define SIVID_REPORT_RANKING_PAGE_HPP

#include <sivid/compiled.hpp>
#include <sivid/decision/measurement_ranking.hpp>
#include <sivid/decision/rank.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/report/decision_page.hpp>
#include <sivid/report/page.hpp>

#include <string>
#include <vector>

namespace sivid::report {

/// An effect in error bounds, rounded outward.
[[nodiscard]] SIVID_DECL std::string effect_text(parameter_effect const& e);

/// What a ranking proves, in sentences: what cannot matter, what alone moves little, what does not
/// count, and what acts in products only.
[[nodiscard]] SIVID_DECL std::vector<std::string>
ranking_sentences(identification_problem const& about, ranking const& found);

/// A group of measurements in words: "psi", "run 2", "psi of run 2, 1 to 2 s".
[[nodiscard]] SIVID_DECL std::string group_text(identification_problem const& about,
                                                measurement_group const& group);

/// A growth in words: "nothing changes", "2.05 to 2.26 times", "at least 1.2 times".
[[nodiscard]] SIVID_DECL std::string growth_text(interval const& growth);

/// A page with a bar for the effect of each parameter on each channel, full up to what is reached
/// and hatched up to what is not excluded; and such bars for groups of measurements.
/// @param measurements  what they are worth; null: not asked
[[nodiscard]] SIVID_DECL page ranking_page(identification_problem const& about,
                                           ranking const& found,
                                           decision_page_options const& options,
                                           measurement_ranking const* measurements = nullptr);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/ranking_page.ipp>
#endif

#endif
