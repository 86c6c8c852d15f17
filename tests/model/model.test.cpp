// SPDX-License-Identifier: MIT
#include <sivid/model/model.hpp>

#include "support/catch.hpp"
#include "support/formulas.hpp"

using namespace sivid;

namespace {

/// x' = -k (x - u), y = 2 x
struct lag {
    static constexpr auto name = "lag";
    static constexpr auto states = sivid::states({{"x", "m", 5}});
    static constexpr auto inputs = sivid::inputs({{"u", "m"}});
    static constexpr auto channels = sivid::channels({{"y", "m"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"k", "1/s", 0.1_dec}});
    }();
    template <class T>
    states_of<lag, T> rate(T const&, states_of<lag, T> const& x, constants_of<lag, T> const& c,
                           inputs_of<lag, T> const& u) const {
        return {-c[0] * (x[0] - u[0])};
    }
    template <class T>
    channels_of<lag, T> observe(T const& t, states_of<lag, T> const& x, constants_of<lag, T> const&,
                                inputs_of<lag, T> const&) const {
        return {2 * x[0] + 0 * t};
    }
};
/// Its rate has the wrong number of components.
struct misshapen : lag {
    template <class T>
    sivid::vec<T, 2> rate(T const&, states_of<lag, T> const& x, constants_of<lag, T> const&,
                          inputs_of<lag, T> const&) const {
        return {x[0], x[0]};
    }
};

/// Two of its constants have one name.
struct named_twice : lag {
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"k", "1/s", 0.1_dec}, {"k", "1/s", 0.1_dec}});
    }();
    template <class T>
    vec<T, 1> rate(T const&, vec<T, 1> const& x, vec<T, 2> const& c, vec<T, 1> const& u) const {
        return {-c[0] * (x[0] - c[1] * u[0])};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 1> const& x, vec<T, 2> const&, vec<T, 1> const&) const {
        return x;
    }
};

} // namespace

TEST_CASE("names are unique within a kind") {
    CHECK_THROWS_WITH(record_model(named_twice{}),
                      ContainsSubstring("two constants are called 'k'"));
    auto about = record_model(lag{}).about;
    CHECK_NOTHROW(model_detail::require_own_names(about)); // a state and a channel may share one
    auto const refused = [](model_description wrong, std::string const& kind) {
        CHECK_THROWS_WITH(model_detail::require_own_names(wrong),
                          ContainsSubstring("two " + kind + " are called"));
    };
    auto wrong = about;
    wrong.states.push_back({"x", "m", 1});
    refused(wrong, "states");
    wrong = about;
    wrong.inputs.push_back({"u", "m"});
    refused(wrong, "inputs");
    wrong = about;
    wrong.channels.push_back({"y", "m"});
    refused(wrong, "channels");
}

TEST_CASE("a functor is recorded with its names, units and graph") {
    STATIC_REQUIRE(dynamic_model<lag>);
    STATIC_REQUIRE_FALSE(dynamic_model<misshapen>);
    STATIC_REQUIRE(state_count<lag> == 1);
    STATIC_REQUIRE(input_count<lag> == 1);
    STATIC_REQUIRE(channel_count<lag> == 1);
    STATIC_REQUIRE(constant_count<lag> == 1);
    auto const m = record_model(lag{});
    CHECK(m.about.name == "lag");
    CHECK(m.about.states[0].name == "x");
    CHECK(m.about.states[0].limit == 5);
    CHECK(m.about.inputs[0].unit == "m");
    CHECK(m.about.channels[0].name == "y");
    CHECK(m.about.constants[0].unit == "1/s");
    CHECK(support::encloses(m.about.constants[0].nominal.enclosure, support::mp("0.1")));
    CHECK(m.about.constants[0].nominal.nearest == 0.1);
    REQUIRE((m.rate.size() == 1 && m.observe.size() == 1));
    support::place_box where;
    where.x[0] = interval(3.0);
    where.p[0] = interval(2.0);
    // The input leaf reads the same slot as the state in this helper: u = x = 3.
    CHECK(contains(support::evaluate(m.g, {m.rate[0]}, where).outputs[0], 0.0));
    CHECK(support::evaluate(m.g, {m.observe[0]}, where).outputs[0].lower() == 6);
}

TEST_CASE("a vec is an aggregate that structured bindings take apart") {
    vec<double, 3> const x{1, 2, 4};
    auto const& [a, b, c] = x;
    CHECK(a + 10 * b + 100 * c == 421);
    STATIC_REQUIRE(std::is_aggregate_v<vec<double, 3>>);
}
