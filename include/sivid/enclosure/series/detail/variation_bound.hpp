// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_SERIES_DETAIL_VARIATION_BOUND_HPP
#define SIVID_ENCLOSURE_SERIES_DETAIL_VARIATION_BOUND_HPP

#include <sivid/enclosure/series/expansion.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace sivid {

/// Bounds the change of the flow's derivatives over a step of length at most h.
///   V' = A V + [0, F] with V(0) = [1, 0]; with \f$ |A(s)| \le M, |F(s)| \le N \f$ on the tube,
///   any E with \f$ h (M (|V_0| + E) + [0, N]) \le E \f$ (componentwise) has
///   \f$ |V(s) - V(0)| \le E \f$ on [0, h]: the Picard operator maps that set into itself.
/// @param e  an expansion with variations over the tube
/// @returns E, n x (n + parameters), or nothing when no E was found (h |A| too large)
/// @cost  O(iterations * entries * columns)
template <class I>
[[nodiscard]] std::optional<Eigen::MatrixXd> bound_variation(flow const& f, expansion<I> const& e,
                                                             double h) {
    using traits = interval_traits<I>;
    auto const n = f.states();
    auto const columns = n + f.parameters();
    std::vector<double> size;
    for (auto const& entry : f.entries()) {
        double m = 0;
        for (std::size_t l = 0; l < traits::lanes; ++l) {
            I const& a = e.jacobian(entry);
            m = std::max({m, -traits::lower(a, l), traits::upper(a, l)});
        }
        if (!std::isfinite(m)) return std::nullopt;
        size.push_back(m);
    }
    using bound = interval_traits<interval>;
    // Picard image of E, rounded up.
    auto const image = [&](Eigen::MatrixXd const& bounds) {
        std::vector<double> sum(n * columns, 0.0);
        for (std::size_t k = 0; k < f.entries().size(); ++k) {
            auto const& entry = f.entries()[k];
            auto const m = bound::point(size[k]);
            auto const accumulate = [&](std::size_t c, interval const& v) {
                auto& s = sum[entry.row * columns + c];
                s = bound::upper(bound::add(bound::point(s), bound::mul(m, v)));
            };
            if (entry.column >= n) {
                accumulate(entry.column, bound::point(1.0));
                continue;
            }
            for (std::size_t c = 0; c < columns; ++c) {
                if (!f.sensitive(entry.column, c)) continue;
                auto const v = bound::point(
                    bounds(static_cast<Eigen::Index>(entry.column), static_cast<Eigen::Index>(c)));
                accumulate(c, entry.column == c ? bound::add(v, bound::point(1.0)) : v);
            }
        }
        Eigen::MatrixXd result(bounds.rows(), bounds.cols());
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = 0; c < columns; ++c) {
                result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) =
                    bound::upper(bound::mul(bound::point(h), bound::point(sum[i * columns + c])));
            }
        }
        return result;
    };
    Eigen::MatrixXd guess =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(columns));
    // What acts through a chain of states takes a round for each of them to arrive.
    for (std::size_t round = 0; round < 12 + n; ++round) {
        auto const next = image(guess);
        if (!next.allFinite()) return std::nullopt;
        if (round > 0 && (next.array() <= guess.array()).all()) return next;
        // The first rounds approach the fixed point from below; then it is overstepped a little.
        guess = round < 3 ? next : Eigen::MatrixXd(1.1 * next);
    }
    return std::nullopt;
}

} // namespace sivid

#endif
