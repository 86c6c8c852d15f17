// SPDX-License-Identifier: MIT
#include <sivid/paving/window_contraction.hpp>

#include <sivid/paving/identify.hpp>

#include "paving/plain_problem.hpp"
#include "paving/planted_problems.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

double last_time(experiment const& e) {
    double last = e.begin;
    for (auto const& m : e.measurements) last = std::max(last, m.time);
    return last;
}

/// A pendulum whose angle is measured, pushed about; its speed is not.
struct pendulum {
    static constexpr auto name = "pendulum";
    static constexpr auto states = sivid::states({{"angle", "rad", 10}, {"speed", "rad/s", 30}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"angle", "rad"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants(
            {{"k", "1/s^2", 9_dec}, {"d", "1/s", 0.3_dec}, {"F", "1/s^2", 4_dec}});
    }();
    template <class T>
    sivid::vec<T, 2> rate(T const& t, sivid::vec<T, 2> const& x, sivid::vec<T, 3> const& c,
                          sivid::vec<T, 0> const&) const {
        using std::sin;
        return {x[1], -(c[0] * sin(x[0])) - c[1] * x[1] + c[2] * sin(T(2.5) * t)};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 2> const& x, sivid::vec<T, 3> const&,
                             sivid::vec<T, 0> const&) const {
        return {x[0]};
    }
};

inline constexpr double truth[] = {9, 0.3, 4};

/// @param seconds  of record, 50 samples each
/// @param spread   of the prior about the truth
identification_problem swinging(double seconds, double spread, unsigned seed) {
    draws d(seed);
    experiment e;
    e.name = "swing";
    e.initial = {interval(0.5), interval(0.0)};
    double x = 0.5, v = 0;
    constexpr int steps = 20;
    double const h = 0.02 / steps, bound = 0.005;
    auto const rate = [](double t, double angle, double speed) {
        return -truth[0] * std::sin(angle) - truth[1] * speed + truth[2] * std::sin(2.5 * t);
    };
    for (int k = 0; k < static_cast<int>(50 * seconds); ++k) {
        for (int s = 0; s < steps; ++s) { // Runge and Kutta
            double const t = 0.02 * k + h * s;
            double const a1 = rate(t, x, v), x2 = x + h / 2 * v, v2 = v + h / 2 * a1;
            double const a2 = rate(t + h / 2, x2, v2), x3 = x + h / 2 * v2, v3 = v + h / 2 * a2;
            double const a3 = rate(t + h / 2, x3, v3), x4 = x + h * v3, v4 = v + h * a3;
            double const a4 = rate(t + h, x4, v4);
            x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
            v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        }
        double const y = x + d.uniform(-0.99, 0.99) * bound;
        e.measurements.push_back({0.02 * (k + 1), 0, interval(y - bound, y + bound)});
    }
    std::vector<interval> prior;
    for (double const c : truth) prior.push_back(interval(c * (1 - spread), c * (1 + spread)));
    return {record_model<pendulum>(), {{"k", "d", "F"}, {}}, box(std::move(prior)), {e}};
}

window_options within(double seconds) {
    window_options options;
    options.seconds = seconds;
    return options;
}

} // namespace

TEST_CASE("windows keep what is feasible in random problems") {
    std::size_t tried = 0, contracted = 0, several = 0;
    for (std::uint64_t seed = 1; seed <= 70; ++seed) {
        draws d(seed);
        auto planted = planted::plant_by_seed(d);
        auto& p = planted.problem;
        window_options options;
        options.seconds = 1.5;
        options.windows = 2 + d.below(6);
        options.longest =
            d.uniform(0.2, 1.2) * (last_time(p.experiments[0]) - p.experiments[0].begin);
        options.share = d.coin() ? 0.02 : 0.2;
        CAPTURE(seed);
        auto const left = contract_by_windows(p, options);
        REQUIRE_FALSE(left.empty);
        REQUIRE(contains(left.rest, planted.truth));
        CHECK(subset(left.rest, p.prior));
        for (std::size_t e = 0; e < p.experiments.size(); ++e) {
            if (p.experiments[e].outliers == 0)
                REQUIRE(contains(left.starts[e], planted.starts[e]));
        }
        ++tried;
        several += left.windows > 2 ? 1 : 0;
        contracted += relative_volume(left.rest, p.prior).upper() < 0.9 ? 1 : 0;
    }
    CHECK(several > tried / 3);
    CHECK(contracted > tried / 4);
}

TEST_CASE("windows contract a prior that no trajectory carries") {
    auto const p = swinging(6, 0.3, 7);
    auto const left = contract_by_windows(p, within(120));
    REQUIRE_FALSE(left.empty);
    CHECK(left.windows > 10);
    for (std::size_t j = 0; j < 3; ++j) {
        CAPTURE(j, width(left.rest[j]) / width(p.prior[j]));
        CHECK(contains(left.rest[j], truth[j]));
        CHECK(width(left.rest[j]) < 0.3 * width(p.prior[j]));
    }
    CHECK(contains(left.starts[0], std::vector<double>{0.5, 0}));
}

TEST_CASE("a prior without the truth is emptied or kept but nothing is invented") {
    auto p = swinging(4, 0.1, 8);
    p.prior[0] = interval(12.0, 13.0);
    auto const left = contract_by_windows(p, within(60));
    CHECK(left.empty);
    identify_options options;
    options.search.seconds = 20;
    auto const found = identify(p, options);
    CHECK(found.verdict == verdict::inconsistent);
}

TEST_CASE("experiments with outliers take no part in windows") {
    auto const spoilt = plain_problem::make(1, 1);
    auto const left = contract_by_windows(spoilt);
    CHECK(left.windows == 0);
    CHECK(subset(spoilt.prior, left.rest));
    auto const sound = contract_by_windows(plain_problem::make());
    CHECK(sound.windows > 0);
    CHECK(subset(plain_problem::feasible(), sound.rest[0]));
    CHECK(width(sound.rest[0]) < 1.1 * width(plain_problem::feasible()));
}

TEST_CASE("windows end in time and when told to") {
    auto const p = swinging(20, 0.3, 9);
    int asked = 0;
    window_options options;
    options.keep_going = [&] { return ++asked < 200; };
    auto const left = contract_by_windows(p, options);
    CHECK(contains(left.rest, std::vector<double>{9, 0.3, 4}));
    CHECK(left.seconds < 30);
}
