// SPDX-License-Identifier: MIT
// A small model whose two rates are known only through their product, and its identification.
#ifndef SIVID_TESTS_IO_SMALL_IDENTIFICATION_HPP
#define SIVID_TESTS_IO_SMALL_IDENTIFICATION_HPP

#include <sivid/paving/identify.hpp>

#include <cmath>
#include <string>

namespace io_support {

/// x' = -a b x, y = x; the truth is a b = 1/2.
struct two_rates {
    static constexpr auto name = "two rates";
    static constexpr auto states = sivid::states({{"x", "m", 10}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "m"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"a", "1/s", 1_dec}, {"b", "1", 0.5_dec}});
    }();

    template <class T>
    sivid::vec<T, 1> rate(T const&, sivid::vec<T, 1> const& x, sivid::vec<T, 2> const& c,
                          sivid::vec<T, 0> const&) const {
        return {-(c[0] * c[1] * x[0])};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 1> const& x, sivid::vec<T, 2> const&,
                             sivid::vec<T, 0> const&) const {
        return x;
    }
};

/// Six exact samples with a bound of 0.05; `spoilt` adds one that no parameter meets.
inline sivid::identification_problem two_rates_problem(bool spoilt = false) {
    sivid::experiment run;
    run.name = "run";
    run.initial = {sivid::interval(2.0)};
    for (int k = 1; k <= 6; ++k) {
        double const t = 0.5 * k, x = 2 * std::exp(-0.5 * t);
        run.measurements.push_back({t, 0, sivid::interval(x - 0.05, x + 0.05)});
    }
    if (spoilt) {
        run.measurements[2].bound = sivid::interval(5.0, 6.0);
        run.outliers = 1;
    }
    return {sivid::record_model<two_rates>(),
            {{"a", "b"}, {}},
            {sivid::interval(0.5, 2.0), sivid::interval(0.25, 1.0)},
            {run}};
}

inline sivid::identification two_rates_result(sivid::identification_problem const& problem) {
    sivid::identify_options options;
    options.search.accuracy = 1.0 / 128;
    options.search.seconds = 20;
    options.search.boxes = 3000;
    return sivid::identify(problem, options);
}

/// No parameter explains this: the state would have to grow.
inline sivid::identification_problem impossible_problem() {
    auto problem = two_rates_problem();
    for (auto& m : problem.experiments[0].measurements) m.bound = sivid::interval(3.0, 4.0);
    return problem;
}

} // namespace io_support

#endif
