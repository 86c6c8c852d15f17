// SPDX-License-Identifier: MIT
// A turning vector x' = p y, y' = -p x, known in closed form, by every set and kind of method.
#include <sivid/enclosure/enclose.hpp>

#include <sivid/enclosure/runge_kutta/implicit_tableau.hpp>
#include <sivid/enclosure/tube.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"

#include <cmath>
#include <optional>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

namespace {

auto turning() {
    return support::flow_of(support::model_of(
        {2, 1, 0, 1e3}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * x[1], -(p[0] * x[0])};
        }));
}
box const starts{between(0.9, 1.1), between(-0.1, 0.1)};
box const speeds{between(0.9, 1.1)};

bool holds(box const& x, std::vector<double> const& x0, double p, double t) {
    long double const c = std::cos(static_cast<long double>(p) * t),
                      s = std::sin(static_cast<long double>(p) * t);
    return support::encloses_reference(x[0], c * x0[0] + s * x0[1]) &&
           support::encloses_reference(x[1], c * x0[1] - s * x0[0]);
}

} // namespace

TEST_CASE("by any set and method, at and over contain every trajectory") {
    auto const f = turning();
    draws d(3);
    double widest_models = 0, narrowest_first = 1e9;
    for (auto const set : {carried_set::doubleton, carried_set::taylor_model}) {
        for (auto const& method :
             {std::optional<tableau>{}, std::optional{rk4()}, std::optional{gauss4()}}) {
            CAPTURE(static_cast<int>(set), method ? method->name : "taylor");
            enclosure_options options{.tolerance = 1e-6, .relative_tolerance = 1e-3};
            options.method = method;
            auto const motion = enclose(f, starts, speeds, 0, 2, set, options);
            REQUIRE(motion.complete());
            CHECK(motion.end_time() == 2);
            REQUIRE(!motion.spans().empty());
            CHECK(motion.spans().front().from == 0);
            CHECK(motion.spans().back().to == 2);
            for (int round = 0; round < 12; ++round) {
                double const from = d.uniform(0, 2), to = d.uniform(from, 2);
                auto const there = motion.at(from), all = motion.over(from, to);
                auto const seen = motion.observe_at(from);
                for (int sample = 0; sample < 20; ++sample) {
                    auto const x0 = d.in(starts);
                    double const p = d.in(speeds)[0];
                    CHECK(holds(there, x0, p, from));
                    CHECK(holds(seen, x0, p, from)); // the channels are the states
                    CHECK(holds(all, x0, p, from));
                    CHECK(holds(all, x0, p, to));
                    CHECK(holds(all, x0, p, d.uniform(from, to)));
                }
            }
            double const end = width(motion.at(2));
            if (set == carried_set::doubleton) narrowest_first = std::min(narrowest_first, end);
            if (set == carried_set::taylor_model) widest_models = std::max(widest_models, end);
            CHECK_THROWS_AS(motion.at(2.1), std::out_of_range);
            CHECK_THROWS_AS(motion.at(-0.1), std::out_of_range);
            CHECK_THROWS_AS(motion.over(1, 0.5), std::invalid_argument);
        }
    }
    CHECK(widest_models < narrowest_first);
}

TEST_CASE("sets of first order are those of integrate, in any interval type") {
    auto const f = turning();
    auto const motion = enclose(f, starts, speeds, 0, 1, carried_set::doubleton);
    auto const tube = integrate<interval>(f, starts, speeds, 0, 1);
    CHECK(equal(motion.at(0.3)[0], tube.at(0.3)[0]));
    CHECK(equal(motion.over(0.3, 0.7)[1], tube.over(0.3, 0.7)[1]));
    CHECK(motion.steps().steps().size() == tube.steps().size());
    CHECK_THROWS_AS(enclose(f, starts, speeds, 0, 1).steps(), std::logic_error);
}

TEST_CASE("what cannot be enclosed is refused, or ends early with a reason") {
    auto const f = turning();
    CHECK_THROWS_AS(enclose(f, box{interval(1)}, speeds, 0, 1), std::invalid_argument);
    CHECK_THROWS_AS(enclose(f, starts, speeds, 1, 0), std::invalid_argument);
    CHECK_THROWS_AS(enclose(f, starts, box{interval_traits<interval>::entire()}, 0, 1),
                    std::invalid_argument);
    auto const many = support::flow_of(support::model_of(
        {2, 2, 0, 1e3}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * x[1], -(p[1] * x[0])};
        }));
    CHECK(enclose(many, starts, box{speeds[0], speeds[0]}, 0, 1).end_time() == 1);
    auto const blow_up = support::flow_of(
        support::model_of({1, 0, 0, 1e3}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{x[0] * x[0]};
        }));
    auto const motion = enclose(blow_up, box{between(0.9, 1.1)}, box{}, 0, 2);
    REQUIRE_FALSE(motion.complete());
    CHECK(motion.end_time() < 1);
    REQUIRE(motion.end_time() > 0.2);
    double const t = 0.9 * motion.end_time();
    CHECK(contains(motion.at(t)[0], 1 / (1 - t)));
    CHECK_THROWS_AS(motion.at(1.5), std::out_of_range);
}
