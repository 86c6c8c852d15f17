// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_TAYLOR_DETAIL_PARAMETRIC_FLOW_SHARP_HPP
#define SIVID_ENCLOSURE_TAYLOR_DETAIL_PARAMETRIC_FLOW_SHARP_HPP

/// @file
/// The centre of a point in twice the digits (`docs/taylor_models.md`, section 3.8).

#include <sivid/enclosure/series/detail/power_sum.hpp>
#include <sivid/enclosure/taylor/detail/parametric_flow_class.hpp>

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace sivid {

template <class Model, class Centre>
std::size_t parametric_flow<Model, Centre>::sharp_orders(C const& length, std::size_t order) const {
    if constexpr (!std::is_same_v<C, double> || Centre::by_formula) {
        return 0;
    } else {
        if (order == 0 || !sharp_pays_ || unknowns().variables > 0) return 0;
        // What the roundings of an order cost, as `at_time` counts them.
        auto const cost = [&](std::size_t i, std::size_t k, double power) {
            auto const& a = centre_.state(i, k);
            return (a.r() + a.norms()[0] * (static_cast<double>(3 * k + 1) * a.unit)) * power;
        };
        std::size_t orders = 0;
        for (std::size_t i = 0; i < set_.centre.size(); ++i) {
            double all = 0, power = 1;
            for (std::size_t k = 0; k <= order; ++k, power *= length) all += cost(i, k, power);
            if (!(all > allowed(i))) continue;
            power = 1;
            std::size_t k = 0;
            for (; k <= order && all > 0.1 * allowed(i); ++k, power *= length) {
                all -= cost(i, k, power);
            }
            orders = std::max(orders, k);
        }
        return orders;
    }
}

template <class Model, class Centre>
bool parametric_flow<Model, Centre>::expand_sharply(std::size_t orders) {
    if constexpr (!std::is_same_v<C, double>) {
        return false;
    } else {
        if (!sharp_) sharp_.emplace(*flow_, options_.order + 1, variations::by_state);
        if (!sharp_ready_) {
            std::vector<twofold> p;
            for (auto const& s : unknowns().parameters) p.emplace_back(s.centre, 0.0, s.rest);
            sharp_->set_parameters(p);
            sharp_ready_ = true;
        }
        std::vector<twofold> x;
        for (std::size_t i = 0; i < set_.centre.size(); ++i) {
            x.emplace_back(set_.centre[i].c()[0], set_.tail[i], 0.0);
        }
        sharp_->expand(set_.time, twofold(set_.time), x, orders - 1);
        return !sharp_->undefined() && !sharp_->kinked();
    }
}

template <class Model, class Centre>
template <class Coefficient>
typename parametric_flow<Model, Centre>::C
parametric_flow<Model, Centre>::sharpen(std::size_t i, Coefficient const& coefficient,
                                        std::size_t top, C const& to, std::size_t orders,
                                        C const& beyond, polynomial& next) {
    next = widened(next, beyond);
    if constexpr (!std::is_same_v<C, double>) {
        return C(0.0);
    } else {
        polynomial const none;
        auto const high = at_time(
            *shape_,
            [&](std::size_t k) -> polynomial const& { return k < orders ? none : coefficient(k); },
            top, to - set_.time);
        twofold const h = twofold(to) - twofold(set_.time);
        twofold sum = sharp_->state(i, orders - 1);
        for (std::size_t k = orders - 1; k-- > 0;) sum = sum * h + sharp_->state(i, k);
        // No variable enters a point, so there is no spread.
        sum = sum + twofold(high.c()[0], 0.0, (high.r() + high.spread() + beyond) * up);
        if (!(sum.radius() < next.r())) return 0.0;
        next = polynomial::constant(sum.head());
        next.r() = sum.radius();
        return sum.tail();
    }
}

} // namespace sivid

#endif
