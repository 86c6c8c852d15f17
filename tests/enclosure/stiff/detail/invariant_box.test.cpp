// SPDX-License-Identifier: MIT
// Boxes that no solution leaves: reference trajectories stay in, for steps of all lengths.
#include <sivid/enclosure/stiff/detail/dissipative_step.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"
#include "support/systems.hpp"

#include <cmath>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

namespace {

template <class Rate>
std::shared_ptr<flow const> scalar(Rate const& rate) {
    return support::flow_of(
        support::model_of({1, 0}, [rate](auto const& t, auto const& x, auto const&, auto const&) {
            return std::vector{rate(t, x[0])};
        }));
}

} // namespace

TEST_CASE("trajectories of all systems stay in the box that was found") {
    draws d(641);
    int found = 0;
    support::for_each_system([&](auto const& system) {
        auto const f = system.flow();
        invariant_box<interval> boxes(*f);
        boxes.set_parameters(system.parameters);
        for (int round = 0; round < 12; ++round) {
            double const most = std::min(system.horizon, f->next_knot(0));
            double const to = most * std::pow(10, -d.uniform(0, 2));
            auto const b = boxes.find(0, to, system.initial, system.initial,
                                      std::vector<double>(f->states(), 1e-3));
            if (!b) continue;
            ++found;
            std::vector<double> times;
            for (int k = 0; k <= 20; ++k) times.push_back(to * k / 20);
            for (int member = 0; member < 4; ++member) {
                auto const states = support::reference_states(
                    system.rate, support::extend(d.in(system.initial)),
                    support::extend(d.in(system.parameters)), 0, times, system.inputs);
                for (auto const& x : states) {
                    for (std::size_t i = 0; i < x.size(); ++i) {
                        CAPTURE(system.name, to, i);
                        CHECK(support::encloses_reference((*b)[i], x[i]));
                    }
                }
            }
        }
    });
    CHECK(found > 40);
}

TEST_CASE("the length of the step does not matter where solutions are drawn together") {
    auto const f = scalar([](auto const& t, auto const& x) {
        using namespace support::real;
        return -(1e6 * (x - cos(t)));
    });
    invariant_box<interval> boxes(*f);
    boxes.set_parameters(box{});
    auto const b = boxes.find(0, 10, box{between(0.5, 0.75)}, box{interval(0.6)}, {1e-6});
    REQUIRE(b);
    CHECK(subset(between(-1, 1), (*b)[0]));
    CHECK(width((*b)[0]) < 2.05);
}

TEST_CASE("where solutions only grow it is the time that bounds them") {
    auto const f = scalar([](auto const&, auto const& x) { return x * 1; });
    invariant_box<interval> boxes(*f);
    boxes.set_parameters(box{});
    auto const b = boxes.find(0, 0.5, box{between(1, 2)}, box{between(1, 2)}, {1e-6});
    REQUIRE(b);
    CHECK((*b)[0].upper() >= 2 * std::exp(0.5));
    CHECK((*b)[0].lower() <= 1);
    // Twice as fast as its box allows: no box has x + h b < b.
    CHECK_FALSE(boxes.find(0, 1.5, box{between(1, 2)}, box{between(1, 2)}, {1e-6}));
}

TEST_CASE("no box where a solution blows up or leaves the domain") {
    auto const square = scalar([](auto const&, auto const& x) {
        using namespace support::real;
        return sqr(x);
    });
    invariant_box<interval> boxes(*square);
    boxes.set_parameters(box{});
    CHECK_FALSE(boxes.find(0, 1.1, box{interval(1.0)}, box{interval(1.0)}, {1e-3}));
    auto const root = scalar([](auto const&, auto const& x) {
        using namespace support::real;
        return -sqrt(x);
    });
    invariant_box<interval> falling(*root);
    falling.set_parameters(box{});
    CHECK_FALSE(falling.find(0, 3, box{interval(1.0)}, box{interval(1.0)}, {1e-3}));
    CHECK(falling.find(0, 0.5, box{interval(1.0)}, box{interval(1.0)}, {1e-3}));
}
