// SPDX-License-Identifier: MIT
// Static problems whose solution sets are known, or cheaply sampled.
#ifndef SIVID_TESTS_PAVING_STATIC_MODELS_HPP
#define SIVID_TESTS_PAVING_STATIC_MODELS_HPP

#include <sivid/paving/static_problem.hpp>

#include <cmath>
#include <cstddef>

namespace static_models {

struct ring {
    static constexpr auto name = "ring";
    static constexpr auto channels = sivid::channels({{"y", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"p", "1", 1_dec}, {"q", "1", 1_dec}});
    }();
    template <class T>
    sivid::channels_of<ring, T> observe(T const&, sivid::constants_of<ring, T> const& c) const {
        return {sqr(c[0]) + sqr(c[1])};
    }
};

/// A second channel that is not defined everywhere, a third with kinks; p stands more than once.
struct mixed {
    static constexpr auto name = "mixed";
    static constexpr auto channels = sivid::channels({{"y", "1"}, {"root", "1"}, {"kink", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"p", "1", 1_dec}, {"q", "1", 1_dec}, {"s", "1", 2_dec}});
    }();
    template <class T>
    sivid::channels_of<mixed, T> observe(T const& t, sivid::constants_of<mixed, T> const& c) const {
        auto const& [p, q, s] = c;
        return {p * exp(-q * t) + p * q * t / s, sqrt(p - t * q), abs(p - q) - max(p, t) + sign(p)};
    }
};
inline double value(std::size_t channel, double t, double p, double q, double s = 2) {
    if (channel == 0) return p * std::exp(-q * t) + p * q * t / s;
    if (channel == 1) return std::sqrt(p - t * q); // NaN where it is not defined
    return std::abs(p - q) - std::max(p, t) + (p > 0 ? 1 : p < 0 ? -1 : 0);
}

inline sivid::static_problem ring_problem(sivid::interval bound = {1, 2}) {
    return {sivid::record_static_model<ring>(),
            {{"p", "q"}, {}},
            {sivid::interval(-5, 5), sivid::interval(-5, 5)},
            {{0, 0, bound}}};
}

/// Samples of `mixed` about a planted truth; the first `spoilt` ones are 2 off.
inline sivid::static_problem mixed_problem(double p, double q, std::size_t spoilt = 0,
                                           std::size_t outliers = 0) {
    sivid::static_problem problem{sivid::record_static_model<mixed>(),
                                  {{"p", "q"}, {}},
                                  {sivid::interval(-3, 3), sivid::interval(-3, 3)},
                                  {}};
    problem.outliers = outliers;
    std::size_t k = 0;
    for (double const t : {0.0, 0.25, 0.5, 1.0, 1.5}) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            double const y = value(channel, t, p, q);
            if (std::isnan(y)) continue;
            double const shift = k++ < spoilt ? 2 : 0;
            problem.measurements.push_back(
                {t, channel, sivid::interval(y + shift - 0.2, y + shift + 0.15)});
        }
    }
    return problem;
}
/// Whether a point violates no more measurements than allowed, in plain doubles.
inline bool approximately_feasible(sivid::static_problem const& problem, double p, double q) {
    std::size_t missed = 0;
    for (auto const& m : problem.measurements) {
        double const y = value(m.channel, m.time, p, q);
        missed += y >= m.bound.lower() && y <= m.bound.upper() ? 0 : 1;
    }
    return missed <= problem.outliers;
}

} // namespace static_models

#endif
