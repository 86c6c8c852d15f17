// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_FRAME_DETAIL_LANE_FRAME_HPP
#define SIVID_SPACE_FRAME_DETAIL_LANE_FRAME_HPP

#include <sivid/number/pack/lanes.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sivid {

/// An almost orthogonal basis in each lane, with a proven bound of what it lacks.
template <class C>
struct lane_frame {
    std::vector<std::vector<C>> axis; ///< axis[k] is \f$ Q_k \f$
    /// \f$ |Q^{-1} g - Q^T g|_k \le defect \cdot \max_l |Q^T g|_l \f$ for every vector g.
    C defect{};
};

namespace space_detail {

template <class C>
[[nodiscard]] C dot(std::vector<C> const& a, std::vector<C> const& b) {
    C sum{};
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}
/// Takes away what v has along q.
template <class C>
void remove_share(std::vector<C>& v, std::vector<C> const& q) {
    C const share = dot(v, q);
    for (std::size_t i = 0; i < v.size(); ++i) v[i] -= q[i] * share;
}
/// 0 stays 0.
/// @param square  about the square of its length
template <class C>
void normalise(std::vector<C>& v, C const& square) {
    C const factor = each_lane<C>([&](std::size_t l) {
        double const x = lane_traits<C>::get(square, l);
        return x > 0 ? 1 / std::sqrt(x) : 0.0;
    });
    for (auto& x : v) x *= factor;
}
/// Bounds \f$ \|Q^T Q - 1\|_\infty \f$.
template <class C>
[[nodiscard]] C orthogonality_defect(std::vector<std::vector<C>> const& axis) {
    constexpr double unit = std::numeric_limits<double>::epsilon();
    auto const n = axis.size();
    C rho{};
    for (std::size_t k = 0; k < n; ++k) {
        C row{};
        for (std::size_t l = 0; l < n; ++l) {
            row += lane_traits<C>::abs(dot(axis[k], axis[l]) - C(k == l ? 1.0 : 0.0));
        }
        rho = lane_traits<C>::max(rho, row);
    }
    // Entries are at most 1 and a little; every sum of n products errs by less than 2n^2 units.
    return rho * (1 + 1e-12) + 4.0 * static_cast<double>(n * n * n) * unit;
}

/// In each lane the longest of the vectors, which is 0 there from then on. Of nearly equal ones the
/// first, so that no rounding decides.
/// @param squares  of their lengths
/// @returns it, and the square of its length
template <class C>
[[nodiscard]] std::pair<std::vector<C>, C> take_longest(std::vector<std::vector<C>>& vectors,
                                                        std::vector<C> const& squares) {
    using side_by_side = lane_traits<C>;
    std::vector<C> longest(vectors.front().size());
    C square{}, which(-1.0);
    for (std::size_t j = 0; j < vectors.size(); ++j) {
        auto const longer = squares[j] > square * (1 + 1e-9);
        square = side_by_side::select(longer, squares[j], square);
        which = side_by_side::select(longer, C(static_cast<double>(j)), which);
    }
    for (std::size_t j = 0; j < vectors.size(); ++j) {
        auto const taken = which == C(static_cast<double>(j));
        for (std::size_t i = 0; i < longest.size(); ++i) {
            longest[i] = side_by_side::select(taken, vectors[j][i], longest[i]);
            vectors[j][i] = side_by_side::select(taken, C(0.0), vectors[j][i]);
        }
    }
    return {std::move(longest), square};
}

} // namespace space_detail

/// Gram-Schmidt, twice, along the longest of the given directions, in each lane its own.
/// Where they do not span the space, or numbers are not finite, unit vectors take their place.
/// @guarantee  `defect`: with \f$ Q^T Q = 1 + R \f$, \f$ \|R\|_\infty \le \rho < 1 \f$,
///   \f$ Q^{-1} = (1+R)^{-1} Q^T \f$ and the difference is at most \f$ \rho/(1-\rho) \f$ of
///   \f$ Q^T g \f$ in the maximum norm. Lanes in which that fails get the identity.
/// @cost  O(m n^2) for m directions of n components
template <class C>
[[nodiscard]] lane_frame<C> make_lane_frame(std::vector<std::vector<C>> directions) {
    using side_by_side = lane_traits<C>;
    using namespace space_detail;
    auto const n = directions.empty() ? 0 : directions.front().size();
    std::vector<C> squares;
    C largest{};
    for (auto const& d : directions) {
        squares.push_back(dot(d, d));
        largest = side_by_side::max(largest, squares.back());
    }
    // Short unit vectors come last, and complete the basis.
    C const little = each_lane<C>([&](std::size_t l) {
        double const x = side_by_side::get(largest, l);
        return x > 1e-200 && x < 1e200 ? 1e-9 * std::sqrt(x) : 1.0;
    });
    for (std::size_t i = 0; i < n; ++i) {
        directions.emplace_back(n);
        directions.back()[i] = little;
        squares.push_back(little * little);
    }
    lane_frame<C> frame;
    for (std::size_t k = 0; k < n; ++k) {
        auto [q, square] = take_longest(directions, squares);
        normalise(q, square);
        for (auto const& p : frame.axis) remove_share(q, p);
        normalise(q, dot(q, q));
        for (std::size_t j = 0; j < directions.size(); ++j) {
            remove_share(directions[j], q);
            squares[j] = dot(directions[j], directions[j]);
        }
        frame.axis.push_back(std::move(q));
    }
    C const rho = orthogonality_defect(frame.axis);
    auto const good = rho < C(0.01);
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t i = 0; i < n; ++i) {
            frame.axis[k][i] = side_by_side::select(good, frame.axis[k][i], C(k == i ? 1.0 : 0.0));
        }
    }
    frame.defect = side_by_side::select(good, rho * 1.02, C(0.0));
    return frame;
}

} // namespace sivid

#endif
