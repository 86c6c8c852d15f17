// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_SIMULATE_ODEINT_STEPPING_HPP
#define SIVID_APPROXIMATE_SIMULATE_ODEINT_STEPPING_HPP

#include <sivid/approximate/simulate/stepping.hpp>

#include <boost/numeric/odeint/algebra/default_operations.hpp>
#include <boost/numeric/odeint/algebra/vector_space_algebra.hpp>
#include <boost/numeric/odeint/stepper/base/explicit_error_stepper_fsal_base.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/stepper_categories.hpp>
#include <boost/numeric/odeint/util/is_resizeable.hpp>
#include <boost/numeric/odeint/util/resize.hpp>
#include <boost/numeric/odeint/util/resizer.hpp>
#include <boost/numeric/odeint/util/same_size.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <type_traits>

// What Odeint has to know of the state.
namespace boost::numeric::odeint {
/// Boost 1.74 asks for its own truth, 1.92 for that of the standard library.
template <>
struct is_resizeable<sivid::simulation_state> : boost::true_type {
    static bool const value = true;
    struct type : boost::true_type {
        constexpr operator std::true_type() const noexcept { return {}; }
    };
};
template <>
struct same_size_impl<sivid::simulation_state, sivid::simulation_state> {
    static bool same_size(sivid::simulation_state const& a, sivid::simulation_state const& b) {
        return a.size() == b.size();
    }
};
template <>
struct resize_impl<sivid::simulation_state, sivid::simulation_state> {
    static void resize(sivid::simulation_state& a, sivid::simulation_state const& b) {
        a.resize(b.size());
    }
};
template <>
struct vector_space_norm_inf<sivid::simulation_state> {
    using result_type = double;
    double operator()(sivid::simulation_state const& x) const {
        return x.size() > 0 ? x.lpNorm<Eigen::Infinity>() : 0;
    }
};
} // namespace boost::numeric::odeint

namespace sivid {

/// Odeint's operations on whole states.
struct state_operations : boost::numeric::odeint::default_operations {
    template <class Factor = double>
    struct rel_error {
        Factor absolute, relative, by_state, by_rate;
        rel_error(Factor a, Factor r, Factor x, Factor dx)
            : absolute(a), relative(r), by_state(x), by_rate(dx) {}
        void operator()(simulation_state& error, simulation_state const& x,
                        simulation_state const& dx) const {
            error.array() =
                error.array().abs() /
                (absolute + relative * (by_state * x.array().abs() + by_rate * dx.array().abs()));
        }
    };
};

/// One of Odeint's steppers for the states of a simulation:
/// `odeint_method<boost::numeric::odeint::runge_kutta_dopri5>`.
template <template <class...> class Method>
using odeint_method = Method<simulation_state, double, simulation_state, double,
                             boost::numeric::odeint::vector_space_algebra, state_operations,
                             boost::numeric::odeint::always_resizer>;

/// The classical Runge-Kutta method of order 4 as an Odeint stepper with an estimate of its error:
/// the rate at the new point, which the next step begins with, gives an embedded result of order 3.
/// (Odeint's own `runge_kutta4` estimates nothing.) Four rates a step; where inputs and samples
/// bound the steps, a method of higher order only has more stages.
class embedded_runge_kutta4
    : public boost::numeric::odeint::explicit_error_stepper_fsal_base<
          embedded_runge_kutta4, 4, 4, 3, simulation_state, double, simulation_state, double,
          boost::numeric::odeint::vector_space_algebra, state_operations,
          boost::numeric::odeint::always_resizer> {
public:
    template <class System, class In, class Rate, class Out, class NewRate, class Error>
    void do_step_impl(System system, In const& in, Rate const& rate, double t, Out& out,
                      NewRate& new_rate, double h, Error& error) {
        auto& f =
            static_cast<typename boost::numeric::odeint::unwrap_reference<System>::type&>(system);
        auto const size = in.size();
        for (auto* k : {&point_, &second_, &third_, &fourth_}) k->resize(size);
        point_ = in + 0.5 * h * rate;
        f(point_, second_, t + 0.5 * h);
        point_ = in + 0.5 * h * second_;
        f(point_, third_, t + 0.5 * h);
        point_ = in + h * third_;
        f(point_, fourth_, t + h);
        out = in + h / 6 * (rate + 2 * (second_ + third_) + fourth_);
        f(out, new_rate, t + h);
        error = h / 6 * (fourth_ - new_rate);
    }
    template <class System, class In, class Rate, class Out, class NewRate>
    void do_step_impl(System system, In const& in, Rate const& rate, double t, Out& out,
                      NewRate& new_rate, double h) {
        do_step_impl(system, in, rate, t, out, new_rate, h, unused_);
    }

private:
    simulation_state point_, second_, third_, fourth_, unused_;
};

/// How Odeint is told what a step may miss: only the states count, not their derivatives.
class state_error_checker {
public:
    explicit state_error_checker(step_tolerance const* allowed) : allowed_(allowed) {}

    template <class Algebra>
    double error(Algebra&, simulation_state const& x, simulation_state const&,
                 simulation_state const& error, double h) const {
        double worst = 0;
        for (std::size_t i = 0; i < allowed_->absolute.size(); ++i) {
            auto const k = static_cast<Eigen::Index>(i);
            double const e =
                std::abs(error[k]) / (allowed_->absolute[i] + allowed_->relative * std::abs(x[k]));
            if (!(e <= std::numeric_limits<double>::max())) return HUGE_VAL;
            worst = std::max(worst, e);
        }
        worst /= allowed_->accuracy;
        return std::abs(h) <= allowed_->shortest ? std::min(worst, 1.0) : worst;
    }

private:
    step_tolerance const* allowed_;
};

/// A simulation's steps by a stepper of Odeint: with an error estimate, it is controlled by that of
/// the states; one that controls itself (`bulirsch_stoer`) counts the sensitivities too; one
/// without an estimate takes the steps that the mesh of the simulation leaves.
/// @tparam Method  explicit, over `simulation_state`: see `odeint_method`
template <class Method>
class odeint_stepping final : public stepping {
    using category = typename Method::stepper_category;
    static constexpr bool reuses_rate =
        std::is_same_v<category, boost::numeric::odeint::explicit_error_stepper_fsal_tag>;
    static constexpr bool estimates =
        reuses_rate || std::is_same_v<category, boost::numeric::odeint::explicit_error_stepper_tag>;
    static constexpr bool controls_itself =
        std::is_same_v<category, boost::numeric::odeint::controlled_stepper_tag>;

public:
    step_outcome step(rate_function& rate, simulation_state const& x, simulation_state const& dx,
                      double& t, simulation_state& to, simulation_state& rate_there,
                      double& h) override {
        namespace odeint = boost::numeric::odeint;
        auto const f = [&rate](simulation_state const& at, simulation_state& slope, double time) {
            slope.resize(at.size());
            rate(at, slope, time);
        };
        auto const system = std::ref(f);
        if constexpr (estimates) {
            using controlled = odeint::controlled_runge_kutta<Method, state_error_checker>;
            if (!work_) {
                work_ = std::make_shared<controlled>(state_error_checker(&tolerance));
            }
            auto& method = *static_cast<controlled*>(work_.get());
            if constexpr (reuses_rate) {
                return method.try_step(system, x, dx, t, to, rate_there, h) == odeint::success
                           ? step_outcome::with_rate
                           : step_outcome::too_long;
            } else {
                to.resize(x.size());
                return method.try_step(system, x, dx, t, to, h) == odeint::success
                           ? step_outcome::taken
                           : step_outcome::too_long;
            }
        } else if constexpr (controls_itself) {
            if (!work_) {
                double const least =
                    *std::min_element(tolerance.absolute.begin(), tolerance.absolute.end());
                work_ = std::make_shared<Method>(tolerance.accuracy * least,
                                                 tolerance.accuracy * tolerance.relative);
            }
            auto& method = *static_cast<Method*>(work_.get());
            to.resize(x.size());
            return method.try_step(system, x, dx, t, to, h) == odeint::success
                       ? step_outcome::taken
                       : step_outcome::too_long;
        } else {
            if (!work_) work_ = std::make_shared<Method>();
            to.resize(x.size());
            static_cast<Method*>(work_.get())->do_step(system, x, dx, t, to, h);
            t += h;
            return step_outcome::taken;
        }
    }
    void restart() override {
        if constexpr (controls_itself) work_.reset();
    }

private:
    std::shared_ptr<void> work_;
};

template <class Method>
[[nodiscard]] std::unique_ptr<stepping> step_by() {
    return std::make_unique<odeint_stepping<Method>>();
}

} // namespace sivid

#endif
