// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_MEAN_VALUE_CUT_HPP
#define SIVID_PAVING_STATIC_MEAN_VALUE_CUT_HPP

#include <sivid/number/pack.hpp>
#include <sivid/paving/static/static_program.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sivid {

/// What first-order forms say of W boxes, measurement by measurement:
///   \f$ g_k(p) = g_k(m) + \sum_j d_j (p_j - m_j) \f$ with some d in the gradient over the box.
/// Solved for each side in turn it leaves of the box a *rest* that may satisfy the measurements and
/// a *core* that may violate them.
/// @guarantee  in lanes of `outer`, a point of the box that satisfies all measurements used is in
/// the rest; in lanes of `inner`, one that violates all of them is in the core
/// @cost  two values and a gradient of each measurement, n^2 operations besides
template <std::size_t W>
class mean_value_cut {
    using I = pack<W>;
    using traits = interval_traits<I>;

public:
    using mask = typename traits::mask;
    /// Lanes in which the measurement certainly holds, in which it certainly fails, and in which
    /// its first-order form is a proof.
    struct finding {
        mask hit = 0, miss = 0, proved = 0;
    };

    explicit mean_value_cut(static_program const& program) : centre_(program.memory<I>()) {
        middle_.resize(program.parameters());
        deviation_ = terms_ = middle_;
    }

    /// New boxes.
    void begin(std::vector<I> const& sides) {
        rest_ = core_ = sides;
        used_ = false;
    }
    [[nodiscard]] bool used() const { return used_; }
    [[nodiscard]] I const& rest(std::size_t j) const { return rest_[j]; }
    [[nodiscard]] I const& core(std::size_t j) const { return core_[j]; }

    /// The midpoint of the boxes in side j, and what the channel of the measurement used last is
    /// there.
    [[nodiscard]] I const& middle(std::size_t j) const { return middle_[j]; }
    [[nodiscard]] I const& centre_value(static_program const& program, std::size_t k) const {
        return program.last_value(centre_, k);
    }

    /// Uses a measurement of channel k.
    /// @param memory  holds its value and gradient over the boxes
    /// @param lanes   where it is open, and defined with its gradient
    finding use(static_program const& program, static_memory<I> const& memory, std::size_t k,
                I const& bound, mask lanes, mask outer, mask inner) {
        if (!used_) find_centres(program);
        used_ = true;
        for (auto const i : program.timed(k)) centre_.values[i] = memory.values[i];
        centre_.time = memory.time;
        mask undefined{};
        auto const& value = program.value(centre_, k, undefined);
        lanes &= ~undefined;
        I y = value;
        for (std::size_t j = 0; j < terms_.size(); ++j) {
            terms_[j] = traits::mul(program.slope(memory, k, j), deviation_[j]);
            y = traits::add(y, terms_[j]);
        }
        y = traits::intersect(y, program.last_value(memory, k));
        auto const slope = [&](std::size_t j) -> I const& { return program.slope(memory, k, j); };
        if ((outer & lanes) != 0) {
            shrink(rest_, traits::sub(bound, value), slope, outer & lanes);
        }
        if ((inner & lanes) != 0) {
            shrink(core_, traits::sub(violation(y, bound), value), slope, inner & lanes);
        }
        return {traits::subset(y, bound) & lanes, traits::disjoint(y, bound) & lanes, lanes};
    }

private:
    void find_centres(static_program const& program) {
        for (std::size_t j = 0; j < middle_.size(); ++j) {
            std::array<double, W> lo{}, hi{};
            rest_[j].store(lo.data(), hi.data());
            for (std::size_t n = 0; n < W; ++n) lo[n] += 0.5 * (hi[n] - lo[n]);
            middle_[j] = I::load(lo.data(), lo.data());
            deviation_[j] = traits::sub(rest_[j], middle_[j]);
        }
        program.start(centre_, [this](std::size_t j) { return middle_[j]; });
    }

    /// The outputs that violate the bound: above it where y is not below, and the other way round;
    /// everything where both are possible.
    [[nodiscard]] static I violation(I const& y, I const& bound) {
        std::array<double, W> lo{}, hi{}, from{}, to{};
        y.store(lo.data(), hi.data());
        bound.store(from.data(), to.data());
        for (std::size_t n = 0; n < W; ++n) {
            bool const only_above = lo[n] >= from[n], only_below = !only_above && hi[n] <= to[n];
            lo[n] = only_above ? to[n] : -HUGE_VAL;
            hi[n] = only_below ? from[n] : HUGE_VAL;
        }
        return I::load(lo.data(), hi.data());
    }

    /// Contracts x, in some lanes, to what may have \f$ \sum_j d_j (p_j - m_j) \in target \f$.
    template <class Slope>
    void shrink(std::vector<I>& x, I const& target, Slope const& slope, mask lanes) const {
        for (std::size_t j = 0; j < x.size(); ++j) {
            I others = target;
            for (std::size_t i = 0; i < x.size(); ++i) {
                if (i != j) others = traits::sub(others, terms_[i]);
            }
            mask undefined{};
            I allowed = traits::add(traits::div(others, slope(j), undefined), middle_[j]);
            auto const chosen = lanes & ~undefined; // a slope of 0 excludes nothing
            if (chosen == 0) continue;
            if (chosen != traits::all_lanes) {
                auto const elsewhere = [chosen](double bound) {
                    return [chosen, bound](std::size_t n) {
                        return ((chosen >> n) & 1U) != 0 ? std::nan("") : bound;
                    };
                };
                allowed = traits::hull(
                    allowed, traits::from_lanes(elsewhere(-HUGE_VAL), elsewhere(HUGE_VAL)));
            }
            x[j] = traits::intersect(x[j], allowed);
        }
    }

    static_memory<I> centre_; ///< at the midpoints
    std::vector<I> rest_, core_, middle_, deviation_, terms_;
    bool used_ = false;
};

} // namespace sivid

#endif
