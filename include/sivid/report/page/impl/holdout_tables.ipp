// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_IMPL_HOLDOUT_TABLES_IPP
#define SIVID_REPORT_PAGE_IMPL_HOLDOUT_TABLES_IPP

#include <sivid/report/page/detail/holdout_tables.hpp>

#include <cmath>
#include <string>

namespace sivid::report {

namespace detail {

/// A share of samples, in percent, rounded down: 99.96 is not all of them.
inline std::string counted_share(double share) {
    double const above = std::nextafter(share, HUGE_VAL); // of the quotient of two counts
    return rounded_text(above, rounding::down, {.significant = 3, .shift = 2}) + "\xC2\xA0%";
}

} // namespace detail

SIVID_DECL table holdout_table(holdout_view const& h, range const& shrink) {
    table t{.columns = {{"measure", column_kind::symbol},
                        {"model as it is", column_kind::number},
                        {"with the effect", column_kind::number},
                        {"known by"}},
            .rows = {}};
    auto const inflation = [](range const& r) {
        return says_something(r) ? inflation_text(r) : std::string{"not bounded"};
    };
    std::string const proved{proved_mark}, estimate{estimate_mark};
    if (says_something(h.inflation_before) || says_something(h.inflation_after)) {
        t.rows.push_back({"bounds must grow by", inflation(h.inflation_before),
                          inflation(h.inflation_after), proved});
    }
    if (says_something(h.over_fits_before) || says_something(h.over_fits_after)) {
        t.rows.push_back({"the same, for every parameter that fits", inflation(h.over_fits_before),
                          inflation(h.over_fits_after), proved});
    }
    if (says_shrink(shrink)) t.rows.push_back({"gap removed", "", shrink_text(shrink), proved});
    auto const add = [&](std::string const& name, double before, double after, auto const& text) {
        auto const number = [&](double x) { return std::isfinite(x) ? text(x) : std::string{"?"}; };
        if (std::isfinite(before) || std::isfinite(after))
            t.rows.push_back({name, number(before), number(after), estimate});
    };
    auto const upward = [](double x) { return rounded_text(x, rounding::up); };
    for (holdout_view::channel const& c : h.channels) {
        add("RMSE of " + c.name, c.rmse_before, c.rmse_after,
            [&](double x) { return rounded_text(x, rounding::nearest) + unit_suffix(c.unit); });
    }
    add("samples in the predicted tube", h.covered_before, h.covered_after, detail::counted_share);
    add("width of that tube, in bounds", h.width_before, h.width_after, upward);
    return t;
}

SIVID_DECL table holdout_candidates_table(diagnosis_view const& v, std::size_t most) {
    table t{.columns = {{"candidate"},
                        {"bounds must grow by (proved)", column_kind::number},
                        {"samples in its tube (estimate)", column_kind::number},
                        {"width of the tube, in bounds (estimate)", column_kind::number}},
            .rows = {},
            .caption = "A wide tube covers much and says little."};
    for (candidate_view const* c : foremost(v, v.candidates.size())) {
        if (!c->holdout || t.rows.size() == most) continue;
        holdout_view const& h = *c->holdout;
        if (c == answer_of(v)) t.chosen_row = t.rows.size();
        t.rows.push_back(
            {names_of(c->effects),
             says_something(h.inflation_after) ? inflation_text(h.inflation_after) : "not bounded",
             std::isfinite(h.covered_after) ? detail::counted_share(h.covered_after) : "",
             std::isfinite(h.width_after) ? rounded_text(h.width_after, rounding::up) : ""});
    }
    return t.rows.size() > 1 ? t : table{};
}

} // namespace sivid::report

#endif
