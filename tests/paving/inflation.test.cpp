// SPDX-License-Identifier: MIT
#include <sivid/paving/inflation.hpp>

#include "support/catch.hpp"
#include "support/epidemic.hpp"
#include "support/inflations.hpp"
#include "support/sweep.hpp"

#include <sivid/approximate/detail/residuals.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

namespace {

inflation_options brief(double seconds = 2) {
    inflation_options o;
    o.seconds = seconds;
    return o;
}

/// All that a bound claims, against the planted truth and samples.
void check_claims(support::planted_problem const& planted, inflation_bound const& found, draws& d) {
    auto const at_truth = support::inflation_of(planted, planted.truth, planted.starts);
    CHECK(found.value.lower() <= at_truth * (1 + 1e-9));
    CHECK(found.value.lower() <= found.value.upper());
    if (at_truth <= found.value.upper()) CHECK(contains(found.hull, planted.truth));
    for (int sample = 0; sample < 15; ++sample) {
        std::vector<std::vector<double>> starts;
        for (auto const& e : planted.problem.experiments) starts.push_back(d.in(e.initial));
        auto const p = d.in(planted.problem.prior);
        double const there = support::inflation_of(planted, p, starts);
        CHECK(found.value.lower() <= there * (1 + 1e-9));
        if (there < found.value.upper() * (1 - 1e-9)) CHECK(contains(found.hull, p));
    }
    REQUIRE(found.witness.has_value() == std::isfinite(found.value.upper()));
    if (!found.witness) return;
    auto const& w = *found.witness;
    CHECK(contains(planted.problem.prior, w.parameters));
    for (std::size_t e = 0; e < w.starts.size(); ++e) {
        CHECK(contains(planted.problem.experiments[e].initial, w.starts[e]));
        CHECK(w.violated[e].size() == planted.problem.experiments[e].measurements.size());
    }
    double const attained = support::inflation_of(planted, w.parameters, w.starts);
    CHECK(attained <= found.value.upper() * (1 + 1e-9));
    CHECK_THAT(attained, WithinRel(found.value.upper(), 0.05)); // runs over kinks lose some
}

} // namespace

TEST_CASE("a search for the inflation that may hold little ends early with what is proved") {
    draws d(409);
    auto const planted =
        support::plant(d, 0, {.experiments = 2, .samples = 12, .outliers = 1, .spread = 0.1});
    auto options = brief(600);
    options.boxes = 400;
    auto const whole = bound_inflation(planted.problem, nullptr, options);
    options.memory = 1;
    auto const little = bound_inflation(planted.problem, nullptr, options);
    CHECK(little.boxes < whole.boxes);
    check_claims(planted, little, d);
    options.memory = std::size_t{1} << 30;
    CHECK(bound_inflation(planted.problem, nullptr, options).value.lower() == whole.value.lower());
}

TEST_CASE("the inflation of planted problems is enclosed") {
    draws d(401);
    int tight = 0;
    int tried = 0;
    for (std::size_t model = 0; model < support::planted_models; ++model) {
        for (std::size_t const outliers : {std::size_t{0}, std::size_t{2}}) {
            for (double const spread : {0.0, 0.03}) {
                auto const planted = support::tightened(
                    support::plant(
                        d, model,
                        {.experiments = 2, .samples = 12, .outliers = outliers, .spread = spread}),
                    d.coin() ? 1 : 5);
                auto const found = bound_inflation(planted.problem, nullptr, brief());
                INFO("model " << model << " outliers " << outliers << " spread " << spread << ": "
                              << found.value.lower() << " .. " << found.value.upper());
                check_claims(planted, found, d);
                CHECK(std::isfinite(found.value.upper()));
                ++tried;
                tight += found.value.lower() >= 0.95 * found.value.upper() ? 1 : 0;
            }
        }
    }
    CHECK(tight >= tried * 3 / 5);
}

TEST_CASE("two measurements of a decay: the inflation has a closed form") {
    for (auto const& [m1, m2] : {std::pair{0.5, 0.16}, std::pair{0.3, 0.2}, std::pair{0.2, 0.04}}) {
        auto const prior = between(0.25, 3);
        auto options = brief();
        options.relative_width = 1e-6;
        auto const problem = support::decay(prior, m1, m2, 0.0078125);
        double const exact = support::decay_inflation(prior, m1, m2, 0.0078125);
        auto const found = bound_inflation(problem, nullptr, options);
        CHECK(found.value.lower() <= exact + 1e-4);
        CHECK(found.value.upper() >= exact - 1e-4);
        CHECK(width(found.value) <= 1e-3);
        REQUIRE(found.witness);
        CHECK(contains(found.hull, found.witness->parameters));
    }
}

TEST_CASE("only the verdict: the search stops as soon as it is proved") {
    auto options = brief();
    options.only_verdict = true;
    auto const gap =
        bound_inflation(support::decay(between(0.25, 3), 0.5, 0.125, 0.0078125), nullptr, options);
    CHECK(gap.value.lower() > 1);
    auto const none =
        bound_inflation(support::decay(between(0.25, 3), 0.5, 0.25, 0.0078125), nullptr, options);
    CHECK(none.value.upper() <= 1);
    REQUIRE(none.witness);
    CHECK(std::count(none.witness->violated[0].begin(), none.witness->violated[0].end(), true) ==
          0);
}

TEST_CASE("solutions that blow up within the prior") {
    auto problem = support::decay(between(0.25, 3), 0, 0, 1);
    problem.model =
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * x[0] * x[0]}; // 1 / (1 - p t)
        });
    auto& measured = problem.experiments[0].measurements;
    measured = {{0.25, 0, support::around(1.25, 0.03125)}, {0.5, 0, support::around(2.5, 0.0625)}};
    double exact = HUGE_VAL;
    for (double p = 0.25; p < 1.9; p += 1e-5) {
        exact = std::min(exact, std::max(std::abs(1 / (1 - 0.25 * p) - 1.25) / 0.03125,
                                         std::abs(1 / (1 - 0.5 * p) - 2.5) / 0.0625));
    }
    auto const found = bound_inflation(problem, nullptr, brief());
    CHECK(found.value.lower() <= exact + 1e-3);
    CHECK(exact - 1e-3 <= found.value.upper());
    CHECK(found.value.lower() > 0.9 * found.value.upper());
    // Everywhere: nothing explains the data, and nothing attains any inflation.
    problem.prior = box{between(5, 6)};
    auto const nowhere = bound_inflation(problem, nullptr, brief(0.5));
    CHECK(nowhere.value.upper() == HUGE_VAL);
    CHECK_FALSE(nowhere.witness);
    CHECK(nowhere.value.lower() >= 0);
}

namespace {

/// x' = p x^2 from 1 and y' = p - k y from 1: runs over wide ranges of p end before the last
/// samples.
struct late_growth {
    identification_problem problem;
    std::vector<double> times{0.2, 0.4, 0.6, 0.8};
    std::vector<double> x, y; ///< measured, within +-0.05 x and +-0.02

    late_growth(draws& d, std::size_t outliers) {
        problem.model =
            support::model_of({2, 2}, [](auto const&, auto const& s, auto const& p, auto const&) {
                return std::vector{p[0] * s[0] * s[0], p[0] - p[1] * s[1]};
            });
        problem.choice.unknown = {"p0", "p1"};
        problem.prior = box{between(0.25, 1.5), between(0.5, 4)};
        experiment e;
        e.name = "E";
        e.initial = box{interval(1.0), interval(1.0)};
        e.outliers = outliers;
        for (double const t : times) {
            x.push_back(seen_x(0.9, t) * (1 + d.uniform(-0.3, 0.3)));
            y.push_back(seen_y(0.9, 2, t) + d.uniform(-0.1, 0.1));
            e.measurements.push_back({t, 0, support::around(x.back(), 0.05 * x.back())});
            e.measurements.push_back({t, 1, support::around(y.back(), 0.02)});
        }
        problem.experiments = {e};
    }
    static double seen_x(double p, double t) { return p * t < 1 ? 1 / (1 - p * t) : HUGE_VAL; }
    static double seen_y(double p, double k, double t) {
        return p / k + (1 - p / k) * std::exp(-k * t);
    }
    [[nodiscard]] double inflation_at(double p, double k) const {
        std::vector<double> missed;
        for (std::size_t n = 0; n < times.size(); ++n) {
            missed.push_back(std::abs(seen_x(p, times[n]) - x[n]) / (0.05 * x[n]));
            missed.push_back(std::abs(seen_y(p, k, times[n]) - y[n]) / 0.02);
        }
        std::sort(missed.begin(), missed.end(), std::greater<>());
        return missed[problem.experiments[0].outliers];
    }
    /// The least on a grid over a box, then on finer and finer grids about the best point.
    [[nodiscard]] double least() const {
        double best = HUGE_VAL;
        std::array<double, 2> at{}, middle{}, reach{};
        for (std::size_t j = 0; j < 2; ++j) {
            middle[j] = mid(problem.prior[j]);
            reach[j] = rad(problem.prior[j]);
        }
        for (int level = 0; level < 12; ++level) {
            int const n = level == 0 ? 250 : 40;
            for (int a = -n; a <= n; ++a) {
                for (int b = -n; b <= n; ++b) {
                    double const p = std::clamp(middle[0] + reach[0] * a / n, 0.25, 1.5);
                    double const k = std::clamp(middle[1] + reach[1] * b / n, 0.5, 4.0);
                    double const there = inflation_at(p, k);
                    if (there < best) {
                        best = there;
                        at = {p, k};
                    }
                }
            }
            middle = at;
            for (double& r : reach) r *= level == 0 ? 0.02 : 0.2;
        }
        return best;
    }
};

} // namespace

TEST_CASE("runs that end early: the inflation is that of a dense grid, and narrowly bounded") {
    draws d(408);
    for (int trial = 0; trial < support::swept(5, 12); ++trial) {
        late_growth const real(d, trial % 3 == 2 ? 1 : 0);
        double const least = real.least();
        auto const found = bound_inflation(real.problem, nullptr, brief(5));
        INFO("trial " << trial << ": " << found.value.lower() << " .. " << found.value.upper()
                      << " with " << least << ", " << found.boxes << " boxes");
        CHECK(found.value.lower() <= least * (1 + 1e-9));
        CHECK(found.value.upper() >= least * (1 - 1e-4));
        CHECK(found.value.lower() >= 0.9 * found.value.upper());
    }
}

TEST_CASE("without time the bounds are wide but valid") {
    draws d(402);
    auto const planted = support::tightened(support::plant(d, 4, {.experiments = 2}), 4);
    for (double const seconds : {-1.0, 0.0, 0.005, 0.02}) {
        auto const found = bound_inflation(planted.problem, nullptr, brief(seconds));
        check_claims(planted, found, d);
    }
    int left = 3;
    auto options = brief();
    options.relative_width = 0;
    options.keep_going = [&left] { return --left > 0; };
    check_claims(planted, bound_inflation(planted.problem, nullptr, options), d);
}

TEST_CASE("a guess is used, and one that does not fit is not") {
    auto const problem = support::decay(between(0.25, 3), 0.5, 0.25, 0.0078125);
    auto options = brief();
    options.keep_going = [] { return false; }; // nothing but the guess
    approximate_fit guess;
    guess.parameters = {0.6931471805599453};
    guess.starts = {{1}};
    CHECK(bound_inflation(problem, &guess, options).value.upper() < 1e-9);
    guess.parameters = {1, 2, 3};
    CHECK_NOTHROW(bound_inflation(problem, &guess, options));
    guess.parameters = {100};
    guess.starts = {{7}};
    auto const found = bound_inflation(problem, &guess, brief());
    REQUIRE(found.witness);
    CHECK(contains(problem.prior, found.witness->parameters));
    CHECK(found.witness->starts[0] == std::vector<double>{1});
}

TEST_CASE("parameters that are known, and measurements that say nothing") {
    double const ln2 = 0.6931471805599453;
    auto problem = support::decay(interval(ln2), 0.5, 0.5, 0.0625);
    auto found = bound_inflation(problem, nullptr, brief());
    CHECK(found.value.lower() <= 4);
    CHECK(4 <= found.value.upper());
    CHECK(width(found.value) < 1e-3);
    problem.experiments[0].measurements[1].bound = interval_traits<interval>::entire();
    found = bound_inflation(problem, nullptr, brief());
    CHECK(found.value.upper() < 1e-6);
    problem.experiments[0].outliers = 7; // more than there are measurements
    CHECK_THROWS_AS(bound_inflation(problem, nullptr, brief()), std::invalid_argument);
    problem.experiments[0].outliers = 2; // all of them
    found = bound_inflation(problem, nullptr, brief());
    CHECK(found.value.upper() == 0);
}

TEST_CASE("a problem restricted to some measurements has no larger inflation") {
    auto const problem = support::decay(between(0.25, 3), 0.5, 0.125, 0.0078125);
    auto const whole = bound_inflation(problem, nullptr, brief());
    auto const first =
        restricted_to(problem, [](std::size_t, measurement const& m) { return m.time < 1.5; });
    REQUIRE(first.experiments.size() == 1);
    CHECK(first.experiments[0].measurements.size() == 1);
    auto const part = bound_inflation(first, nullptr, brief());
    CHECK(part.value.upper() < 1e-6);
    CHECK(part.value.lower() <= whole.value.upper());
    auto const nothing =
        restricted_to(problem, [](std::size_t, measurement const&) { return false; });
    CHECK(nothing.experiments.empty());
    CHECK_THROWS_AS(bound_inflation(nothing), std::invalid_argument);
}

TEST_CASE("a part with fewer measurements than outliers may be explained by anything") {
    auto problem = support::decay(between(0.25, 3), 0.5, 0.125, 0.0078125);
    problem.experiments[0].outliers = 2;
    auto const first =
        restricted_to(problem, [](std::size_t, measurement const& m) { return m.time < 1.5; });
    REQUIRE(first.experiments[0].measurements.size() == 1);
    CHECK(first.experiments[0].outliers == 1);
    CHECK(bound_inflation(first, nullptr, brief()).value.upper() == 0);
}

TEST_CASE("contractors bound the inflation where runs over the prior say nothing") {
    auto const narrow = bound_inflation(support::infection(1.5, 1.65), nullptr, brief());
    REQUIRE(narrow.value.lower() > 2);
    for (double const most : {100., 1e7}) {
        CAPTURE(most);
        auto const found = bound_inflation(support::infection(most, 1.65), nullptr, brief());
        CHECK(found.value.lower() > 2);
        CHECK(found.value.upper() < 2.5);
        CHECK(found.value.lower() <= narrow.value.upper());
        CHECK(narrow.value.lower() <= found.value.upper());
        CHECK(found.hull[0].upper() < 2);
        CHECK(contains(found.hull, found.witness->parameters));

        auto alone = brief(0.5);
        alone.strategy = {};
        CHECK_FALSE(bound_inflation(support::infection(most, 1.65), nullptr, alone).value.lower() > 1);

        auto const explained = bound_inflation(support::infection(most, 1), nullptr, brief());
        CHECK(explained.value.upper() < 1);
        CHECK(contains(explained.hull, std::vector<double>{0.5, 0.3}));
    }
    auto only = brief();
    only.only_verdict = true;
    CHECK(bound_inflation(support::infection(1e7, 8), nullptr, only).value.lower() > 1);
}
