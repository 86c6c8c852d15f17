// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/stated_equation.hpp>

#include <sivid/model/change/detail/smoothed.hpp>
#include <sivid/model/change/detail/substitution.hpp>
#include <sivid/model/effects.hpp>
#include <sivid/model/implicit_model.hpp>

#include "paving/relation/two_links.hpp"
#include "support/catch.hpp"

#include <vector>

using namespace diagnosis_support;
using namespace relation_support;

namespace {

bound_model bound_of(recorded_model const& m) {
    std::vector<std::string> names;
    for (auto const& c : m.about.constants) names.push_back(c.name);
    return bind(m, {names, {}},
                std::vector<signal>(m.about.inputs.size(),
                                    sampled_signal({0.0}, {0.0}, interpolation::linear)));
}

/// What equation i leaves at a state, for the rates that the model has there.
interval left_at(bound_model& b, std::size_t i, std::vector<double> const& x,
                 std::vector<double> const& c, std::vector<double> u) {
    auto const equation = stated_equation(b, i);
    auto const box_of = [](std::vector<double> const& v) {
        std::vector<interval> sides;
        for (double const s : v) sides.emplace_back(s);
        return box(std::move(sides));
    };
    graph_range rates(b.g, b.rate);
    rates.evaluate({interval(0.5), box_of(x), box_of(c), box_of(u)});
    auto inputs = box_of(u);
    std::vector<interval> with(inputs.begin(), inputs.end());
    for (auto const r : b.rate) with.push_back(rates.value(r));
    graph_range left(b.g, {equation});
    left.evaluate({interval(0.5), box_of(x), box_of(c), box(std::move(with))});
    return left.value(equation);
}

/// Whether every stated equation is zero for the rates of the model, to rounding.
void check_equations(recorded_model const& m, draws& d) {
    auto b = bound_of(m);
    for (std::size_t i = 0; i < b.state_count(); ++i) {
        for (int n = 0; n < 5; ++n) {
            std::vector<double> x, c, u;
            for (std::size_t k = 0; k < b.state_count(); ++k) x.push_back(d.uniform(-1, 1));
            for (auto const k : b.parameters)
                c.push_back(b.about.constants[k].nominal.nearest * d.uniform(0.97, 1.03));
            for (std::size_t k = 0; k < m.about.inputs.size(); ++k) u.push_back(d.uniform(-1, 1));
            auto const left = left_at(b, i, x, c, u);
            CHECK(contains(left, 0));
            CHECK(width(left) < 1e-9);
        }
    }
}

/// A weight on a rod, held by the rod's pull: a constraint of index 1.
struct held_weight {
    static constexpr auto name = "weight on a rod";
    static constexpr auto states = sivid::states({{"x", "m", 2}, {"v", "m/s", 5}});
    static constexpr auto inputs = sivid::inputs({{"F", "N"}});
    static constexpr auto channels = sivid::channels({{"x", "m"}});
    static constexpr auto constants = sivid::constants({{"m", "kg", 2_dec}});
    static constexpr auto algebraic = sivid::algebraic({{"pull", "N"}});
    template <class T>
    matrix_of<held_weight, T> mass(T const&, vec<T, 2> const&, vec<T, 1> const& c,
                                   vec<T, 1> const&) const {
        return {{{1, 0, 0}, {0, c[0], 1}, {0, 0, 1}}};
    }
    template <class T>
    vec<T, 3> force(T const&, vec<T, 2> const& x, vec<T, 1> const&, vec<T, 1> const& u) const {
        return {x[1], u[0], 3 * x[0]};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 2> const& x, vec<T, 1> const&, vec<T, 1> const&) const {
        return {x[0]};
    }
};

} // namespace

TEST_CASE("a stated equation is zero along every motion, whatever was made of the model") {
    draws d(41);
    auto const m = record_model(two_links());
    check_equations(m, d);
    // Linear in constants that the rates have behind a determinant.
    auto b = bound_of(m);
    CHECK(
        make_relation_row(b.g, stated_equation(b, 2), 2, prior_of_links(0.3)).inseparable.empty());
    // An effect on inputs changes what stands in them; one on a rate leaves the rates alone.
    using namespace sivid::literals;
    auto const scaled = with(m, {effects::input_gain("gain", "T1", {0.5_dec, 2_dec})});
    CHECK(scaled.stated.has_value());
    check_equations(scaled, d);
    auto const pushed = with(m, {effects::constant_rate("push", "w1", "rad/s^2", {0_dec, 1_dec})});
    CHECK_FALSE(pushed.stated.has_value());
    check_equations(pushed, d);
    check_equations(record_model(held_weight()), d); // forces of constraints are left out
    auto const rounded = smoothed(m, 0.01).model;    // a graph of its own
    CHECK_FALSE(rounded.stated.has_value());
    // Other constants: a1 = s + d, a3 = s - d.
    recorded_map const halves(2, [](auto const& q) {
        return std::vector{q[0] + q[1], q[0] - q[1]};
    });
    auto const other = substituted(m, {"a1", "a3"},
                                   {{"s", "kg m^2", literal{interval(0.375), 0.375}},
                                    {"e", "kg m^2", literal{interval(0.225), 0.225}}},
                                   halves);
    CHECK(other.stated.has_value());
    check_equations(other, d);
}

TEST_CASE("rates along a motion hold where they are defined") {
    auto const m = record_model(two_links());
    draws d(42);
    std::vector<double> const truth{0.6, 0.12, 0.15, 0.3, 0.2};
    auto const e = record_of_links(d, m, truth, 1, 0.002, noise::uniform);
    auto const b = bound_of(m);
    auto const of = [&](double share) {
        auto const motion =
            proved_motion(b, prior_of_links(share), e, measured_states(b, {&e}), 4, {});
        return rates_along(b, motion);
    };
    for (auto const& rates : of(0.02)) CHECK(is_bounded(rates[2]));
    bool open = false; // where the mass matrix may be singular
    for (auto const& rates : of(0.4)) open = open || !is_bounded(rates[2]);
    CHECK(open);
}
