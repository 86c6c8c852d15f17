// SPDX-License-Identifier: MIT
// Experiments of a known model, simulated in plain floating point by small Runge-Kutta steps: what
// the tests of relations take for the truth.
#ifndef SIVID_TESTS_DIAGNOSIS_PLANTED_MOTION_HPP
#define SIVID_TESTS_DIAGNOSIS_PLANTED_MOTION_HPP

#include "support/models.hpp"
#include "support/random.hpp"

#include <sivid/model/problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace diagnosis_support {

using namespace sivid;
using support::around;
using support::between;
using support::draws;

/// The rates of a recorded model in doubles; every constant of the model is given.
class double_rates {
public:
    explicit double_rates(recorded_model const& m) : model_(&m), values_(m.g.size()) {}

    std::vector<double> operator()(double t, std::vector<double> const& x,
                                   std::vector<double> const& c, std::vector<double> const& u) {
        for (std::size_t i = 0; i < values_.size(); ++i) {
            auto const& n = model_->g.nodes()[i];
            auto const k = static_cast<std::size_t>(n.index);
            bool ignored = false;
            switch (n.op) {
            case operation::literal:
                values_[i] = model_->g.value(n).nearest;
                break;
            case operation::time:
                values_[i] = t;
                break;
            case operation::state:
                values_[i] = x[k];
                break;
            case operation::constant:
                values_[i] = c[k];
                break;
            case operation::input:
                values_[i] = u[k];
                break;
            default:
                values_[i] = apply<approximate_arithmetic>(
                    n.op, values_[n.a], is_binary(n.op) ? values_[n.b] : 0, n.index, ignored);
            }
        }
        std::vector<double> result;
        for (auto const i : model_->rate) result.push_back(values_[i]);
        return result;
    }

private:
    recorded_model const* model_;
    std::vector<double> values_;
};

/// A simulated motion at a fine step.
struct motion_truth {
    double step = 0;
    std::vector<std::vector<double>> states; ///< at 0, step, 2 step, ...

    [[nodiscard]] std::vector<double> const& at(double t) const {
        return states[std::min(static_cast<std::size_t>(std::lround(t / step)), states.size() - 1)];
    }
};

/// Simulates with constants `c` from x; `step` has to divide the knots of the inputs.
inline motion_truth simulate(recorded_model const& m, std::vector<double> const& c,
                             std::vector<sampled_signal> const& inputs, std::vector<double> x,
                             double duration, double step = 0.005) {
    double_rates rate(m);
    motion_truth result{step, {x}};
    auto const count = std::lround(duration / step);
    for (long k = 0; k < count; ++k) {
        double const t = static_cast<double>(k) * step;
        auto const slope = [&](double s, std::vector<double> const& y) {
            std::vector<double> u;
            for (auto const& i : inputs) u.push_back(i.approximate_on(i.piece(t + step / 2), s));
            return rate(s, y, c, u);
        };
        auto const moved = [&](std::vector<double> const& d, double h) {
            auto y = x;
            for (std::size_t i = 0; i < y.size(); ++i) y[i] += h * d[i];
            return y;
        };
        auto const k1 = slope(t, x);
        auto const k2 = slope(t + step / 2, moved(k1, step / 2));
        auto const k3 = slope(t + step / 2, moved(k2, step / 2));
        auto const k4 = slope(t + step, moved(k3, step));
        for (std::size_t i = 0; i < x.size(); ++i) {
            x[i] += step / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
        }
        result.states.push_back(x);
    }
    return result;
}

/// How the errors of the measurements are drawn, within their bounds.
enum class noise { uniform, at_the_bounds, offset, slow };

/// An experiment in which the states `shown` are measured every `period` by channels of the same
/// index; `shift` is added to what the channels show.
inline experiment measured(draws& d, std::string name, motion_truth const& truth,
                           std::vector<sampled_signal> const& inputs,
                           std::vector<std::size_t> const& shown, double error, noise kind,
                           std::vector<double> const& shift = {}, double period = 0.1) {
    experiment e;
    e.name = std::move(name);
    for (auto const& i : inputs) e.inputs.emplace_back(i);
    e.initial = point_box(truth.states.front());
    double const duration = static_cast<double>(truth.states.size() - 1) * truth.step;
    for (auto const y : shown) {
        double const side = d.coin() ? 1 : -1;
        double const pace = d.uniform(0.3, 4);
        double const phase = d.uniform(0, 6);
        for (long k = 1; static_cast<double>(k) * period < duration + 1e-9; ++k) {
            double const t = static_cast<double>(k) * period;
            double const most = 0.99 * error;
            double const off = kind == noise::uniform         ? d.uniform(-most, most)
                               : kind == noise::at_the_bounds ? (d.coin() ? most : -most)
                               : kind == noise::offset        ? side * most
                                                              : most * std::sin(pace * t + phase);
            double const value = truth.at(t)[y] + (shift.empty() ? 0 : shift[y]);
            e.measurements.push_back({t, y, around(value + off, error)});
        }
    }
    return e;
}

/// \f$ \int f(x(t), t) dt \f$ over the truth by the trapezoidal rule.
template <class F>
double integral(motion_truth const& truth, double from, double to, F const& f) {
    auto const a = std::lround(from / truth.step);
    auto const b = std::lround(to / truth.step);
    double sum = 0;
    for (long k = a; k <= b; ++k) {
        double const t = static_cast<double>(k) * truth.step;
        sum += (k == a || k == b ? 0.5 : 1) * f(truth.states[static_cast<std::size_t>(k)], t);
    }
    return sum * truth.step;
}

/// A driven pendulum: x0' = x1, x1' = -p0 sin x0 - p1 x1 + p2 u0, with or without dry friction.
inline recorded_model pendulum(double dry = 0) {
    return support::model_of(
        {2, 3, 1, 20}, [dry](auto const&, auto const& x, auto const& p, auto const& u) {
            using T = std::decay_t<decltype(x[0])>;
            T const friction = T(dry) * x[1] / sqrt(sqr(x[1]) + T(1e-4));
            return std::vector<T>{x[1], p[2] * u[0] - p[0] * sin(x[0]) - p[1] * x[1] - friction};
        });
}
inline sampled_signal sine_input(double size, double pace, double duration) {
    std::vector<double> t, v;
    for (long k = 0; static_cast<double>(k) * 0.05 < duration + 0.06; ++k) {
        t.push_back(static_cast<double>(k) * 0.05);
        v.push_back(size * std::sin(pace * t.back()));
    }
    return {t, v, interpolation::linear};
}

} // namespace diagnosis_support

#endif
