// SPDX-License-Identifier: MIT
#ifndef TESTS_SUPPORT_EPIDEMIC_HPP
#define TESTS_SUPPORT_EPIDEMIC_HPP

#include <sivid/model/model.hpp>
#include <sivid/model/problem.hpp>

#include <cmath>

namespace support {

/// An infection whose prior somebody left at "anything up to `most` a day": nearly all of it
/// explodes within an hour. From the seventh day on readings are `factor` times what they were.
struct epidemic {
    static constexpr auto name = "epidemic";
    static constexpr auto states = sivid::states({{"s", "", 10}, {"i", "", 1}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"i", ""}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"beta", "1/d", 0_dec}, {"gamma", "1/d", 0_dec}});
    }();
    template <class T>
    sivid::vec<T, 2> rate(T const&, sivid::vec<T, 2> const& x, sivid::vec<T, 2> const& c,
                          sivid::vec<T, 0> const&) const {
        T const infections = c[0] * x[0] * x[1];
        return {-infections, infections - c[1] * x[1]};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 2> const& x, sivid::vec<T, 2> const&,
                             sivid::vec<T, 0> const&) const {
        return {x[1]};
    }
};
inline sivid::identification_problem infection(double most, double factor) {
    sivid::experiment e;
    e.name = "region";
    e.initial = {sivid::interval(1), sivid::interval(1e-6)};
    for (int k = 1; k <= 10; ++k) { // beta - gamma = 0.2 as long as s is 1
        double const i = 1e-6 * std::exp(0.2 * k) * (k > 6 ? factor : 1);
        e.measurements.push_back({1. * k, 0, sivid::interval(0.9 * i, 1.1 * i)});
    }
    return {sivid::record_model<epidemic>(),
            {{"beta", "gamma"}, {}},
            {sivid::interval(0, most), sivid::interval(0, 1)},
            {e}};
}

} // namespace support

#endif
