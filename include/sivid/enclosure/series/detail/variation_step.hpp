// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_SERIES_DETAIL_VARIATION_STEP_HPP
#define SIVID_ENCLOSURE_SERIES_DETAIL_VARIATION_STEP_HPP

#include <sivid/enclosure/flow.hpp>
#include <sivid/enclosure/series/detail/power_sum.hpp>
#include <sivid/enclosure/series/expansion.hpp>
#include <sivid/number/taylor_model.hpp>

#include <cstddef>
#include <vector>

/// @file
/// What a flow's derivatives V by states, or by states and parameters, do during a step
/// (`docs/theory/taylor_models.md`, section 3, (a)). n x m entries, by rows.

namespace sivid::enclosure_detail {

/// Makes computed sums of a few dozen non-negative numbers upper bounds.
inline constexpr double sum_up = 1 + 1e-12;

/// \f$ \sum_{from \le k < order} h^k \|V_k\| \f$, rounded up.
template <class C>
[[nodiscard]] std::vector<C> variation_sizes(flow const& f, expansion<taylor_model<C>> const& e,
                                             std::size_t columns, C const& h, std::size_t order,
                                             std::size_t from) {
    std::vector<C> result(f.states() * columns, C(0.0));
    for (std::size_t i = 0; i < f.states(); ++i) {
        for (std::size_t c = 0; c < columns; ++c) {
            if (!f.sensitive(i, c)) continue;
            C sum{};
            for (std::size_t k = order; k-- > from;) sum = sum * h + e.variation(i, c, k).norm();
            for (std::size_t k = 0; k < from; ++k) sum *= h;
            result[i * columns + c] = sum * sum_up + taylor_model<C>::tiny;
        }
    }
    return result;
}

/// \f$ h^L \|J\| \f$, rounded up, with J the coefficients of order L on a tube.
/// @param power  at least \f$ h^L \f$
template <class C>
[[nodiscard]] std::vector<C>
last_variation_sizes(flow const& f, expansion<taylor_model<C>> const& tube, std::size_t columns,
                     C const& power, std::size_t L) {
    std::vector<C> result(f.states() * columns, C(0.0));
    for (std::size_t i = 0; i < f.states(); ++i) {
        for (std::size_t c = 0; c < columns; ++c) {
            if (!f.sensitive(i, c)) continue;
            result[i * columns + c] = tube.variation(i, c, L).norm() * power * sum_up;
        }
    }
    return result;
}

/// Looks for W > base + last ([1, 0] + W), which bounds \f$ |V - [1, 0]| \f$ on the step.
/// @param base, last  the sizes of orders 1 to L - 1, and those of order L
/// @param rounds      to try; what acts through a chain of states takes one for each to arrive
/// @param w           W in the lanes where it was found, 0 elsewhere
/// @returns the lanes of `pending` where it was found, so where the step is short enough
template <class C>
[[nodiscard]] typename lane_traits<C>::mask
bound_variations(std::vector<C> const& base, std::vector<C> const& last, std::size_t n,
                 std::size_t rounds, typename lane_traits<C>::mask pending, std::vector<C>& w) {
    using side_by_side = lane_traits<C>;
    std::size_t const size = base.size(), m = n == 0 ? 0 : size / n;
    auto const image = [&](std::vector<C> const& x, std::vector<C>& y) {
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = 0; c < m; ++c) {
                C sum = base[i * m + c] + last[i * m + c];
                for (std::size_t l = 0; l < n; ++l) sum += last[i * m + l] * x[l * m + c];
                y[i * m + c] = sum * sum_up;
            }
        }
    };
    std::vector<C> guess(size), inside(size);
    for (std::size_t k = 0; k < size; ++k) guess[k] = base[k] + last[k];
    typename side_by_side::mask found{};
    w.assign(size, C(0.0));
    for (std::size_t round = 0; round < rounds; ++round) {
        image(guess, inside);
        for (std::size_t k = 0; k < size; ++k) guess[k] = inside[k] * 1.1 + 1e-300;
        image(guess, inside);
        typename side_by_side::mask good = pending & !found;
        for (std::size_t k = 0; k < size; ++k) good = good & (inside[k] < guess[k]);
        if (side_by_side::any(good)) {
            for (std::size_t k = 0; k < size; ++k)
                w[k] = side_by_side::select(good, guess[k], w[k]);
            found = found | good;
        }
        if (!side_by_side::any(pending & !found)) break;
    }
    return found;
}

/// \f$ J + |J_x| [-W, W] \f$ of one entry, without the time: what of V is left at order L.
template <class C>
[[nodiscard]] taylor_model<C> last_variation(flow const& f, expansion<taylor_model<C>> const& tube,
                                             std::vector<C> const& w, std::size_t i, std::size_t c,
                                             std::size_t L, model_shape<C> const& shape) {
    auto const m = w.size() / f.states();
    C spread{};
    for (std::size_t l = 0; l < f.states(); ++l) {
        if (f.sensitive(i, l)) spread += tube.variation(i, l, L).norm() * w[l * m + c];
    }
    return widened(without_last_variable(tube.variation(i, c, L), shape), spread * sum_up);
}

/// One entry of V at the end of the step, from its coefficients below L and the last one.
template <class C>
[[nodiscard]] taylor_model<C>
variation_at_end(expansion<taylor_model<C>> const& e, taylor_model<C> const& last, std::size_t i,
                 std::size_t c, std::size_t L, model_shape<C> const& shape, C const& length) {
    return at_time(
        shape,
        [&](std::size_t k) -> taylor_model<C> const& {
            return k < L ? e.variation(i, c, k) : last;
        },
        L, length);
}
/// The same where `rest` bounds what the series leaves out, without a tube.
template <class C>
[[nodiscard]] taylor_model<C> variation_at_end(expansion<taylor_model<C>> const& e, C const& rest,
                                               std::size_t i, std::size_t c, std::size_t L,
                                               model_shape<C> const& shape, C const& length) {
    auto const known = at_time(
        shape, [&](std::size_t k) -> taylor_model<C> const& { return e.variation(i, c, k); }, L - 1,
        length);
    return widened(known, rest);
}

} // namespace sivid::enclosure_detail

#endif
