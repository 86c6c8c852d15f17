// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_IMPL_IDENTIFICATION_PARAMETERS_IPP
#define SIVID_REPORT_PAGE_IMPL_IDENTIFICATION_PARAMETERS_IPP

#include <sivid/report/page/detail/identification_parameters.hpp>

namespace sivid::report::detail {

SIVID_DECL void add_parameters(page& out, identification_view const& v) {
    if (v.parameters.empty()) return;
    out.section("Parameters");
    std::vector<interval_row> rows;
    table t{.columns = {{"parameter", column_kind::symbol},
                        {"unit"},
                        {"prior", column_kind::number},
                        {"hull (proved)", column_kind::number},
                        {"left of the prior", column_kind::number},
                        {"witness, about", column_kind::number},
                        {"meaning", column_kind::note}},
            .caption = "The hull contains every value that can explain the data; its ends are "
                       "rounded outward. What is left of the prior is at most the share of its "
                       "range that is given: values between the ends may be excluded, too."};
    for (parameter_view const& p : v.parameters) {
        interval_row row{p.name, p.unit, p.prior, p.hull};
        if (v.witness) {
            for (named_estimate const& w : v.witness->parameters) {
                if (w.name == p.name) row.witness = w.value;
            }
        }
        double const share = share_of_prior(p);
        t.rows.push_back(
            {p.name, unit_text(p.unit), given_text(p.prior), outward_text_within(p.hull, p.prior),
             std::isnan(share) ? "\xE2\x80\x93"
                               : std::string{"\xE2\x89\xA4 "} + at_most_percent(share),
             row.witness
                 ? rounded_text(*row.witness, rounding::nearest, {.significant = 6, .shift = 0})
                 : std::string{},
             p.meaning});
        rows.push_back(std::move(row));
    }
    std::vector<legend_entry> legend{{symbol::prior, "prior"},
                                     {symbol::hull, "hull: all that can explain the data"}};
    if (v.witness) legend.push_back({symbol::witness, "witness"});
    out.add(figure{.panels = {draw_interval_chart(rows, {.width = 1000, .title = ""})},
                   .legend = legend,
                   .title = "What the data leave of the prior.",
                   .caption = "Each row has its own scale, from one end of the prior to the other.",
                   .layout = panel_layout::wide});
    out.add(t);
    if (!v.combinations.empty()) {
        out.subsection("Combinations that the data fix");
        table c{.columns = {{"combination", column_kind::symbol},
                            {"unit"},
                            {"over the prior", column_kind::number},
                            {"hull (proved)", column_kind::number},
                            {"remark", column_kind::note}}};
        for (combination_view const& k : v.combinations) {
            c.rows.push_back({formula_text(k.formula), unit_text(k.unit),
                              is_empty(k.prior) ? "" : outward_text(k.prior), outward_text(k.hull),
                              k.note});
        }
        out.add(c);
    }
}

SIVID_DECL figure paving_figure(std::vector<paving_projection> const& pavings, std::string title,
                                std::string caption, paving_words const& words) {
    // The zoom stands beside or below its whole view in the same order, so panels go in pairs.
    figure f{.legend = paving_plot_legend(pavings, words),
             .title = std::move(title),
             .caption = std::move(caption),
             .layout = panel_layout::pair,
             .data = paving_attributes(pavings, 3000, words)};
    for (paving_projection const& p : pavings) {
        std::string const name = p.y.label + " against " + p.x.label;
        auto const zoom = zoom_window(p);
        f.panels.push_back(draw_paving_plot(
            p,
            {.width = 440, .height = 310, .title = name + ": " + words.whole, .mark_zoom = true}));
        if (zoom) {
            f.panels.push_back(draw_paving_plot(p, {.width = 440,
                                                    .height = 310,
                                                    .title = name + ": closer",
                                                    .x_window = zoom->x,
                                                    .y_window = zoom->y}));
        }
    }
    return f;
}

SIVID_DECL void add_pavings(page& out, identification_view const& v) {
    if (v.pavings.empty()) return;
    out.section("The set of parameters that explain the data");
    bool const anything =
        std::any_of(v.pavings.begin(), v.pavings.end(), [](paving_projection const& p) {
            return std::any_of(p.boxes.begin(), p.boxes.end(),
                               [](projected_box const& b) { return b.verdict != region::outside; });
        });
    if (!anything) {
        out.prose("It is empty: every box of the paving was proved outside.");
        return;
    }
    if (!v.product_pavings.empty()) {
        out.add(paving_figure(
            v.product_pavings, "In the coordinates that the data fix.",
            std::string{"The search ran here, where a product of parameters counts as one: all "
                        "parameters whose products lie in an inside box are proved to explain the "
                        "data, all others than those of the boxes drawn are excluded. "}
                .append(projection_rule)));
    }
    out.add(paving_figure(v.pavings, "Projections of the paving of the parameters.",
                          std::string{projection_rule} +
                              " Regions are drawn with a hairline around them so that slivers can "
                              "be seen: the better region may look larger than it is by that much, "
                              "the outside never does."));
}

SIVID_DECL void add_witness(page& out, named_witness const& w) {
    out.subsection("The witness");
    out.prose("One point that was verified by validated integration: " + values_text(w.parameters) +
              ".");
    std::vector<std::string> starts;
    for (named_witness::start const& s : w.starts)
        starts.push_back("Scenario " + s.scenario + " starts at " + values_text(s.states) + ".");
    out.bullets(starts);
}

} // namespace sivid::report::detail

#endif
