// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_DETAIL_OTHER_ANSWERS_HPP
#define SIVID_APP_DETAIL_OTHER_ANSWERS_HPP

#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace sivid::app::detail {

/// True where one of these effects acts in some scenarios only, or for a time.
inline bool switches(std::vector<std::string> const& effects) {
    return std::any_of(effects.begin(), effects.end(),
                       [](auto const& e) { return e.find('@') != std::string::npos; });
}

/// Beside an answer that switches: the cause that does not and fits best, an estimate; of those
/// that fit as well within 1 % the one of fewest effects. @returns nullptr where there is none
inline cause const* closest_without_switches(diagnosis const& d) {
    if (d.answer != answer_kind::effects || !switches(d.effects)) return nullptr;
    auto const counts = [](cause const& c) {
        return !c.effects.empty() && !switches(c.effects) && report::is_fitted(c.fitted_inflation);
    };
    double least = std::numeric_limits<double>::infinity();
    for (auto const& c : d.causes)
        if (counts(c)) least = std::min(least, c.fitted_inflation);
    cause const* closest = nullptr;
    for (auto const& c : d.causes) {
        if (!counts(c) || c.fitted_inflation > 1.01 * least) continue;
        if (closest == nullptr || c.effects.size() < closest->effects.size()) closest = &c;
    }
    return closest;
}

/// Causes whose effects are some of the answer's and that are proved to explain all data alone. A
/// proof may come after the answer was chosen by fits.
inline std::vector<cause const*> parts_that_explain(diagnosis const& d) {
    std::vector<cause const*> parts;
    if (d.answer != answer_kind::effects) return parts;
    auto const in_answer = [&d](std::string const& e) {
        return std::find(d.effects.begin(), d.effects.end(), e) != d.effects.end();
    };
    for (auto const& c : d.causes) {
        bool const part = !c.effects.empty() && c.effects.size() < d.effects.size() &&
                          std::all_of(c.effects.begin(), c.effects.end(), in_answer);
        if (part && c.verdict == cause_verdict::explains) parts.push_back(&c);
    }
    return parts;
}

} // namespace sivid::app::detail

#endif
