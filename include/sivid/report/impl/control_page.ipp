// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_CONTROL_PAGE_IPP
#define SIVID_REPORT_IMPL_CONTROL_PAGE_IPP

#include <sivid/report/control_page.hpp>

#include <sivid/compiled.hpp>
#include <sivid/report/draw/detail/paving_projections.hpp>
#include <sivid/report/identification_words.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/page/detail/decision_figures.hpp>
#include <sivid/report/page/detail/identification_parameters.hpp>
#include <sivid/report/table.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid::report {

namespace detail {

inline std::string excluded_percent(subpaving const& paving) {
    using traits = interval_traits<interval>;
    auto const rest = traits::sub(traits::point(1.0), paving.outer_volume());
    return at_least_percent(std::clamp(rest.lower(), 0.0, 1.0));
}

/// The set of gains: pictures of pairs, or the ranges of a single one.
inline void add_gains(page& out, gain_set const& found) {
    out.section("The gains");
    auto const& paving = found.paving.paving;
    named_paving named{&paving, {}, {}, found.suggested.value_or(std::vector<double>{})};
    auto const hull = paving.outer_hull();
    for (std::size_t k = 0; k < found.names.size(); ++k) {
        named.sides.push_back({found.names[k], "", paving.prior()[k]});
        named.hull.push_back(hull[k]);
    }
    auto const pairs = projections(named, {}, 6);
    if (!pairs.empty()) {
        out.add(paving_figure(pairs, "Gains that meet the requirement.",
                              std::string{projection_rule} +
                                  " Proved means for every parameter that the identification "
                                  "leaves, every start, every instant.",
                              {"inside: proved for every parameter",
                               "outside: violated by a parameter that the data allow", "suggested",
                               "whole range"}));
        return;
    }
    table t{.columns = {{found.names[0], column_kind::number}, {"", column_kind::note}}};
    std::vector<paved_box const*> row;
    for (auto const& b : paving.boxes()) row.push_back(&b);
    std::sort(row.begin(), row.end(), [](paved_box const* a, paved_box const* b) {
        return a->set[0].lower() < b->set[0].lower();
    });
    for (std::size_t k = 0; k < row.size();) {
        auto const first = k;
        while (k < row.size() && row[k]->verdict == row[first]->verdict) ++k;
        range const r{row[first]->set[0].lower(), row[k - 1]->set[0].upper()};
        auto const says = row[first]->verdict == box_verdict::inside    ? "proved"
                          : row[first]->verdict == box_verdict::outside ? "violated"
                                                                        : "";
        // What is known holds within, what is not may reach further.
        auto const within = "[" + exact_text(r.lo) + ", " + exact_text(r.hi) + "]";
        t.rows.push_back(
            {*says != 0 ? inward_text(r, {.significant = 5}).value_or(within) : outward_text(r),
             *says != 0 ? says : "not decided"});
    }
    out.add(t);
}

} // namespace detail

SIVID_DECL std::string gain_sentence(gain_set const& found) {
    auto const& paving = found.paving.paving;
    std::string const why{to_string(found.paving.reason)};
    if (found.none_exists())
        return "Every gain in the ranges violates the requirement for some parameter that the data "
               "allow: no law of this form meets it for all.";
    auto const excluded = detail::excluded_percent(paving);
    if (!found.some_proved())
        return "No gain is proved, and not all are excluded (" + why + "): at least " + excluded +
               " of the ranges are." +
               (found.unknown ? " Of some gains nothing is known, since what the requirement is "
                                "provided for is not kept, such as the slew limit."
                              : "") +
               (found.against.empty() ? " No parameter is known that violates it." : "");
    std::string text = "Proved for every parameter that the identification leaves and every start "
                       "of the scenario, at every instant: ";
    if (found.suggested) text += detail::named(found.names, *found.suggested);
    std::string around;
    for (std::size_t k = 0; k < found.tolerance.size(); ++k) {
        auto const side = inward_text(found.tolerance[k]);
        around += (k == 0 ? ", all around with " : ", ") + found.names[k] + " in " +
                  side.value_or("no range of a few digits");
    }
    text += around;
    double const inner = paving.inner_volume().lower();
    if (inner > 0)
        text += (found.suggested ? ", at least " : "at least ") + at_least_percent(inner) +
                " of the ranges";
    if (paving.outer_volume().upper() < 1) text += "; at least " + excluded + " are excluded";
    return text + ".";
}

SIVID_DECL page control_page(stored_prediction const& about, requirement const& asked,
                             gain_set const& found, verification const* proof,
                             prediction const* tubes, decision_page_options const& o) {
    page out{{.kind = "Control law",
              .title = o.law,
              .lead = asked.text + ". " + o.scenario + ", from " + o.dataset}};
    out.banner(found.some_proved()   ? outcome::proved
               : found.none_exists() ? outcome::refuted
                                     : outcome::undecided,
               found.some_proved()   ? "Gains are proved"
               : found.none_exists() ? "No gain will do"
                                     : "No gain is proved",
               gain_sentence(found));
    std::vector<card> cards;
    auto const& paving = found.paving.paving;
    cards.push_back(
        {"proved", at_least_percent(paving.inner_volume().lower()), "of the ranges of the gains"});
    cards.push_back({"excluded", detail::excluded_percent(paving),
                     "each violates it for a parameter that the data allow"});
    if (proof != nullptr)
        cards.push_back({"robustness",
                         "\xE2\x89\xA5 " + rounded_text(proof->found.low, rounding::down),
                         "of the suggested gains"});
    cards.push_back({"time", duration_text(found.seconds), ""});
    cards.push_back({"integrations", count_text(found.integrations), "validated"});
    out.cards(cards);
    detail::add_gains(out, found);
    if (found.suggested && proof != nullptr) {
        out.section("With " + detail::named(found.names, *found.suggested));
        out.prose(answer_sentence(about, *proof));
        if (tubes != nullptr) {
            detail::add_margins(out, asked, *tubes, o);
            detail::add_motions(out, *tubes, o);
        }
    }
    if (!found.against.empty()) {
        out.section("What excludes gains");
        table t;
        for (auto const& name : about.direct.choice.unknown)
            t.columns.push_back({name, column_kind::number});
        t.columns.push_back({"robustness", column_kind::number});
        for (auto const& w : found.against) {
            std::vector<std::string> row;
            for (double const x : w.parameters) row.push_back(rounded_text(x, rounding::nearest));
            row.push_back("\xE2\x89\xA4 " + rounded_text(w.found.high, rounding::up));
            t.rows.push_back(std::move(row));
        }
        t.caption = "Parameters that the data allow (proved by validated runs), each with a gain "
                    "under which it violates the requirement. Every excluded box of gains "
                    "violates it for one of them. Rounded; control.json has them in full.";
        out.add(t);
    }
    detail::add_basis(out, about, o, decision_assumptions(about));
    return out;
}

} // namespace sivid::report

#endif
