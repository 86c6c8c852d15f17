// SPDX-License-Identifier: MIT
// The unit of time of a model is the user's: microseconds or days, the same data leave the same
// set.
#include <sivid/paving/identify.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <vector>

using namespace sivid;

namespace {

/// x' = r x (1 - x/K)
struct growth {
    static constexpr auto name = "growth";
    static constexpr auto states = sivid::states({{"x", "1", 10}});
    static constexpr auto inputs = no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "1"}});
    static constexpr auto constants = sivid::constants({{"r", "1", 1_dec}, {"K", "1", 1_dec}});

    template <class T>
    vec<T, 1> rate(T const&, vec<T, 1> const& x, vec<T, 2> const& c, vec<T, 0> const&) const {
        return {c[0] * x[0] * (1 - x[0] / c[1])};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 1> const& x, vec<T, 2> const&, vec<T, 0> const&) const {
        return x;
    }
};

/// x'' = u - k x - d x'
struct oscillator {
    static constexpr auto name = "oscillator";
    static constexpr auto states = sivid::states({{"x", "1", 10}, {"v", "1", 1e5}});
    static constexpr auto inputs = sivid::inputs({{"u", "1"}});
    static constexpr auto channels = sivid::channels({{"x", "1"}});
    static constexpr auto constants = sivid::constants({{"k", "1", 1_dec}, {"d", "1", 1_dec}});

    template <class T>
    vec<T, 2> rate(T const&, vec<T, 2> const& x, vec<T, 2> const& c, vec<T, 1> const& u) const {
        return {x[1], u[0] - c[0] * x[0] - c[1] * x[1]};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 2> const& x, vec<T, 2> const&, vec<T, 1> const&) const {
        return {x[0]};
    }
};

identify_options hulls_alone() {
    identify_options options;
    options.only_hulls = true;
    return options;
}

} // namespace

TEST_CASE("a model may count in any unit of time") {
    double const r = 1.1, K = 0.9, x0 = 0.1;
    std::vector<interval> hulls;
    for (double const unit : {1.0, 0x1p-20, 0x1p-10, 0x1p10, 0x1p20}) { // a second in the unit
        experiment e;
        e.name = "culture";
        e.initial = box{interval(x0)};
        for (int k = 1; k <= 8; ++k) {
            double const t = k / 2.0, x = K / (1 + (K / x0 - 1) * std::exp(-r * t));
            e.measurements.push_back({t * unit, 0, {x - 0.01, x + 0.01}});
        }
        box const prior{interval(0.1 / unit, 3 / unit), interval(0.5, 2)};
        auto const found =
            identify({record_model<growth>(), {{"r", "K"}, {}}, prior, {e}}, hulls_alone());
        CAPTURE(unit);
        CHECK(found.verdict == verdict::consistent);
        CHECK(contains(found.hull[0], r / unit));
        CHECK(contains(found.hull[1], K));
        hulls.emplace_back(found.hull[0].lower() * unit, found.hull[0].upper() * unit);
        CHECK(width(hulls.back()) < 1.05 * width(hulls.front()));
    }
    CHECK(width(hulls.front()) < 0.05 * 2.9);
}

TEST_CASE("records of milliseconds and of hours with inputs are carried as those of seconds") {
    double const k = 4, d = 0.3;
    std::vector<double> widths;
    for (double const unit : {1.0, 0x1p-10, 0x1p10}) {
        experiment e;
        e.name = "step";
        e.initial = box{interval(0.0), interval(0.0)};
        std::vector<double> times, values;
        for (int n = 0; n <= 8; ++n) {
            times.push_back(n * unit);
            values.push_back((n % 2 == 0 ? 1 : -1) / (unit * unit));
        }
        e.inputs = {sampled_signal(times, values, interpolation::hold)};
        double x = 0, v = 0; // small enough steps of Euler's method, made symplectic
        int const steps = 200000;
        double const h = 8.0 / steps;
        for (int n = 1; n <= steps; ++n) {
            double const u = int((n - 0.5) * h) % 2 == 0 ? 1 : -1;
            v += h * (u - k * x - d * v);
            x += h * v;
            if (n % (steps / 32) == 0)
                e.measurements.push_back({n * h * unit, 0, {x - 0.01, x + 0.01}});
        }
        box const prior{interval(3.2 / (unit * unit), 4.8 / (unit * unit)),
                        interval(0.2 / unit, 0.4 / unit)};
        auto const found =
            identify({record_model<oscillator>(), {{"k", "d"}, {}}, prior, {e}}, hulls_alone());
        CAPTURE(unit);
        CHECK(found.verdict == verdict::consistent);
        CHECK(contains(found.hull[0], k / (unit * unit)));
        CHECK(contains(found.hull[1], d / unit));
        widths.push_back(width(found.hull[0]) * unit * unit);
        CHECK(widths.back() < 1.1 * widths.front());
        CHECK(widths.back() < 0.1 * 1.6);
    }
}
