// SPDX-License-Identifier: MIT
#include <sivid/paving/judge/witness.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("a witness is verified with what it violates, or refused") {
    auto const check = [](identification_problem const& problem, double rate, double start) {
        feasibility_test test(problem, {});
        return verify_witness(test, problem, {rate}, {{start}});
    };
    auto const sound = plain_problem::make();
    auto const good = check(sound, plain_problem::truth, 2);
    REQUIRE(good);
    CHECK(good->violated == std::vector<std::vector<bool>>{std::vector<bool>(6, false)});
    CHECK_FALSE(check(sound, 0.9, 2)); // explains nothing
    CHECK_FALSE(check(sound, 0.1, 2)); // neither does the end of the prior
    // A guess outside the problem's boxes is moved into them.
    auto const moved = check(sound, plain_problem::truth, 2.1);
    REQUIRE(moved);
    CHECK(contains(sound.experiments[0].initial, moved->starts[0]));
    auto const spoilt = plain_problem::make(2, 2);
    auto const tolerant = check(spoilt, plain_problem::truth, 2);
    REQUIRE(tolerant);
    CHECK(tolerant->violated[0] == std::vector<bool>{true, true, false, false, false, false});
    CHECK_FALSE(check(plain_problem::make(2, 1), plain_problem::truth, 2));
}

namespace {

/// Dry friction that brings the state to rest at 0.
struct resting : plain_problem::decay {
    static constexpr auto name = "resting";
    template <class T>
    sivid::vec<T, 1> rate(T const&, sivid::vec<T, 1> const& x, sivid::vec<T, 1> const& c,
                          sivid::vec<T, 0> const&) const {
        using sivid::sign;
        return {-(c[0] * sign(x[0]))};
    }
};
/// A rate that no long step follows.
struct trembling : plain_problem::decay {
    static constexpr auto name = "trembling";
    template <class T>
    sivid::vec<T, 1> rate(T const& t, sivid::vec<T, 1> const&, sivid::vec<T, 1> const& c,
                          sivid::vec<T, 0> const&) const {
        using std::cos;
        return {c[0] * cos(1e5 * t)};
    }
};

} // namespace

TEST_CASE("a run that trembles ends by its number of steps, one that comes to rest does not") {
    auto problem = plain_problem::make();
    problem.experiments[0].outliers = 6; // misfits end nothing
    feasibility_test_options options;
    options.witness_steps = 300;
    auto const outputs_of = [&](recorded_model model) {
        problem.model = std::move(model);
        feasibility_test test(problem, options);
        return test.run_finely(0, problem.experiments[0].initial, {interval(1.0)})->outputs();
    };
    CHECK(outputs_of(record_model<trembling>()) < 6);
    CHECK(outputs_of(record_model<resting>()) == 6); // x = 2 - t is at rest from t = 2 on
    // A smooth run of as many measurements does not notice.
    auto const smooth = plain_problem::make();
    feasibility_test other(smooth, options);
    CHECK(other.run_finely(0, smooth.experiments[0].initial, {interval(0.5)})->outputs() == 6);
}

TEST_CASE("a point is run without generators where nothing stops it, and means the same") {
    auto const smooth = plain_problem::make();
    feasibility_test_options first_order;
    first_order.witness.set = carried_set::doubleton;
    feasibility_test quick(smooth, {});
    feasibility_test slow(smooth, first_order);
    for (double const rate : {0.2, 0.5, 0.9}) {
        for (double const start : {1.9, 2.0, 2.1}) {
            box const parameters{interval(rate)};
            auto const a =
                output_ranges(*quick.run_finely(0, {interval(start)}, parameters), parameters);
            auto const b =
                output_ranges(*slow.run_finely(0, {interval(start)}, parameters), parameters);
            REQUIRE(a.size() == b.size());
            for (std::size_t y = 0; y < a.size(); ++y) {
                CHECK_FALSE(disjoint(a[y], b[y]));
                CHECK(width(a[y]) <= 2 * width(b[y]));
            }
        }
    }
    // At rest on a kink first-order sets go on.
    auto rests = plain_problem::make();
    rests.model = record_model<resting>();
    rests.experiments[0].outliers = 6;
    feasibility_test both(rests, {});
    feasibility_test one(rests, first_order);
    box const parameters{interval(1.0)};
    auto const far = both.run_finely(0, rests.experiments[0].initial, parameters);
    CHECK(far->outputs() >= one.run_finely(0, rests.experiments[0].initial, parameters)->outputs());
}

namespace {

/// x' = -a (1 + |x - 1|), which crosses its kink, beside r' = -r |r| - v and v' = r, which rest at
/// one.
struct bent {
    static constexpr auto name = "bent";
    static constexpr auto states = sivid::states({{"x", "m", 10}, {"r", "1", 1}, {"v", "1", 1}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "m"}, {"|r|", "1"}});
    static constexpr auto constants = plain_problem::decay::constants;
    template <class T>
    vec<T, 3> rate(T const&, vec<T, 3> const& x, vec<T, 1> const& c, vec<T, 0> const&) const {
        using std::abs;
        return {-c[0] * (1 + abs(x[0] - 1)) + x[1], -(x[1] * abs(x[1])) - x[2], x[1]};
    }
    template <class T>
    vec<T, 2> observe(T const&, vec<T, 3> const& x, vec<T, 1> const&, vec<T, 0> const&) const {
        using std::abs;
        return {x[0], abs(x[1])};
    }
};

} // namespace

TEST_CASE("kinks that are crossed, and those that a trajectory rests at, take few steps") {
    auto problem = plain_problem::make();
    problem.model = record_model<bent>();
    auto& run = problem.experiments[0];
    run.initial = {interval(2.0), interval(0.0), interval(0.0)};
    run.outliers = 12; // misfits end nothing
    auto const half = run.measurements;
    for (auto m : half) run.measurements.push_back({m.time, 1, interval(-0.05, 0.05)});
    feasibility_test_options options;
    options.witness_steps = 400;
    feasibility_test test(problem, options);
    box const a{interval(0.5)};
    auto const found = test.run_finely(0, run.initial, a);
    REQUIRE(found->outputs() == 12);
    auto const values = output_ranges(*found, a);
    for (std::size_t y = 0; y < values.size(); ++y) {
        auto const t = 0.5 * static_cast<double>(y / 2 + 1);
        auto const x = t < 2 * std::log(2) ? 2 * std::exp(-0.5 * t) : 2 - std::exp(0.5 * t) / 2;
        CHECK(contains(values[y], y % 2 == 0 ? x : 0));
        CHECK(width(values[y]) < 1e-5); // a tenth of a thousandth of the bounds
    }
}

namespace {

/// x' = -c^2 - 100 max(x, 0) from 1/2 with c = 1/2: it crosses its kink at t = ln(201)/100.
struct braked : plain_problem::decay {
    static constexpr auto name = "braked";
    template <class T>
    vec<T, 1> rate(T const&, vec<T, 1> const& x, vec<T, 1> const& c, vec<T, 0> const&) const {
        using std::abs;
        return {-(c[0] * c[0]) - 50 * (x[0] + abs(x[0]))};
    }
};

} // namespace

TEST_CASE("a kink that is crossed leaves little of a measurement open") {
    auto problem = plain_problem::make();
    problem.model = record_model<braked>();
    auto& run = problem.experiments[0];
    run.initial = {interval(0.5)};
    double const end = -0.25 * (3 - std::log(201.0) / 100);
    run.measurements = {{3, 0, interval(end - 0.1, end + 0.1)}};
    box const c{interval(0.5)};
    feasibility_test before(problem, {});
    auto const finely = before.run_finely(0, run.initial, c);
    REQUIRE(finely->outputs() == 1);
    double const open = finely->radius[0];
    CAPTURE(open);
    REQUIRE(open < 1e-5);
    REQUIRE(open > 1e-12);
    for (std::size_t const allowed : {0u, 1u}) { // one: misfits end nothing
        run.outliers = allowed;
        for (double const little : {1.5 * open, -1.5 * open}) {
            run.measurements[0].bound = interval(end - 0.1, end + little);
            feasibility_test test(problem, {});
            auto const found = test.run_finely(0, run.initial, c);
            auto const value = output_ranges(*found, c)[0];
            CHECK(contains(value, end));
            CHECK(subset(value, run.measurements[0].bound) == (little > 0));
            CHECK(disjoint(value, run.measurements[0].bound) == (little < 0));
        }
    }
}
