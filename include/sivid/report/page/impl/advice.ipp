// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_IMPL_ADVICE_IPP
#define SIVID_REPORT_PAGE_IMPL_ADVICE_IPP

#include <sivid/report/page/detail/advice.hpp>

#include <sivid/compiled.hpp>
#include <sivid/report/diagnosis_words.hpp>
#include <sivid/report/identification_words.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/page/detail/diagnosis_tables.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace sivid::report {

namespace detail {

/// The largest of some misfits.
struct largest_misfit {
    comparison_series const* channel = nullptr;
    double time = 0, bounds = 0; ///< how many error bounds

    void look_at(comparison_series const& c, std::vector<point> const& misfits) {
        for (auto const& [t, m] : misfits) {
            if (std::isfinite(m) && m > bounds) channel = &c, time = t, bounds = m;
        }
    }
    /// In the unit of its channel.
    [[nodiscard]] double size() const {
        for (auto const& s : channel->measured)
            if (s.time == time) return bounds * (s.value.hi - s.value.lo) / 2;
        return std::nan("");
    }
};

/// What is wrong with measurements that alone stand against the model.
inline std::string instrument_advice(confined_gap const& c) {
    auto const part = part_words(c);
    auto const stated = "state error bounds of " + part;
    if (c.steps)
        return stated + " that are wider by " + (c.steps->cut_off ? "a" : "half a") +
               " step of its readings, or read it more finely";
    if (c.grows && c.grows->what == noise_growth::with::rate)
        return "look at the time stamps of " + part + ", or " + stated +
               " that grow with how fast it changes";
    if (c.grows) return "calibrate " + part + ", or " + stated + " that grow with what it shows";
    if (!c.channel.empty())
        return "look at the instrument of " + part + ", or " + stated + " that are " +
               inflation_text(c.factor) + " times as wide";
    return "look at what was different in " + part + ": all else is explained without it";
}

/// Candidates that explain the data without the answer being a part of them.
inline std::vector<std::string> other_explanations(diagnosis_view const& v) {
    std::vector<std::string> names;
    for (cause const& c : v.causes) {
        bool const explains = c.verdict == cause_verdict::explains ||
                              (c.verdict == cause_verdict::undecided &&
                               is_fitted(c.fitted_inflation) && c.fitted_inflation <= 1);
        bool const more = std::all_of(v.effects.begin(), v.effects.end(), [&c](auto const& e) {
            return std::find(c.effects.begin(), c.effects.end(), e) != c.effects.end();
        });
        if (explains && !more && !c.effects.empty()) names.push_back(names_of(c.effects));
    }
    return names;
}

} // namespace detail

SIVID_DECL table change_table(diagnosis_view const& v) {
    table t{.columns = {{"symbol", column_kind::symbol},
                        {"value", column_kind::number},
                        {"proved range", column_kind::number},
                        {"unit"},
                        {"of", column_kind::note}}};
    cause const* const c = answer_of(v);
    if (c == nullptr) return t;
    for (auto const& [e, verified] : parameters_of(*c)) {
        auto const symbol = v.change.symbols.find(e.name);
        if (symbol == v.change.symbols.end()) continue;
        auto const dot = e.name.rfind('.');
        t.rows.push_back({symbol->second, value_text(e, verified), hull_text(e),
                          kept_together(unit_text(e.unit)), name_of(e.name.substr(0, dot))});
    }
    return t;
}

SIVID_DECL table cost_table(diagnosis_view const& v) {
    table t{.columns = {{"scenario", column_kind::symbol},
                        {"most off"},
                        {"at [" + unit_text(v.time_unit) + "]", column_kind::number},
                        {"by", column_kind::number},
                        {"in error bounds", column_kind::number},
                        {"with it, at most", column_kind::number}},
            .caption =
                "Of best fits (estimates). With it: the largest misfit of any channel there, "
                "in error bounds."};
    for (compared_scenario const& s : v.plots.scenarios) {
        detail::largest_misfit before, after;
        for (comparison_series const& c : s.channels) {
            before.look_at(c, c.misfit_before);
            after.look_at(c, c.misfit_after);
        }
        if (before.channel == nullptr) continue;
        auto const number = [](double x) { return rounded_text(x, rounding::nearest); };
        t.rows.push_back(
            {s.name + (s.holdout ? " (held out)" : ""), before.channel->name,
             given_text(before.time), number(before.size()) + unit_suffix(before.channel->unit),
             number(before.bounds), after.channel == nullptr ? "" : number(after.bounds)});
    }
    return t;
}

SIVID_DECL std::vector<std::string> advice_lines(diagnosis_view const& v) {
    std::vector<std::string> lines;
    auto const add = [&lines](std::string const& text) {
        if (!text.empty()) lines.push_back(capitalised(text) + (text.back() == '.' ? "" : "."));
    };
    bool const answered = v.answer == answer_kind::effects && !v.effects.empty();
    if (v.gap == gap_verdict::none)
        add("nothing has to be added: the model explains all data of the fit");
    if (v.answer == answer_kind::open)
        add("give it more time: a larger --budget tries the candidates that are left");
    if (!answered)
        for (auto const& c : v.confined) add(detail::instrument_advice(c));
    if (v.answer == answer_kind::unexplained) {
        auto const& places =
            v.remainder && !v.remainder->where.empty() ? v.remainder->where : v.where;
        if (v.confined.empty() && !places.empty())
            add("look for an effect of your own in " +
                std::string(places.front().kind == "equation" ? "the " : "") +
                place_name(places.front()) +
                (places.front().where.scenario.empty()
                     ? ""
                     : " (" + window_text(places.front().where, v.time_unit) + ")") +
                ": nothing that was tried explains what is missing there");
        if (v.confined.empty() && places.empty())
            add("nothing that was tried explains the data, and no place stands out: look at error "
                "bounds and priors, or measure more channels");
    }
    for (constant_at_end const& e : v.at_ends) add(end_words(e));
    constexpr std::size_t most = 3;
    auto others = detail::other_explanations(v);
    if (answered && others.empty() && v.indistinguishable.empty()) {
        add("no other candidate was found to explain all data" +
            (v.tried.complete()
                 ? std::string{", so no experiment has to tell explanations apart"}
                 : " (" + tried_text(v.tried) + "): a larger --budget tries the rest"));
    } else if (answered && !v.indistinguishable.empty()) {
        if (!v.next) add(alternatives_clause(v));
    } else if (answered) {
        auto const many = others.size();
        others.resize(std::min(many, most));
        add("other candidates explain all data in a best fit, too, but far less well on the whole "
            "(estimate): " +
            enumeration(others, many > most ? ", " : " and ") +
            (many > most ? " and " + count_text(many - most) + " more" : ""));
    }
    add(next_words(v));
    return lines;
}

SIVID_DECL void add_advice(page& out, diagnosis_view const& v) {
    auto const lines = advice_lines(v);
    if (lines.empty() && v.change.lines.empty()) return;
    out.section("What to do now");
    if (!v.change.lines.empty()) {
        out.subsection("Add to the simulator");
        out.prose(
            "In this order: what is remembered, inputs and constants, rates (x' is that of x), "
            "sensors. Lines of one kind take effect together: on the right stands what was "
            "there before.");
        std::vector<std::string> formulas;
        for (auto const& f : v.change.lines) formulas.push_back(formula_text(f));
        out.bullets(formulas);
        out.add(change_table(v));
        if (!v.constants.empty())
            out.prose("The model's own constants go with it: take those of the table "
                      "\xE2\x80\x9C"
                      "All constants\xE2\x80\x9D.");
        auto const costs = cost_table(v);
        if (!costs.rows.empty()) {
            out.subsection("What it costs to leave it out");
            out.add(costs);
        }
        if (!lines.empty()) out.subsection("What to look at and to measure");
    }
    out.bullets(lines);
}

} // namespace sivid::report

#endif
