// SPDX-License-Identifier: MIT
// Models with one to four constants, records of them with errors of several distributions, and the
// region by its definition in plain doubles.
#ifndef SIVID_TESTS_PAVING_CONFIDENCE_MODELS_HPP
#define SIVID_TESTS_PAVING_CONFIDENCE_MODELS_HPP

#include <sivid/model/model.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/confidence/confidence_test.hpp>
#include <sivid/paving/confidence_region.hpp>

#include "support/random.hpp"

#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace confidence_models {

using namespace sivid::literals;

/// x' = b, y = a + x: linear in both constants.
struct line {
    static constexpr auto name = "line";
    static constexpr double start = 0;
    static constexpr auto states = sivid::states({{"x", "1", 1}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"y", "1"}});
    static constexpr auto constants = sivid::constants({{"a", "1", 1_dec}, {"b", "1", 1_dec}});
    template <class T>
    sivid::vec<T, 1> rate(T const&, sivid::vec<T, 1> const&, sivid::vec<T, 2> const& c,
                          sivid::vec<T, 0> const&) const {
        return {c[1]};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 1> const& x, sivid::vec<T, 2> const& c,
                             sivid::vec<T, 0> const&) const {
        return {c[0] + x[0]};
    }
    static double output(double t, std::vector<double> const& c) { return c[0] + c[1] * t; }
};

/// x' = -k x, y = A x.
struct decay {
    static constexpr auto name = "decay";
    static constexpr double start = 1;
    static constexpr auto states = sivid::states({{"x", "1", 1}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"y", "1"}});
    static constexpr auto constants = sivid::constants({{"A", "1", 1_dec}, {"k", "1/s", 1_dec}});
    template <class T>
    sivid::vec<T, 1> rate(T const&, sivid::vec<T, 1> const& x, sivid::vec<T, 2> const& c,
                          sivid::vec<T, 0> const&) const {
        return {-(c[1] * x[0])};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 1> const& x, sivid::vec<T, 2> const& c,
                             sivid::vec<T, 0> const&) const {
        return {c[0] * x[0]};
    }
    static double output(double t, std::vector<double> const& c) {
        return c[0] * std::exp(-c[1] * t);
    }
};

/// Two compartments that empty at their own rates: y = A exp(-k t) + B exp(-l t).
struct two_decays {
    static constexpr auto name = "two decays";
    static constexpr double start = 1;
    static constexpr auto states = sivid::states({{"x", "1", 1}, {"z", "1", 1}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"y", "1"}});
    static constexpr auto constants = sivid::constants(
        {{"A", "1", 1_dec}, {"k", "1/s", 1_dec}, {"B", "1", 1_dec}, {"l", "1/s", 1_dec}});
    template <class T>
    sivid::vec<T, 2> rate(T const&, sivid::vec<T, 2> const& x, sivid::vec<T, 4> const& c,
                          sivid::vec<T, 0> const&) const {
        return {-(c[1] * x[0]), -(c[3] * x[1])};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 2> const& x, sivid::vec<T, 4> const& c,
                             sivid::vec<T, 0> const&) const {
        return {c[0] * x[0] + c[2] * x[1]};
    }
    static double output(double t, std::vector<double> const& c) {
        return c[0] * std::exp(-c[1] * t) + c[2] * std::exp(-c[3] * t);
    }
};

enum class noise { gaussian, laplace, uniform, mixed };
inline constexpr noise all_noises[] = {noise::gaussian, noise::laplace, noise::uniform,
                                       noise::mixed};

/// One error of size about 1; of the mixed ones each tenth is thirty times as large.
inline double error_of(noise kind, support::draws& d, std::size_t i) {
    double const u = d.uniform(1e-12, 1), v = d.uniform(0, 1);
    double const normal = std::sqrt(-2 * std::log(u)) * std::cos(6.283185307179586 * v);
    switch (kind) {
    case noise::gaussian:
        return normal;
    case noise::laplace:
        return (v < 0.5 ? 1 : -1) * std::log(u);
    case noise::uniform:
        return 2 * v - 1;
    case noise::mixed:
        break;
    }
    return (d.below(10) == 0 ? 30 : 1) *
           (i % 2 == 0 ? normal : (2 * v - 1) * (1 + 0.1 * static_cast<double>(i)));
}

/// A record of a model whose truth is known.
template <class Model>
struct recorded {
    std::vector<double> truth;
    sivid::identification_problem problem;
    std::vector<double> times, seen;

    /// @param bound  what the problem states as error bound: nothing rests on it
    recorded(std::vector<double> p, sivid::box prior, std::size_t samples, double last,
             double bound = 0.1)
        : truth(std::move(p)) {
        sivid::experiment run;
        run.name = "run";
        auto const model = sivid::record_model<Model>();
        run.initial = sivid::box(model.about.states.size());
        for (std::size_t s = 0; s < run.initial.size(); ++s)
            run.initial[s] = sivid::interval(Model::start);
        for (std::size_t i = 1; i <= samples; ++i) {
            times.push_back(last * static_cast<double>(i) / static_cast<double>(samples));
            run.measurements.push_back({times.back(), 0, sivid::interval(0.0)});
        }
        seen.resize(samples);
        bound_ = bound;
        sivid::parameter_choice choice;
        for (auto const& c : model.about.constants) choice.unknown.push_back(c.name);
        problem = {model, choice, std::move(prior), {run}};
    }
    void draw(noise kind, double size, support::draws& d) {
        for (std::size_t i = 0; i < times.size(); ++i) {
            seen[i] = Model::output(times[i], truth) + size * error_of(kind, d, i);
            problem.experiments[0].measurements[i].bound =
                sivid::interval(seen[i] - bound_, seen[i] + bound_);
        }
    }

private:
    double bound_ = 0;
};

} // namespace confidence_models

#endif
