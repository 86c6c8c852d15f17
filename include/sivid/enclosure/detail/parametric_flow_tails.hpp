// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_DETAIL_PARAMETRIC_FLOW_TAILS_HPP
#define SIVID_ENCLOSURE_DETAIL_PARAMETRIC_FLOW_TAILS_HPP

/// @file
/// A step proved without a tube, from the sizes of the series' coefficients
/// (`docs/taylor_models.md`, section 3.0).

#include <sivid/enclosure/detail/parametric_flow_class.hpp>

namespace sivid {

template <std::size_t N, std::size_t D, class C>
template <class Entry>
typename parametric_flow<N, D, C>::mask
parametric_flow<N, D, C>::bound_states(expansion<Entry> const& e, series_tail<Entry>& tail,
                                       C const& h, std::size_t order, bool rest,
                                       std::vector<C>& beyond) {
    auto const n = flow_->states();
    tail.measure(e.coefficients(), order, h, rest);
    C power = h;
    for (std::size_t k = 1; k < order; ++k) power *= h;
    C const shared = h * (up / static_cast<double>(order + 1));
    std::vector<C> first(n);
    for (std::size_t i = 0; i < n; ++i) {
        first[i] = e.state(i, order).norm() * power * up + polynomial::tiny;
        state_tail_[i] = first[i] * 1.05;
    }
    mask proved{};
    for (int round = 0; round < 4; ++round) {
        tail.propagate(state_tail_,
                       [&](std::size_t i) -> Entry const& { return e.input_slope(i); });
        proved = mask(true);
        for (std::size_t i = 0; i < n; ++i) {
            beyond[i] = (tail.tail(e.program().output(i)) * shared + polynomial::tiny) * up;
            C const image = (first[i] + beyond[i]) * up;
            proved = proved & (image < state_tail_[i]);
        }
        if (side_by_side::all(proved)) break;
        if (round == 3) break;
        for (std::size_t i = 0; i < n; ++i) {
            state_tail_[i] =
                side_by_side::select(proved, state_tail_[i], (first[i] + beyond[i]) * 1.1);
        }
    }
    return proved;
}

template <std::size_t N, std::size_t D, class C>
typename parametric_flow<N, D, C>::mask parametric_flow<N, D, C>::bound_flow_tail(C const& h,
                                                                                  std::size_t L) {
    auto const n = flow_->states();
    auto const& entries = flow_->entries();
    // |V_k| h^k, the sums of the last ones of them, and all together.
    std::vector<C> size(L), above(L);
    square whole(n * n), own(n * n), ends(n * n), image(n * n);
    C const once = h * (up / static_cast<double>(L));
    C const again = h * (up / static_cast<double>(L + 1));
    for (std::size_t m = 0; m < n; ++m) {
        for (std::size_t c = 0; c < n; ++c) {
            if (!flow_->sensitive(m, c)) continue;
            C power = C(1.0);
            for (std::size_t k = 0; k < L; ++k) {
                size[k] = derivative_.variation(m, c, k).norm() * power;
                power *= h;
            }
            above[0] = C(0.0); // [k]: the last k
            for (std::size_t k = 1; k < L; ++k) above[k] = above[k - 1] + size[L - k];
            whole[m * n + c] = (above[L - 1] + size[0]) * up;
            for (std::size_t k = 0; k < flow_->state_entries(); ++k) {
                auto const& e = entries[k];
                if (e.column != m) continue;
                auto const slot = derivative_.program().output(e.output);
                C sum{};
                if (derivative_.program().output_varies(e.output)) {
                    // A_a V_b with a <= L - 2, b <= L - 1, a + b >= L - 1.
                    for (std::size_t a = 0; a + 1 < L; ++a) {
                        sum += derivative_tail_.size(slot, a) * above[a + 1];
                    }
                    sum += derivative_tail_.tail(slot) * whole[m * n + c];
                } else {
                    sum += derivative_tail_.whole(slot) * above[1];
                }
                own[e.row * n + c] += sum * once;
            }
        }
    }
    for (std::size_t k = 0; k < flow_->state_entries(); ++k) {
        auto const& e = entries[k];
        auto const slot = derivative_.program().output(e.output);
        C sum = derivative_tail_.whole(slot);
        if (derivative_.program().output_varies(e.output)) sum += derivative_tail_.tail(slot);
        ends[e.row * n + e.column] += sum * again;
    }
    for (std::size_t k = 0; k < n * n; ++k) {
        own[k] = own[k] * up + polynomial::tiny;
        flow_rest_[k] = own[k];
    }
    mask proved{};
    for (int round = 0; round < 8; ++round) {
        proved = mask(true);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = 0; c < n; ++c) {
                C sum = own[i * n + c];
                for (std::size_t m = 0; m < n; ++m) {
                    sum += ends[i * n + m] * flow_rest_[m * n + c];
                }
                image[i * n + c] = sum * up;
                proved = proved & (image[i * n + c] < flow_rest_[i * n + c]);
            }
        }
        if (side_by_side::all(proved) || round == 7) break;
        for (std::size_t k = 0; k < n * n; ++k) {
            flow_rest_[k] = side_by_side::select(proved, flow_rest_[k], image[k] * 1.1);
        }
    }
    return proved;
}

template <std::size_t N, std::size_t D, class C>
typename parametric_flow<N, D, C>::mask
parametric_flow<N, D, C>::bound_tails(C const& h, std::size_t order, std::size_t flow_order) {
    state_tail_.resize(flow_->states());
    derivative_beyond_.resize(flow_->states());
    flow_rest_.assign(flow_->states() * flow_->states(), C(0.0));
    mask proved = bound_states(centre_, centre_tail_, h, order, false, truncation_);
    if (!side_by_side::any(proved)) return proved;
    proved = proved & bound_states(derivative_, derivative_tail_, h, flow_order - 1, true,
                                   derivative_beyond_);
    if (!side_by_side::any(proved)) return proved;
    return proved & bound_flow_tail(h, flow_order);
}

/// The lanes in which what V has beyond its coefficients does not add much to the reach; the others
/// try again with more of them or, if there are no more, with a shorter step.
template <std::size_t N, std::size_t D, class C>
typename parametric_flow<N, D, C>::mask
parametric_flow<N, D, C>::carries_well(mask trying, C const& h, std::size_t flow_order) {
    auto const n = flow_->states();
    C most{};
    for (std::size_t i = 0; i < n; ++i) {
        C added{};
        for (std::size_t c = 0; c < n; ++c) added += flow_rest_[i * n + c] * set_.reach[c];
        most = side_by_side::max(added / side_by_side::max(allowed(i), set_.reach[i] * 0.01), most);
    }
    mask const poor = trying & (most > C(1.0)) & (h > C(4 * options_.minimum_step));
    if (!side_by_side::any(poor)) return trying;
    if (flow_order < std::min(options_.order, order_)) {
        flow_order_ = flow_order + 1;
        return trying & !poor;
    }
    reject(poor, failure_reason::minimum_step, each_lane<C>([&](std::size_t l) {
               double const x = side_by_side::get(most, l);
               if (!std::isfinite(x)) return 0.5;
               return std::clamp(0.9 * std::pow(x, -1.0 / static_cast<double>(flow_order)), 0.3,
                                 0.9);
           }));
    return trying & !poor;
}

} // namespace sivid

#endif
