// SPDX-License-Identifier: MIT
// Advice is checked by following it: the remedy carries the enclosure further, and where nothing is
// said to help, nothing does.
#include <sivid/enclosure/advice/detail/failure_advice.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/parametric_sets.hpp"
#include "support/random.hpp"

#include "../../../../examples/hovercraft/model.hpp"

#include <sivid/enclosure/taylor/parametric_flow.hpp>
#include <sivid/enclosure/taylor/parametric_runge_kutta.hpp>

#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace sivid;
using support::between;

namespace {

using doubletons = trajectory<interval>;
using models = support::sized_flow<2, 2>;
using better_models = support::sized_flow<2, 4>;
using part = std::pair<box, box>;

struct family {
    std::shared_ptr<flow const> f;
    box x, p;
    double end;
    enclosure_options options = {};
};

template <class Run>
double reach(family const& y, enclosure_options const& o, part const& b) {
    Run run(*y.f, o);
    run.begin(0, b.first, b.second);
    while (run.time() < y.end && run.step(y.end)) {
    }
    return run.time();
}

/// Every side with a width in k equal parts.
std::vector<part> split(family const& y, std::size_t k) {
    std::vector<part> parts{{y.x, y.p}};
    for (std::size_t side = 0; side < y.x.size() + y.p.size(); ++side) {
        std::vector<part> next;
        for (auto const& whole : parts) {
            auto const at = [&](part& b) -> interval& {
                return side < y.x.size() ? b.first[side] : b.second[side - y.x.size()];
            };
            auto copy = whole;
            auto const x = at(copy);
            if (width(x) == 0) {
                next.push_back(whole);
                continue;
            }
            auto const end = [&](std::size_t j) {
                double const share = static_cast<double>(j) / static_cast<double>(k);
                return j == k ? x.upper() : x.lower() + share * (x.upper() - x.lower());
            };
            for (std::size_t j = 0; j < k; ++j) {
                at(copy) = interval(end(j), end(j + 1));
                next.push_back(copy);
            }
        }
        parts = std::move(next);
    }
    return parts;
}

enclosure_options strong(enclosure_options o) {
    o.order = 40;
    o.tolerance = 1e-17;
    o.minimum_step = 1e-12;
    o.maximum_steps = 5000;
    return o;
}

/// Explains the failure, follows the advice, and returns what was said.
template <class Run, class Other>
advised_failure followed(family const& y) {
    auto const said = explain_failure<Run, Other>(*y.f, y.options, y.x, y.p, 0, y.end);
    REQUIRE(said);
    part const whole{y.x, y.p};
    double const before = reach<Run>(y, y.options, whole);
    REQUIRE(before < y.end);
    auto const further = [&](double t) { return t >= y.end || t > 1.05 * before; };
    INFO(said->message("x" + std::to_string(said->failure.component)));
    CHECK(said->failure.time == before);
    remedy_trial const* best = nullptr;
    for (auto const& t : said->trials) {
        CHECK(t.further == further(t.reached));
        if (t.further && t.remedy == said->failure.help && (!best || t.reached > best->reached))
            best = &t;
        if (t.share != 1) continue;
        bool const other = t.remedy == advice::other_set || t.remedy == advice::higher_degree;
        double const again =
            other ? reach<Other>(y, t.options, whole) : reach<Run>(y, t.options, whole);
        CHECK(again == t.reached);
    }
    switch (said->failure.help) {
    case advice::nothing:
        for (auto const& o : {strong(y.options), y.options}) {
            CHECK_FALSE(further(reach<Run>(y, o, whole)));
            CHECK_FALSE(further(reach<Other>(y, o, whole)));
        }
        break;
    case advice::parts_only: {
        std::size_t go_on = 0, end_there = 0;
        for (auto const& b : split(y, 64)) {
            (further(reach<Run>(y, y.options, b)) ? go_on : end_there) += 1;
        }
        CHECK(go_on > 0);
        CHECK(end_there > 0);
        break;
    }
    case advice::smaller_box:
        REQUIRE(best != nullptr);
        REQUIRE(best->share > 0);
        for (auto const& b : split(y, static_cast<std::size_t>(1 / best->share))) {
            CHECK(further(reach<Run>(y, y.options, b)));
        }
        break;
    default:
        REQUIRE(best != nullptr);
    }
    return *said;
}

template <class Rate>
std::shared_ptr<flow const> flow_of(support::shape const& s, Rate const& rate) {
    return support::flow_of(support::model_of(s, rate));
}

auto squares() {
    return flow_of({2, 0, 0, 1e6}, [](auto const&, auto const& x, auto const&, auto const&) {
        return std::vector{-x[0], sqr(x[1])};
    });
}
auto oscillator() {
    return flow_of({2, 0, 0, 10}, [](auto const&, auto const& x, auto const&, auto const&) {
        return std::vector{x[1], (1 - sqr(x[0])) * x[1] - x[0]};
    });
}
auto draining() {
    return flow_of({2, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{-x[0], -(p[0] * sqrt(x[1]))};
    });
}

interval const one(1.0);

} // namespace

TEST_CASE("what does not fail needs no advice") {
    family const y{squares(), {one, one}, {}, 0.5};
    CHECK_FALSE(explain_failure<doubletons>(*y.f, {}, y.x, y.p, 0, y.end));
    CHECK_FALSE(explain_failure<doubletons>(*y.f, {}, y.x, y.p, 0, 0));
    CHECK_THROWS_AS(explain_failure<doubletons>(*y.f, {}, box{one}, y.p, 0, 1),
                    std::invalid_argument);
}

TEST_CASE("a blow-up: nothing helps a point, splitting helps some of a box") {
    auto const check = [](advised_failure const& said, advice help) {
        CHECK(said.failure.help == help);
        CHECK(said.failure.reason == failure_reason::blow_up);
        CHECK(said.failure.component == 1);
        for (double const t : said.members) CHECK(t < 2); // of x1 = 1/2, the slowest
    };
    family const point{squares(), {one, one}, {}, 3};
    check(followed<doubletons, better_models>(point), advice::nothing);
    check(followed<models, better_models>(point), advice::nothing);
    family const wide{squares(), {one, between(0.5, 1)}, {}, 3};
    check(followed<doubletons, models>(wide), advice::parts_only);
    check(followed<models, better_models>(wide), advice::parts_only);
}

TEST_CASE("van der Pol from a wide box: doubletons need another set") {
    family const y{oscillator(), {between(1.25, 1.55), between(2.35, 2.45)}, {}, 7};
    auto const said = followed<doubletons, support::sized_flow<2, 6>>(y);
    CHECK(said.failure.help == advice::other_set);
    CHECK(said.trials.back().reached == 7);
    CHECK_THAT(said.message("v"), ContainsSubstring("use Taylor models") &&
                                      ContainsSubstring("the other set to the end"));
    // Without another set to try, and with Taylor models of a low degree.
    auto const alone = explain_failure<doubletons>(*y.f, {}, y.x, y.p, 0, y.end);
    REQUIRE(alone);
    CHECK(alone->failure.help == advice::smaller_box);
    CHECK(followed<models, better_models>(y).failure.help == advice::higher_degree);
}

TEST_CASE("a stiff problem with a low order: a higher one helps") {
    auto const f = flow_of({2}, [](auto const&, auto const& x, auto const&, auto const&) {
        return std::vector{1000 * (x[1] - x[0]), -x[1]};
    });
    family low{f, {one, one}, {}, 0.5};
    low.options.order = 2;
    CHECK(followed<doubletons, models>(low).failure.help == advice::higher_order);
    low.options.tolerance = 1e-7;
    low.options.maximum_steps = 100;
    auto const few = followed<doubletons, models>(low);
    CHECK(few.failure.reason == failure_reason::step_limit);
    CHECK((few.failure.help == advice::more_steps || few.failure.help == advice::higher_order));
    family coarse{f, {one, between(1, 1.1)}, {}, 0.01};
    coarse.options.order = 2;
    coarse.options.minimum_step = 1e-3;
    CHECK(followed<doubletons, models>(coarse).failure.help == advice::higher_order);
}

TEST_CASE("steps that may not be short enough") {
    auto const f = flow_of({1}, [](auto const&, auto const& x, auto const&, auto const&) {
        return std::vector{-30 * x[0] * sqr(x[0])};
    });
    family y{f, {between(1, 2)}, {}, 0.2};
    y.options.minimum_step = 0.05;
    y.options.tolerance = 1e-4;
    auto const said = followed<doubletons, models>(y);
    CHECK(said.failure.reason == failure_reason::minimum_step);
    CHECK(said.failure.help == advice::shorter_steps);
}

TEST_CASE("the end of a domain: nothing helps who gets there, another set or parts the others") {
    family y{draining(), {one, one}, {one}, 3}; // x1 is 0 at t = 2
    auto const edge = [](advised_failure const& said) {
        CHECK(said.failure.reason == failure_reason::undefined);
        CHECK(said.failure.component == 1);
        REQUIRE(said.failure.edge);
        CHECK(said.failure.edge->state == 1);
        CHECK(said.failure.edge->lower <= 0);
    };
    for (auto const& said : {followed<doubletons, models>(y), followed<models, better_models>(y)}) {
        edge(said);
        CHECK(said.failure.help == advice::nothing);
        CHECK(said.members.front() > 1.999);
        CHECK(said.members.front() < 2);
    }
    y.x[1] = between(-0.1, 1); // a part of it is outside
    y.end = 0.1;
    for (auto const& said : {followed<doubletons, models>(y), followed<models, better_models>(y)}) {
        edge(said);
        CHECK(said.failure.help == advice::parts_only);
        CHECK(said.failure.time == 0);
    }
    y.x[1] = between(0.5, 1); // all get past t = 1.2, the first to 1.41
    y.end = 1.2;
    CHECK(followed<doubletons, better_models>(y).failure.help == advice::other_set);
    auto const coarse = followed<models, better_models>(y);
    edge(coarse);
    CHECK(coarse.failure.help == advice::higher_degree);
    auto const alone = explain_failure<doubletons>(*y.f, {}, y.x, y.p, 0, y.end);
    REQUIRE(alone);
    CHECK(alone->failure.help == advice::smaller_box);
}

TEST_CASE("division by what may be zero: smaller boxes, or nothing for who runs into it") {
    auto const away = flow_of({1}, [](auto const&, auto const& x, auto const&, auto const&) {
        return std::vector{1 / (x[0] - 1)};
    });
    auto const smaller = followed<doubletons, models>({away, {between(-1, 0.9)}, {}, 1});
    CHECK(
        (smaller.failure.help == advice::smaller_box || smaller.failure.help == advice::other_set));
    auto const across = followed<doubletons, models>({away, {between(0.5, 2)}, {}, 0.1});
    CHECK(across.failure.help == advice::parts_only);
    REQUIRE(across.failure.edge);
    CHECK(across.failure.edge->function == operation::div);
    auto const into = flow_of({1}, [](auto const&, auto const& x, auto const&, auto const&) {
        return std::vector{1 / (1 - x[0])}; // x = 1 at t = 1/2
    });
    for (auto const& said : {followed<doubletons, models>({into, {interval(0.0)}, {}, 1}),
                             followed<models, better_models>({into, {interval(0.0)}, {}, 1})}) {
        CHECK(said.failure.help == advice::nothing);
        CHECK(said.failure.reason == failure_reason::undefined);
        REQUIRE(said.failure.edge);
        CHECK(said.failure.edge->function == operation::div);
        CHECK(said.members.front() < 0.5);
    }
}

TEST_CASE("Runge-Kutta methods are advised, too") {
    family y{squares(), {one, one}, {}, 3};
    y.options.tolerance = 1e-7;
    y.options.minimum_step = 1e-4;
    for (auto const& method : {rk4(), radau_iia5()}) {
        y.options.method = method;
        auto const set = explain_failure<doubletons>(*y.f, y.options, y.x, y.p, 0, y.end);
        REQUIRE(set);
        CHECK(set->failure.help == advice::nothing);
        CHECK(set->failure.reason == failure_reason::blow_up);
        using by_method = support::sized_runge_kutta<2, 2>;
        auto const model = explain_failure<by_method>(*y.f, y.options, y.x, y.p, 0, y.end);
        REQUIRE(model);
        CHECK(model->failure.help == advice::nothing);
    }
}

TEST_CASE("advice is the same every time, and what was reached exists: random blow-ups") {
    support::draws d(17);
    auto const f = squares();
    std::set<advice> given;
    for (int k = 0; k < 40; ++k) {
        double const x = d.uniform(0.3, 2), r = d.coin() ? 0 : d.uniform(0, 0.2);
        enclosure_options o;
        o.order = 4 + d.below(12);
        o.tolerance = std::pow(10, -d.uniform(4, 12));
        o.minimum_step = std::pow(10, -d.uniform(3, 7));
        box const start{support::between(0.5, 1), support::around(x, r)};
        double const end = d.uniform(0.2, 3);
        auto const said = explain_failure<doubletons>(*f, o, start, {}, 0, end);
        auto const again = explain_failure<doubletons>(*f, o, start, {}, 0, end);
        REQUIRE(said.has_value() == again.has_value());
        if (!said) {
            REQUIRE(end < 1 / (x + r));
            continue;
        }
        REQUIRE(said->message("x") == again->message("x"));
        given.insert(said->failure.help);
        // Blow-up at 1/x, of the earliest member for what the whole box reached.
        REQUIRE(said->failure.time < 1 / (x + r));
        REQUIRE(said->members.front() < 1 / x * (1 + 1e-12));
        for (auto const& t : said->trials) {
            if (t.share == 1) REQUIRE(t.reached < 1 / (x + r));
        }
        if (said->failure.help == advice::nothing && r == 0)
            REQUIRE(1.06 * said->failure.time > 1 / x);
    }
    CHECK(given.count(advice::nothing) == 1);
    CHECK(given.count(advice::parts_only) == 1);
}

TEST_CASE("the hovercraft over its whole prior") {
    expression const pi(between(0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1));
    auto const rotor = analytic_signal::from([](auto const&) { return expression(250) / 3; });
    auto const rudder =
        analytic_signal::from([&](auto const& t) { return pi / 12 * (1 + sin(pi * t / 2)); });
    auto const f = std::make_shared<flow const>(record_model(hovercraft{}),
                                                parameter_choice{{"Sv", "Sg", "L"}, {}},
                                                std::vector<signal>{rotor, rudder});
    family y{f, point_box({2, 0, 0, 0, 0, 0}),
             box{between(0.20, 0.25), between(0.0042, 0.0754), between(0.25, 0.35)}, 3};
    y.options.minimum_step = 2e-3; // doubletons would go on for long in shorter and shorter steps
    auto const first_order = followed<doubletons, support::sized_flow<3, 2>>(y);
    CHECK(first_order.failure.help == advice::other_set);
    y.options.order = 6;
    y.options.tolerance = 1e-5;
    y.options.minimum_step = 1e-2;
    auto const second = followed<support::sized_flow<3, 2>, support::sized_flow<3, 4>>(y);
    CHECK(second.failure.help == advice::smaller_box);
    CHECK(second.failure.time > first_order.failure.time);
}
