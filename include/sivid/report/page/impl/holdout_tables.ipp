// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_IMPL_HOLDOUT_TABLES_IPP
#define SIVID_REPORT_PAGE_IMPL_HOLDOUT_TABLES_IPP

#include <sivid/report/page/detail/holdout_tables.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace sivid::report {

namespace detail {

/// A share of samples, in percent, rounded down: 99.96 is not all of them.
inline std::string counted_share(double share) {
    double const above = std::nextafter(share, HUGE_VAL); // of the quotient of two counts
    return rounded_text(above, rounding::down, {.significant = 3, .shift = 2}) + "\xC2\xA0%";
}

/// A tube without width was not computed.
inline bool has_tube(holdout_figures const& h) { return h.width_before > 0 || h.width_after > 0; }

} // namespace detail

SIVID_DECL table holdout_table(diagnosis_view const& v, holdout_figures const& h) {
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
    if (says_shrink(v.shrink_holdout))
        t.rows.push_back({"gap removed", "", shrink_text(v.shrink_holdout), proved});
    auto const add = [&](std::string const& name, double before, double after, auto const& text) {
        auto const number = [&](double x) { return std::isfinite(x) ? text(x) : std::string{"?"}; };
        if (std::isfinite(before) || std::isfinite(after))
            t.rows.push_back({name, number(before), number(after), estimate});
    };
    auto const upward = [](double x) { return rounded_text(x, rounding::up); };
    auto const unit_of = [&](std::string const& name) {
        for (compared_scenario const& s : v.plots.scenarios)
            for (comparison_series const& c : s.channels)
                if (c.name == name) return c.unit;
        return std::string{};
    };
    auto const at = [](std::vector<double> const& all, std::size_t i) {
        return i < all.size() ? all[i] : std::nan("");
    };
    for (std::size_t i = 0; i < h.channels.size(); ++i) {
        add("RMSE of " + h.channels[i], at(h.rmse_before, i), at(h.rmse_after, i), [&](double x) {
            return rounded_text(x, rounding::nearest) + unit_suffix(unit_of(h.channels[i]));
        });
    }
    if (detail::has_tube(h)) {
        add("samples in the predicted tube", h.covered_before, h.covered_after,
            detail::counted_share);
        add("width of that tube, in bounds", h.width_before, h.width_after, upward);
    }
    return t;
}

SIVID_DECL table holdout_candidates_table(diagnosis_view const& v, std::size_t most) {
    table t{.columns = {{"candidate"},
                        {"bounds must grow by (proved)", column_kind::number},
                        {"samples in its tube (estimate)", column_kind::number},
                        {"width of the tube, in bounds (estimate)", column_kind::number}},
            .rows = {},
            .caption = "A wide tube covers much and says little."};
    for (cause const* c : foremost(v, v.causes.size())) {
        if (!c->holdout || t.rows.size() == most) continue;
        holdout_figures const& h = *c->holdout;
        if (c == answer_of(v)) t.chosen_row = t.rows.size();
        t.rows.push_back(
            {names_of(c->effects),
             says_something(h.inflation_after) ? inflation_text(h.inflation_after) : "not bounded",
             detail::has_tube(h) ? detail::counted_share(h.covered_after) : "",
             detail::has_tube(h) ? rounded_text(h.width_after, rounding::up) : ""});
    }
    return t.rows.size() > 1 ? t : table{};
}

} // namespace sivid::report

#endif
