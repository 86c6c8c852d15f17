// SPDX-License-Identifier: MIT
#include <sivid/paving/static_problem.hpp>

#include "paving/static_models.hpp"
#include "support/catch.hpp"

using namespace sivid;

namespace {

struct named_twice : static_models::ring {
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"p", "1", 1_dec}, {"p", "1", 1_dec}});
    }();
};

} // namespace

TEST_CASE("constants of a static model have names of their own") {
    CHECK_THROWS_WITH(record_static_model<named_twice>(),
                      ContainsSubstring("two constants are called 'p'"));
}

TEST_CASE("a static model is recorded without states and inputs") {
    auto const m = record_static_model<static_models::mixed>();
    CHECK(m.about.name == "mixed");
    CHECK(m.about.states.empty());
    CHECK(m.about.channels.size() == 3);
    CHECK(m.about.constants.size() == 3);
    CHECK(m.observe.size() == 3);
    CHECK_NOTHROW(static_models::mixed_problem(1, 0.5).require_valid());
}

TEST_CASE("what does not fit is named") {
    auto const spoilt = [](auto const& change, std::string const& words) {
        auto problem = static_models::ring_problem();
        change(problem);
        CHECK_THROWS_WITH(problem.require_valid(), ContainsSubstring(words));
    };
    double const inf = HUGE_VAL;
    using traits = interval_traits<interval>;
    spoilt([](auto& p) { p.choice.unknown.clear(); }, "no unknown parameter");
    spoilt([](auto& p) { p.prior = box{interval(0, 1)}; }, "one side per parameter");
    spoilt([](auto& p) { p.prior[0] = traits::empty(); }, "empty");
    spoilt([&](auto& p) { p.prior[0] = traits::bounds(0, inf); }, "bounded");
    spoilt([](auto& p) { p.measurements.clear(); }, "no measurement");
    spoilt([](auto& p) { p.measurements[0].channel = 1; }, "unknown channel");
    spoilt([&](auto& p) { p.measurements[0].time = inf; }, "no finite time");
    spoilt([](auto& p) { p.measurements[0].bound = traits::empty(); }, "empty measurement");
    spoilt([&](auto& p) { p.measurements[0].bound = interval(inf, inf); }, "empty measurement");
    spoilt([](auto& p) { p.choice.fixed["q"] = interval(1.0); }, "'q' is unknown and has a fixed");
    spoilt([](auto& p) { p.model.about.states.push_back({"x", "", 1}); }, "states");
}
