// SPDX-License-Identifier: MIT
// Which function of which rate is not defined.
#include <sivid/enclosure/series/domain_edge.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

using namespace sivid;
using support::between;

TEST_CASE("a domain's edge is found by value, parameter, time or derivative") {
    auto const f = support::flow_of(
        support::model_of({4, 1}, [](auto const& t, auto const& x, auto const& p, auto const&) {
            return std::vector{x[0] + x[1], log(x[1]), x[2] / p[0], sqrt(2 - t) + sqrt(x[3])};
        }));
    box const x{interval(1.0), interval(2.0), interval(3.0), interval(4.0)}, p{interval(1.0)};
    auto const at = [&](box const& states, box const& parameters, double time) {
        return find_domain_edge<interval>(*f, 0, interval(time), states, parameters);
    };
    CHECK_FALSE(at(x, p, 1));
    auto y = x;
    y[1] = between(-1, 1);
    auto const value = at(y, p, 1);
    REQUIRE(value);
    CHECK(value->state == 1);
    CHECK(value->function == operation::log);
    CHECK_FALSE(value->derivative);
    CHECK(value->lower == -1);
    CHECK(value->upper == 1);
    auto const parameter = at(x, box{between(-1, 1)}, 1);
    REQUIRE(parameter);
    CHECK(parameter->state == 2);
    CHECK(parameter->function == operation::div);
    auto const late = at(x, p, 3);
    REQUIRE(late);
    CHECK(late->state == 3);
    CHECK(late->function == operation::sqrt);
    CHECK(late->upper == -1);
    y = x;
    y[3] = between(0, 1); // the root is defined, its derivative is not
    auto const steep = at(y, p, 1);
    REQUIRE(steep);
    CHECK(steep->state == 3);
    CHECK(steep->derivative);
    CHECK(steep->lower <= 0);
}

TEST_CASE("the first function is named, not those that its result spoils") {
    auto const f = support::flow_of(
        support::model_of({2, 0}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{-x[0], log(1 / sqrt(x[0] - x[1]))};
        }));
    auto const edge = find_domain_edge<interval>(*f, 0, interval(0.0),
                                                 box{between(0, 1), between(0.5, 0.5)}, box{});
    REQUIRE(edge);
    CHECK(edge->state == 1);
    CHECK(edge->function == operation::sqrt);
    CHECK(edge->lower == -0.5);
}

TEST_CASE("edges are found where the model is undefined for some point, in random boxes") {
    auto const f = support::flow_of(
        support::model_of({2, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{log(x[0] - p[0]), x[0] / x[1]};
        }));
    support::draws d(31);
    std::size_t found = 0;
    for (int k = 0; k < 2000; ++k) {
        box const x{d.interval(-1, 1, 0.5), d.interval(-1, 1, 0.5)}, p{d.interval(-1, 1, 0.5)};
        auto const edge = find_domain_edge<interval>(*f, 0, interval(0.0), x, p);
        bool const first = !(x[0].lower() > p[0].upper());
        bool const second = contains(x[1], 0.0);
        if (first) {
            REQUIRE(edge);
            REQUIRE(edge->state == 0);
        } else if (second) {
            REQUIRE(edge);
            REQUIRE(edge->state == 1);
        } else {
            REQUIRE_FALSE((edge && !edge->derivative));
        }
        found += edge ? 1 : 0;
    }
    CHECK(found > 500);
    CHECK(found < 1900);
}
