// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/untouched_relation.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

#include <sivid/paving/relation/detail/broken_relation.hpp>

#include <string>
#include <vector>

using namespace sivid;
using namespace sivid::literals;

namespace {

/// Of the cart: p' = v with both sensors, or v' = k u - d v with the sensor of v.
relation_finding kinematic() {
    relation_finding f;
    f.equation = 0;
    f.channels = {"p", "v"};
    return f;
}
relation_finding dynamic(bool by_parts = false) {
    relation_finding f;
    f.equation = 1;
    f.channels = {"v"};
    if (by_parts) {
        f.channels.push_back("p");
        f.further = {0};
    }
    return f;
}
bool keeps(std::vector<effect> const& effects, relation_finding const& f) {
    auto const base = record_model(small_campaign::cart{});
    return keeps_relation(base, with(base, effects), f);
}

/// A law with a decimal that no double equals, twice.
struct decimal_law {
    static constexpr auto name = "decimal law";
    static constexpr auto states = sivid::states({{"x", "m", 10}, {"y", "m", 10}});
    static constexpr auto inputs = sivid::inputs({{"u", "m/s"}});
    static constexpr auto channels = sivid::channels({{"x", "m"}, {"y", "m"}});
    static constexpr auto constants = sivid::constants({{"k", "1/s", 1_dec}});
    template <class T>
    sivid::states_of<decimal_law, T> rate(T const&, sivid::states_of<decimal_law, T> const& x,
                                          sivid::constants_of<decimal_law, T> const& c,
                                          sivid::inputs_of<decimal_law, T> const& u) const {
        T const third(0.1_dec);
        return {third * x[0] - sqrt(third + x[1] * x[1]) * c[0], u[0] - x[1]};
    }
    template <class T>
    sivid::channels_of<decimal_law, T> observe(T const&, sivid::states_of<decimal_law, T> const& x,
                                               sivid::constants_of<decimal_law, T> const&,
                                               sivid::inputs_of<decimal_law, T> const&) const {
        return {x[0], x[1]};
    }
};

} // namespace

TEST_CASE("an effect keeps the relations that it does not act in") {
    namespace any = sivid::effects;
    auto const slope = any::constant_rate("slope", "v", "m/s^2", {-1_dec, 1_dec});
    auto const scale = any::sensor_scale("scale", {"p"}, {-0.5_dec, 0.5_dec});
    auto const late = any::input_delay("late", "u", {0_dec, 0.5_dec});
    auto const lag = any::input_lag("lag", "u", "N", {0_dec, 0.5_dec}, 10);
    CHECK(keeps({}, kinematic()));
    CHECK(keeps({}, dynamic(true)));
    for (auto const& e : {slope, late, lag, only_within(slope, {"E1"}), only_within(late, {"E1"}),
                          only_within(lag, {"E1"})}) {
        CAPTURE(e.name);
        CHECK(keeps({e}, kinematic()));
        CHECK_FALSE(keeps({e}, dynamic()));
        CHECK_FALSE(keeps({e, scale}, kinematic()));
    }
    CHECK(keeps({slope, late}, kinematic()));
    CHECK(keeps({scale}, dynamic()));
    CHECK_FALSE(keeps({scale}, dynamic(true))); // its proof looks at p, too
    CHECK_FALSE(keeps({scale}, kinematic()));
    effect drift{"drift", {{"c", "m/s", -1_dec, 1_dec, 0_dec}}};
    drift.on_rates = [](effect_scope& h) { h.rate("p") += h.parameter(); };
    CHECK(keeps({drift}, dynamic()));
    CHECK_FALSE(keeps({drift}, dynamic(true))); // nor p' = v
    effect stronger{"stronger", {{"c", "1", 0_dec, 1_dec, 0_dec}}};
    stronger.on_inputs = [](effect_scope& h) { h.constant("k") *= 1 + h.parameter(); };
    CHECK(keeps({stronger}, kinematic()));
    CHECK_FALSE(keeps({stronger}, dynamic()));
}

TEST_CASE("a channel that is late is another one, a delay of the model itself is left alone") {
    effect seen_late{"seen late", {{"tau", "s", 0_dec, 1_dec, 0_dec}}};
    seen_late.on_channels = [](effect_scope& h) { h.show_late("v", memory_kind::delay); };
    for (auto const& e : {seen_late, only_within(seen_late, {"E1"})}) {
        CHECK_FALSE(keeps({e}, kinematic()));
        CHECK_FALSE(keeps({e}, dynamic()));
    }
    effect other_late{"other late", {{"tau", "s", 0_dec, 1_dec, 0_dec}}};
    other_late.on_channels = [](effect_scope& h) { h.show_late("p", memory_kind::delay); };
    CHECK(keeps({other_late}, dynamic()));
    auto const delayed = with(record_model(small_campaign::cart{}), {seen_late});
    CHECK_FALSE(keeps_relation(delayed, delayed, kinematic()));
}

TEST_CASE("numbers that are enclosed are compared by their enclosures, as often as they stand") {
    auto const base = record_model(decimal_law{});
    relation_finding f;
    f.equation = 0;
    f.channels = {"x", "y"};
    effect elsewhere{"elsewhere", {{"c", "m/s", -1_dec, 1_dec, 0_dec}}};
    elsewhere.on_rates = [](effect_scope& h) { h.rate("y") += h.parameter(); };
    CHECK(keeps_relation(base, with(base, {elsewhere}), f));
    // The same text with two numbers that need not be equal.
    auto const image = [&](bool shared) {
        recorded_model m;
        m.about = base.about;
        auto const leaf = [&](operation op, std::size_t k) {
            return expression(m.g, m.g.leaf(op, k));
        };
        auto const tenth = literal{enclose(0.1_dec), 0.1};
        expression const one(m.g, m.g.constant(tenth));
        auto const two = shared ? one : expression(m.g, m.g.constant(tenth));
        auto const x = leaf(operation::state, 0), y = leaf(operation::state, 1);
        auto const rate = one * x - sqrt(two + y * y) * leaf(operation::constant, 0);
        auto const other = leaf(operation::input, 0) - y;
        m.rate = {rate.in(m.g), other.in(m.g)};
        m.observe = {x.in(m.g), y.in(m.g)};
        return m;
    };
    CHECK(keeps_relation(image(true), image(true), f));
    CHECK(keeps_relation(image(false), image(true), f));
    CHECK_FALSE(keeps_relation(image(true), image(false), f));
}

TEST_CASE("no truth keeps a relation that its own data refute") {
    using namespace small_campaign;
    auto const all = catalogue();
    auto const base = record_model(cart{});
    std::vector<truth> const truths{with_drag(0.3), with_slope(0.4), with_scale(0.3),
                                    with_delay(0.3)};
    std::size_t proved = 0;
    for (std::size_t k = 0; k < truths.size(); ++k) {
        for (auto const& f : find_broken_relations(problem(truths[k]))) {
            ++proved;
            INFO(all[k].name << ": " << f.name);
            CHECK_FALSE(keeps_relation(base, with(base, {all[k]}), f));
            CHECK(keeps_relation(base, base, f));
        }
    }
    CHECK(proved >= truths.size());
}
