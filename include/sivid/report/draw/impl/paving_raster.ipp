// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_IMPL_PAVING_RASTER_IPP
#define SIVID_REPORT_DRAW_IMPL_PAVING_RASTER_IPP

#include <sivid/report/draw/detail/paving_raster.hpp>

namespace sivid::report {

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

} // namespace detail

SIVID_DECL region_raster project_paving(std::vector<projected_box> const& boxes, range const& x,
                                        range const& y, std::size_t most) {
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

SIVID_DECL std::vector<region_rect> merge_cells(region_raster const& raster) {
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

} // namespace sivid::report

#endif
