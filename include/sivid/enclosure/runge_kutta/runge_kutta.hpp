// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_RUNGE_KUTTA_RUNGE_KUTTA_HPP
#define SIVID_ENCLOSURE_RUNGE_KUTTA_RUNGE_KUTTA_HPP

#include <sivid/enclosure/runge_kutta/order_conditions.hpp>
#include <sivid/enclosure/runge_kutta/tableau.hpp>
#include <sivid/enclosure/series/expansion.hpp>
#include <sivid/model/series/series.hpp>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// The two numbers that a Runge-Kutta method of order p adds to a step: its value
/// \f$ \phi(h) \f$, and \f$ \phi^{[p+1]} \f$ over all s in [0, h].
template <class T>
struct runge_kutta_formula {
    std::vector<T> value;
    std::vector<T> next;
};

/// The formula of an explicit Runge-Kutta method as a function of the step, \f$ \phi(s) \f$, with
/// its Taylor coefficients in s: the stages are expanded by the same series as the solution itself.
///   A method of order p agrees with the solution in the coefficients 0 .. p at s = 0, hence
///   \f$ x(h) \in \phi(h) + h^{p+1} ( x^{[p+1]}(B) - \phi^{[p+1]}([0, h]) ) \f$,
///   with B an enclosure of the solution on [0, h].
/// @tparam T  an interval type, or a Taylor model
/// @ref  Alexandre dit Sandretto and Chapoutot, Reliable Computing 22 (2016), section 3; the local
///       error is bounded here by series in the step instead of rooted trees (docs/runge_kutta.md).
template <class T>
class runge_kutta {
    using arithmetic = arithmetic_of<T>;

public:
    /// @throws std::invalid_argument for a tableau of another shape, or not of its stated order
    /// @param values  see `series`
    runge_kutta(flow const& f, tableau const& method, size_of_values<T> const& values = {})
        : flow_(&f), method_(method), rate_(f.rate(), method.order + 1, values) {
        method_.require_explicit();
        require_order(method_);
        auto const enter = [](surd const& x) {
            return arithmetic::enclose(x.template enclose<interval>());
        };
        for (auto const& row : method_.a) {
            a_.emplace_back();
            for (auto const& x : row) a_.back().push_back(enter(x));
        }
        for (auto const& x : method_.b) b_.push_back(enter(x));
        for (auto const& x : method_.c) c_.push_back(enter(x));
    }

    [[nodiscard]] std::size_t order() const { return method_.order; }
    template <class Box>
    void set_parameters(Box const& p) {
        rate_.set_parameters(p);
    }
    /// A stage of the last `coefficient` crossed a kink of the model.
    [[nodiscard]] bool kinked() const { return kinked_; }

    /// Coefficient `k` of \f$ \phi \f$, expanded about each s in `step`, from `x` at time `t`.
    /// @param undefined  set where a stage leaves the domain of the model
    template <class States>
    [[nodiscard]] std::vector<T> coefficient(double t, States const& x, T const& step,
                                             std::size_t k, typename arithmetic::mask& undefined) {
        auto const n = x.size();
        auto const stages = method_.stages();
        kinked_ = false;
        auto const stride = k + 1;
        // stage[(i * n + s) * stride + j]: coefficient j of component s of k_i
        std::vector<T> stage(stages * n * stride, arithmetic::point(0.0));
        auto const get = [&](std::size_t i, std::size_t s, std::size_t j) -> T& {
            return stage[(i * n + s) * stride + j];
        };
        // coefficient j of (step + tau) * k_i
        auto const scaled = [&](std::size_t i, std::size_t s, std::size_t j) {
            T const value = arithmetic::mul(step, get(i, s, j));
            return j == 0 ? value : arithmetic::add(value, get(i, s, j - 1));
        };
        for (std::size_t i = 0; i < stages; ++i) {
            T const time = arithmetic::add(arithmetic::point(t), arithmetic::mul(c_[i], step));
            input_pieces<T> const pieces(*flow_, t, time);
            auto const input = [&](std::size_t u, std::size_t j) {
                return j == 1 ? arithmetic::mul(c_[i], pieces(u, 1)) : pieces(u, j);
            };
            auto const state = [&](std::size_t s, std::size_t j) {
                T value = j == 0 ? x[s] : arithmetic::point(0.0);
                for (std::size_t l = 0; l < i; ++l) {
                    value = arithmetic::add(value, arithmetic::mul(a_[i][l], scaled(l, s, j)));
                }
                return value;
            };
            rate_.start(time, c_[i]);
            for (std::size_t j = 0; j <= k; ++j) {
                rate_.advance(j, state, input);
                for (std::size_t s = 0; s < n; ++s) {
                    bool const zero = j > 0 && !flow_->rate().output_varies(s);
                    get(i, s, j) = zero ? arithmetic::point(0.0) : rate_.output(s, j);
                }
            }
            undefined |= rate_.undefined();
            kinked_ = kinked_ || rate_.kinked();
        }
        std::vector<T> result(n, arithmetic::point(0.0));
        for (std::size_t s = 0; s < n; ++s) {
            T value = k == 0 ? x[s] : arithmetic::point(0.0);
            for (std::size_t i = 0; i < stages; ++i) {
                value = arithmetic::add(value, arithmetic::mul(b_[i], scaled(i, s, k)));
            }
            result[s] = value;
        }
        return result;
    }

    /// @returns nothing when a stage leaves the domain of the model or crosses a kink
    template <class States>
    [[nodiscard]] std::optional<runge_kutta_formula<T>> formula(double t, States const& x,
                                                                T const& step) {
        typename arithmetic::mask undefined{};
        auto value = coefficient(t, x, step, 0, undefined);
        bool rough = kinked_;
        auto const range = arithmetic::hull(arithmetic::point(0.0), step);
        auto next = coefficient(t, x, range, order() + 1, undefined);
        if (undefined || rough || kinked_) return std::nullopt;
        return runge_kutta_formula<T>{std::move(value), std::move(next)};
    }

private:
    flow const* flow_;
    tableau method_;
    series<T> rate_;
    std::vector<std::vector<T>> a_;
    std::vector<T> b_, c_;
    bool kinked_ = false;
};

} // namespace sivid

#endif
