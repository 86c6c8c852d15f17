// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_TAYLOR_DETAIL_PARAMETRIC_FLOW_ACCEPT_HPP
#define SIVID_ENCLOSURE_TAYLOR_DETAIL_PARAMETRIC_FLOW_ACCEPT_HPP

/// @file
/// The sets after a proved step.

#include <sivid/enclosure/series/detail/power_sum.hpp>
#include <sivid/enclosure/series/detail/variation_step.hpp>
#include <sivid/enclosure/taylor/detail/parametric_flow_class.hpp>
#include <sivid/enclosure/taylor/detail/parametric_flow_sharp.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

template <class Model, class Centre>
void parametric_flow<Model, Centre>::accept(mask moved, C const& to, std::size_t order,
                                            std::size_t flow_order, square const& w, mask jumps) {
    using namespace enclosure_detail;
    auto const n = flow_->states();
    C const length = to - set_.time; // off by less than a unit
    std::vector<C> lost(n);
    std::vector<polynomial> next(n);
    std::vector<C> tails(n);
    std::size_t const sharp = Centre::by_formula ? 0 : sharp_orders(length, order);
    bool const sharply = sharp > 0 && expand_sharply(sharp);
    bool pays = false;
    std::size_t const top = tails_ ? order : order + 1;
    for (std::size_t i = 0; i < n; ++i) {
        if constexpr (Centre::by_formula) {
            next[i] = method_.at_end(i, tube_.state(i, order + 1));
            lost[i] = next[i].r();
            next[i].r() = 0.0;
            continue;
        }
        polynomial last;
        if (!tails_) last = without_last_variable(tube_.state(i, order + 1), *shape_);
        auto const coefficient = [&](std::size_t k) -> polynomial const& {
            return k <= order ? centre_.state(i, k) : last;
        };
        next[i] = at_time(*shape_, coefficient, top, length);
        if (sharply) {
            C const rounding = next[i].r();
            C const beyond = tails_ ? truncation_[i] : C(0.0);
            tails[i] = sharpen(i, coefficient, top, to, sharp, beyond, next[i]);
            pays = pays || side_by_side::all(next[i].r() < beyond + rounding * 0.5);
        } else if (tails_) {
            next[i] = widened(next[i], truncation_[i]);
        }
        lost[i] = side_by_side::select(moved, next[i].r(), C(0.0));
        next[i].r() = 0.0;
    }
    if (sharp > 0) sharp_pays_ = pays;
    // What V's Lagrange term adds to the reach.
    std::vector<C> added(n);
    C flow_power = length;
    for (std::size_t k = 1; k < flow_order; ++k) flow_power *= length;
    if (!side_by_side::all(jumps | !moved)) {
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = 0; c < n; ++c) {
                if (!flow_->sensitive(i, c)) continue;
                added[i] += (tails_ ? derivative_tail_.variation(i, c)
                                    : tube_.variation(i, c, flow_order).norm() * flow_power) *
                            set_.reach[c];
            }
        }
    }
    if (!side_by_side::all(jumps | !moved) && !set_.columns.empty()) {
        std::vector<column_entry> j(n * n);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = 0; c < n; ++c) {
                if (!flow_->sensitive(i, c)) continue;
                auto sum = tails_ ? variation_at_end(derivative_, derivative_tail_.variation(i, c),
                                                     i, c, flow_order, *column_shape_, length)
                                  : variation_at_end(derivative_,
                                                     last_variation(*flow_, tube_, w, i, c,
                                                                    flow_order, *column_shape_),
                                                     i, c, flow_order, *column_shape_, length);
                // Lanes that stay, or jump, keep their generators.
                j[i * n + c] = select(moved & !jumps, std::move(sum),
                                      column_entry::constant(C(i == c ? 1.0 : 0.0)));
            }
        }
        mask const carried = moved & !jumps;
        bool const all = side_by_side::all(carried);
        image_.resize(n);
        std::vector<unsigned char> present(n);
        for (auto& g : set_.columns) {
            for (std::size_t l = 0; l < n; ++l) {
                present[l] = side_by_side::all(g[l].norm() == C(0.0)) ? 0 : 1;
            }
            for (std::size_t i = 0; i < n; ++i) {
                product_sum<C> sum(image_[i]);
                for (std::size_t l = 0; l < n; ++l) {
                    if (present[l] != 0 && flow_->sensitive(i, l)) sum.add(j[i * n + l], g[l]);
                }
                sum.finish();
                if (!all) image_[i] = select(carried, image_[i], g[i]);
                lost[i] += image_[i].r();
                image_[i].r() = 0.0;
            }
            g.swap(image_);
        }
    }
    release_states(moved, next, lost);
    if (perturbed_) {
        auto const all = variation_sizes(*flow_, derivative_, n, length, flow_order, 0);
        std::vector<C> carried(n);
        for (std::size_t i = 0; i < n; ++i) {
            C const own = side_by_side::select(moved, perturbed_->at_end()[i], C(0.0));
            lost[i] += own;
            carried[i] = own;
            for (std::size_t c = 0; c < n; ++c) carried[i] += all[i * n + c] * disturbed_[c];
        }
        for (std::size_t i = 0; i < n; ++i) {
            disturbed_[i] = side_by_side::select(moved, carried[i], disturbed_[i]);
        }
    }
    for (auto& x : lost) x *= up;
    bool clamped = true;
    for (std::size_t l = 0; l < width; ++l) {
        if (!side_by_side::test(moved, l)) continue;
        double const h = side_by_side::get(length, l);
        clamped = clamped && (side_by_side::get(to, l) >= flow_->next_knot(time(l)) ||
                              h >= options_.longest_step() || lanes_[l].held);
    }
    for (std::size_t i = 0; i < n; ++i) {
        set_.centre[i] = select(moved, next[i], set_.centre[i]);
        set_.tail[i] = side_by_side::select(moved, tails[i], set_.tail[i]);
        auto const during =
            perturbed_ ? widened(tube_box_[i], perturbed_->largest()[i]) : tube_box_[i];
        swept_[i] = select(moved, during, swept_[i]);
    }
    set_.time = side_by_side::select(moved, to, set_.time);
    set_.reduce(13 * n, lost, running_);
    set_.append(lost);
    set_.measure();
    adapt_flow_order(moved, order, flow_order, added);
    if (order > 0) adapt_order(moved, length, clamped);
    for (std::size_t i = 0; i < n && perturbed_; ++i) {
        disturbed_[i] = side_by_side::min(disturbed_[i], set_.reach[i]);
    }
    stale_ = true;
}

/// The order of V follows what its Lagrange term adds to the reach: that may be a share of the
/// reach itself, smaller where this is still less than what the step may lose anyway.
template <class Model, class Centre>
void parametric_flow<Model, Centre>::adapt_flow_order(mask moved, std::size_t order,
                                                      std::size_t flow_order,
                                                      std::vector<C> const& added) {
    if (order == 0) {
        flow_order_ = 3;
        return;
    }
    C most{};
    for (std::size_t i = 0; i < added.size(); ++i) {
        C const bearable = side_by_side::max(
            side_by_side::min(allowed(i) * 0.3, set_.reach[i] * 0.05), set_.reach[i] * 1e-3);
        most = side_by_side::max(most, added[i] / (bearable + C(1e-300)));
    }
    if (side_by_side::any(moved & (most > C(1.0)))) {
        flow_order_ = std::min(flow_order + 1, options_.order);
    } else if (side_by_side::all((most < C(0.01)) | !moved) && flow_order > 2) {
        flow_order_ = flow_order - 1;
    }
}

} // namespace sivid

#endif
