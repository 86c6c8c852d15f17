// SPDX-License-Identifier: MIT
// Static problems of the literature, in the sizes that were measured with Ibex.
#ifndef SIVID_BENCHMARKS_PAVING_PROBLEMS_HPP
#define SIVID_BENCHMARKS_PAVING_PROBLEMS_HPP

#include <sivid/paving/static_problem.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace paving_benchmark {

/// y = p1^2 + p2^2.
struct ring {
    static constexpr auto name = "ring";
    static constexpr auto channels = sivid::channels({{"y", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"p1", "1", 1_dec}, {"p2", "1", 1_dec}});
    }();
    template <class T>
    sivid::channels_of<ring, T> observe(T const&, sivid::constants_of<ring, T> const& p) const {
        return {sqr(p[0]) + sqr(p[1])};
    }
};

/// y = p1 exp(-p2 t).
struct decay {
    static constexpr auto name = "decay";
    static constexpr auto channels = sivid::channels({{"y", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"p1", "1", 2_dec}, {"p2", "1", 0.3_dec}});
    }();
    template <class T>
    sivid::channels_of<decay, T> observe(T const& t, sivid::constants_of<decay, T> const& p) const {
        return {p[0] * exp(-p[1] * t)};
    }
};

/// y = p1 exp(-p2 t) + p3 exp(-p4 t).
struct two_decays {
    static constexpr auto name = "two exponentials";
    static constexpr auto channels = sivid::channels({{"y", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants(
            {{"p1", "1", 2_dec}, {"p2", "1", 0.3_dec}, {"p3", "1", 1_dec}, {"p4", "1", 2_dec}});
    }();
    template <class T>
    sivid::channels_of<two_decays, T> observe(T const& t,
                                              sivid::constants_of<two_decays, T> const& p) const {
        return {p[0] * exp(-p[1] * t) + p[2] * exp(-p[3] * t)};
    }
};

/// A polynomial in time, linear in its n coefficients.
template <std::size_t n>
struct polynomial {
    static constexpr auto name = "polynomial";
    static constexpr auto channels = sivid::channels({{"y", "1"}});
    static constexpr auto constants = []<std::size_t... J>(std::index_sequence<J...>) {
        using namespace sivid::literals;
        constexpr std::array names{"a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l"};
        return std::array{sivid::constant_quantity{names[J], "1", 1_dec}...};
    }
    (std::make_index_sequence<n>{});
    template <class T>
    sivid::channels_of<polynomial, T> observe(T const& t,
                                              sivid::constants_of<polynomial, T> const& c) const {
        T y = c[n - 1];
        for (std::size_t j = n - 1; j-- > 0;) y = y * t + c[j];
        return {y};
    }
};

inline sivid::box plane() { return {sivid::interval(-5, 5), sivid::interval(-5, 5)}; }

inline sivid::static_problem ring_problem() {
    return {sivid::record_static_model<ring>(),
            {{"p1", "p2"}, {}},
            plane(),
            {{0, 0, sivid::interval(1, 2)}}};
}

/// Ten samples; with outliers the fourth and the eighth are half a unit off, and two may be.
inline sivid::static_problem decay_problem(bool outliers) {
    sivid::static_problem problem{
        sivid::record_static_model<decay>(), {{"p1", "p2"}, {}}, plane(), {}};
    for (int i = 0; i < 10; ++i) {
        double y = 2 * std::exp(-0.3 * i) + 0.02 * std::sin(7.0 * i);
        if (outliers && i == 3) y += 0.5;
        if (outliers && i == 7) y -= 0.5;
        problem.measurements.push_back(
            {static_cast<double>(i), 0, sivid::interval(y - 0.05, y + 0.05)});
    }
    problem.outliers = outliers ? 2 : 0;
    return problem;
}

} // namespace paving_benchmark

#endif
