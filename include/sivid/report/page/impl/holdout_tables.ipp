// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_IMPL_HOLDOUT_TABLES_IPP
#define SIVID_REPORT_PAGE_IMPL_HOLDOUT_TABLES_IPP

#include <sivid/report/page/detail/holdout_tables.hpp>

namespace sivid::report {

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
        t.rows.push_back(
            {"the same, for every parameter that fits",
             inflation(h.over_fits_before), inflation(h.over_fits_after), proved});
    }
    if (says_shrink(shrink)) t.rows.push_back({"gap removed", "", shrink_text(shrink), proved});
    auto const number = [](double x) {
        return std::isfinite(x) ? rounded_text(x, rounding::nearest) : std::string{"?"};
    };
    auto const add = [&](std::string const& name, double before, double after,
                         std::string const& unit, double factor) {
        if (std::isfinite(before) || std::isfinite(after)) {
            t.rows.push_back(
                {name, number(before * factor) + unit, number(after * factor) + unit, estimate});
        }
    };
    for (holdout_view::channel const& c : h.channels) {
        add("RMSE of " + c.name, c.rmse_before, c.rmse_after, unit_suffix(c.unit), 1);
    }
    add("samples in the predicted tube", h.covered_before, h.covered_after, "\xC2\xA0%", 100);
    add("width of that tube, in bounds", h.width_before, h.width_after, "", 1);
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
             std::isfinite(h.covered_after)
                 ? rounded_text(100 * h.covered_after, rounding::nearest) + "\xC2\xA0%"
                 : "",
             std::isfinite(h.width_after) ? rounded_text(h.width_after, rounding::nearest) : ""});
    }
    return t.rows.size() > 1 ? t : table{};
}

} // namespace sivid::report

#endif
