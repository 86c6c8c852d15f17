// SPDX-License-Identifier: MIT
// Records of machines, as long and as dense as their loggers write them, each identified from a
// cold start:
//     sivid_benchmark_robots [--seconds S] [--no-windows] [NAME...]
// Beside the hulls, in shares of the prior, stands a plain least-squares fit of the same record
// (not proved). Noise is uniform and fills its bound.
#include <sivid/approximate/fit/fit.hpp>
#include <sivid/model/model.hpp>
#include <sivid/paving/identify.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace sivid;

/// Two links that turn about upright axes and lean against gravity: the momentum form's constants,
/// viscous friction, torques as inputs; the angles are measured.
struct arm {
    static constexpr auto name = "arm";
    static constexpr auto states = sivid::states(
        {{"q1", "rad", 10}, {"q2", "rad", 10}, {"w1", "rad/s", 20}, {"w2", "rad/s", 20}});
    static constexpr auto inputs = sivid::inputs({{"T1", "N m"}, {"T2", "N m"}});
    static constexpr auto channels = sivid::channels({{"q1", "rad"}, {"q2", "rad"}});
    static constexpr auto constants = sivid::constants({{"a1", "kg m^2", 0.6_dec},
                                                        {"a2", "kg m^2", 0.12_dec},
                                                        {"a3", "kg m^2", 0.15_dec},
                                                        {"f1", "N m s", 0.3_dec},
                                                        {"f2", "N m s", 0.1_dec},
                                                        {"g", "N m", 2_dec}});
    template <class T>
    vec<T, 4> rate(T const&, vec<T, 4> const& x, vec<T, 6> const& c, vec<T, 2> const& u) const {
        using std::cos, std::sin;
        auto const& [a1, a2, a3, f1, f2, g] = c;
        T const c2 = cos(x[1]), h = a2 * sin(x[1]);
        T const m11 = a1 + 2 * a2 * c2, m12 = a3 + a2 * c2;
        T const r1 = u[0] - f1 * x[2] + h * x[3] * (2 * x[2] + x[3]) - g * cos(x[0]);
        T const r2 = u[1] - f2 * x[3] - h * x[2] * x[2];
        T const det = m11 * a3 - m12 * m12;
        return {x[2], x[3], (a3 * r1 - m12 * r2) / det, (m11 * r2 - m12 * r1) / det};
    }
    template <class T>
    vec<T, 2> observe(T const&, vec<T, 4> const& x, vec<T, 6> const&, vec<T, 2> const&) const {
        return {x[0], x[1]};
    }
};

/// Masses in a row between springs and dampers, the first one pushed; all places are measured.
struct chain {
    static constexpr std::size_t masses = 6;
    static constexpr auto name = "chain";
    static constexpr auto states = sivid::states({{"x1", "m", 5},
                                                  {"x2", "m", 5},
                                                  {"x3", "m", 5},
                                                  {"x4", "m", 5},
                                                  {"x5", "m", 5},
                                                  {"x6", "m", 5},
                                                  {"v1", "m/s", 9},
                                                  {"v2", "m/s", 9},
                                                  {"v3", "m/s", 9},
                                                  {"v4", "m/s", 9},
                                                  {"v5", "m/s", 9},
                                                  {"v6", "m/s", 9}});
    static constexpr auto inputs = sivid::inputs({{"F", "N"}});
    static constexpr auto channels = sivid::channels(
        {{"x1", "m"}, {"x2", "m"}, {"x3", "m"}, {"x4", "m"}, {"x5", "m"}, {"x6", "m"}});
    static constexpr auto constants = sivid::constants({{"k1", "N/m", 3_dec},
                                                        {"k2", "N/m", 4_dec},
                                                        {"k3", "N/m", 5_dec},
                                                        {"k4", "N/m", 3_dec},
                                                        {"k5", "N/m", 4_dec},
                                                        {"k6", "N/m", 5_dec},
                                                        {"d1", "N s/m", 0.2_dec},
                                                        {"d2", "N s/m", 0.3_dec},
                                                        {"d3", "N s/m", 0.2_dec},
                                                        {"d4", "N s/m", 0.3_dec},
                                                        {"d5", "N s/m", 0.2_dec},
                                                        {"d6", "N s/m", 0.3_dec}});
    template <class T>
    vec<T, 12> rate(T const&, vec<T, 12> const& x, vec<T, 12> const& c, vec<T, 1> const& u) const {
        vec<T, 12> f;
        for (std::size_t i = 0; i < masses; ++i) {
            auto const pull = [&](std::size_t k) { // of spring k: from mass k - 1, or the wall
                T const dx = k == 0 ? x[0] : x[k] - x[k - 1];
                T const dv = k == 0 ? x[masses] : x[masses + k] - x[masses + k - 1];
                return c[k] * dx + c[masses + k] * dv;
            };
            f[i] = x[masses + i];
            T force = -pull(i);
            if (i + 1 < masses) force = force + pull(i + 1);
            f[masses + i] = i == 0 ? force + u[0] : force;
        }
        return f;
    }
    template <class T>
    vec<T, 6> observe(T const&, vec<T, 12> const& x, vec<T, 12> const&, vec<T, 1> const&) const {
        return {x[0], x[1], x[2], x[3], x[4], x[5]};
    }
};

/// A driven mass on a spring; its place is measured, and where it began is hardly known.
struct oscillator {
    static constexpr auto name = "oscillator";
    static constexpr auto states = sivid::states({{"x", "m", 10}, {"v", "m/s", 20}});
    static constexpr auto inputs = sivid::inputs({{"F", "N"}});
    static constexpr auto channels = sivid::channels({{"x", "m"}});
    static constexpr auto constants =
        sivid::constants({{"k", "N/m", 4_dec}, {"d", "N s/m", 0.5_dec}, {"b", "1", 1_dec}});
    template <class T>
    vec<T, 2> rate(T const&, vec<T, 2> const& x, vec<T, 3> const& c, vec<T, 1> const& u) const {
        return {x[1], c[2] * u[0] - c[0] * x[0] - c[1] * x[1]};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 2> const& x, vec<T, 3> const&, vec<T, 1> const&) const {
        return {x[0]};
    }
};

/// How a record is made.
struct recording {
    std::string what;
    double seconds = 10, rate = 100;               ///< of samples [1/s]
    double held = 0.01;                            ///< inputs are held so long [s]
    double bound = 0.002, spread = 0.1, start = 0; ///< of measurements, of the prior, of the start
};

template <class Model, class Input>
identification_problem record_of(recording const& how, states_of<Model, double> x,
                                 Input const& input) {
    Model const model;
    auto const recorded = record_model(model);
    constants_of<Model, double> c;
    std::vector<std::string> names;
    std::vector<interval> prior, start;
    for (std::size_t j = 0; j < c.size(); ++j) {
        c[j] = recorded.about.constants[j].nominal.nearest;
        names.push_back(recorded.about.constants[j].name);
        prior.push_back(interval(c[j] * (1 - how.spread), c[j] * (1 + how.spread)));
    }
    std::mt19937 random(1);
    std::uniform_real_distribution<> noise(-0.999, 0.999);
    for (double const value : x) {
        double const middle = value + 0.5 * how.start * noise(random);
        start.push_back(interval(middle - how.start, middle + how.start));
    }
    experiment e{how.what, {}, 0, box(std::move(start)), {}, 0};
    std::array<std::vector<double>, input_count<Model>> u;
    std::vector<double> times;
    auto const every = static_cast<int>(std::lround(1 / (how.rate * how.held)));
    auto const count = static_cast<int>(std::lround(how.seconds / how.held));
    int const parts = std::max(1, static_cast<int>(how.held / 0.0005));
    double const h = how.held / parts;
    auto const moved = [](auto a, auto const& b, double w) {
        for (std::size_t i = 0; i < a.size(); ++i) a[i] += w * b[i];
        return a;
    };
    for (int k = 0; k <= count; ++k) {
        double const t = k * how.held;
        auto const now = input(t, x);
        times.push_back(t);
        for (std::size_t i = 0; i < now.size(); ++i) u[i].push_back(now[i]);
        if (k > 0 && k % every == 0) {
            auto const y = model.observe(t, x, c, now);
            for (std::size_t i = 0; i < y.size(); ++i) {
                double const seen = y[i] + how.bound * noise(random);
                e.measurements.push_back({t, i, interval(seen - how.bound, seen + how.bound)});
            }
        }
        for (int s = 0; s < parts; ++s) { // Runge and Kutta
            auto const k1 = model.rate(t, x, c, now),
                       k2 = model.rate(t, moved(x, k1, h / 2), c, now),
                       k3 = model.rate(t, moved(x, k2, h / 2), c, now),
                       k4 = model.rate(t, moved(x, k3, h), c, now);
            for (std::size_t i = 0; i < x.size(); ++i) {
                x[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
            }
        }
    }
    for (auto& values : u) {
        e.inputs.push_back(sampled_signal(times, values, interpolation::hold));
    }
    return {recorded, {names, {}}, box(std::move(prior)), {e}};
}

identification_problem moving_arm(recording const& how) {
    return record_of<arm>(how, {0, 0.5, 0, 0}, [](double t, vec<double, 4> const& x) {
        return vec<double, 2>{2 * std::cos(x[0]) - 3 * (x[0] - 0.8 * std::sin(1.3 * t + 1)) -
                                  0.3 * x[2] + 1.5 * std::sin(3.1 * t) + std::sin(7 * t + 2),
                              0.5 + std::sin(1.9 * t) - x[1] - 0.05 * x[3] +
                                  0.5 * std::sin(4.3 * t + 1) + 0.4 * std::sin(9 * t)};
    });
}
identification_problem pushed_chain(recording const& how) {
    return record_of<chain>(how, {}, [](double t, auto const&) {
        return vec<double, 1>{2 * std::sin(1.1 * t) + 2 * std::sin(2.3 * t + 1) +
                              std::sin(4.1 * t)};
    });
}
identification_problem driven_mass(recording const& how) {
    return record_of<oscillator>(how, {0.3, -0.4}, [](double t, auto const&) {
        return vec<double, 1>{std::sin(1.3 * t) > 0 ? 3.0 : -3.0};
    });
}

void show(recording const& how, identification_problem const& problem, double budget,
          bool windows) {
    using clock = std::chrono::steady_clock;
    auto const begin = clock::now();
    auto const fitted = fit(problem, fit_norm::squares);
    double const fit_seconds = std::chrono::duration<double>(clock::now() - begin).count();
    identify_options options;
    options.search.seconds = budget;
    options.only_hulls = true;
    options.windows = windows;
    auto const found = identify(problem, options);
    std::printf("%s: %s, %s, %.1f s, %zu boxes", how.what.c_str(),
                std::string{to_string(found.verdict)}.c_str(),
                std::string{to_string(found.reason)}.c_str(), found.seconds, found.boxes);
    if (found.windows) {
        std::printf("; %zu windows, at most %.2f s, left %.3g of the volume in %.1f s",
                    found.windows->windows, found.windows->longest, found.windows->left,
                    found.windows->seconds);
    }
    std::printf("\n  hulls, %% of the prior:");
    bool contains_truth = true;
    for (std::size_t j = 0; j < found.hull.size(); ++j) {
        std::printf(" %.3g", 100 * width(found.hull[j]) / width(problem.prior[j]));
        contains_truth = contains_truth && contains(found.hull[j], mid(problem.prior[j]));
    }
    std::printf("%s\n  least squares off by, %% of the prior:",
                contains_truth ? "" : " TRUTH LOST");
    for (std::size_t j = 0; j < fitted.parameters.size(); ++j) {
        auto const& side = problem.prior[j];
        std::printf(" %.2g", 100 * std::abs(fitted.parameters[j] - mid(side)) / width(side));
    }
    std::printf(" (%.2f s)\n", fit_seconds);
    std::fflush(stdout);
}

struct machine {
    recording how;
    std::function<identification_problem(recording const&)> make;
};

} // namespace

int main(int argc, char** argv) {
    std::vector<machine> const all{
        {{"arm, 10 s, torque at 100 Hz, +-10 %"}, moving_arm},
        {{"arm, 10 s, torque at 1 kHz, +-10 %", 10, 100, 0.001}, moving_arm},
        {{"arm, 10 s, torque at 100 Hz, +-15 %", 10, 100, 0.01, 0.002, 0.15}, moving_arm},
        {{"arm, 10 s, torque at 100 Hz, +-10 %, start +-0.1", 10, 100, 0.01, 0.002, 0.1, 0.1},
         moving_arm},
        {{"arm, 10 s, torque at 1 kHz, +-20 %", 10, 100, 0.001, 0.002, 0.2}, moving_arm},
        {{"chain of 6 masses, 20 s, +-25 %", 20, 5, 0.1, 0.01, 0.25}, pushed_chain},
        {{"oscillator, 100 s, start +-1", 100, 10, 0.1, 0.02, 0.3, 1}, driven_mass},
        {{"oscillator, 10 s, start +-1", 10, 10, 0.1, 0.02, 0.3, 1}, driven_mass}};
    double budget = 10;
    bool windows = true;
    std::vector<std::string> chosen;
    for (int k = 1; k < argc; ++k) {
        if (std::string{argv[k]} == "--seconds" && k + 1 < argc) {
            budget = std::atof(argv[++k]);
        } else if (std::string{argv[k]} == "--no-windows") {
            windows = false;
        } else {
            chosen.emplace_back(argv[k]);
        }
    }
    for (auto const& m : all) {
        bool const wanted =
            chosen.empty() || std::any_of(chosen.begin(), chosen.end(), [&m](auto const& name) {
                return m.how.what.starts_with(name);
            });
        if (wanted) show(m.how, m.make(m.how), budget, windows);
    }
}
