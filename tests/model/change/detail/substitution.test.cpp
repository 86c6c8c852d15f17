// SPDX-License-Identifier: MIT
#include <sivid/model/change/detail/substitution.hpp>

#include <sivid/enclosure/tube.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

#include <memory>

using namespace sivid;
using support::draws;

namespace {

recorded_model original() {
    return support::model_of({1, 3}, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{p[2] - p[0] * x[0] / p[1]};
    });
}
model_description::constant named(std::string const& name) {
    return {name, "1", literal{interval(1.0), 1.0}};
}
/// p0 = s + d, p1 = s - d
recorded_map const halves(2, [](auto const& q) { return std::vector{q[0] + q[1], q[0] - q[1]}; });

} // namespace

TEST_CASE("a model in other constants has the trajectories of the original one") {
    auto const fresh =
        substituted(original(), {"p0", "p1"}, {named("s"), named("d")}, halves, true);
    REQUIRE(fresh.about.constants.size() == 3);
    CHECK(fresh.about.constants[0].name == "p2");
    CHECK(fresh.about.constants[2].name == "d");
    REQUIRE(fresh.about.channels.size() == 3);
    CHECK(fresh.about.channels[1].name == "p0");
    auto const before = support::flow_of(original());
    auto const after = std::make_shared<flow const>(fresh, parameter_choice{{"s", "d", "p2"}, {}},
                                                    std::vector<signal>{});
    draws d(661);
    for (int round = 0; round < 40; ++round) {
        double const s = d.uniform(1, 2), half = d.uniform(-0.5, 0.5), c = d.uniform(0, 1);
        box const q{interval(s), interval(half), interval(c)};
        auto const p = halves.over(box{q[0], q[1]});
        REQUIRE(p);
        auto const a =
            integrate<interval>(before, box{interval(1.0)}, box{(*p)[0], (*p)[1], q[2]}, 0, 1);
        auto const b = integrate<interval>(after, box{interval(1.0)}, q, 0, 1);
        REQUIRE((a.complete() && b.complete()));
        CHECK_FALSE(disjoint(a.at(1)[0], b.at(1)[0]));
        CHECK(width(b.at(1)[0]) < 1e-10);
    }
}

TEST_CASE("names may be taken over from what is replaced, from nothing else") {
    CHECK_NOTHROW(substituted(original(), {"p0", "p1"}, {named("p0"), named("d")}, halves));
    CHECK_THROWS_AS(substituted(original(), {"p0", "p1"}, {named("p2"), named("d")}, halves),
                    std::invalid_argument);
    CHECK_THROWS_AS(substituted(original(), {"p0", "p1"}, {named("d"), named("d")}, halves),
                    std::invalid_argument);
    CHECK_THROWS_AS(substituted(original(), {"p0"}, {named("s"), named("d")}, halves),
                    std::invalid_argument);
    CHECK_THROWS_AS(substituted(original(), {"p0", "none"}, {named("s"), named("d")}, halves),
                    std::invalid_argument);
}

TEST_CASE("delays keep their constants") {
    auto model = original();
    model.channel_delays.push_back({0, 2});
    auto const fresh = substituted(model, {"p0", "p1"}, {named("s"), named("d")}, halves);
    REQUIRE(fresh.channel_delays.size() == 1);
    CHECK(fresh.about.constants[fresh.channel_delays[0].constant].name == "p2");
    CHECK_THROWS_AS(substituted(model, {"p2", "p1"}, {named("s"), named("d")}, halves),
                    std::invalid_argument);
}
