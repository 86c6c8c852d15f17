// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_DETAIL_ODEINT_SIMULATOR_HPP
#define SIVID_ENCLOSURE_DETAIL_ODEINT_SIMULATOR_HPP

#include <sivid/compiled.hpp>
#include <sivid/enclosure/expansion.hpp>
#include <sivid/enclosure/flow.hpp>

#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <stdexcept>
#include <vector>

namespace sivid {

namespace enclosure_detail {

/// What `approximate_simulator` does.
class odeint_simulator {
public:
    explicit odeint_simulator(flow const& f)
        : flow_(&f), rate_(f.rate(), 0), observe_(f.observe(), 0) {}

    [[nodiscard]] approximate_trajectory operator()(std::vector<double> const& initial,
                                                    std::vector<double> const& parameters,
                                                    double from, std::vector<double> const& times,
                                                    double tolerance,
                                                    std::function<bool()> const& keep_going) {
        namespace odeint = boost::numeric::odeint;
        using state = std::vector<double>;
        rate_.set_parameters(parameters);
        observe_.set_parameters(parameters);
        double piece_start = from;
        auto const rhs = [&](state const& x, state& dxdt, double t) {
            evaluate(rate_, piece_start, t, x);
            for (std::size_t i = 0; i < dxdt.size(); ++i) dxdt[i] = rate_.output(i, 0);
        };
        auto method =
            odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_dopri5<state>{});
        approximate_trajectory result;
        result.times = times;
        state x = initial;
        double t = from;
        double step = 1e-3;
        for (double const target : times) {
            while (t < target) {
                piece_start = t;
                double const to = std::min(target, flow_->next_knot(t));
                // The method keeps its last derivative, which a knot may have changed.
                method.reset();
                step = std::min(step, to - t);
                advance(method, rhs, x, t, to, step, keep_going);
            }
            result.states.push_back(x);
            evaluate(observe_, t, t, x);
            auto& y = result.outputs.emplace_back(flow_->channels());
            for (std::size_t i = 0; i < y.size(); ++i) y[i] = observe_.output(i, 0);
        }
        return result;
    }

private:
    template <class Method, class Rate>
    static void advance(Method& method, Rate const& rate, std::vector<double>& x, double& t,
                        double to, double& step, std::function<bool()> const& keep_going) {
        namespace odeint = boost::numeric::odeint;
        std::size_t attempts = 0;
        while (t < to) {
            if (keep_going && !keep_going())
                throw std::runtime_error("simulation was told to stop");
            double trial = std::min(step, to - t);
            bool const last = trial >= to - t;
            if (method.try_step(rate, x, t, trial) == odeint::success) {
                if (last) t = to;
                step = std::max(trial, last ? step : trial);
                attempts = 0;
            } else {
                step = trial;
                if (++attempts > 500) throw std::runtime_error("simulation got stuck");
            }
        }
    }
    void evaluate(series<double>& s, double start, double t, std::vector<double> const& x) {
        input_pieces<double> const inputs(*flow_, start, t);
        s.start(t);
        s.advance(
            0, [&x](std::size_t i, std::size_t) { return x[i]; }, inputs);
    }

    flow const* flow_;
    series<double> rate_;
    series<double> observe_;
};

} // namespace enclosure_detail

SIVID_ENTRY approximate_simulator::approximate_simulator(flow const& f)
    : work_(std::make_unique<enclosure_detail::odeint_simulator>(f)) {}
SIVID_ENTRY
approximate_simulator::approximate_simulator(approximate_simulator&&) noexcept = default;
SIVID_ENTRY approximate_simulator&
approximate_simulator::operator=(approximate_simulator&&) noexcept = default;
SIVID_ENTRY approximate_simulator::~approximate_simulator() = default;
SIVID_ENTRY approximate_trajectory approximate_simulator::operator()(
    std::vector<double> const& initial, std::vector<double> const& parameters, double from,
    std::vector<double> const& times, double tolerance, std::function<bool()> const& keep_going) {
    return (*work_)(initial, parameters, from, times, tolerance, keep_going);
}

} // namespace sivid

#endif
