// SPDX-License-Identifier: MIT
// Simulations of the hovercraft with sensitivities, the work of which fits consist, by some of
// Boost.Odeint's steppers: seconds of the processor for a run (the least of some), and how far its
// outputs and derivatives are from those of a far smaller tolerance.
//     sivid_benchmark_simulation [REPETITIONS]
#include "model.hpp"

#include <sivid/approximate/simulate/approximate_simulator.hpp>
#include <sivid/approximate/simulate/odeint_stepping.hpp>
#ifdef SIVID_FORMER_SIMULATOR // to compare with another implementation in one run
#include SIVID_FORMER_SIMULATOR
#endif

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

struct result {
    double best = HUGE_VAL;
    sivid::simulated_outputs out;
};

template <class Simulator>
result timed(Simulator run, setting const& s, bool sensitive, double accuracy, int repetitions) {
    run.set_accuracy(accuracy);
    auto const layout = s.layout();
    result r;
    for (int k = 0; k < repetitions; ++k) {
        double const begin = seconds();
        if (!run({1, 0.1, 0, 0, 0, 0}, s.parameters, s.disturbance, layout, sensitive, r.out)) {
            std::printf("    failed\n");
            return {};
        }
        r.best = std::min(r.best, seconds() - begin);
    }
    return r;
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
        auto const exact = timed(make(methods[3].steps), s, true, 1e-5, 1);
        auto const print = [&](char const* name, result const& values, result const& all) {
            std::printf("  %-22s outputs %10.6f s, with derivatives %10.6f s; off by %.1e, %.1e\n",
                        name, values.best, all.best,
                        largest_difference(all.out.values, exact.out.values),
                        largest_difference(all.out.jacobian, exact.out.jacobian));
        };
#ifdef SIVID_FORMER_SIMULATOR
        sivid::old::sensitive_simulator const former(model, s.inputs, 0, s.requests, tolerances,
                                                     s.knots);
        auto const before = timed(former, s, false, 1, repetitions);
        print("former", before, timed(former, s, true, 1, repetitions));
#endif
        for (auto const& m : methods) {
            auto const values = timed(make(m.steps), s, false, 1, repetitions);
            print(m.name, values, timed(make(m.steps), s, true, 1, repetitions));
        }
    }
    return 0;
}
