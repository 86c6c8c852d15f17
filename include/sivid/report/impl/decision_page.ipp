// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_DECISION_PAGE_IPP
#define SIVID_REPORT_IMPL_DECISION_PAGE_IPP

#include <sivid/report/decision_page.hpp>

#include <sivid/compiled.hpp>
#include <sivid/report/identification_words.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/page/detail/decision_figures.hpp>
#include <sivid/report/table.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid::report {

SIVID_DECL std::string answer_sentence(stored_prediction const& about, verification const& found) {
    range const r{found.found.low, found.found.high};
    switch (found.answer) {
    case requirement_answer::proved:
        return "It holds for every parameter that the identification leaves and every start of the "
               "scenario, at every instant" +
               std::string{is_finite(r) ? "; the robustness is within " + outward_text(r) : ""} +
               ".";
    case requirement_answer::refuted: {
        auto const& w = *found.witness;
        auto const start = detail::start_of(about.direct, w.start);
        return "Violated at " + detail::named(about.direct.choice.unknown, w.parameters) +
               ", which the data allow (proved by validated runs" +
               (about.feasible_with.empty() ? "" : "; " + about.feasible_with) + ")" +
               (start.empty() ? "" : ", from the start " + start) + ": its robustness is at most " +
               rounded_text(w.found.high, rounding::up) + ".";
    }
    case requirement_answer::open:
        break;
    }
    auto const& b = found.open.front();
    std::string text =
        "Neither proved nor refuted: " + count_text(found.open.size()) +
        (found.open.size() == 1 ? " box is open; " : " boxes are open; the largest ") + "is " +
        std::string{to_string(b.why)};
    if (b.why == open_reason::not_enclosed)
        text += " (motions are enclosed up to t = " + exact_text(b.reached) + " " +
                about.problem.model.about.time_unit + ")";
    text += ", at ";
    for (std::size_t j = 0; j < b.parameters.size(); ++j)
        text += (j > 0 ? ", " : "") + formula_text(about.sides[j]) + " in " +
                detail::text_of(b.parameters[j]);
    return text + ".";
}

SIVID_DECL std::vector<std::string> decision_assumptions(stored_prediction const& s) {
    std::vector<std::string> lines;
    lines.push_back("The identification's result is taken as it stands: what it excludes is "
                    "excluded. `check --all` proves that anew. A witness of a violation does not "
                    "rest on it.");
    for (auto const& a : s.assumptions) lines.push_back(a + ".");
    auto const& inputs = s.problem.inputs;
    bool const exact = std::none_of(inputs.begin(), inputs.end(), is_uncertain);
    lines.push_back(
        "The scenario's inputs " +
        std::string{exact ? "act exactly as stated" : "stay within their stated errors"} +
        ", and the model's equations hold in it.");
    if (!s.not_in_products.empty())
        lines.push_back("The products that the data fix do not tell this prediction (" +
                        s.not_in_products +
                        "): it is made in the parameters themselves, where "
                        "the result is drawn more coarsely.");
    return lines;
}

SIVID_DECL page prediction_page(stored_prediction const& about, prediction const& found,
                                decision_page_options const& o) {
    page out{{.kind = "Prediction",
              .title = o.scenario + ", from " + o.dataset,
              .lead = o.about.empty() ? "All motions that the identification leaves." : o.about}};
    out.banner(found.complete ? outcome::proved : outcome::undecided,
               found.complete ? "Proved for the whole scenario"
                              : "Proved up to t = " + exact_text(found.reached) + " " +
                                    about.problem.model.about.time_unit,
               found.complete
                   ? "Every motion runs within the tubes at every instant."
                   : "The enclosure ends before the scenario does, or has gaps: a smaller set of "
                     "parameters, more time (--budget) or a shorter scenario may help.");
    std::vector<card> cards;
    if (std::isfinite(found.excess))
        cards.push_back({"against what is reached", "\xE2\x89\xA4 " + wider_text(found.excess),
                         "at the instants, by the parameters and starts themselves"});
    cards.push_back({"time", duration_text(found.seconds), ""});
    cards.push_back({"parts", count_text(found.parts), ""});
    cards.push_back({"integrations", count_text(found.integrations), "validated"});
    out.cards(cards);
    detail::add_motions(out, found, o);
    out.section("At the end");
    table t{
        .columns = {{"quantity", column_kind::symbol}, {"range", column_kind::number}, {"unit"}}};
    for (auto const& c : found.channels) {
        range const r{c.low.back(), c.high.back()};
        t.rows.push_back({c.name, is_finite(r) ? outward_text(r) : "not known", unit_text(c.unit)});
    }
    out.add(t);
    detail::add_basis(out, about, o, decision_assumptions(about));
    return out;
}

SIVID_DECL page verification_page(stored_prediction const& about, requirement const& asked,
                                  verification const& found, prediction const& tubes,
                                  decision_page_options const& o) {
    page out{
        {.kind = "Verification", .title = asked.text, .lead = o.scenario + ", from " + o.dataset}};
    bool const proved = found.answer == requirement_answer::proved;
    bool const refuted = found.answer == requirement_answer::refuted;
    out.banner(proved    ? outcome::proved
               : refuted ? outcome::refuted
                         : outcome::undecided,
               proved    ? "Proved"
               : refuted ? "Refuted"
                         : "Open",
               answer_sentence(about, found));
    std::vector<card> cards;
    range const r{found.found.low, found.found.high};
    if (refuted) {
        cards.push_back({"robustness", "≤ " + rounded_text(found.witness->found.high, rounding::up),
                         "of the motion that violates it; above 0 the requirement holds"});
    } else {
        cards.push_back({"robustness", is_finite(r) ? outward_text(r) : "not bounded",
                         "of all motions; above 0 the requirement holds"});
    }
    cards.push_back({"time", duration_text(found.seconds), ""});
    cards.push_back({"parts", count_text(found.parts), ""});
    cards.push_back({"integrations", count_text(found.integrations), "validated"});
    out.cards(cards);
    detail::add_margins(out, asked, tubes, o);
    if (!found.open.empty()) {
        out.section("Where it is open");
        table t;
        for (auto const& side : about.sides)
            t.columns.push_back({formula_text(side), column_kind::number});
        t.columns.push_back({"robustness", column_kind::number});
        t.columns.push_back({"why", column_kind::note});
        for (std::size_t k = 0; k < std::min<std::size_t>(found.open.size(), 40); ++k) {
            auto const& b = found.open[k];
            std::vector<std::string> row;
            for (auto const& side : b.parameters) row.push_back(detail::text_of(side));
            range const own{b.found.low, b.found.high};
            row.push_back(is_finite(own) ? outward_text(own) : "not bounded");
            row.push_back(std::string{to_string(b.why)});
            t.rows.push_back(std::move(row));
        }
        if (found.open.size() > 40)
            t.caption = "The largest 40 of " + count_text(found.open.size()) + ".";
        out.add(t);
    }
    out.section("The motion");
    detail::add_motions(out, tubes, o);
    detail::add_basis(out, about, o, decision_assumptions(about));
    return out;
}

} // namespace sivid::report

#endif
