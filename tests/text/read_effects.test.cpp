// SPDX-License-Identifier: MIT
// Effects in text on a model in C++.
#include <sivid/model/affected_problem.hpp>
#include <sivid/model/effects.hpp>
#include <sivid/text/read_model.hpp>

#include "support/catch.hpp"
#include "text/values.hpp"

#include <cmath>
#include <string>

using namespace sivid;

namespace {

struct drive {
    static constexpr auto name = "drive";
    static constexpr auto states = sivid::states({{"q", "rad", 4}, {"w", "rad/s", 15}});
    static constexpr auto inputs = sivid::inputs({{"u", "V"}});
    static constexpr auto channels = sivid::channels({{"angle", "rad"}});
    static constexpr auto constants =
        sivid::constants({{"J", "kg m^2", 0.01_dec}, {"k", "N m/V", 0.3_dec}});

    template <class T>
    vec<T, 2> rate(T const&, vec<T, 2> const& x, vec<T, 2> const& c, vec<T, 1> const& u) const {
        return {x[1], c[1] * u[0] / c[0]};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 2> const& x, vec<T, 2> const&, vec<T, 1> const&) const {
        return {x[0]};
    }
};

std::string const actuator = R"toml(format = "sivid-effects-1"
[let]
motor = "k*u"
way = "sign(w)"
[effect.coulomb]
constants.c = "[0, 2] rad/s^2"
equations = "w' -= c*way"
[effect.stribeck]
constants = { c = "[0, 0.06] N m", slow = { prior = "[0.1, 3] rad/s", neutral = "1 rad/s" } }
equations = "w' -= c*exp(-w^2/slow^2)*way/J"
[effect.load_friction]
constants.c = [0, 0.4]
equations = "w' -= c*abs(motor)*way/J"
[effect.encoder]
kind = "sensor_bias"
of = "angle"
prior = "[-0.02, 0.02] rad"
)toml";

void refuses(std::string const& part, std::string const& by, std::string const& what) {
    auto text = actuator;
    auto const at = text.find(part);
    REQUIRE(at != std::string::npos);
    text.replace(at, part.size(), by);
    INFO(by);
    try {
        (void)effects_from_text(text, "effects.toml", record_model<drive>());
        FAIL("it was read");
    } catch (model_text_error const& error) {
        CHECK_THAT(std::string(error.what()), ContainsSubstring(what));
    }
}

} // namespace

TEST_CASE("effects in text act on a model in C++ as its own would") {
    auto const model = record_model<drive>();
    auto const found = effects_from_text(actuator, "effects.toml", model);
    REQUIRE(found.size() == 4);
    CHECK(texts::same_equations(
        with(model, {found[0]}),
        with(model, {effects::dry_friction("coulomb", "w", "rad/s^2", {0_dec, 2_dec}, 0_dec)})));
    auto joined = with(model, {found[1], found[2]});
    auto const set = [&](char const* name, double value) {
        joined.about.constants[index_of(joined.about.constants, name, "constant")].nominal = {
            interval(value), value};
    };
    set("stribeck.c", 0.05);
    set("stribeck.slow", 2);
    set("load_friction.c", 0.25);
    auto const at = texts::values(joined, {1, 2}, {0.5});
    CHECK(at[0] == 2);
    CHECK(texts::is_near(at[1], (0.15 - 0.05 * std::exp(-1) - 0.25 * 0.15) / 0.01));
    CHECK(nearest(found[3].parameters[0].upper) == 0.02);
}

TEST_CASE("a file of effects that does not fit the model is refused") {
    refuses("sivid-effects-1", "sivid-model-1", "no file in the format sivid-effects-1");
    refuses("motor = ", "motar = ", "unknown name 'motor'");
    refuses("\"w' -= c*way\"", "\"v' -= c*way\"", "'v' is no state");
    refuses("abs(motor)*way/J", "abs(motor)*way", "w'");
    refuses("[let]", "[states]\nz = 1\n[let]", "unknown key");
    refuses("of = \"angle\"", "of = \"q\"", "is no output");
    refuses("motor = \"k*u\"", "motor = \"k*u\"\nidle = \"k\"", "'idle' stands in no formula");
    CHECK_THROWS_AS(effects_from_text("format = \"sivid-effects-1\"", "e", record_model<drive>()),
                    model_text_error);
    auto odd = record_model<drive>();
    odd.about.states[0].unit = "furlongs per 3";
    CHECK_THROWS_AS(effects_from_text(actuator, "e", odd), model_text_error);
}
