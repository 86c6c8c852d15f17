// SPDX-License-Identifier: MIT
#include "hovercraft/effects.hpp"
#include "hovercraft/model.hpp"
#include "support/catch.hpp"
#include "text/texts.hpp"
#include "text/values.hpp"

#include <sivid/enclosure/enclose.hpp>
#include <sivid/io/dataset.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/text/read_model.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

using namespace sivid;
using texts::is_near;
using texts::values;

namespace {

struct logistic_growth {
    static constexpr auto name = "logistic growth";
    static constexpr auto time_unit = "h";
    static constexpr auto states = sivid::states({{"x", "g/L", 10}});
    static constexpr auto inputs = no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "g/L"}});
    static constexpr auto constants = sivid::constants({{"r", "1/h", 1_dec}, {"K", "g/L", 1_dec}});

    template <class T>
    vec<T, 1> rate(T const&, vec<T, 1> const& x, vec<T, 2> const& c, vec<T, 0> const&) const {
        auto const& [r, K] = c;
        return {r * x[0] * (1 - x[0] / K)};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 1> const& x, vec<T, 2> const&, vec<T, 0> const&) const {
        return x;
    }
};

bool same_bits(literal const& a, literal const& b) {
    return a.nearest == b.nearest && a.enclosure.lower() == b.enclosure.lower() &&
           a.enclosure.upper() == b.enclosure.upper();
}

/// Node by node, with the bits of all literals.
void require_same_graph(recorded_model const& a, recorded_model const& b) {
    REQUIRE(a.g.size() == b.g.size());
    for (node_id k = 0; k < a.g.size(); ++k) {
        auto const &x = a.g[k], &y = b.g[k];
        REQUIRE(x.op == y.op);
        if (x.op == operation::literal) {
            REQUIRE(same_bits(a.g.value(x), b.g.value(y)));
        } else {
            REQUIRE((x.a == y.a && x.b == y.b && x.index == y.index && x.companion == y.companion));
        }
    }
    CHECK(a.rate == b.rate);
    CHECK(a.observe == b.observe);
}

/// All that a recorded model has.
void require_same(recorded_model const& a, recorded_model const& b) {
    require_same_graph(a, b);
    CHECK(a.about.name == b.about.name);
    CHECK(a.about.time_unit == b.about.time_unit);
    REQUIRE(a.about.states.size() == b.about.states.size());
    for (std::size_t i = 0; i < a.about.states.size(); ++i) {
        auto const &x = a.about.states[i], &y = b.about.states[i];
        CHECK((x.name == y.name && x.unit == y.unit && x.equation == y.equation));
        CHECK((x.limit.lower == y.limit.lower && x.limit.upper == y.limit.upper));
    }
    REQUIRE(a.about.constants.size() == b.about.constants.size());
    for (std::size_t i = 0; i < a.about.constants.size(); ++i) {
        auto const &x = a.about.constants[i], &y = b.about.constants[i];
        CHECK((x.name == y.name && x.unit == y.unit && x.formula == y.formula));
        CHECK(same_bits(x.nominal, y.nominal));
    }
    for (auto const* m : {&a, &b}) CHECK(m->about.inputs.size() == a.about.inputs.size());
    for (std::size_t i = 0; i < a.about.inputs.size(); ++i)
        CHECK(a.about.inputs[i].name + a.about.inputs[i].unit ==
              b.about.inputs[i].name + b.about.inputs[i].unit);
    REQUIRE(a.about.channels.size() == b.about.channels.size());
    for (std::size_t i = 0; i < a.about.channels.size(); ++i)
        CHECK(a.about.channels[i].name + a.about.channels[i].unit ==
              b.about.channels[i].name + b.about.channels[i].unit);
    REQUIRE(a.derived.size() == b.derived.size());
    for (std::size_t i = 0; i < a.derived.size(); ++i) {
        CHECK(a.derived[i].constant == b.derived[i].constant);
        CHECK(a.derived[i].value == b.derived[i].value);
    }
}

text_model read_example(std::string const& name) {
    return read_model(SIVID_SOURCE_DIR "/examples/" + name);
}

bool same(interval const& a, interval const& b) {
    return a.lower() == b.lower() && a.upper() == b.upper();
}
bool same(box const& a, box const& b) {
    bool all = a.size() == b.size();
    for (std::size_t i = 0; all && i < a.size(); ++i) all = same(a[i], b[i]);
    return all;
}

} // namespace

TEST_CASE("the hovercraft as text is recorded as its functor is") {
    auto const text = read_example("hovercraft/hovercraft.toml");
    require_same(text.model, record_model(hovercraft{}));
    CHECK(text.about == "A hovercraft with one rotor and a rudder behind it");
    CHECK(text.unknown.empty());
}

TEST_CASE("the effects of the hovercraft as text are those of C++") {
    auto const text = read_example("hovercraft/hovercraft.toml");
    auto const catalogue = hovercraft_example::catalogue();
    auto const plain = record_model(hovercraft{});
    REQUIRE(text.effects.size() == catalogue.size());
    for (std::size_t k = 0; k < catalogue.size(); ++k) {
        auto const &a = text.effects[k], &b = catalogue[k];
        INFO(b.name);
        CHECK(a.name == b.name);
        CHECK(a.about == b.about);
        CHECK(a.order == b.order);
        REQUIRE(a.parameters.size() == b.parameters.size());
        for (std::size_t j = 0; j < a.parameters.size(); ++j) {
            auto const &p = a.parameters[j], &q = b.parameters[j];
            CHECK(p.name == q.name);
            CHECK(p.unit_in(plain.about) == q.unit_in(plain.about));
            CHECK(same(p.prior(), q.prior()));
            CHECK(nearest(p.neutral) == nearest(q.neutral));
        }
        auto const x = with(text.model, {a}), y = with(plain, {b});
        CHECK(x.about.states.size() == y.about.states.size());
        CHECK(x.input_memory.size() == y.input_memory.size());
        CHECK(x.channel_delays.size() == y.channel_delays.size());
        // Nodes may stand in another order; with numbers for all leaves they are these.
        std::vector<double> const state{1.1, -0.3, 0.7, 2, 3, 0.4, 0.05}, input{90, 0.2};
        auto moved = [&](recorded_model m) {
            auto& constants = m.about.constants;
            for (auto k2 = plain.about.constants.size(); k2 < constants.size(); ++k2)
                constants[k2].nominal = {interval(0.125), 0.125};
            return values(m, state, input);
        };
        CHECK(moved(x) == moved(y));
    }
    CHECK(with(text.model, text.effects).about.constants.size() ==
          with(plain, catalogue).about.constants.size());
}

TEST_CASE("an enclosure of the hovercraft as text has the bits of that of the functor") {
    auto const steady = [](double v) {
        return analytic_signal::from([v](auto const&) { return expression(v); });
    };
    std::vector<signal> const inputs{steady(90), steady(0.2)};
    box start(6);
    start[0] = interval(2.0);
    auto const run = [&](recorded_model const& m) {
        return enclose(m, {{"Sv"}, {}}, start, box({hull(0.21_dec, 0.23_dec)}), 0, 0.5,
                       carried_set::doubleton, {}, inputs)
            .at(0.5);
    };
    auto const text = run(read_example("hovercraft/hovercraft.toml").model);
    CHECK(same(text, run(record_model(hovercraft{}))));
}

TEST_CASE("logistic growth as text is identified as its functor is") {
    std::string const file = SIVID_SOURCE_DIR "/examples/first_steps/logistic_growth.toml";
    auto const text = sivid::read_model(file);
    require_same(text.model, record_model(logistic_growth{}));
    CHECK(text.parameters().unknown == std::vector<std::string>{"r", "K"});
    CHECK(same(text.prior, box({hull(0.1_dec, 3_dec), hull(0.5_dec, 2_dec)})));
    CHECK(same(text.start_ranges(), box({interval(-10, 10)})));

    experiment culture;
    culture.name = "culture";
    culture.initial = {hull(0.10_dec, 0.12_dec)};
    culture.measurements = {{1, 0, hull(0.24_dec, 0.29_dec)},
                            {2, 0, hull(0.47_dec, 0.55_dec)},
                            {4, 0, hull(0.89_dec, 0.96_dec)}};
    identify_options options;
    options.search.seconds = 1e6;
    options.search.boxes = 500;
    auto const a = identify({text.model, text.parameters(), text.prior, {culture}}, options);
    auto const b = identify(
        {record_model(logistic_growth{}), {{"r", "K"}, {}}, text.prior, {culture}}, options);
    CHECK(a.verdict == verdict::consistent);
    CHECK(a.verdict == b.verdict);
    CHECK(same(a.hull, b.hull));
}

TEST_CASE("the hovercraft as text is identified as its functor is") {
    auto const identified = [](recorded_model const& m) {
        auto const data =
            read_dataset(SIVID_SOURCE_DIR "/examples/hovercraft/data/h3", names_of(m.about));
        identify_options options;
        options.search.seconds = 1e6;
        options.search.boxes = 20;
        return identify(problem_from_dataset(data, m), options);
    };
    auto const a = identified(read_example("hovercraft/hovercraft.toml").model);
    auto const b = identified(record_model(hovercraft{}));
    CHECK(a.verdict == b.verdict);
    CHECK(same(a.hull, b.hull));
}

TEST_CASE("a model is read and identified in two lines") {
    std::string const file = SIVID_SOURCE_DIR "/examples/first_steps/logistic_growth.toml";
    experiment culture;
    culture.initial = {hull(0.10_dec, 0.12_dec)};
    culture.measurements = {{1, 0, hull(0.24_dec, 0.29_dec)}, {4, 0, hull(0.89_dec, 0.96_dec)}};
    auto const text = sivid::read_model(file);
    auto const found = sivid::identify({text.model, text.parameters(), text.prior, {culture}});
    CHECK(found.verdict == verdict::consistent);
}

TEST_CASE("a text with all that the format has is read") {
    auto const text = read_model(SIVID_SOURCE_DIR "/tests/text/everything.toml");
    CHECK(text.model.about.states.size() == 6);
    CHECK(text.effects.size() == 9);
    CHECK(text.model.channel_delays.size() == 1);
    CHECK(text.unknown == std::vector<std::string>{"J", "b"});
    auto const all = with(text.model, text.effects);
    CHECK(all.about.states.size() == 9); // the lags'
    CHECK(all.about.constants.size() == text.model.about.constants.size() + 10);
}

TEST_CASE("disturbances that a text allows for are in the model's units, never smaller") {
    auto const text = [](std::string const& size) {
        return model_from_text(
            "format = \"sivid-model-1\"\nname = \"m\"\ntime = \"ms\"\n[states]\na = \"10 rad\"\n"
            "[equations]\na = \"1 [rad/s]\"\n[outputs]\ny = { equation = \"a\", unit = \"mrad\" }\n"
            "[disturbance]\na = \"" +
                size + "\"\n[error]\ny = \"0.1 rad\"\n",
            "m.toml");
    };
    auto const exact = text("3 rad/s").disturbances;
    REQUIRE(exact.equations.size() == 1);
    CHECK(exact.equations[0].first == "a");
    CHECK(exact.equations[0].second.text() == "0.003");
    REQUIRE(exact.channels.size() == 1);
    CHECK(exact.channels[0].second.text() == "100");
    // 180 deg/s are pi/1000 rad/ms.
    auto const most = text("180 deg/s").disturbances.equations[0].second;
    CHECK(*exact_decimal::parse("3.14159265358979323846264338327e-3") < most);
    CHECK(most < *exact_decimal::parse("3.1415926535897932384626433834e-3"));
    CHECK(model_from_text(texts::motor, "motor.toml").disturbances.empty());

    auto const cart = read_model(SIVID_SOURCE_DIR "/tests/text/cart.toml").disturbances;
    CHECK(cart.equations.size() == 1);
    CHECK(cart.channels.size() == 1);
}

TEST_CASE("units of a text are converted exactly") {
    auto const text = model_from_text(texts::motor, "motor.toml");
    auto const& constants = text.model.about.constants;
    CHECK(same_bits(constants[6].nominal, {enclose(0.01_dec), nearest(0.01_dec)})); // 10 ms in s
    CHECK(same(text.prior[2], hull(0_dec, 0.02_dec)));
    CHECK(text.unknown == std::vector<std::string>{"J", "b", "late"});
    REQUIRE(text.model.input_memory.size() == 1);
    CHECK(text.model.input_memory[0].constant == 6);

    double const w = 100, theta = 2, i = 3, u = 12;
    auto const found = values(text.model, {w, theta, i}, {u});
    std::vector<double> const wanted{
        (0.05 * i - 1e-4 * w - 0.02) / 1.25e-3, w,
        (u - 0.5 * i - 0.05 * w) / 1e-3,        w * 30 / std::numbers::pi,
        theta * 180 / std::numbers::pi,         i};
    REQUIRE(found.size() == wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k) CHECK(is_near(found[k], wanted[k]));
}

TEST_CASE("factors between units enclose what no decimal is") {
    auto const text = model_from_text(
        "format = \"sivid-model-1\"\nname = \"m\"\n[states]\na = \"360 deg\"\n[constants]\n"
        "k = \"30 deg\"\nq = { value = \"30 deg\", unit = \"rad\" }\n[equations]\n"
        "a = \"(sin(k) + sin(q))*1 [deg/s]\"\n[outputs]\na = \"a\"\n",
        "m.toml");
    auto const sixth = text.model.about.constants[1].nominal.enclosure;
    CHECK((sixth.lower() < 0x1.0c152382d7366p-1 && 0x1.0c152382d7365p-1 < sixth.upper()));
    CHECK(sixth.upper() - sixth.lower() < 4e-16);
    CHECK(std::abs(values(text.model, {1}, {})[0] - 1) < 1e-15);
}

TEST_CASE("formulas of a text mean what they mean in C++") {
    auto const value = [](std::string const& formula) {
        auto const text = model_from_text(
            "format = \"sivid-model-1\"\nname = \"m\"\n[states]\nx = 10\ny = 10\n[equations]\n"
            "x = \"(" +
                formula + ") * 1 [1/s]\"\ny = \"y * 1 [Hz]\"\n[outputs]\nx = \"x\"\n",
            "m.toml");
        return values(text.model, {0.5, -2}, {})[0];
    };
    CHECK(value("-x^2 + 2*y") == -4.25);
    CHECK(value("2/4/x") == 1);
    CHECK(std::abs(value("sin(0.25 [rev]) + cos(180 [deg]) + sin(30 [deg])") - 0.5) < 1e-15);
    CHECK(std::abs(value("atan(1)/(45 [deg])") - 1) < 1e-15);
    CHECK(value("1 - 2 - 3") == -4);
    CHECK(value("y^-1") == -0.5);
    CHECK(value("max(x, y, 0.25) + min(x, y)") == -1.5);
    CHECK(value("clamp(y, -1, 1)") == -1);
    CHECK(value("deadband(y, 0.5)") == -1.5);
    CHECK(value("if(x > 0, 3, 4)") == 3);
    CHECK(value("if(x < 0, 3, 4)") == 4);
    CHECK(value("if(y <= -1, 3, x)") == 3);
    CHECK(value("sign(y)*abs(y)") == -2);
    CHECK(value("sqr(y) + sqrt(4)") == 6);
    CHECK(std::abs(value("tanh(x) + atan(x) + tan(x) + log(x) + exp(y)") -
                   (std::tanh(0.5) + std::atan(0.5) + std::tan(0.5) + std::log(0.5) +
                    std::exp(-2))) < 1e-15);
    CHECK(std::abs(value("cos(pi)") + 1) < 1e-15);
}

TEST_CASE("effects of a text change rates, inputs and outputs") {
    auto const text = model_from_text(texts::motor, "motor.toml");
    REQUIRE(text.effects.size() == 4);
    auto joined = with(text.model, text.effects);
    auto const set = [&](std::string const& name, double v) {
        joined.about.constants[index_of(joined.about.constants, name, "constant")].nominal = {
            interval(v), v};
    };
    std::vector<double> const x{100, 2, 3}, u{12};
    auto const before = values(joined, x, u);
    CHECK(before == values(text.model, x, u));
    set("torque.T0", 0.01);
    set("gain.k", 0.1);
    set("crossed.k", 0.2);
    set("bias.b", 0.5);
    auto const after = values(joined, x, u);
    CHECK(is_near(after[0] - before[0], 0.01 / 1.25e-3));
    CHECK(is_near(after[2] - before[2], 1.2 / 1e-3));
    CHECK(is_near(after[3], 1.2 * before[3]));
    CHECK(is_near(after[5], before[5] + 0.5));
}

TEST_CASE("ready-made effects of all kinds are read") {
    struct kind {
        std::string name, of, prior, more, unit;
    };
    auto text = texts::motor;
    std::vector<kind> const kinds{
        {"input_delay", "\"u\"", "[0, 1] s", "", "s"},
        {"input_clock_drift", "\"u\"", "[0, 0.1]", "", "1"},
        {"input_dead_band", "\"u\"", "[0, 1] V", "", "V"},
        {"input_backlash", "\"u\"", "[0, 1] V", "", "V"},
        {"input_rate_limit", "\"u\"", "[1, 100] V/s", "", "V/s"},
        {"input_lag", "\"u\"", "[0, 1] s", "limit = \"24 V\"", "s"},
        {"input_saturation", "\"u\"", "[1, 24] V", "", "V"},
        {"input_trim", "\"u\"", "[-1, 1] V", "", "V"},
        {"input_gain", "\"u\"", "[-0.1, 0.1]", "", "1"},
        {"constant_rate", "\"w\"", "[-9, 9] rad/s^2", "", "rad/s^2"},
        {"linear_damping", "\"w\"", "[0, 1] 1/s", "", "1/s"},
        {"quadratic_damping", "\"w\"", "[0, 1] 1/rad", "", "1/rad"},
        {"dry_friction", "\"w\"", "[0, 9] rad/s^2", "smooth_below = \"1 rad/s\"", "rad/s^2"},
        {"drift", "\"R\"", "[0, 0.1] 1/s", "", "1/s"},
        {"sensor_bias", "\"i\"", "[-1, 1] A", "", "A"},
        {"sensor_drift", "\"i\"", "[-1, 1] A/s", "", "A/s"},
        {"sensor_saturation", "\"i\"", "[1, 20] A", "", "A"},
        {"sensor_rotation", "[\"speed\", \"angle\"]", "[-1, 1] rad", "", "rad"},
        {"sensor_swap", "[\"speed\", \"angle\"]", "[-1, 1]", "", "1"},
        {"sensor_scale", "[\"i\"]", "[-1, 1]", "", "1"},
        {"sensor_latency", "\"i\"", "[0, 1] s", "", "s"},
        {"sensor_clock_drift", "\"i\"", "[0, 0.1]", "", "1"},
        {"sensor_lag", "\"i\"", "[0.01, 1] s", "", "s"}};
    for (auto const& k : kinds)
        text += "[effect." + k.name + "]\nkind = \"" + k.name + "\"\nof = " + k.of +
                "\nprior = \"" + k.prior + "\"\n" + k.more + "\n";
    auto const read = model_from_text(text, "motor.toml");
    REQUIRE(read.effects.size() == 4 + kinds.size());
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        INFO(kinds[k].name);
        auto const& e = read.effects[4 + k];
        CHECK(e.name == kinds[k].name);
        CHECK(e.parameters.front().unit_in(read.model.about) == kinds[k].unit);
    }
}
