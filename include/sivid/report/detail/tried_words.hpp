// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DETAIL_TRIED_WORDS_HPP
#define SIVID_REPORT_DETAIL_TRIED_WORDS_HPP

#include <sivid/paving/strategy/contractor.hpp>
#include <sivid/report/identification_view.hpp>
#include <sivid/report/identification_words.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/page.hpp>

#include <string>
#include <vector>

namespace sivid::report {

/// A journal, line by line.
[[nodiscard]] inline std::vector<tried_view> tried_words(contraction_journal const& journal) {
    std::vector<tried_view> result;
    for (auto const& r : journal) {
        auto& words = result.emplace_back(
            tried_view{r.by, std::string{to_string(r.how)}, r.why, std::string{}});
        if (!r.asked()) continue;
        if (r.left < 1) words.outcome += ": at most " + at_most_percent(r.left) + " left";
        words.effort = duration_text(r.seconds);
        if (r.integrations > 0) words.effort += ", " + count_text(r.integrations) + " integrations";
        for (auto const& [name, value] : r.figures)
            if (value > 0) words.effort += ", " + name + " " + given_text(value);
    }
    return result;
}

[[nodiscard]] inline table tried_table(std::vector<tried_view> const& tried) {
    table result{.columns = columns("*contractor|outcome|~why it was tried, or not|~effort"),
                 .caption = "In this order; the shares are those of the volume that each was "
                            "given."};
    for (auto const& r : tried) result.rows.push_back({r.by, r.outcome, r.why, r.effort});
    return result;
}

} // namespace sivid::report

#endif
