// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_RUNGE_KUTTA_HPP
#define SIVID_ENCLOSURE_RUNGE_KUTTA_HPP

#include <sivid/enclosure/expansion.hpp>
#include <sivid/enclosure/tableau.hpp>
#include <sivid/model/series.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// The formula of an explicit Runge-Kutta method as a function of the step, \f$ \phi(s) \f$, with
/// its Taylor coefficients in s: the stages are expanded by the same series as the solution itself.
///   A method of order p agrees with the solution in the coefficients 0 .. p at s = 0, hence
///   \f$ x(h) \in \phi(h) + h^{p+1} ( x^{[p+1]}(B) - \phi^{[p+1]}([0, h]) ) \f$,
///   with B an enclosure of the solution on [0, h].
/// @ref  Alexandre dit Sandretto and Chapoutot, Reliable Computing 22 (2016), section 3; the local
///       error is bounded here by series in the step instead of rooted trees.
template <class I>
class runge_kutta {
    using traits = arithmetic_of<I>;

public:
    runge_kutta(flow const& f, tableau const& method)
        : flow_(&f), method_(method), rate_(f.rate(), method.order + 1) {
        method_.require_explicit();
        for (auto const& row : method_.a) {
            a_.emplace_back();
            for (auto const& r : row) a_.back().push_back(r.template enclose<I>());
        }
        for (auto const& r : method_.b) b_.push_back(r.template enclose<I>());
        for (auto const& r : method_.c) c_.push_back(r.template enclose<I>());
    }

    [[nodiscard]] std::size_t order() const { return method_.order; }
    void set_parameters(basic_box<I> const& p) { rate_.set_parameters(p); }
    /// A stage of the last `coefficient` crossed a kink of the model.
    [[nodiscard]] bool kinked() const { return kinked_; }

    /// Coefficient `k` of \f$ \phi \f$, expanded about each s in `step`, from `x` at time `t`.
    /// @param undefined  set where a stage leaves the domain of the model
    [[nodiscard]] basic_box<I> coefficient(double t, basic_box<I> const& x, I const& step,
                                           std::size_t k, typename traits::mask& undefined) {
        auto const n = x.size();
        auto const stages = method_.stages();
        kinked_ = false;
        auto const stride = k + 1;
        // stage[(i * n + s) * stride + j]: coefficient j of component s of k_i
        std::vector<I> stage(stages * n * stride, traits::point(0.0));
        auto const get = [&](std::size_t i, std::size_t s, std::size_t j) -> I& {
            return stage[(i * n + s) * stride + j];
        };
        // coefficient j of (step + tau) * k_i
        auto const scaled = [&](std::size_t i, std::size_t s, std::size_t j) {
            I const value = traits::mul(step, get(i, s, j));
            return j == 0 ? value : traits::add(value, get(i, s, j - 1));
        };
        for (std::size_t i = 0; i < stages; ++i) {
            I const time = traits::add(traits::point(t), traits::mul(c_[i], step));
            input_pieces<I> const pieces(*flow_, t, time);
            auto const input = [&](std::size_t u, std::size_t j) {
                return j == 1 ? traits::mul(c_[i], pieces(u, 1)) : pieces(u, j);
            };
            auto const state = [&](std::size_t s, std::size_t j) {
                I value = j == 0 ? x[s] : traits::point(0.0);
                for (std::size_t l = 0; l < i; ++l) {
                    value = traits::add(value, traits::mul(a_[i][l], scaled(l, s, j)));
                }
                return value;
            };
            rate_.start(time, c_[i]);
            for (std::size_t j = 0; j <= k; ++j) {
                rate_.advance(j, state, input);
                for (std::size_t s = 0; s < n; ++s) {
                    bool const zero = j > 0 && !flow_->rate().output_varies(s);
                    get(i, s, j) = zero ? traits::point(0.0) : rate_.output(s, j);
                }
            }
            undefined |= rate_.undefined();
            kinked_ = kinked_ || rate_.kinked();
        }
        basic_box<I> result(n);
        for (std::size_t s = 0; s < n; ++s) {
            I value = k == 0 ? x[s] : traits::point(0.0);
            for (std::size_t i = 0; i < stages; ++i) {
                value = traits::add(value, traits::mul(b_[i], scaled(i, s, k)));
            }
            result[s] = value;
        }
        return result;
    }

private:
    flow const* flow_;
    tableau method_;
    series<I> rate_;
    std::vector<std::vector<I>> a_;
    std::vector<I> b_, c_;
    bool kinked_ = false;
};

} // namespace sivid

#endif
