// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_IMPL_PAVING_PLOT_IPP
#define SIVID_REPORT_DRAW_IMPL_PAVING_PLOT_IPP

#include <sivid/report/draw/paving_plot.hpp>

namespace sivid::report {

SIVID_DECL std::optional<plane_window> zoom_window(paving_projection const& p, double most_share) {
    range const whole_x = axis_range(p.x.bounds), whole_y = axis_range(p.y.bounds);
    for (region const least : {region::undecided, region::inside}) {
        plane_window w;
        for (projected_box const& b : p.boxes) {
            if (b.verdict >= least) {
                w.x = hull(w.x, intersect(b.x, whole_x));
                w.y = hull(w.y, intersect(b.y, whole_y));
            }
        }
        if (is_empty(w.x) || is_empty(w.y)) continue;
        w.x = intersect(with_margin(axis_range(w.x), 0.08), whole_x);
        w.y = intersect(with_margin(axis_range(w.y), 0.08), whole_y);
        double const share = approximate_width(w.x) / approximate_width(whole_x) *
                             (approximate_width(w.y) / approximate_width(whole_y));
        if (share <= most_share && approximate_width(w.x) > 0 && approximate_width(w.y) > 0) {
            return w;
        }
    }
    return std::nullopt;
}

SIVID_DECL std::vector<attribute_text> paving_attributes(std::vector<paving_projection> const& all,
                                                         std::size_t most,
                                                         paving_words const& words) {
    constexpr double steps = 10'000;
    struct side {
        axis const* what;
        std::vector<projected_box> const* boxes;
        range projected_box::*of;
        range hull;
    };
    std::vector<side> sides;
    std::size_t const count = all.empty() ? 0 : all.front().boxes.size();
    for (paving_projection const& p : all) {
        if (p.boxes.size() != count) return {};
        for (auto const& [what, of] :
             {std::pair{&p.x, &projected_box::x}, {&p.y, &projected_box::y}}) {
            bool const known =
                std::any_of(sides.begin(), sides.end(),
                            [&, w = what](side const& s) { return s.what->label == w->label; });
            if (!known) sides.push_back({what, &p.boxes, of, {}});
        }
    }
    std::vector<std::pair<double, std::size_t>> order; // by size, largest first
    for (std::size_t i = 0; i < count; ++i) {
        double size = 0;
        for (side& s : sides) {
            range const& r = (*s.boxes)[i].*s.of;
            if (!is_finite(r)) return {};
            s.hull = hull(s.hull, r);
            size += std::log(std::max((r.hi - r.lo) / approximate_width(s.what->bounds), 1e-300));
        }
        if (all.front().boxes[i].verdict != region::outside) order.emplace_back(-size, i);
    }
    if (order.empty()) return {};
    std::size_t const listed = std::min(order.size(), most);
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(listed),
                      order.end());
    std::string names, scales, boxes;
    for (side const& s : sides) {
        names += s.what->label + '\n' + unit_text(s.what->unit) + '\n';
        scales += sivid::nearest_text(s.hull.lo) + ' ' + sivid::nearest_text(s.hull.hi) + ' ';
    }
    for (std::size_t k = 0; k < listed; ++k) {
        std::size_t const i = order[k].second;
        boxes += std::to_string(static_cast<int>(all.front().boxes[i].verdict));
        for (side const& s : sides) {
            range const& r = (*s.boxes)[i].*s.of;
            double const width = s.hull.hi - s.hull.lo;
            for (double const end : {r.lo, r.hi})
                boxes += ' ' + std::to_string(
                                   width > 0 ? std::lround((end - s.hull.lo) / width * steps) : 0);
        }
        boxes += ';';
    }
    return {{"sides", names},           {"scales", scales},
            {"boxes", boxes},           {"inside", words.inside},
            {"outside", words.outside}, {"left-out", std::to_string(order.size() - listed)}};
}

SIVID_DECL std::vector<legend_entry> paving_plot_legend(std::vector<paving_projection> const& all,
                                                        paving_words const& words) {
    bool used[4] = {true, false, false, false};
    bool witness = false, zoom = false;
    for (paving_projection const& p : all) {
        for (projected_box const& b : p.boxes) used[static_cast<std::size_t>(b.verdict)] = true;
        witness = witness || p.witness.has_value();
        zoom = zoom || zoom_window(p).has_value();
    }
    return legend_of({{used[3], {symbol::inside, words.inside}},
                      {used[2], {symbol::undecided, "undecided"}},
                      {used[1], {symbol::pending, "pending: not looked at closely"}},
                      {true, {symbol::outside, words.outside}},
                      {witness, {symbol::witness, words.point}},
                      {zoom, {symbol::window, "what the closer look shows"}}});
}

SIVID_DECL svg draw_paving_plot(paving_projection const& p, paving_plot_options const& o) {
    svg out{o.width, o.height,
            (o.title.empty() ? p.y.label + " against " + p.x.label : o.title) + ": paving"};
    axes const a{{p.x.label, p.x.unit, is_empty(o.x_window) ? p.x.bounds : o.x_window},
                 {p.y.label, p.y.unit, is_empty(o.y_window) ? p.y.bounds : o.y_window},
                 {.width = o.width, .height = o.height, .title = o.title, .grid = false}};
    a.open(out);
    out.rect(a.left(), a.top(), a.right() - a.left(), a.bottom() - a.top(),
             {.fill = palette::outside});

    path_data shapes[4];
    for (std::size_t cells = std::max<std::size_t>(o.finest, 4);; cells /= 2) {
        region_raster const raster = project_paving(p.boxes, a.x_bounds(), a.y_bounds(), cells);
        for (path_data& d : shapes) d = {};
        for (region_rect const& r : merge_cells(raster)) {
            double const x = a.px(raster.xs[r.left]), y = a.py(raster.ys[r.high]);
            shapes[static_cast<std::size_t>(r.what)].rect(x, y, a.px(raster.xs[r.right]) - x,
                                                          a.py(raster.ys[r.low]) - y);
        }
        if (cells <= 8 ||
            shapes[1].str().size() + shapes[2].str().size() + shapes[3].str().size() <=
                o.most_bytes) {
            break;
        }
    }
    // The thin outline hides the seams between joined cells and keeps slivers visible.
    out.path(shapes[1],
             {.fill = region_fill(out, symbol::pending), .stroke = palette::pending, .width = 0.4});
    out.path(
        shapes[2],
        {.fill = region_fill(out, symbol::undecided), .stroke = palette::undecided, .width = 0.4});
    out.path(shapes[3], {.fill = palette::inside, .stroke = palette::inside, .width = 0.4});

    if (auto const w = o.mark_zoom ? zoom_window(p) : std::nullopt) {
        double const x = a.px(w->x.lo), y = a.py(w->y.hi);
        double const wide = a.px(w->x.hi) - x, high = a.py(w->y.lo) - y;
        out.rect(x - 3, y - 3, wide + 6, high + 6,
                 {.stroke = palette::blue, .width = 1.3, .dash = "4 2"});
    }
    if (p.witness && is_finite(*p.witness)) {
        draw_witness(out, a.px(p.witness->x), a.py(p.witness->y), "witness: a verified point");
    }
    a.close(out);
    return out;
}

} // namespace sivid::report

#endif
