// SPDX-License-Identifier: MIT
// x' = -a x, x(0) = 2, measured with a bound of 0.05: what explains it is known in closed form.
#ifndef SIVID_TESTS_PAVING_PLAIN_PROBLEM_HPP
#define SIVID_TESTS_PAVING_PLAIN_PROBLEM_HPP

#include <sivid/model/model.hpp>
#include <sivid/model/problem.hpp>

#include <algorithm>
#include <cmath>

namespace plain_problem {

struct decay {
    static constexpr auto name = "decay";
    static constexpr auto states = sivid::states({{"x", "m", 10}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "m"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"a", "1/s", 1_dec}});
    }();
    template <class T>
    sivid::vec<T, 1> rate(T const&, sivid::vec<T, 1> const& x, sivid::vec<T, 1> const& c,
                          sivid::vec<T, 0> const&) const {
        return {-(c[0] * x[0])};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 1> const& x, sivid::vec<T, 1> const&,
                             sivid::vec<T, 0> const&) const {
        return x;
    }
};

inline constexpr double truth = 0.5;

/// @param spoilt  so many of the samples are moved by 3
inline sivid::identification_problem make(std::size_t spoilt = 0, std::size_t outliers = 0,
                                          sivid::interval start = sivid::interval(2.0)) {
    sivid::experiment run;
    run.name = "run";
    run.initial = {start};
    for (int k = 1; k <= 6; ++k) {
        double const t = 0.5 * k, x = 2 * std::exp(-truth * t);
        double const shift = static_cast<std::size_t>(k) <= spoilt ? 3 : 0;
        run.measurements.push_back({t, 0, sivid::interval(x + shift - 0.05, x + shift + 0.05)});
    }
    run.outliers = outliers;
    return {sivid::record_model<decay>(), {{"a"}, {}}, {sivid::interval(0.25, 1.0)}, {run}};
}

/// The feasible rates of the unspoilt problem: the intersection over all samples.
inline sivid::interval feasible() {
    double low = 0, high = 9;
    for (int k = 1; k <= 6; ++k) {
        double const t = 0.5 * k, x = 2 * std::exp(-truth * t);
        low = std::max(low, -std::log((x + 0.05) / 2) / t);
        high = std::min(high, -std::log((x - 0.05) / 2) / t);
    }
    return {low, high};
}

} // namespace plain_problem

#endif
