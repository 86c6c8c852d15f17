// SPDX-License-Identifier: MIT
// Algorithms 1 and 2 of the report in every interval type, on the hovercraft and in closed form.
#include <sivid/paving/bisection_test.hpp>

#include <sivid/enclosure/methods.hpp>
#include <sivid/enclosure/tube.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"
#include "support/hovercraft_campaign.hpp"
#include "support/interval_types.hpp"

#include <cmath>
#include <memory>
#include <tuple>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

namespace {

/// The turn of scenario 3 for 0.6 s, each state measured five times; S_v is 0.22.
/// @param spoilt  so many measurements are moved by ten bounds
identification_problem hovercraft_turn(std::size_t spoilt) {
    draws d(7);
    auto all =
        support::hovercraft_campaign(d, {}, {.priors = {{"Sv", between(0.15, 0.3)}}, .share = 0.2});
    auto turn = all.experiments[2];
    record kept;
    std::size_t n = 0;
    for (auto const& m : sorted(turn.measurements)) {
        double const fifths = m.time / 0.1;
        if (std::abs(fifths - std::round(fifths)) > 1e-6) continue;
        kept.push_back(m);
        if (n++ < spoilt) {
            double const by = 10 * width(m.bound);
            kept.back().bound = between(m.bound.lower() + by, m.bound.upper() + by);
        }
    }
    turn.measurements = kept;
    turn.outliers = spoilt;
    all.experiments = {turn};
    return all;
}

inversion_options search() {
    inversion_options options;
    options.accuracy = 1.0 / 256;
    options.sufficient_ratio = 1;
    options.seconds = 1e6;
    return options;
}

/// No box that one proves inside has points of one that the other proves outside.
bool agree(subpaving const& a, subpaving const& b) {
    for (auto const& x : a.boxes()) {
        for (auto const& y : b.boxes()) {
            bool const opposed =
                (x.verdict == box_verdict::inside && y.verdict == box_verdict::outside) ||
                (x.verdict == box_verdict::outside && y.verdict == box_verdict::inside);
            if (!opposed) continue;
            auto const common = intersect(x.set, y.set);
            if (!is_empty(common) && width(common) > 0) return false;
        }
    }
    return true;
}

} // namespace

TEMPLATE_TEST_CASE("each interval type says the same of every box of the hovercraft", "",
                   SIVID_INTERVAL_TYPES) {
    auto const spoilt = GENERATE(std::size_t{0}, std::size_t{2});
    CAPTURE(spoilt);
    auto const problem = hovercraft_turn(spoilt);
    auto const reference = identify_by_bisection(problem, search());
    REQUIRE(proved_verdict(reference.paving) == verdict::consistent);
    REQUIRE(reference.paving.count(box_verdict::outside) > 1);
    auto const found = identify_by_bisection<TestType>(problem, search());
    CHECK(agree(found.paving, reference.paving));
    CHECK(contains(found.paving.outer_hull(), std::vector<double>{0.22}));
    CHECK(proved_verdict(found.paving) == verdict::consistent);
    if constexpr (!std::is_same_v<TestType, support::coarse>) { // but for roundings
        CHECK(found.tested == reference.tested);
        auto const hull = found.paving.outer_hull(), same = reference.paving.outer_hull();
        CHECK(std::abs(hull[0].lower() - same[0].lower()) < 1e-9);
        CHECK(std::abs(hull[0].upper() - same[0].upper()) < 1e-9);
    }
}

TEST_CASE("Algorithm 1 rejects what Algorithm 2 explains with two outliers") {
    auto problem = hovercraft_turn(2);
    problem.experiments[0].outliers = 0;
    CHECK(proved_verdict(identify_by_bisection(problem, search()).paving) == verdict::inconsistent);
}

TEMPLATE_TEST_CASE("what is paved in closed form is right in every interval type", "",
                   SIVID_INTERVAL_TYPES) {
    auto const exact = plain_problem::feasible();
    auto options = search();
    options.accuracy = 1.0 / 256;
    auto const found = identify_by_bisection<TestType>(plain_problem::make(), options);
    for (auto const& b : found.paving.boxes()) {
        if (b.verdict == box_verdict::inside) {
            CHECK(exact.lower() <= b.set[0].lower() + 1e-12);
            CHECK(b.set[0].upper() <= exact.upper() + 1e-12);
        }
        if (b.verdict == box_verdict::outside) {
            CHECK((b.set[0].upper() <= exact.lower() + 1e-12 ||
                   exact.upper() <= b.set[0].lower() + 1e-12));
        }
    }
    CHECK(found.paving.count(box_verdict::inside) > 0);
    CHECK(width(found.paving.outer_hull()) < width(exact) + 0.02);
    // One sample that is 3 off: only with an outlier.
    CHECK(proved_verdict(identify_by_bisection<TestType>(plain_problem::make(1), options).paving) ==
          verdict::inconsistent);
    CHECK(proved_verdict(
              identify_by_bisection<TestType>(plain_problem::make(1, 1), options).paving) ==
          verdict::consistent);
}

TEMPLATE_TEST_CASE("what the test cuts off a box explains nothing", "", SIVID_INTERVAL_TYPES) {
    auto const exact = plain_problem::feasible();
    draws d(21);
    for (std::size_t const spoilt : {std::size_t{0}, std::size_t{1}}) {
        auto const problem = plain_problem::make(spoilt, spoilt);
        bisection_test<TestType> test(problem, {.order = 12, .tolerance = 1e-7});
        int cuts = 0;
        for (int k = 0; k < 40; ++k) {
            double const low = d.uniform(0.25, 1), high = d.uniform(low, 1);
            box const over{between(low, high)};
            auto const says = test(box_in<TestType>(over));
            auto const rest = lane_of(says.rest);
            CAPTURE(spoilt, low, high, rest[0].lower(), rest[0].upper());
            CHECK(subset(rest, lane_of(box_in<TestType>(over))));
            auto const feasible = intersect(exact, over[0]); // with an outlier there is more
            if (lane_of(says.outside, 0)) {
                CHECK((is_empty(feasible) || width(feasible) < 1e-9));
            } else if (!is_empty(feasible)) {
                CHECK(rest[0].lower() <= feasible.lower() + 1e-12);
                CHECK(feasible.upper() - 1e-12 <= rest[0].upper());
            }
            cuts += !lane_of(says.outside, 0) && width(rest[0]) < 0.8 * width(over[0]);
        }
        CHECK(cuts > 5);
    }
}

namespace {

/// x' = -a x from 2, seen as b x: two parameters.
struct scaled_decay : plain_problem::decay {
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"a", "1/s", 1_dec}, {"b", "1", 1_dec}});
    }();
    template <class T>
    vec<T, 1> rate(T const&, vec<T, 1> const& x, vec<T, 2> const& c, vec<T, 0> const&) const {
        return {-(c[0] * x[0])};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 1> const& x, vec<T, 2> const& c, vec<T, 0> const&) const {
        return {c[1] * x[0]};
    }
};

/// The same test without what it contracts.
struct uncontracted {
    bisection_test<interval>* test;

    assessment<> operator()(box const& x) const {
        auto const says = (*test)(x);
        return {.verdict = says.inside    ? box_verdict::inside
                           : says.outside ? box_verdict::outside
                                          : box_verdict::undecided,
                .rest = x};
    }
};

} // namespace

TEST_CASE("contraction spares boxes, and leaves no more") {
    identification_problem const problem{record_model<scaled_decay>(),
                                         {{"a", "b"}, {}},
                                         {between(0.25, 1), between(0.5, 2)},
                                         plain_problem::make().experiments};
    auto options = search();
    options.accuracy = 1.0 / 64;
    options.order = search_order::first_in;
    bisection_test<interval> test(problem, {.order = 12, .tolerance = 1e-7});
    uncontracted alone{&test};
    auto const plain = invert(alone, problem.prior, options);
    auto const found = identify_by_bisection<interval>(problem, options);
    CAPTURE(plain.tested, found.tested, plain.paving.outer_volume().upper(),
            found.paving.outer_volume().upper());
    CHECK(found.tested < plain.tested);
    CHECK(found.paving.outer_volume().upper() < plain.paving.outer_volume().upper());
    CHECK(contains(found.paving.outer_hull(), std::vector<double>{plain_problem::truth, 1}));
}

TEMPLATE_TEST_CASE("validated Runge-Kutta serves every interval type", "", SIVID_SINGLE_TYPES) {
    auto const exact = plain_problem::feasible();
    for (auto const& method : {rk4(), gauss4()}) {
        CAPTURE(method.name);
        enclosure_options how{.tolerance = 1e-7, .minimum_step = 1e-4};
        how.method = for_steps<TestType>(method);
        auto const found = identify_by_bisection<TestType>(plain_problem::make(), search(), how);
        CHECK(proved_verdict(found.paving) == verdict::consistent);
        auto const hull = found.paving.outer_hull()[0];
        CHECK(hull.lower() <= exact.lower() + 1e-12);
        CHECK(exact.upper() <= hull.upper() + 1e-12);
    }
}

TEST_CASE("a bound between the type's numbers is not widened to call it met") {
    // All measurements are the exact motion's neighbours in double: in single precision the
    // enclosures are wider than that, whatever the bounds are read as.
    auto problem = plain_problem::make();
    for (auto& m : problem.experiments[0].measurements) {
        double const y = mid(m.bound);
        m.bound = between(y - 1e-9, y + 1e-9);
    }
    problem.prior = box{interval(0.5)};
    bisection_test<support::coarse> test(problem, {});
    auto const says = test(box_in<support::coarse>(problem.prior));
    CHECK_FALSE(says.inside);
    CHECK_FALSE(says.outside);
}

namespace {

struct root { // y = sqrt(a - 1) x
    static constexpr auto name = "root";
    static constexpr auto states = sivid::states({{"x", "m", 10}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"y", "m"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"a", "1", 1_dec}});
    }();
    template <class T>
    vec<T, 1> rate(T const&, vec<T, 1> const& x, vec<T, 1> const&, vec<T, 0> const&) const {
        return {-x[0]};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 1> const& x, vec<T, 1> const& c, vec<T, 0> const&) const {
        return {sqrt(c[0] - T(1)) * x[0]};
    }
};

} // namespace

TEST_CASE("a domain that the box leaves proves nothing of the box") {
    experiment run;
    run.name = "run";
    run.initial = {interval(1.0)};
    run.measurements.push_back({0.5, 0, interval(-100.0, 100.0)});
    identification_problem const problem{
        record_model<root>(), {{"a"}, {}}, {interval(0.0, 3.0)}, {run}};
    bisection_test<support::boost_type> test(problem, {});
    auto const over = [&](double lo, double hi) {
        return test(box_in<support::boost_type>(box{interval(lo, hi)}));
    };
    CHECK(over(1.5, 3).inside);
    CHECK_FALSE(over(0.5, 3).inside);
    CHECK_FALSE(over(0.5, 3).outside);
    CHECK_FALSE(over(0, 0.5).inside);
    // What is no box of parameters is refused, whatever marks it in the type.
    double const nan = detail::not_a_number;
    using I = support::boost_type;
    for (I const& bad : {I(nan, nan, true), I(nan, 2, true), I(3, 2, true),
                         interval_traits<I>::entire(), I(1, detail::infinity, true)}) {
        CHECK_THROWS_AS(test(basic_box<I>{bad}), std::invalid_argument);
    }
}

TEST_CASE("a search that is told to stop returns what is proved") {
    int left = 3;
    auto options = search();
    options.keep_going = [&left] { return --left > 0; };
    auto const found = identify_by_bisection<interval>(plain_problem::make(), options);
    CHECK((found.reason == stop_reason::cancelled || found.reason == stop_reason::time_budget));
    CHECK(contains(found.paving.outer_hull(), std::vector<double>{plain_problem::truth}));
    auto bad = plain_problem::make();
    bad.prior = box{interval_traits<interval>::entire()};
    CHECK_THROWS_AS(identify_by_bisection<interval>(bad), std::invalid_argument);
}

TEMPLATE_TEST_CASE("the hovercraft's tube in each interval type holds the motion", "",
                   SIVID_SINGLE_TYPES) {
    using traits = interval_traits<TestType>;
    auto const problem = hovercraft_turn(0);
    auto const& e = problem.experiments[0];
    auto const f = std::make_shared<flow const>(problem.model, problem.choice, e.inputs);
    enclosure_options const options{.order = 12, .tolerance = 1e-7, .minimum_step = 1e-3};
    box const region{between(0.219, 0.221)};
    auto const reference = integrate(f, e.initial, region, 0, 0.5, options);
    auto const point = integrate(f, e.initial, box{interval(0.22)}, 0, 0.5);
    auto const tube = integrate<TestType>(f, box_in<TestType>(e.initial), box_in<TestType>(region),
                                          0, 0.5, options);
    REQUIRE(tube.complete());
    for (double const t : {0.07, 0.25, 0.5}) {
        auto const own = tube.at(t), all = tube.over(0.5 * t, t);
        auto const truth = point.at(t), same = reference.at(t);
        for (std::size_t i = 0; i < 6; ++i) {
            CAPTURE(t, i);
            interval const seen(traits::lower(own[i]), traits::upper(own[i]));
            // Each contains the motion, none is far from the others, times between steps included.
            CHECK_FALSE(disjoint(seen, truth[i]));
            CHECK(subset(interval(mid(truth[i])), seen));
            CHECK(traits::lower(all[i]) <= seen.lower());
            CHECK(seen.upper() <= traits::upper(all[i]));
            double const slack = std::is_same_v<TestType, support::coarse> ? 1e-4 : 1e-9;
            CHECK(std::abs(seen.lower() - same[i].lower()) <= slack);
            CHECK(std::abs(seen.upper() - same[i].upper()) <= slack);
        }
    }
}
