// SPDX-License-Identifier: MIT
// Simulations of the hovercraft with sensitivities, the work of which fits consist, by a
// Runge-Kutta method written by hand and by some of Boost.Odeint's steppers: seconds of the
// processor for a run (the least of some, the methods taking turns) and how many times those by
// hand, and how far its outputs and derivatives are from those of a far smaller tolerance.
//     sivid_benchmark_simulation [REPETITIONS]
#include "model.hpp"

#include <sivid/approximate/simulate/approximate_simulator.hpp>
#include <sivid/approximate/simulate/odeint_stepping.hpp>

#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_cash_karp54.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

namespace {

namespace odeint = boost::numeric::odeint;

struct setting {
    std::string name;
    std::vector<sivid::signal> inputs;
    std::vector<sivid::output_request> requests;
    std::vector<std::string> unknown;
    std::vector<double> parameters, knots, disturbance;
    bool starts = false;
    std::vector<std::size_t> disturbed{};

    [[nodiscard]] sivid::sensitivity_layout layout() const {
        sivid::sensitivity_layout l;
        for (std::size_t j = 0; j < unknown.size(); ++j) l.parameter_column.push_back(l.columns++);
        l.start_column.assign(6, sivid::sensitivity_layout::none);
        for (auto& c : l.start_column) {
            if (starts) c = l.columns++;
        }
        l.disturbed = disturbed;
        l.first_disturbance = l.columns;
        l.columns += disturbed.size() * knots.size();
        return l;
    }
};

/// A sinuous drive, sampled.
setting drive(std::string name, std::size_t samples, double rate) {
    setting s;
    s.name = std::move(name);
    std::vector<double> t, w, d;
    for (std::size_t k = 0; k <= samples; ++k) {
        t.push_back(static_cast<double>(k) / rate);
        w.push_back(80 + 10 * std::sin(0.7 * t.back()));
        d.push_back(0.4 * std::sin(1.3 * t.back()));
        for (std::size_t c = 0; k > 0 && c < 6; ++c) s.requests.push_back({t.back(), c});
    }
    s.inputs = {sivid::sampled_signal(t, w, sivid::interpolation::linear),
                sivid::sampled_signal(t, d, sivid::interpolation::linear)};
    s.unknown = {"Sv", "Sg", "L"};
    s.parameters = {0.22, 0.04, 0.3};
    return s;
}

double seconds() { return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC); }

using simulator = sivid::approximate_simulator;

/// What `classical_steps` has Odeint do, without Odeint: the measure of what that costs.
class steps_by_hand final : public sivid::stepping {
public:
    sivid::step_outcome step(sivid::rate_function& rate, sivid::simulation_state const& x,
                             sivid::simulation_state const& dx, double& t,
                             sivid::simulation_state& to, sivid::simulation_state& rate_there,
                             double& h) override {
        auto const size = x.size();
        for (auto* v : {&to, &rate_there, &at_, &second_, &third_, &fourth_}) v->resize(size);
        auto const ahead = [&](double by, sivid::simulation_state const& slope) {
            for (Eigen::Index i = 0; i < size; ++i) at_[i] = x[i] + by * slope[i];
        };
        ahead(0.5 * h, dx);
        rate(at_, second_, t + 0.5 * h);
        ahead(0.5 * h, second_);
        rate(at_, third_, t + 0.5 * h);
        ahead(h, third_);
        rate(at_, fourth_, t + h);
        for (Eigen::Index i = 0; i < size; ++i) {
            to[i] = x[i] + h / 6 * (dx[i] + 2 * (second_[i] + third_[i]) + fourth_[i]);
        }
        rate(to, rate_there, t + h);
        double worst = 0;
        for (std::size_t i = 0; i < tolerance.absolute.size(); ++i) {
            auto const k = static_cast<Eigen::Index>(i);
            worst =
                std::max(worst, h / 6 * std::abs(fourth_[k] - rate_there[k]) /
                                    (tolerance.absolute[i] + tolerance.relative * std::abs(x[k])));
        }
        worst /= tolerance.accuracy;
        if (!(worst <= 1) && h > tolerance.shortest) {
            h *= std::max(0.9 * std::pow(worst, -1.0 / 3), 0.2);
            return sivid::step_outcome::too_long;
        }
        t += h;
        if (worst < 0.5) h *= 0.9 * std::pow(std::max(worst, std::pow(5.0, -4)), -0.25);
        return sivid::step_outcome::with_rate;
    }

private:
    sivid::simulation_state at_, second_, third_, fourth_;
};
std::unique_ptr<sivid::stepping> by_hand() { return std::make_unique<steps_by_hand>(); }

struct result {
    double best = HUGE_VAL;
    sivid::simulated_outputs out;
};

/// One run after another of each simulator in turn, so that what disturbs one disturbs all.
std::vector<result> timed(std::vector<simulator>& runs, setting const& s, bool sensitive,
                          double accuracy, int repetitions) {
    auto const layout = s.layout();
    std::vector<result> results(runs.size());
    for (auto& run : runs) run.set_accuracy(accuracy);
    for (int k = 0; k < repetitions; ++k) {
        for (std::size_t m = 0; m < runs.size(); ++m) {
            auto& r = results[m];
            double const begin = seconds();
            if (!runs[m]({1, 0.1, 0, 0, 0, 0}, s.parameters, s.disturbance, layout, sensitive,
                         r.out)) {
                std::printf("    failed\n");
                return results;
            }
            r.best = std::min(r.best, seconds() - begin);
        }
    }
    return results;
}

double largest_difference(std::vector<double> const& a, std::vector<double> const& b) {
    double most = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        most = std::max(most, std::abs(a[k] - b[k]) / (1 + std::abs(b[k])));
    }
    return most;
}

} // namespace

int main(int argc, char** argv) {
    int const repetitions = argc > 1 ? std::atoi(argv[1]) : 20;
    std::vector<setting> settings{drive("3 s at 100 Hz, 3 parameters", 300, 100),
                                  drive("20 000 samples, 3 parameters and 6 starts", 20000, 100),
                                  drive("3 s at 100 Hz, two missing rates", 300, 100),
                                  drive("3 samples in 30 s", 3, 0.1)};
    settings[1].starts = true;
    for (int k = 0; k <= 150; ++k) settings[2].knots.push_back(0.02 * k);
    settings[2].disturbed = {0, 2};
    settings[2].disturbance.assign(2 * settings[2].knots.size(), 0.01);
    struct method {
        char const* name;
        sivid::stepping_maker steps;
    };
    method const methods[] = {
        {"by hand", by_hand},
        {"classical_steps", sivid::classical_steps},
        {"dormand_prince_steps", sivid::dormand_prince_steps},
        {"cash_karp54", sivid::step_by<sivid::odeint_method<odeint::runge_kutta_cash_karp54>>},
        {"fehlberg78", sivid::step_by<sivid::odeint_method<odeint::runge_kutta_fehlberg78>>},
        {"bulirsch_stoer", sivid::step_by<sivid::odeint_method<odeint::bulirsch_stoer>>}};
    for (auto const& s : settings) {
        std::printf("%s: %zu columns\n", s.name.c_str(), s.layout().columns);
        sivid::parameter_choice const choice{s.unknown, {}};
        auto const model = std::make_shared<sivid::approximate_model const>(
            sivid::record_model(hovercraft{}), choice, s.inputs);
        std::vector<double> const tolerances(6, 1e-6);
        auto const make = [&](sivid::stepping_maker steps) {
            return simulator(model, s.inputs, 0, s.requests, tolerances, s.knots, steps);
        };
        std::vector<simulator> runs, finest;
        for (auto const& m : methods) runs.push_back(make(m.steps));
        finest.push_back(
            make(sivid::step_by<sivid::odeint_method<odeint::runge_kutta_fehlberg78>>));
        auto const exact = timed(finest, s, true, 1e-5, 1).front();
        auto const values = timed(runs, s, false, 1, repetitions);
        auto const all = timed(runs, s, true, 1, repetitions);
        for (std::size_t m = 0; m < all.size(); ++m) {
            std::printf("  %-22s outputs %10.6f s (%.2f), with derivatives %10.6f s (%.2f); "
                        "off by %.1e, %.1e\n",
                        methods[m].name, values[m].best, values[m].best / values[0].best,
                        all[m].best, all[m].best / all[0].best,
                        largest_difference(all[m].out.values, exact.out.values),
                        largest_difference(all[m].out.jacobian, exact.out.jacobian));
        }
    }
    return 0;
}
