// SPDX-License-Identifier: MIT
#include "fit.hpp"
#include "measure.hpp"
#include "simulate.hpp"

#include <algorithm>
#include <cmath>

namespace withheld {

namespace {

constexpr double smallest_lag = 0.02; // below it explicit steps of 25 ms become unstable

/// Coarse, but finer where the model is stiff.
double step_for(world const& w) {
    double step = 0.025;
    if (w.e.rudder_lag > 0) step = std::min(step, w.e.rudder_lag / 2);
    if (w.e.motor_lag > 0) step = std::min(step, w.e.motor_lag / 2);
    if (w.e.dry_yaw_friction > 0) step = std::min(step, 0.01 * w.c.Iz / w.e.dry_yaw_friction);
    return std::max(step, 1e-3);
}

} // namespace

fit_problem::fit_problem(recording const& data, std::vector<effect const*> const& effects)
    : data_{data} {
    for (auto const& u : data.unknown)
        variables_.push_back(
            {u.name, u.prior.lo, u.prior.hi, constant_named(u.name), nullptr, 0, 0});
    for (auto const* e : effects)
        for (auto const& p : e->parameters) {
            bool const lag = e->name == "rudder_lag" || e->name == "motor_lag";
            variables_.push_back({std::string{e->name} + '.' + std::string{p.name},
                                  lag ? smallest_lag : p.lo, p.hi, nullptr, p.member, 0, 0});
        }
    for (std::size_t s = 0; s < data.scenarios.size(); ++s) {
        auto const& plan = data.scenarios[s].plan;
        if (plan.holdout) continue;
        samples_ += data.scenarios[s].samples.size();
        for (std::size_t k = 0; k < channel_count; ++k)
            if (plan.initial[k].hi > plan.initial[k].lo)
                variables_.push_back({plan.name + ':' + std::string{channel_names[k]},
                                      plan.initial[k].lo, plan.initial[k].hi, nullptr, nullptr, k,
                                      s});
    }
}

std::vector<double>
fit_problem::start(std::vector<std::pair<std::string, double>> const& values) const {
    std::vector<double> x(variables_.size(), 0.5);
    for (std::size_t i = 0; i < variables_.size(); ++i)
        for (auto const& [name, value] : values)
            if (name == variables_[i].name)
                x[i] = std::clamp(
                    (value - variables_[i].lo) / (variables_[i].hi - variables_[i].lo), 0.0, 1.0);
    return x;
}

std::vector<std::pair<std::string, double>>
fit_problem::values(std::vector<double> const& x) const {
    std::vector<std::pair<std::string, double>> all;
    for (std::size_t i = 0; i < x.size(); ++i)
        all.emplace_back(variables_[i].name,
                         variables_[i].lo + x[i] * (variables_[i].hi - variables_[i].lo));
    return all;
}

fit_problem::residuals fit_problem::evaluate(std::vector<double> const& x, bool holdout,
                                             double step) const {
    residuals all(data_.scenarios.size());
    world w;
    w.c = data_.fixed;
    auto const value = [&](std::size_t i) {
        return variables_[i].lo + x[i] * (variables_[i].hi - variables_[i].lo);
    };
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (variables_[i].constant != nullptr) w.c.*variables_[i].constant = value(i);
        if (variables_[i].effect != nullptr) w.e.*variables_[i].effect = value(i);
    }
    double const h = step > 0 ? step : step_for(w);
    for (std::size_t s = 0; s < all.size(); ++s) {
        auto const& recorded = data_.scenarios[s];
        if (recorded.plan.holdout != holdout) continue;
        channels initial{};
        for (std::size_t k = 0; k < channel_count; ++k)
            initial[k] = recorded.plan.initial[k].middle();
        for (std::size_t i = 0; i < x.size(); ++i)
            if (variables_[i].is_start() && variables_[i].scenario == s)
                initial[variables_[i].state] = value(i);
        w.motor = recorded.plan.motor;
        w.rudder = recorded.plan.rudder;
        auto const model = readings(w, initial, recorded.plan.sample_times, h);
        all[s].reserve(recorded.samples.size());
        for (auto const& m : recorded.samples) {
            double const z = (model[m.time][m.channel] - m.value) / m.error;
            all[s].push_back(std::isfinite(z) ? std::clamp(z, -1e6, 1e6) : 1e6);
        }
    }
    return all;
}

namespace {

/// The size above which a scenario's residuals are spent on the outlier budget.
double trimmed_above(std::vector<double> const& z, std::size_t budget) {
    if (budget == 0) return 1e300;
    std::vector<double> sizes;
    sizes.reserve(z.size());
    for (double const r : z) sizes.push_back(std::abs(r));
    return inflation_of(sizes, budget);
}

double powered_sum(std::vector<double> const& z, double limit, double power, double scale) {
    double sum = 0;
    for (double const r : z) {
        if (std::abs(r) > limit) continue;
        sum += power == 2 ? r * r : std::pow(std::abs(r) / scale, power);
    }
    return sum;
}

} // namespace

fit_problem::difference_quotients fit_problem::differences(std::vector<double> const& x,
                                                           bool holdout) const {
    std::size_t const n = x.size();
    double const difference = 1e-4;
    difference_quotients d{evaluate(x, holdout, 0), std::vector<residuals>(n),
                           std::vector<double>(n)};
    // Starts of different scenarios do not meet in one residual: one run serves all of a state.
    for (std::size_t i = 0; i < n; ++i) {
        if (!d.moved[i].empty()) continue;
        auto moved = x;
        std::vector<std::size_t> together{i};
        if (variables_[i].is_start())
            for (std::size_t j = i + 1; j < n; ++j)
                if (variables_[j].is_start() && variables_[j].state == variables_[i].state)
                    together.push_back(j);
        for (std::size_t const j : together) {
            d.step[j] = x[j] > 0.5 ? -difference : difference;
            moved[j] += d.step[j];
        }
        auto const run = evaluate(moved, holdout, 0);
        for (std::size_t const j : together) d.moved[j] = run;
    }
    return d;
}

std::vector<double> fit_problem::misfits(std::vector<double> const& x, bool holdout) const {
    std::vector<double> all;
    for (auto const& z : evaluate(x, holdout, 0)) all.insert(all.end(), z.begin(), z.end());
    return all;
}

fit_problem::linear_model fit_problem::linear(std::vector<double> const& x, bool holdout) const {
    auto const d = differences(x, holdout);
    linear_model l;
    l.slope.resize(x.size());
    for (std::size_t s = 0; s < d.z.size(); ++s)
        for (std::size_t m = 0; m < d.z[s].size(); ++m) {
            l.misfit.push_back(d.z[s][m]);
            for (std::size_t i = 0; i < x.size(); ++i)
                l.slope[i].push_back(elsewhere(i, s) ? 0 : d.slope(i, s, m));
        }
    return l;
}

normal_equations fit_problem::linearised(std::vector<double> const& x, double power,
                                         double scale) const {
    std::size_t const n = x.size();
    auto const d = differences(x);
    auto const& z = d.z;
    normal_equations eq;
    eq.matrix.assign(n, std::vector<double>(n, 0.0));
    eq.gradient.assign(n, 0.0);
    std::vector<double> row(n);
    for (std::size_t s = 0; s < z.size(); ++s) {
        double const limit = trimmed_above(z[s], data_.scenarios[s].budget);
        eq.objective += powered_sum(z[s], limit, power, scale);
        for (std::size_t m = 0; m < z[s].size(); ++m) {
            double const size = std::abs(z[s][m]);
            if (size > limit) continue;
            // |z|^(p/2) is the residual whose square is summed.
            double weight = 1, residual = z[s][m];
            if (power != 2) {
                double const root = std::pow(size / scale, power / 2 - 1);
                weight = power / 2 * root / scale;
                residual = root * z[s][m] / scale;
            }
            for (std::size_t i = 0; i < n; ++i)
                row[i] = elsewhere(i, s) ? 0 : weight * d.slope(i, s, m);
            for (std::size_t i = 0; i < n; ++i) {
                if (row[i] == 0) continue;
                eq.gradient[i] += row[i] * residual;
                for (std::size_t j = 0; j <= i; ++j) eq.matrix[i][j] += row[i] * row[j];
            }
        }
    }
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j) eq.matrix[i][j] = eq.matrix[j][i];
    return eq;
}

double fit_problem::minimise(std::vector<double>& x, double power, int iterations) const {
    double const scale = power == 2 ? 1 : std::max(inflation(x), 1e-6);
    least_squares_problem const problem{
        [&](std::vector<double> const& at) {
            double sum = 0;
            auto const z = evaluate(at, false, 0);
            for (std::size_t s = 0; s < z.size(); ++s)
                sum +=
                    powered_sum(z[s], trimmed_above(z[s], data_.scenarios[s].budget), power, scale);
            return sum;
        },
        [&](std::vector<double> const& at) { return linearised(at, power, scale); }};
    return withheld::minimise(problem, x, iterations);
}

double fit_problem::inflation(std::vector<double> const& x, bool holdout) const {
    double most = 0;
    auto const z = evaluate(x, holdout, 1e-3);
    for (std::size_t s = 0; s < z.size(); ++s) {
        std::vector<double> sizes;
        for (double const r : z[s]) sizes.push_back(std::abs(r));
        if (!sizes.empty()) most = std::max(most, inflation_of(sizes, data_.scenarios[s].budget));
    }
    return most;
}

double fit_problem::tighten(std::vector<double>& x) const {
    double best = inflation(x);
    auto trial = x;
    for (double const power : {4.0, 8.0, 16.0, 32.0, 64.0}) {
        minimise(trial, power, 8);
        double const now = inflation(trial);
        if (now < best) {
            best = now;
            x = trial;
        }
    }
    return best;
}

fit_result fit(fit_problem const& problem, std::vector<effect const*> const& effects,
               std::vector<std::pair<std::string, double>> const& known) {
    // One start for each combination of signs of the last effect; the earlier ones are known.
    std::vector<std::vector<std::pair<std::string, double>>> starts{known};
    if (!effects.empty())
        for (auto const& p : effects.back()->parameters) {
            auto const name = std::string{effects.back()->name} + '.' + std::string{p.name};
            bool const alone = effects.back()->parameters.size() == 1;
            double const size = (p.small + p.large) / 2;
            auto mirrored = starts;
            for (auto& s : starts) s.emplace_back(name, alone ? size : size / 20);
            if (!p.either_sign || !alone) continue;
            for (auto& s : mirrored) s.emplace_back(name, -size);
            starts.insert(starts.end(), mirrored.begin(), mirrored.end());
        }
    fit_result best;
    for (auto const& s : starts) {
        auto x = problem.start(s);
        double const rss = problem.minimise(x, 2, 25);
        if (best.x.empty() || rss < best.rss) best = {x, rss, 0, 0};
    }
    best.inflation = problem.inflation(best.x);
    auto const count = static_cast<double>(problem.variables().size());
    best.criterion = 3 * best.rss + count * std::log(static_cast<double>(problem.samples()));
    return best;
}

} // namespace withheld
