// SPDX-License-Identifier: MIT
#include <sivid/paving/contract/window_contraction.hpp>

#include <sivid/enclosure/methods.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/paving/strategy/inquiry.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"
#include "support/pendulum.hpp"
#include "support/planted_problems.hpp"
#include "support/random.hpp"
#include "support/sweep.hpp"

#include <algorithm>
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

window_options within(double seconds) {
    window_options options;
    options.seconds = seconds;
    return options;
}

} // namespace

TEST_CASE("windows keep what is feasible in random problems") {
    std::size_t tried = 0, contracted = 0, several = 0;
    for (std::uint64_t seed = 1; seed <= support::swept(25U, 70U); ++seed) {
        draws d(seed);
        auto planted = planted::plant_by_seed(d);
        auto& p = planted.problem;
        window_options options;
        options.seconds = 1.5;
        options.windows = 2 + d.below(6);
        if (d.below(3) == 0) options.chained = 1;
        options.longest =
            d.uniform(0.2, 1.2) * (last_time(p.experiments[0]) - p.experiments[0].begin);
        options.share = d.coin() ? 0.02 : 0.2;
        CAPTURE(seed);
        auto const left = contract_by_windows(p, options);
        REQUIRE_FALSE(left.empty());
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
    auto const p = support::swinging(6, 0.3, 7);
    auto const left = contract_by_windows(p, within(120));
    REQUIRE_FALSE(left.empty());
    CHECK(left.windows > 10);
    for (std::size_t j = 0; j < 3; ++j) {
        CAPTURE(j, width(left.rest[j]) / width(p.prior[j]));
        CHECK(contains(left.rest[j], support::pendulum_truth[j]));
        CHECK(width(left.rest[j]) < 0.3 * width(p.prior[j]));
    }
    CHECK(contains(left.starts[0], std::vector<double>{0.5, 0}));
}

namespace {

/// Masses in a row on springs with dampers, pushed at the first; their places are measured.
struct row_of_masses : plain_problem::decay {
    static constexpr std::size_t masses = 3;
    static constexpr auto name = "row";
    static constexpr auto states = sivid::states({{"x1", "m", 5},
                                                  {"x2", "m", 5},
                                                  {"x3", "m", 5},
                                                  {"v1", "m/s", 9},
                                                  {"v2", "m/s", 9},
                                                  {"v3", "m/s", 9}});
    static constexpr auto channels = sivid::channels({{"x1", "m"}, {"x2", "m"}, {"x3", "m"}});
    static constexpr auto constants = sivid::constants({{"k1", "N/m", 3_dec},
                                                        {"k2", "N/m", 4_dec},
                                                        {"k3", "N/m", 5_dec},
                                                        {"d1", "N s/m", 0.2_dec},
                                                        {"d2", "N s/m", 0.3_dec},
                                                        {"d3", "N s/m", 0.2_dec}});
    template <class T>
    vec<T, 6> rate(T const& t, vec<T, 6> const& x, vec<T, 6> const& c, vec<T, 0> const&) const {
        vec<T, 6> f;
        auto const pull = [&](std::size_t k) {
            T const dx = k == 0 ? x[0] : T(x[k] - x[k - 1]);
            T const dv = k == 0 ? x[masses] : T(x[masses + k] - x[masses + k - 1]);
            return T(c[k] * dx + c[masses + k] * dv);
        };
        using std::sin;
        for (std::size_t i = 0; i < masses; ++i) {
            f[i] = x[masses + i];
            f[masses + i] = -pull(i);
            if (i + 1 < masses) f[masses + i] = f[masses + i] + pull(i + 1);
        }
        f[masses] = f[masses] + 2 * sin(2.3 * t + 1);
        return f;
    }
    template <class T>
    vec<T, 3> observe(T const&, vec<T, 6> const& x, vec<T, 6> const&, vec<T, 0> const&) const {
        return {x[0], x[1], x[2]};
    }
};

} // namespace

TEST_CASE("a window that grows from a known start tells many constants") {
    std::vector<double> const truth{3.2, 3.7, 5.3, 0.23, 0.28, 0.17};
    experiment run{"run", {}, 0, box(std::vector<interval>(6, interval(0.0))), {}, 0};
    row_of_masses const model;
    constants_of<row_of_masses, double> c{};
    std::copy(truth.begin(), truth.end(), c.begin());
    vec<double, 6> x{};
    draws d(5);
    double const h = 1e-3;
    for (int k = 0; k < 12000; ++k) {
        double const t = k * h;
        auto const moved = [&x](vec<double, 6> const& f, double by) {
            auto at = x;
            for (std::size_t i = 0; i < 6; ++i) at[i] += by * f[i];
            return at;
        };
        auto const k1 = model.rate(t, x, c, {}),
                   k2 = model.rate(t + h / 2, moved(k1, h / 2), c, {}),
                   k3 = model.rate(t + h / 2, moved(k2, h / 2), c, {}),
                   k4 = model.rate(t + h, moved(k3, h), c, {});
        for (std::size_t i = 0; i < 6; ++i) x[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
        if ((k + 1) % 200 != 0) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            double const seen = x[i] + d.uniform(-0.0099, 0.0099);
            run.measurements.push_back({(k + 1) * h, i, interval(seen - 0.01, seen + 0.01)});
        }
    }
    std::vector<interval> prior;
    for (auto const& one : row_of_masses::constants) {
        double const v = nearest(one.nominal);
        prior.push_back(interval(0.75 * v, 1.25 * v));
    }
    identification_problem const p{
        record_model(model), {{"k1", "k2", "k3", "d1", "d2", "d3"}, {}}, box(prior), {run}};
    auto growing = within(120);
    growing.chained = 1;
    auto const left = contract_by_windows(p, growing);
    REQUIRE_FALSE(left.empty());
    CHECK(contains(left.rest, truth));
    CHECK(left.longest > 11.9); // the whole record
    for (std::size_t j = 0; j < 6; ++j) {
        CAPTURE(j);
        CHECK(width(left.rest[j]) < (j < 3 ? 0.05 : 0.4) * width(p.prior[j]));
    }
    // The search begins with it.
    identify_options options;
    options.search.seconds = 60;
    options.only_hulls = true;
    auto const found = identify(p, options);
    CHECK(std::ranges::any_of(found.journal, [](auto const& r) {
        return r.by == "growing window" && r.figure("longest window") > 11.9;
    }));
    CHECK(contains(found.hull, truth));
    CHECK(found.verdict == verdict::consistent);
}

TEST_CASE("a prior without the truth is emptied or kept but nothing is invented") {
    auto p = support::swinging(4, 0.1, 8);
    p.prior[0] = interval(12.0, 13.0);
    auto const left = contract_by_windows(p, within(60));
    CHECK(left.empty());
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

TEST_CASE("windows are carried by Taylor models and series or not at all") {
    auto const p = support::swinging(1, 0.2, 10, 0.1);
    CHECK(contract_by_windows(p).windows > 0);
    window_options other;
    other.run.set = carried_set::doubleton;
    CHECK(contract_by_windows(p, other).windows == 0);
    window_options method;
    method.run.method = rk4();
    CHECK(contract_by_windows(p, method).windows == 0);
}

TEST_CASE("windows end in time and when told to") {
    auto const p = support::swinging(20, 0.3, 9);
    int asked = 0;
    window_options options;
    options.keep_going = [&] { return ++asked < 200; };
    auto const left = contract_by_windows(p, options);
    CHECK(contains(left.rest, std::vector<double>{9, 0.3, 4}));
    CHECK(asked < 1000); // who was told to stop asks a few times more at most
}

TEST_CASE("starts that are decimals are known and those of which little is known hinder") {
    auto p = support::swinging(6, 0.95, 7);
    auto const hinder = [&p] {
        inquiry asked(p, {}, {}, work_limit(10));
        return !asked.starts_known() && asked.reach() < 0.25;
    };
    p.experiments[0].initial[0] = interval(std::nextafter(0.5, 0.0), std::nextafter(0.5, 1.0));
    CHECK_FALSE(hinder());
    p.experiments[0].initial[0] = interval(0.2, 0.8);
    CHECK(hinder());
    identify_options options;
    options.search.seconds = 2;
    options.search.boxes = 16;
    auto const unknown = identify(p, options);
    CHECK(std::ranges::any_of(unknown.journal,
                              [](auto const& r) { return r.figure("windows") > 0; }));
}
