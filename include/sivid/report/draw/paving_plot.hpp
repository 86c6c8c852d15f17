// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_PAVING_PLOT_HPP
#define SIVID_REPORT_DRAW_PAVING_PLOT_HPP

#include <sivid/number/text/nearest_text.hpp>
#include <sivid/paving/subpaving.hpp>
#include <sivid/report/draw/axes.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The shadow of a paving on a plane.
///
/// Rule: a point of the plane is *inside* when some inside box projects onto it; otherwise
/// *undecided* when an undecided box does; otherwise *pending* when a pending box does; it is
/// *outside* only when everything above it is outside.
namespace sivid::report {

enum class region : std::uint8_t { outside, pending, undecided, inside };

/// One box of the paving, projected on two of its coordinates.
struct projected_box {
    range x{};
    range y{};
    region verdict = region::undecided;
};

inline constexpr std::string_view projection_rule =
    "A point of a projection is painted inside when at least one proven-inside box lies above it; "
    "undecided or pending "
    "when the best box above it is undecided or pending; outside only when every box above it is "
    "proved outside.";

/// The plane cut in cells by break points, each cell with the best region above it.
struct region_raster {
    std::vector<double> xs{};
    std::vector<double> ys{};
    std::vector<region> cells{}; ///< row by row, (ys.size()-1) rows of xs.size()-1
    bool exact = true; ///< the breaks are the boxes' own ends; else each cell has the best region
                       ///< that touches it
    [[nodiscard]] std::size_t columns() const { return xs.size() - 1; }
    [[nodiscard]] std::size_t rows() const { return ys.size() - 1; }
    [[nodiscard]] region at(std::size_t column, std::size_t row) const {
        return cells[row * columns() + column];
    }
};

/// A merged rectangle of cells of one region.
struct region_rect {
    std::size_t left, right, low, high; ///< cell numbers, right and high exclusive
    region what;
};

/// The projection of a paving on two parameters. Outside boxes may be left out: what no box covers
/// counts as outside.
struct paving_projection {
    axis x{}; ///< bounds: the prior
    axis y{};
    std::vector<projected_box> boxes{};
    std::optional<point> witness{}; ///< a verified point
};

struct plane_window {
    range x{};
    range y{};
};

/// What the regions of a paving mean.
struct paving_words {
    std::string inside = "inside: proved to explain the data";
    std::string outside = "outside: proved impossible";
    std::string point = "witness";
    std::string whole = "whole prior";
};

/// A paving with what its sides are called.
struct named_paving {
    subpaving const* paving = nullptr;
    std::vector<axis> sides{};     ///< bounds: the prior
    std::vector<range> hull{};     ///< per side: what the data leave of it
    std::vector<double> witness{}; ///< a verified point; may be empty
};

/// A box of the plane.
struct plane_box {
    range x{};
    range y{};
};

/// A place and heading [rad] of the craft on the non-validated line.
struct pose {
    double x = 0;
    double y = 0;
    double heading = 0;
};

/// A motion in the plane.
struct plane_series {
    std::string x_name = "x";
    std::string y_name = "y";
    std::string unit = "m";
    std::vector<plane_box> tube{};     ///< proven enclosures, one for each step
    std::vector<plane_box> measured{}; ///< measured position intervals
    std::vector<point> reference{};    ///< not validated
    std::vector<pose> poses{};         ///< not validated; drawn as small arrowheads
};

namespace detail {

/// True when r has points inside the window, or is a single value on it.
inline bool shows(range const& window, range const& r) {
    return (r.lo < window.hi && r.hi > window.lo) ||
           (r.lo == r.hi && r.lo >= window.lo && r.hi <= window.hi);
}

/// Break points of one axis: the ends of the boxes when at most `most` cells result, else evenly
/// spaced (also when a box has no width there, so that it cannot take a wide cell).
/// @returns whether they are the ends
inline bool axis_breaks(std::vector<projected_box> const& boxes, range projected_box::*side,
                        range const& window, std::size_t most, std::vector<double>& out) {
    out = {window.lo, window.hi};
    bool thin = false;
    for (projected_box const& b : boxes) {
        range const& r = b.*side;
        if (b.verdict != region::outside && shows(window, r)) {
            thin = thin || r.lo == r.hi;
            for (double const end : {r.lo, r.hi}) {
                if (end > window.lo && end < window.hi) out.push_back(end);
            }
        }
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    if (out.size() <= most + 1 && !thin) return true;
    out.resize(most + 1);
    for (std::size_t i = 0; i <= most; ++i) {
        double const share = static_cast<double>(i) / static_cast<double>(most);
        out[i] = i == most ? window.hi : window.lo + share * (window.hi - window.lo);
    }
    return false;
}

/// The cells that [r] touches, [first, last); at least one, so that thin pieces stay visible.
inline std::array<std::size_t, 2> touched(std::vector<double> const& breaks, range const& r) {
    std::size_t const cells = breaks.size() - 1;
    auto const after = std::upper_bound(breaks.begin(), breaks.end(), r.lo) - breaks.begin();
    auto const first =
        std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - 1, 0)), cells - 1);
    auto const until = static_cast<std::size_t>(
        std::lower_bound(breaks.begin(), breaks.end(), r.hi) - breaks.begin());
    return {first, std::clamp(until, first + 1, cells)};
}

inline void add_box(path_data& d, axes const& a, plane_box const& b, double least) {
    double const x = a.px(b.x.lo), y = a.py(b.y.hi);
    double const w = a.px(b.x.hi) - x, h = a.py(b.y.lo) - y;
    double const more_w = std::max(0.0, least - w), more_h = std::max(0.0, least - h);
    d.rect(x - more_w / 2, y - more_h / 2, w + more_w, h + more_h);
}

/// The axes of a plot of a plane.
inline axes plane_axes(plane_series const& s, double width, double height) {
    range xs;
    range ys;
    auto const include = [&](plane_box const& b) {
        if (is_finite(b.x) && is_finite(b.y)) {
            xs = hull(xs, b.x);
            ys = hull(ys, b.y);
        }
    };
    for (plane_box const& b : s.measured) include(b);
    for (point const& p : s.reference) include({{p.x, p.x}, {p.y, p.y}});
    // A tube that bursts must not hide the measurements.
    range const x_core = xs, y_core = ys;
    for (plane_box const& b : s.tube) include(b);
    if (!is_empty(x_core)) {
        double const room = std::max({approximate_width(x_core), approximate_width(y_core), 1e-9});
        xs = intersect(xs, {x_core.lo - room, x_core.hi + room});
        ys = intersect(ys, {y_core.lo - room, y_core.hi + room});
    }
    return {{s.x_name, s.unit, with_margin(axis_range(xs), 0.04)},
            {s.y_name, s.unit, with_margin(axis_range(ys), 0.08)},
            {.width = width, .height = height, .equal_aspect = true}};
}

inline void draw_start(svg& out, axes const& a, point const& start) {
    out.circle(a.px(start.x), a.py(start.y), 4, {.fill = palette::ink}, "start");
    double const wide = approximate_text_width("start", 11) + 6;
    out.rect(a.px(start.x) - wide / 2, a.py(start.y) - 20, wide, 14,
             {.fill = palette::paper, .opacity = 0.8}, 3);
    out.text(a.px(start.x), a.py(start.y) - 9, "start", {.size = 11, .align = anchor::middle});
}

} // namespace detail

/// Projects boxes on a window of the plane, at most `most` cells a side. What no box covers is
/// outside: contraction removes proven-outside parts without leaving a box.
/// @given  window finite, of positive width
/// @cost   O(boxes log(cells) + cells), whatever the overlap
[[nodiscard]] inline region_raster project_paving(std::vector<projected_box> const& boxes,
                                                  range const& x, range const& y,
                                                  std::size_t most) {
    region_raster out;
    auto const seen = [&](projected_box const& b) {
        return b.verdict != region::outside && detail::shows(x, b.x) && detail::shows(y, b.y);
    };
    bool const exact_x =
        detail::axis_breaks(boxes, &projected_box::x, x, std::max<std::size_t>(most, 1), out.xs);
    bool const exact_y =
        detail::axis_breaks(boxes, &projected_box::y, y, std::max<std::size_t>(most, 1), out.ys);
    out.exact = exact_x && exact_y;

    // Count the boxes of each region above each cell by two-dimensional running sums.
    std::size_t const columns = out.columns(), rows = out.rows(), stride = columns + 1;
    out.cells.assign(columns * rows, region::outside);
    for (region const what : {region::pending, region::undecided, region::inside}) {
        std::vector<std::int32_t> change(stride * (rows + 1), 0);
        for (projected_box const& b : boxes) {
            if (b.verdict == what && seen(b)) {
                auto const [left, right] = detail::touched(out.xs, b.x);
                auto const [low, high] = detail::touched(out.ys, b.y);
                ++change[low * stride + left];
                --change[low * stride + right];
                --change[high * stride + left];
                ++change[high * stride + right];
            }
        }
        for (std::size_t r = 0; r < rows; ++r) {
            std::int32_t along = 0;
            for (std::size_t c = 0; c < columns; ++c) {
                along += change[r * stride + c];
                std::int32_t const above = along + (r > 0 ? change[(r - 1) * stride + c] : 0);
                change[r * stride + c] = above;
                if (above > 0) out.cells[r * columns + c] = what;
            }
        }
    }
    return out;
}

/// Joins cells of one region to rectangles: runs along rows, equal runs over rows. The outside is
/// left out (it is the ground).
[[nodiscard]] inline std::vector<region_rect> merge_cells(region_raster const& raster) {
    std::vector<region_rect> done;
    std::vector<region_rect> open;
    std::vector<region_rect> row_runs;
    for (std::size_t r = 0; r <= raster.rows(); ++r) {
        row_runs.clear();
        for (std::size_t c = 0; r < raster.rows() && c < raster.columns();) {
            region const what = raster.at(c, r);
            std::size_t end = c + 1;
            while (end < raster.columns() && raster.at(end, r) == what) ++end;
            if (what != region::outside) row_runs.push_back({c, end, r, r + 1, what});
            c = end;
        }
        // Both lists are ordered by their left end: one pass finds the runs that go on.
        std::size_t k = 0;
        for (region_rect& run : row_runs) {
            while (k < open.size() && open[k].left < run.left) done.push_back(open[k++]);
            if (k < open.size() && open[k].left == run.left && open[k].right == run.right &&
                open[k].what == run.what) {
                run.low = open[k++].low;
            }
        }
        done.insert(done.end(), open.begin() + static_cast<std::ptrdiff_t>(k), open.end());
        open = row_runs;
    }
    return done;
}

/// What is worth a closer look: the hull of inside and undecided boxes, or of the inside boxes
/// when that is nearly all of the prior. Nothing when the whole view shows it well.
[[nodiscard]] inline std::optional<plane_window> zoom_window(paving_projection const& p,
                                                             double most_share = 0.55) {
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

/// The boxes behind the projections of one paving, for the page's script: attributes of the figure
/// that shows them. Ends are rounded to the nearest of 10^4 steps over all boxes: enough to show
/// where a box lies, no bound.
/// @given  box i of each projection belongs to the same box of the paving; else nothing comes back
/// @param most  of so many boxes, the largest; how many are left out is said
[[nodiscard]] inline std::vector<attribute_text>
paving_attributes(std::vector<paving_projection> const& all, std::size_t most = 3000,
                  paving_words const& words = {}) {
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

/// The legend of paving plots, with the regions that occur.
[[nodiscard]] inline std::vector<legend_entry>
paving_plot_legend(std::vector<paving_projection> const& all, paving_words const& words = {}) {
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

/// The projection of a paving, on a closer window of it or whole with that of `zoom_window`
/// outlined. However many boxes come in, the text stays within 150 kB and a small constant: cells
/// of one region are joined, and coarser cells are taken until they fit.
[[nodiscard]] inline svg draw_paving_plot(paving_projection const& p, std::string const& title,
                                          std::optional<plane_window> const& closer = {}) {
    constexpr double width = 440, height = 310;
    constexpr std::size_t finest = 640;         // cells a side before the text limit
    constexpr std::size_t most_bytes = 150'000; // of the regions' outlines
    svg out{width, height, title + ": paving"};
    axes const a{{p.x.label, p.x.unit, closer ? closer->x : p.x.bounds},
                 {p.y.label, p.y.unit, closer ? closer->y : p.y.bounds},
                 {.width = width, .height = height, .title = title, .grid = false}};
    a.open(out);
    out.rect(a.left(), a.top(), a.right() - a.left(), a.bottom() - a.top(),
             {.fill = palette::outside});

    path_data shapes[4];
    for (std::size_t cells = finest;; cells /= 2) {
        region_raster const raster = project_paving(p.boxes, a.x_bounds(), a.y_bounds(), cells);
        for (path_data& d : shapes) d = {};
        for (region_rect const& r : merge_cells(raster)) {
            double const x = a.px(raster.xs[r.left]), y = a.py(raster.ys[r.high]);
            shapes[static_cast<std::size_t>(r.what)].rect(x, y, a.px(raster.xs[r.right]) - x,
                                                          a.py(raster.ys[r.low]) - y);
        }
        if (cells <= 8 ||
            shapes[1].str().size() + shapes[2].str().size() + shapes[3].str().size() <=
                most_bytes) {
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

    if (auto const w = closer ? std::nullopt : zoom_window(p)) {
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

/// The projection of a paving on its sides a and b.
inline paving_projection projection(named_paving const& p, std::size_t a, std::size_t b) {
    paving_projection out{.x = p.sides[a], .y = p.sides[b]};
    auto const side = [](box const& set, std::size_t j) {
        return range{lower(set[j]), upper(set[j])};
    };
    for (paved_box const& piece : p.paving->boxes()) {
        if (piece.verdict == box_verdict::outside) continue;
        out.boxes.push_back({side(piece.set, a), side(piece.set, b),
                             piece.verdict == box_verdict::inside      ? region::inside
                             : piece.verdict == box_verdict::undecided ? region::undecided
                                                                       : region::pending});
    }
    if (!p.witness.empty()) out.witness = point{p.witness[a], p.witness[b]};
    return out;
}

/// The projections worth a picture: on all pairs of sides when these are few, else of the four that
/// the data narrow most.
/// @param first  sides whose pairs come first
/// @param most   so many projections
[[nodiscard]] inline std::vector<paving_projection>
projections(named_paving const& p, std::vector<std::size_t> const& first, std::size_t most) {
    std::vector<std::size_t> order;
    for (std::size_t j = 0; j < p.sides.size(); ++j) {
        if (p.sides[j].bounds.lo < p.sides[j].bounds.hi) order.push_back(j);
    }
    auto const share = [&](std::size_t j) {
        return approximate_width(p.hull[j]) / approximate_width(p.sides[j].bounds);
    };
    if (order.size() > 4) {
        std::stable_sort(order.begin(), order.end(),
                         [&](auto a, auto b) { return share(a) < share(b); });
        order.resize(4);
    }
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t a = 0; a < order.size(); ++a) {
        for (std::size_t b = a + 1; b < order.size(); ++b) pairs.emplace_back(order[a], order[b]);
    }
    std::stable_partition(pairs.begin(), pairs.end(), [&](auto const& pair) {
        return std::count(first.begin(), first.end(), pair.first) +
                   std::count(first.begin(), first.end(), pair.second) ==
               2;
    });
    pairs.resize(std::min(pairs.size(), most));
    std::vector<paving_projection> out;
    for (auto const& [a, b] : pairs) out.push_back(projection(p, a, b));
    return out;
}

[[nodiscard]] inline std::vector<legend_entry> plane_plot_legend(plane_series const& s) {
    return legend_of({{!s.tube.empty(), {symbol::tube, "proven enclosure of the motion"}},
                      {!s.measured.empty(), {symbol::measured_box, "measured position"}},
                      {!s.reference.empty(), {symbol::reference, "reference, not validated"}},
                      {!s.poses.empty(), {symbol::heading, "heading on the reference"}}});
}

/// Joins neighbours by their hull until at most `most` boxes are left.
[[nodiscard]] inline std::vector<plane_box> merged(std::vector<plane_box> boxes, std::size_t most) {
    while (boxes.size() > std::max<std::size_t>(most, 1)) {
        std::size_t n = 0;
        for (std::size_t i = 0; i < boxes.size(); i += 2) {
            plane_box const& next = boxes[std::min(i + 1, boxes.size() - 1)];
            boxes[n++] = {hull(boxes[i].x, next.x), hull(boxes[i].y, next.y)};
        }
        boxes.resize(n);
    }
    return boxes;
}

/// A motion seen from above: the proven boxes step by step, the measured positions and a
/// reference line that is not validated; equal scales on both axes. Beyond some thousand boxes
/// neighbours are joined, which only enlarges them.
[[nodiscard]] inline svg draw_plane_plot(plane_series const& s) {
    double const width = 1000, height = 330;
    svg out{width, height, s.y_name + " against " + s.x_name};
    axes const a = detail::plane_axes(s, width, height);
    a.open(out);
    constexpr std::size_t most_boxes = 4000;
    path_data boxes;
    for (plane_box const& b : merged(s.tube, most_boxes)) {
        if (!is_empty(b.x) && !is_empty(b.y)) detail::add_box(boxes, a, b, 1.2);
    }
    // One path: where boxes overlap, the colour does not add up.
    out.path(boxes,
             {.fill = palette::tube, .stroke = palette::tube_edge, .width = 0.5, .opacity = 0.6});
    path_data line;
    bool down = false;
    for (point const& p : s.reference) {
        if (is_finite(p)) down ? line.line(a.px(p.x), a.py(p.y)) : line.move(a.px(p.x), a.py(p.y));
        down = is_finite(p);
    }
    out.path(line, {.stroke = palette::truth, .width = 1.5, .dash = "5 3"});
    path_data measured;
    for (plane_box const& b : merged(s.measured, most_boxes)) {
        if (is_finite(b.x) && is_finite(b.y)) detail::add_box(measured, a, b, 3);
    }
    out.path(measured, {.stroke = palette::measurement, .width = 1});
    path_data arrows;
    for (pose const& p : s.poses) {
        if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.heading)) {
            add_arrowhead(arrows, a.px(p.x), a.py(p.y), p.heading);
        }
    }
    out.path(arrows, {.fill = palette::paper, .stroke = palette::truth, .width = 1.2},
             "heading, not validated");
    if (!s.reference.empty() && is_finite(s.reference.front()))
        detail::draw_start(out, a, s.reference.front());
    a.close(out);
    if (boxes.empty() && measured.empty() && line.empty()) a.say(out, "no data");
    return out;
}

} // namespace sivid::report

#endif
