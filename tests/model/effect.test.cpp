// SPDX-License-Identifier: MIT
#include <sivid/model/effect.hpp>

#include "support/catch.hpp"

#include "support/formulas.hpp"
#include "support/models.hpp"
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/named_effects.hpp>

#include <sivid/model/effects.hpp>

#include <limits>
#include <vector>

using namespace sivid;

namespace {

/// x' = -k x + u, y = x
struct tank {
    static constexpr auto name = "tank";
    static constexpr auto states = sivid::states({{"x", "m", 5}});
    static constexpr auto inputs = sivid::inputs({{"u", "m/s"}});
    static constexpr auto channels = sivid::channels({{"y", "m"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"k", "1/s", 0.5_dec}});
    }();
    template <class T>
    states_of<tank, T> rate(T const&, states_of<tank, T> const& x, constants_of<tank, T> const& c,
                            inputs_of<tank, T> const& u) const {
        return {-c[0] * x[0] + u[0]};
    }
    template <class T>
    channels_of<tank, T> observe(T const&, states_of<tank, T> const& x,
                                 constants_of<tank, T> const&, inputs_of<tank, T> const&) const {
        return {x[0]};
    }
};

effect doubled(std::string const& name) {
    using namespace sivid::literals;
    effect e;
    e.name = name;
    e.parameters = {{"g", "1", 0_dec, 3_dec, 1_dec}};
    e.on_inputs = [](effect_scope& m) { m.input("u") *= m.parameter(); };
    return e;
}

} // namespace

TEST_CASE("an effect adds constants, states and terms") {
    using namespace sivid::literals;
    effect lag;
    lag.name = "lag";
    lag.parameters = {{"tau", "s", 0.1_dec, 1_dec, 0.5_dec}};
    lag.order = 1;
    lag.on_inputs = [](effect_scope& m) {
        auto const d = m.add_state("d", "m/s", 9, m.input("u"));
        m.rate("d") = (m.input("u") - d) / m.parameter();
        m.input("u") = d;
    };
    lag.on_rates = [](effect_scope& m) { m.rate("x") += m.time() * m.constant("k"); };
    lag.on_channels = [](effect_scope& m) { m.channel("y") *= 2; };
    // Written behind the lag, but its order puts the gain in front.
    auto const m = with(tank{}, lag, doubled("gain"));
    REQUIRE(m.about.states.size() == 2);
    CHECK(m.about.states[1].name == "d");
    CHECK(m.about.states[1].limit == 9);
    REQUIRE(m.about.constants.size() == 3);
    CHECK(m.about.constants[1].name == "gain.g");
    CHECK(m.about.constants[2].name == "lag.tau");
    CHECK(m.about.constants[2].nominal.nearest == 0.5);
    REQUIRE(m.added_states.size() == 1);
    auto const value = [&m](node_id n) {
        graph g;
        auto const at = copy_into(g, m.g, {n}, [](node const& leaf, graph& to) {
            double const states[] = {3, 7}, constants[] = {0.5, 2, 0.25};
            auto const k = static_cast<std::size_t>(leaf.index);
            return to.constant(leaf.op == operation::state      ? states[k]
                               : leaf.op == operation::constant ? constants[k]
                               : leaf.op == operation::input    ? 5.0
                                                                : 1.0);
        });
        return g.value(g[at.front()]).nearest;
    };
    CHECK(value(m.rate[0]) == -0.5 * 3 + 7 + 1 * 0.5);
    CHECK(value(m.rate[1]) == (2 * 5 - 7) / 0.25);
    CHECK(value(m.observe[0]) == 6);
    CHECK(value(m.added_states[0].at_begin) == 10);
}

TEST_CASE("effects can be joined one after the other") {
    auto const once = with(tank{}, doubled("a"));
    auto const twice = with(once, {doubled("b")});
    auto const together = with(tank{}, doubled("a"), doubled("b"));
    CHECK(twice.about.constants.size() == 3);
    CHECK(twice.g.size() == together.g.size());
}

TEST_CASE("an effect that is joined later sees the copies of an input, or is refused") {
    using namespace sivid::literals;
    auto const late = effects::input_delay("late", "u", {0_dec, 1_dec});
    auto const base = with(tank{}, only_within(late, {"S1"}, {1.5}));
    auto const refused = [&](effect const& e) {
        CHECK_THROWS_WITH(with(base, {e}), ContainsSubstring("effect '" + e.name + "'") &&
                                               ContainsSubstring("join both effects at once"));
        CHECK_NOTHROW(with(tank{}, only_within(late, {"S1"}, {1.5}), e));
    };
    refused(doubled("gain"));
    refused(effects::input_lag("lag", "u", "m/s", {0.1_dec, 1_dec}, 5));
    refused(only_within(effects::input_delay("later", "u", {0_dec, 1_dec}), {"S2"}, {2}));
    effect leaks = doubled("leaks"); // it reads the input alone
    leaks.on_inputs = {};
    leaks.on_rates = [](effect_scope& m) { m.rate("x") -= m.parameter() * m.named("u"); };
    refused(leaks);
    effect both = doubled("both");
    both.on_inputs = [](effect_scope& m) {
        for (auto const& u : {"u", "late@S1>=1.5.u"}) m.input(u) *= m.parameter();
    };
    CHECK_NOTHROW(with(base, {both}));
    effect drag = doubled("drag"); // it names no input
    drag.on_inputs = {};
    drag.on_rates = [](effect_scope& m) { m.rate("x") -= m.parameter() * m.state("x"); };
    CHECK_NOTHROW(with(base, {drag}));
}

TEST_CASE("an effect without parameters is switched like any other") {
    effect cut;
    cut.name = "cut";
    CHECK(cut.may_leave_traces());
    cut.on_inputs = [](effect_scope& m) {
        m.input("u") = saturate(m.input("u"), expression(-1), expression(1));
    };
    auto const m = with(tank{}, only_within(cut, {"S1"}));
    for (double const on : {0.0, 1.0}) {
        graph_range rate(m.g, {m.rate[0]});
        rate.evaluate({interval(0.0), point_box({0.0}), point_box({0.5}), point_box({3.0, on})});
        CHECK(rate.value(m.rate[0]).lower() == (on == 1 ? 1 : 3));
        CHECK(rate.value(m.rate[0]).upper() == (on == 1 ? 1 : 3));
    }
}

TEST_CASE("an input and a constant may have one name, an effect has a name of its own") {
    using namespace sivid::literals;
    auto base = record_model(tank{});
    base.about.constants.push_back({"u", "m", literal{interval(1.0), 1.0}});
    CHECK(finds_as_recorded(base, {doubled("first")}, 0, "u"));
    CHECK_FALSE(finds_as_recorded(base, {doubled("first"), doubled("second")}, 1, "u"));
    auto drag = effects::linear_damping("u", "x", {0_dec, 1_dec});
    CHECK_NOTHROW(with(tank{}, only_within(drag, {"S1"})));
    drag.only_in = {"S1"}; // its switch would be the input
    CHECK_THROWS_WITH(with(tank{}, drag), ContainsSubstring("two inputs are called 'u'"));
}

TEST_CASE("delays are named, and binding refuses them") {
    using namespace sivid::literals;
    effect late;
    late.name = "late";
    late.parameters = {{"in", "s", 0_dec, 1_dec, 0_dec}, {"out", "s", 0_dec, 1_dec, 0_dec}};
    late.on_inputs = [](effect_scope& m) { m.remember("u", memory_kind::delay); };
    late.on_channels = [](effect_scope& m) { m.show_late("y", memory_kind::delay, 1); };
    auto const m = with(tank{}, late);
    REQUIRE((m.input_memory.size() == 1 && m.channel_delays.size() == 1));
    CHECK(m.input_memory[0].constant == 1);
    CHECK(m.channel_delays[0].constant == 2);
    auto const hold = sampled_signal({0.0}, {1.0}, interpolation::hold);
    CHECK_THROWS_AS(bind(m, {}, {hold}), std::invalid_argument);
    CHECK(with(m, {}).input_memory.size() == 1);
    for (auto const kind : {memory_kind::play, memory_kind::rate_limit}) {
        late.on_channels = [kind](effect_scope& scope) { scope.show_late("y", kind, 1); };
        CHECK_THROWS_AS(with(tank{}, late), std::invalid_argument);
    }
}

TEST_CASE("an effect finds an input as it was recorded unless one before it changes that") {
    using namespace sivid::literals;
    effect last;
    last.name = "last";
    last.order = 2;
    effect weaker = doubled("weaker"); // a constant alone, at the same stage
    weaker.on_inputs = [](effect_scope& m) { m.constant("k") *= m.parameter(); };
    effect reads = doubled("reads"); // what it makes of the input is not what the last one leaves
    reads.on_inputs = [](effect_scope& m) { m.constant("k") *= 1 + m.parameter() * m.input("u"); };
    effect follows = doubled("follows");
    follows.on_inputs = [](effect_scope& m) {
        auto const d = m.add_state("d", "m", 9, expression(0));
        m.rate("d") = m.input("u") - d;
    };
    effect late = doubled("late");
    late.on_inputs = [](effect_scope& m) { m.remember("u", memory_kind::delay); };
    auto const model = record_model(tank{});
    CHECK(finds_as_recorded(model, {last}, 0, "u"));
    CHECK(finds_as_recorded(model, {last, weaker}, 0, "u"));
    CHECK_FALSE(finds_as_recorded(model, {last, doubled("gain")}, 0, "u"));
    CHECK_FALSE(finds_as_recorded(model, {late, last}, 1, "u"));
    CHECK_FALSE(finds_as_recorded(model, {last, reads}, 0, "u"));
    CHECK_FALSE(finds_as_recorded(model, {follows, last}, 1, "u"));
    CHECK(finds_as_recorded(model, {last, doubled("gain")}, 1, "u")); // which comes first
    CHECK_THROWS_AS(finds_as_recorded(model, {last}, 0, "v"), std::invalid_argument);
}

TEST_CASE("effects are picked from a catalogue by their names") {
    std::vector<effect> const catalogue{doubled("a"), doubled("k"), doubled("x")};
    CHECK(effects_named(catalogue, {}).empty());
    auto const some = effects_named(catalogue, {"x", "a"});
    REQUIRE(some.size() == 2);
    CHECK(some[0].name == "x");
    CHECK(some[1].name == "a");
    CHECK_THROWS_WITH(effects_named(catalogue, {"b"}),
                      ContainsSubstring("unknown effect 'b'; known: a, k, x"));
}

TEST_CASE("an effect in some experiments only has a switch and is none where that is off") {
    auto const m = with(tank{}, only_within(doubled("a"), {"E2", "E4"}));
    REQUIRE(m.about.inputs.size() == 2);
    CHECK(m.about.inputs[1].name == "a@E2+E4");
    REQUIRE(m.about.constants.size() == 2);
    CHECK(m.about.constants[1].name == "a@E2+E4.g");
    struct outcome {
        double rate;
        std::size_t constants; ///< that the rate still depends on
    };
    auto const at = [&m](double on) {
        graph g;
        auto const root = copy_into(g, m.g, m.rate, [on](node const& n, graph& to) {
            auto const k = static_cast<std::size_t>(n.index);
            return n.op == operation::input   ? to.constant(k == 0 ? 2.0 : on)
                   : n.op == operation::state ? to.constant(3.0)
                                              : to.leaf(n.op, k);
        });
        auto const operands = operands_of(g, root);
        outcome result{0, 0};
        for (std::size_t k = 0; k < operands.size(); ++k) {
            if (operands[k] && g.nodes()[k].op == operation::constant) ++result.constants;
        }
        graph values;
        auto const value = copy_into(values, g, root, [](node const& n, graph& to) {
            return to.constant(n.index == 0 ? 0.5 : 2.5);
        });
        result.rate = values.value(values[value.front()]).nearest;
        return result;
    };
    CHECK(at(0).rate == -0.5 * 3 + 2);
    CHECK(at(0).constants == 1); // k: the effect is gone, not only small
    CHECK(at(1).rate == -0.5 * 3 + 2.5 * 2);
    CHECK(at(1).constants == 2);

    std::vector<effect> const catalogue{doubled("a"), doubled("b")};
    auto const named = effects_named(catalogue, {"b@S1", "a_wider@S1+S3", "a"});
    REQUIRE(named.size() == 3);
    CHECK(named[0].name == "b@S1");
    CHECK(named[0].only_in == std::vector<std::string>{"S1"});
    CHECK(named[1].name == "a_wider@S1+S3");
    CHECK(named[1].only_in == std::vector<std::string>{"S1", "S3"});
    CHECK(named[1].parameters[0].widened == 4);
    CHECK(named[2].only_in.empty());
    CHECK_THROWS_AS(effects_named(catalogue, {"c@S1"}), std::invalid_argument);
    CHECK(with(tank{}, named[0], named[1]).about.inputs.size() == 3);

    effect late, lag;
    late.name = "late";
    late.parameters = {{"tau", "s", decimal(), decimal(), decimal()}};
    late.on_inputs = [](effect_scope& e) { e.remember("u", memory_kind::delay); };
    lag = late;
    lag.on_inputs = [](effect_scope& e) { (void)e.add_state("d", "m", 1, e.input("u")); };
    CHECK_FALSE(with(tank{}, late).input_memory[0].only_if);
    auto const switched = with(tank{}, only_within(late, {"S1"}));
    REQUIRE(switched.input_memory.size() == 1);
    REQUIRE(switched.input_memory[0].only_if);
    CHECK(switched.about.inputs[*switched.input_memory[0].only_if].name == "late@S1");
    for (double const on : {0.0, 1.0}) {
        auto const switch_at = analytic_signal::from([on](auto const&) { return on; });
        CHECK(acts_in(switched.input_memory[0],
                      {sampled_signal({0.0}, {0.0}, interpolation::linear), switch_at}) ==
              (on == 1));
    }
}

TEST_CASE("a memory that is seen for a time is behind a copy of its input") {
    auto const late = effects::input_delay("late", "u", {0_dec, 1_dec});
    auto const gap = effects::input_backlash("gap", "u", "m", {0_dec, 1_dec});
    auto const slow = effects::input_lag("slow", "u", "m", {0_dec, 1_dec}, 5);
    auto const some = only_within(late, {"S1"}, {1.5});
    auto const m = with(tank{}, some);
    REQUIRE(m.about.inputs.size() == 3);
    CHECK(m.about.inputs[2].name == "late@S1>=1.5.u");
    REQUIRE(m.input_copies.size() == 1);
    CHECK((m.input_copies[0].copy == 2 && m.input_copies[0].of == 0));
    REQUIRE(m.input_memory.size() == 1);
    CHECK(m.input_memory[0].index == 2);
    CHECK_FALSE(m.input_memory[0].only_if);

    // What the model sees where the switch is off and on: u, or its copy.
    auto const seen = [](recorded_model const& changed, double on) {
        auto prompt = changed;
        prompt.input_memory.clear();
        sampled_signal const u({0.0, 1.0}, {2.0, 3.0}, interpolation::linear);
        std::vector<signal> inputs(changed.about.inputs.size(), u);
        inputs[1] = analytic_signal::from([on](auto const&) { return on; });
        std::vector<std::string> unknown;
        for (auto const& c : changed.about.constants) unknown.push_back(c.name);
        auto const bound = bind(prompt, {unknown, {}}, inputs);
        auto const needed = operands_of(bound.g, {bound.rate[0]});
        std::vector<int> result;
        for (std::size_t k = 0; k < needed.size(); ++k) {
            auto const& n = bound.g.nodes()[k];
            if (needed[k] && n.op == operation::input) result.push_back(n.index);
        }
        return result;
    };
    CHECK(seen(m, 0) == std::vector<int>{0});
    CHECK(seen(m, 1) == std::vector<int>{2});

    // Another memory of the same input is behind both, before and after this one.
    for (auto const& both : {with(tank{}, some, gap), with(tank{}, gap, some),
                             with(with(tank{}, some), {gap}), with(with(tank{}, gap), {some})}) {
        int plays = 0, delays = 0;
        for (auto const& d : both.input_memory) {
            (d.kind == memory_kind::play ? plays : delays) += 1;
            if (d.kind == memory_kind::delay) CHECK(d.index == both.input_copies.at(0).copy);
        }
        CHECK((plays == 2 && delays == 1));
    }
    // Two that are seen for a time: u alone, behind either, behind both.
    auto const two = with(tank{}, some, only_within(gap, {"S1"}, {2}));
    CHECK(two.input_copies.size() == 3);
    CHECK(two.input_memory.size() == 4);

    // The state of a lag goes on with its own time constant, wherever it is seen.
    auto const lags = with(tank{}, only_within(slow, {"S1"}, {1.5}));
    CHECK((lags.g.depends(lags.rate[1]) & (on_constant | on_input)) == (on_constant | on_input));
    CHECK(seen(lags, 0) == std::vector<int>{0});
    CHECK(seen(lags, 1).empty());
}

TEST_CASE("a state of an effect is seen where its switch is on, and has a rate where it is off") {
    auto const lag = effects::input_lag("lag", "u", "m", {0_dec, 0.5_dec}, 5);
    auto const m = with(tank{}, only_within(lag, {"S1"}));
    REQUIRE(m.rate.size() == 2);
    parameter_choice const choice{{"k", "lag@S1.tau"}, {}};
    for (double const on : {0.0, 1.0}) {
        sampled_signal const u({0.0, 1.0}, {2.0, 2.0}, interpolation::linear);
        auto const bound =
            bind(m, choice, {u, analytic_signal::from([on](auto const&) { return on; })});
        auto const needed = operands_of(bound.g, {bound.rate[0]});
        bool sees_input = false, sees_lag = false;
        for (std::size_t k = 0; k < needed.size(); ++k) {
            auto const& n = bound.g.nodes()[k];
            sees_input = sees_input || (needed[k] && n.op == operation::input);
            sees_lag = sees_lag || (needed[k] && n.op == operation::state && n.index == 1);
        }
        CHECK(sees_lag == (on == 1));
        CHECK(sees_input == (on == 0));
        // Off, the lag is one of half a second, and no time constant can spoil it.
        CHECK((bound.g.depends(bound.rate[1]) & on_constant) == (on == 1 ? on_constant : 0));
    }
}

TEST_CASE("an effect that begins later has the time in its name, which reads back") {
    for (double const t : {1.5, 0.1, 1.0 / 3, 1234567.25, 1e-7, -2.5, 0.0}) {
        auto const e = only_within(doubled("a"), {"E2", "E4"}, {t, effect::from_start});
        CHECK(e.begins_later());
        auto const read = effects_named({doubled("a")}, {e.name}).front();
        CHECK(read.name == e.name);
        CHECK(read.only_in == e.only_in);
        CHECK(read.since == e.since);
        CHECK(with(tank{}, read).about.inputs[1].name == e.name);
    }
    auto const e = only_within(doubled("a"), {"E2", "E4"}, {1.5, effect::from_start});
    CHECK(e.name == "a@E2>=1.5+E4");
    CHECK(effects_named({doubled("a")}, {"a_wider@E2>=2"}).front().parameters[0].widened == 4);
    CHECK_FALSE(effects_named({doubled("a")}, {"a@E2+E4"}).front().begins_later());
    CHECK_FALSE(doubled("a").begins_later());
    for (auto const* bad :
         {"a@E2>=", "a@E2>=soon", "a@E2>=1.5s", "a@E2<", "a@E2<x", "a@E2>=1<", "a@E2<3>=1"}) {
        CHECK_THROWS_WITH(effects_named({doubled("a")}, {bad}), ContainsSubstring("is no time"));
    }
    // One that ends again, or ends only.
    auto const episode = only_within(doubled("a"), {"E1", "E2", "E3"}, {1.5, effect::from_start, 2},
                                     {4, 0.25, effect::for_ever});
    CHECK(episode.name == "a@E1>=1.5<4+E2<0.25+E3>=2");
    CHECK(episode.begins_later());
    CHECK(episode.ends());
    auto const read = effects_named({doubled("a")}, {episode.name}).front();
    CHECK(read.only_in == episode.only_in);
    CHECK(read.since == episode.since);
    CHECK(read.until == episode.until);
    auto const ended = effects_named({doubled("a")}, {"a@E2<3"}).front();
    CHECK_FALSE(ended.begins_later());
    CHECK(ended.ends());
    CHECK_THROWS_WITH(effects_named({doubled("a")}, {"a@E2>=3<3"}),
                      ContainsSubstring("ends in E2 before it begins"));
}

TEST_CASE("mistakes in effects are named") {
    auto const with_input = [](std::string const& name) {
        effect e;
        e.name = "wrong";
        e.on_inputs = [name](effect_scope& m) { m.input(name) *= 2; };
        return e;
    };
    CHECK_THROWS_WITH(with(tank{}, with_input("v")), ContainsSubstring("unknown input 'v'"));
    CHECK_THROWS_WITH(with(tank{}, doubled("a"), doubled("a")),
                      ContainsSubstring("two effects are called 'a'"));
    effect start;
    start.name = "start";
    start.on_inputs = [](effect_scope& m) { (void)m.add_state("d", "m", 1, m.state("x")); };
    CHECK_THROWS_WITH(with(tank{}, start), ContainsSubstring("initial value"));
    effect again;
    again.name = "again";
    again.on_inputs = [](effect_scope& m) { (void)m.add_state("x", "m", 1, 0); };
    CHECK_THROWS_WITH(with(tank{}, again), ContainsSubstring("has a state 'x'"));
}

TEST_CASE("what the model sees stands behind the edits of others, in the order of the model") {
    using namespace sivid::literals;
    auto const m =
        support::model_of({1, 1, 2}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{u[0] + u[1] - p[0] * x[0]};
        });
    auto doubled = effects::input_gain("seen", "u1", {0_dec, 1_dec}); // has that name already
    auto const seen =
        model_detail::seen_effect(m.about, {doubled}, std::numeric_limits<int>::max());
    CHECK(seen.name == "seen'");
    auto const joined = with(m, {doubled, seen});
    REQUIRE(joined.rate.size() == 1 + 2 + 1 + 1); // inputs, the model's constant, the time
    auto const op = [&](std::size_t i) { return joined.g[joined.rate[1 + i]].op; };
    CHECK(op(0) == operation::input);
    CHECK(op(1) == operation::mul); // u1 (1 + k)
    CHECK(op(2) == operation::constant);
    CHECK(op(3) == operation::time);
    CHECK(joined.about.states[1].name == "seen' input u0");
}
