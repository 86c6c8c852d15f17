// SPDX-License-Identifier: MIT
#include <sivid/decision/measurement_ranking.hpp>

#include "support/catch.hpp"
#include "support/epidemic.hpp"
#include "support/models.hpp"
#include "support/products.hpp"
#include "support/random.hpp"
#include "support/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using support::between;

namespace {

sivid::run_options of_degree(std::size_t degree) {
    sivid::run_options run;
    run.degree = degree;
    return run;
}

/// Ended by boxes, so that a slow machine finds the same.
sivid::measurement_ranking_options const patient{
    .seconds = 1e6, .boxes = 4000, .accuracy = 0.05, .run = of_degree(4)};

/// x' = -p0 x from x0; y0 = x, y1 = p1 x, y2 = x / 100: what y2 tells, y0 has told.
sivid::identification_problem fading(sivid::interval const& start, std::size_t experiments = 1) {
    sivid::identification_problem p;
    p.model = support::model_of(
        {.states = 1, .constants = 2},
        [](auto const&, auto const& x, auto const& c, auto const&) {
            return std::vector{-(c[0] * x[0])};
        },
        [](auto const&, auto const& x, auto const& c, auto const&) {
            return std::vector{x[0], c[1] * x[0], x[0] / 100};
        });
    p.choice.unknown = support::all_constants(2);
    p.prior = {between(0.5, 1.5), between(0.5, 1.5)};
    for (std::size_t e = 0; e < experiments; ++e) {
        sivid::experiment run;
        run.name = "run " + std::to_string(e + 1);
        run.initial = {start};
        double const end = e == 0 ? 1 : 2;
        for (int n = 1; n <= 4; ++n) {
            double const t = end * n / 4, x = 2 * std::exp(-t);
            run.measurements.push_back({t, 0, support::around(x, 0.1)});
            run.measurements.push_back({t, 1, support::around(1.1 * x, 0.2)});
            run.measurements.push_back({t, 2, support::around(x / 100, 0.1)});
        }
        p.experiments.push_back(run);
    }
    return p;
}

/// Whether parameters explain an experiment without a group, by the closed form.
bool explains(sivid::identification_problem const& p, std::size_t e, double p0, double p1,
              sivid::measurement_group const* left_out) {
    auto const& run = p.experiments[e];
    // Each measurement holds for an interval of starts; the most that hold at once begin at an end.
    std::vector<sivid::interval> allowed;
    for (auto const& m : run.measurements) {
        if (left_out != nullptr && left_out->holds(e, m)) continue;
        double const gain = std::exp(-p0 * m.time) * (m.channel == 0   ? 1
                                                      : m.channel == 1 ? p1
                                                                       : 0.01);
        allowed.push_back({m.bound.lower() / gain, m.bound.upper() / gain});
    }
    std::vector<double> starts{run.initial[0].lower(), run.initial[0].upper()};
    for (auto const& a : allowed) starts.insert(starts.end(), {a.lower(), a.upper()});
    return std::any_of(starts.begin(), starts.end(), [&](double x0) {
        if (!(run.initial[0].lower() <= x0 && x0 <= run.initial[0].upper())) return false;
        auto const violated =
            std::count_if(allowed.begin(), allowed.end(), [x0](sivid::interval const& a) {
                return x0 < a.lower() || x0 > a.upper();
            });
        return violated <= static_cast<long>(run.outliers);
    });
}
bool explains(sivid::identification_problem const& p, double p0, double p1,
              sivid::measurement_group const* left_out) {
    for (std::size_t e = 0; e < p.experiments.size(); ++e)
        if (!explains(p, e, p0, p1, left_out)) return false;
    return true;
}

/// Counts on a grid: points that explain all, and those that explain all but a group.
struct grid_counts {
    double all = 0, without = 0;
};
grid_counts counts(sivid::identification_problem const& p, sivid::measurement_group const& g) {
    constexpr int n = 200;
    grid_counts result;
    auto const at = [](sivid::interval const& side, int k) {
        return side.lower() + width(side) * (k + 0.5) / n;
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            double const p0 = at(p.prior[0], i), p1 = at(p.prior[1], j);
            result.all += explains(p, p0, p1, nullptr) ? 1 : 0;
            result.without += explains(p, p0, p1, &g) ? 1 : 0;
        }
    }
    return result;
}

void check_against_grid(sivid::identification_problem const& p,
                        sivid::measurement_ranking const& found) {
    REQUIRE(!found.groups.empty());
    for (auto const& g : found.groups) {
        auto const c = counts(p, g.what);
        REQUIRE(c.all > 1000);
        CAPTURE(g.what.channel.value_or(99), g.what.experiment.value_or(99), g.what.from,
                g.growth.lower(), g.growth.upper());
        CHECK(g.growth.lower() <= 1.04 * c.without / c.all);
        CHECK(g.growth.upper() >= 0.96 * c.without / c.all);
        if (g.changes_nothing()) CHECK(c.without == c.all);
    }
}

sivid::measurement_worth const& of_channel(sivid::measurement_ranking const& r, std::size_t c) {
    return *std::find_if(r.groups.begin(), r.groups.end(),
                         [c](auto const& g) { return g.what.channel == c && !g.what.experiment; });
}

} // namespace

TEST_CASE("growth without a group holds the ratio of the true sets") {
    auto const p = fading(sivid::interval(2.0), 2);
    auto const found = sivid::rank_measurements(p, patient);
    CHECK(found.explained == sivid::verdict::consistent);
    CHECK(found.complete);
    CHECK(found.groups.size() == 3 + 2 + 4);
    check_against_grid(p, found);
    CHECK(of_channel(found, 2).changes_nothing());
    CHECK(of_channel(found, 0).growth.lower() > 1.2);
    CHECK(of_channel(found, 1).growth.lower() > 1.5);
    CHECK(std::is_sorted(found.groups.begin(), found.groups.end(),
                         [](auto& a, auto& b) { return a.growth.lower() > b.growth.lower(); }));
}

TEST_CASE("growth holds the true ratio where starts are not known") {
    auto const p = fading(between(1.95, 2.05));
    auto const found = sivid::rank_measurements(p, patient);
    check_against_grid(p, found);
    CHECK(of_channel(found, 0).growth.lower() > 1.05);
}

TEST_CASE("growth holds the true ratio where outliers are allowed") {
    auto p = fading(sivid::interval(2.0));
    p.experiments[0].outliers = 1;
    check_against_grid(p, sivid::rank_measurements(p, patient));
    p.experiments[0].measurements[3].bound = between(3, 4); // one is
    auto const found = sivid::rank_measurements(p, patient);
    check_against_grid(p, found);
    // With the outlier its channel goes, and another measurement may fail in its place.
    CHECK(of_channel(found, 0).growth.lower() > 1.05);
}

TEST_CASE("drawn data sets have no growth that the grid refutes") {
    support::draws random(20261122);
    for (int trial = 0; trial < support::swept(2, 12); ++trial) {
        auto p = fading(trial % 3 == 0 ? between(1.9, 2.1) : sivid::interval(2.0), 2);
        double const p0 = random.uniform(0.8, 1.2), p1 = random.uniform(0.8, 1.2);
        for (auto& e : p.experiments) {
            e.outliers = static_cast<std::size_t>(trial % 2);
            for (auto& m : e.measurements) {
                double const error = random.uniform(0.2, 0.4);
                double const y = 2 * std::exp(-p0 * m.time) *
                                 (m.channel == 0   ? 1
                                  : m.channel == 1 ? p1
                                                   : 0.01);
                m.bound = support::around(y + random.uniform(-0.5, 0.5) * error, error);
            }
        }
        for (auto& e : p.experiments)
            std::reverse(e.measurements.begin(), e.measurements.end()); // any order will do
        // Few boxes: the bounds are wide, and hold.
        auto options = patient;
        options.boxes = 100 + 100 * static_cast<std::size_t>(trial);
        auto const found = sivid::rank_measurements(p, options);
        check_against_grid(p, found);
    }
}

TEST_CASE("nothing is claimed of data that nothing explains, and no budget makes claims false") {
    auto p = fading(sivid::interval(2.0));
    auto const cut = sivid::rank_measurements(p, {.keep_going = [] { return false; }});
    CHECK(!cut.complete);
    for (auto const& g : cut.groups) {
        CHECK(g.growth.lower() == 1);
        CHECK(g.growth.upper() > 1e300);
    }
    auto const hasty = sivid::rank_measurements(p, {.seconds = 0});
    for (auto const& g : hasty.groups) CHECK(!g.changes_nothing());
    for (auto& m : p.experiments[0].measurements) m.bound = between(3, 4);
    auto const none = sivid::rank_measurements(p, patient);
    CHECK(none.explained == sivid::verdict::inconsistent);
    CHECK(none.groups.empty());
    p.prior = {};
    CHECK_THROWS_AS(sivid::rank_measurements(p), std::invalid_argument);
    auto twice = fading(sivid::interval(2.0), 2); // groups are called by the experiments' names
    twice.experiments[1].name = twice.experiments[0].name;
    CHECK_THROWS_WITH(sivid::rank_measurements(twice), ContainsSubstring("a name of its own"));
}

TEST_CASE("groups may be chosen, and those without measurements are left out") {
    auto const p = fading(sivid::interval(2.0));
    sivid::measurement_group one{.experiment = 0, .channel = 1, .from = 0.4, .to = 0.6};
    auto const found =
        sivid::rank_measurements(p, patient, {one, {.experiment = {}, .channel = 7}});
    REQUIRE(found.groups.size() == 1);
    CHECK(found.groups[0].measurements == 1);
    check_against_grid(p, found);
}

TEST_CASE("growth is that of what parameters reach where products share a factor") {
    // The share of the parameters that p0 p1 >= 3.8 leaves.
    double share = 0;
    constexpr int n = 100'000;
    for (int k = 0; k < n; ++k) share += std::max(0.0, 2 - 3.8 / (1 + (k + 0.5) / n)) / n;
    auto const narrow = sivid::rank_measurements(
        support::with_shared_factor(between(1, 2), between(3.8, 4), between(0.5, 5)), patient,
        {{.experiment = {}, .channel = 0}});
    CHECK(narrow.coordinates == support::all_constants(3));
    REQUIRE(narrow.groups.size() == 1);
    CHECK(narrow.groups[0].growth.lower() <= 1 / share);
    CHECK(narrow.groups[0].growth.upper() >= 1 / share);
    CHECK(narrow.volume.lower() <= share);
    CHECK(narrow.volume.upper() >= share);

    // Where p0 p1 >= 3.5, p1 p2 >= 1.75: what y1 excludes no parameter reaches.
    auto const implied = sivid::rank_measurements(
        support::with_shared_factor(between(1, 2), between(3.5, 4), between(1.7, 4)), patient,
        {{.experiment = {}, .channel = 1}});
    REQUIRE(implied.groups.size() == 1);
    CHECK(implied.groups[0].growth.lower() == 1);
    CHECK(implied.groups[0].growth.upper() < 1.01);

    // Products that both measurements allow, and no parameter reaches.
    auto const none = sivid::rank_measurements(
        support::with_shared_factor(between(1, 2), between(3.9, 4), between(0.5, 1.5)), patient);
    CHECK(none.explained == sivid::verdict::inconsistent);
    CHECK(none.groups.empty());
}

TEST_CASE("contractors bound a growth where runs over the prior say nothing") {
    auto const p = support::infection(1e4, 1);
    sivid::measurement_group const last{.experiment = 0, .from = 8};
    sivid::measurement_ranking_options options{.seconds = 1e6, .boxes = 2000, .accuracy = 0.5};
    auto const found = sivid::rank_measurements(p, options, {last}).groups.at(0);
    CHECK(found.growth.lower() >= 1);
    CHECK(found.growth.upper() < 10);
    auto narrow = p;
    narrow.prior[0] = sivid::interval(0, 2);
    auto const near = sivid::rank_measurements(narrow, options, {last}).groups.at(0);
    CHECK(near.growth.lower() <= found.growth.upper());
    CHECK(found.growth.lower() <= near.growth.upper());
    options.strategy = {};
    CHECK_FALSE(sivid::rank_measurements(p, options, {last}).groups.at(0).growth.upper() < 10);
}
