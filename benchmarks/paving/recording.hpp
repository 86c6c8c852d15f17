// SPDX-License-Identifier: MIT
#ifndef SIVID_BENCHMARKS_PAVING_RECORDING_HPP
#define SIVID_BENCHMARKS_PAVING_RECORDING_HPP

#include <sivid/approximate/simulate/approximate_program.hpp>
#include <sivid/model/model.hpp>
#include <sivid/model/problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace robots {

using namespace sivid;

/// How records are made: a machine with its nominal constants runs under inputs that are held for
/// some time; noise is uniform and fills its bound.
struct recording {
    std::string what;
    double seconds = 10, rate = 100; ///< of samples [1/s]
    double held = 0.01;              ///< inputs are held so long [s]
    double bound = 0.002;            ///< of errors, times the channel's own unit
    double spread = 0.1;             ///< of the prior about the truth, as a share of it
    double start = 0;                ///< the states at the start are known so well
    std::size_t experiments = 1;
    std::size_t outliers = 0;           ///< allowed in each, none planted
    std::vector<std::string> unknown{}; ///< constants; empty: all
    double finest = 0.0005;             ///< step of the simulation, at most [s]
};

using values = std::vector<double>;

/// What drives a machine, and from where: `input(t, x)` may feed the states back.
struct driven {
    recorded_model model;
    values start;
    std::function<values(double, values const&)> input;
    values units{}; ///< of the channels' errors; empty: 1
};

/// The machine in plain doubles, by the method of Runge and Kutta.
class simulator {
public:
    explicit simulator(driven const& machine)
        : n_(machine.model.about.states.size()),
          program_(machine.model.g,
                   [&] {
                       auto outputs = machine.model.rate;
                       outputs.insert(outputs.end(), machine.model.observe.begin(),
                                      machine.model.observe.end());
                       return outputs;
                   }(),
                   {n_, machine.model.about.inputs.size(), machine.model.about.constants.size()}),
          memory_(program_.memory()) {
        auto const& constants = machine.model.about.constants;
        for (std::size_t j = 0; j < constants.size(); ++j) {
            memory_[program_.shape().constant() + j] = constants[j].nominal.nearest;
        }
        program_.prepare(memory_);
    }

    values outputs(double t, values const& x, values const& u) {
        run(t, x, u);
        values y;
        for (std::size_t i = n_; i < program_.output_count(); ++i) {
            y.push_back(memory_[program_.output(i)]);
        }
        return y;
    }

    void step(double t, values& x, values const& u, double h) {
        auto const rate = [&](values const& at) {
            run(t, at, u);
            values f(n_);
            for (std::size_t i = 0; i < n_; ++i) f[i] = memory_[program_.output(i)];
            return f;
        };
        auto const moved = [&x](values const& f, double by) {
            auto at = x;
            for (std::size_t i = 0; i < at.size(); ++i) at[i] += by * f[i];
            return at;
        };
        auto const k1 = rate(x), k2 = rate(moved(k1, h / 2)), k3 = rate(moved(k2, h / 2)),
                   k4 = rate(moved(k3, h));
        for (std::size_t i = 0; i < n_; ++i)
            x[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }

private:
    void run(double t, values const& x, values const& u) {
        memory_[0] = t;
        std::copy(x.begin(), x.end(),
                  memory_.begin() + static_cast<long>(program_.shape().state()));
        std::copy(u.begin(), u.end(),
                  memory_.begin() + static_cast<long>(program_.shape().input()));
        program_.run(memory_);
    }

    std::size_t n_;
    approximate_program program_;
    values memory_;
};

/// One record; inputs run `late` against those of the first one.
inline experiment recorded(driven const& machine, recording const& how, std::string name,
                           double late, std::mt19937& random) {
    std::uniform_real_distribution<> noise(-0.999, 0.999);
    simulator simulated(machine);
    std::vector<interval> start;
    for (double const value : machine.start) {
        double const middle = value + 0.5 * how.start * noise(random);
        start.push_back(interval(middle - how.start, middle + how.start));
    }
    experiment e{std::move(name), {}, 0, box(std::move(start)), {}, how.outliers};
    std::vector<values> u(machine.model.about.inputs.size());
    values times, now, x = machine.start;
    double const tick = std::min(how.held, 1 / how.rate);
    auto const ticks = [tick](double time) { return static_cast<int>(std::lround(time / tick)); };
    int const hold = ticks(how.held), every = ticks(1 / how.rate), count = ticks(how.seconds);
    int const parts = std::max(1, static_cast<int>(std::ceil(tick / how.finest - 1e-9)));
    for (int k = 0; k <= count; ++k) {
        double const t = k * tick;
        if (k % hold == 0) {
            now = machine.input(t + late, x);
            times.push_back(t);
            for (std::size_t i = 0; i < now.size(); ++i) u[i].push_back(now[i]);
        }
        if (k > 0 && k % every == 0) {
            auto const y = simulated.outputs(t, x, now);
            for (std::size_t i = 0; i < y.size(); ++i) {
                double const bound = how.bound * (machine.units.empty() ? 1 : machine.units[i]);
                double const seen = y[i] + bound * noise(random);
                e.measurements.push_back({t, i, interval(seen - bound, seen + bound)});
            }
        }
        for (int s = 0; s < parts; ++s) simulated.step(t, x, now, tick / parts);
    }
    for (auto const& each : u) {
        e.inputs.push_back(sampled_signal(times, each, interpolation::hold));
    }
    return e;
}

/// Which constants explain the machine's records?
inline identification_problem record_of(driven const& machine, recording const& how) {
    identification_problem p{machine.model, {how.unknown, {}}, {}, {}};
    auto& unknown = p.choice.unknown;
    auto const& constants = p.model.about.constants;
    if (unknown.empty()) {
        for (auto const& c : constants) unknown.push_back(c.name);
    }
    std::vector<interval> prior; // in the order of the unknowns
    for (auto const& name : unknown) {
        double const truth = constants[index_of(constants, name, "constant")].nominal.nearest;
        prior.push_back(interval(truth * (1 - how.spread), truth * (1 + how.spread)));
    }
    p.prior = box(std::move(prior));
    std::mt19937 random(1);
    for (std::size_t k = 0; k < how.experiments; ++k) {
        p.experiments.push_back(recorded(machine, how, "record " + std::to_string(k + 1),
                                         0.37 * static_cast<double>(k), random));
    }
    return p;
}

} // namespace robots

#endif
