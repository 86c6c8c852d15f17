// SPDX-License-Identifier: MIT
#include <sivid/text/model_text_error.hpp>

#include "io/support.hpp"
#include "support/catch.hpp"
#include "text/texts.hpp"

#include <sivid/text/read_model.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>

using namespace sivid;

namespace {

std::optional<model_text_error> error_of(std::string const& text,
                                         std::string const& name = "m.toml") {
    try {
        (void)model_from_text(text, name);
    } catch (model_text_error const& error) {
        return error;
    }
    return std::nullopt;
}

/// With a part of the motor's text replaced the error stands at that line and column and says so.
void says(std::string const& part, std::string const& by, std::size_t line, std::size_t column,
          std::string const& what) {
    auto const error = error_of(texts::with(texts::motor, part, by));
    INFO(by);
    REQUIRE(error);
    INFO(error->what());
    CHECK(error->place().line == line);
    CHECK(error->place().column == column);
    CHECK_THAT(std::string(error->what()), ContainsSubstring(what));
}

} // namespace

TEST_CASE("an error points at the character") {
    auto const error = error_of(texts::with(texts::motor, "kt*i - b", "kf*i - b"), "motor.toml");
    REQUIRE(error);
    CHECK(std::string(error->what()) + "\n" == texts::of_file("tests/text/error.txt"));
    CHECK(error->problem() == "unknown name 'kf'");
}

TEST_CASE("names that are wrong are told") {
    says("load = c*sign(w)", "load = more\nmore = less\nless = load", 7, 8,
         "'load' is defined by itself: load -> more -> less -> load");
    says("theta = \"[", "sin = 3\ntheta = \"[", 12, 1, "'sin' has a meaning of its own");
    says("kt = \"", "w = 3\nkt = \"", 18, 1, "two things are called 'w'");
    says("theta' = w", "theta' = w\nw' = 0", 8, 1, "a second equation for w'");
    says("theta' = w\n", "", 11, 1, "the state 'theta' has no equation");
    says("theta' = w", "thta' = w", 7, 1, "'thta' is no state; did you mean 'theta'?");
    says("load = c*sign(w)", "load = c*sign(w)\nmore = less\nless = more", 7, 8,
         "defined by itself");
    says("R = \"0.5", "R = 3\nR = \"0.5", 22, 5, "cannot redefine");
    says("R = \"0.5", "Q = 3\nR = \"0.5", 21, 1, "'Q' stands in no formula");
    says("kt = \"", "t = 3\nkt = \"", 18, 1, "'t' has a meaning of its own");
    says("kt = \"", "i = 3\nkt = \"", 18, 1, "two things are called 'i'");
    says("prior = \"[0.5", "priar = \"[0.5", 17, 7, "unknown key 'priar'");
    says("name = ", "nme = ", 3, 1, "unknown key 'nme'; did you mean 'name'?");
    says("sivid-model-1", "sivid-model-2", 2, 10, "no file in the format");
    says("sign(w)", "sgn(w)", 5, 10, "unknown function 'sgn'; did you mean 'sign'?");
    says("delay = \"late\"", "delay = \"J\"", 15, 27, "the delay 'J' is in g m^2");
}

TEST_CASE("units that do not fit are told") {
    says("- kt*w", "- kt*i", 8, 15, "the unit on the left is V, that on the right N m");
    says("theta' = w", "theta' = i", 7, 10, "this has the unit A, and theta' has rad/s");
    says("sign(w)", "sin(c)", 5, 14, "and what stands in sin has rad");
    says("c*sign(w)", "c + 1", 5, 10, "that on the right 1 (no unit)");
    says("\"deg\"", "\"m\"", 26, 23, "the unit rad, and the output 'angle' has m");
    says("unit = \"s\"", "unit = \"m\"", 23, 19, "the constant 'late' has the unit m");
    says("20 mN m", "20 mN m^(1/7)", 20, 9, "this is no unit");
    says("T0/J", "T0*J", 31, 20, "and w' has rad/s^2");
    says("[-1, 1] A", "[-1, 1] V", 42, 10, "the prior is in V, not in A");
    says("c*sign(w)", "c*9.81 m/s", 5, 16, "units of numbers in brackets");
    says("c*sign(w)", "c*3 [m^1000]", 5, 13, "a power is beyond 99");
    says("\"20 A\"", "\"20 A^1000\"", 13, 9, "a power is beyond 99");
    says("c*sign(w)", "c*9.81 [m", 5, 15, "the bracket of the unit does not close");
}

TEST_CASE("formulas that are wrong are told") {
    says("c*sign(w)", "c*sign(w", 6, 1, "')' is missing");
    says("c*sign(w)", "2c", 5, 8, "this is no number");
    says("c*sign(w)", "c*1e400", 5, 10, "no finite number");
    says("c*sign(w)", "c*w^1.5", 5, 11, "a whole number from -32 to 32");
    says("c*sign(w)", "c*if(w, 1, 2)", 5, 14, "a comparison is needed");
    says("c*sign(w)", "c/0", 5, 10, "a division by 0");
    says("c*sign(w)", "c*log(-abs(w)*1 [s])", 5, 10, "log of what is not above 0");
    says("c*sign(w)", "c*sqrt(-2 - cos(t*1 [1/s])^2)", 5, 10, "sqrt of what is below 0");
    says("c*sign(w)", "c*sqrt(-2)", 5, 10, "no finite number");
    says("c*sign(w)", "c*w'", 6, 18, "the unit on the left is N m");
    says("u *= 1 + k", "u *= 1 + k*w'/(1 [rad/s^2])", 35, 22, "the rate w' has no place here");
    says("w' = (kt", "w' += (kt", 6, 1, "have = alone");
    says("c*sign(w)", std::string(70, '('), 5, 68, "nested too deep");
    says("c*sign(w)", std::string(5000, '(') + "w\n" + std::string(5000, ')'), 5, 68,
         "nested too deep");
    says("c*sign(w)", "c*" + std::string(9000, '1'), 5, 10, "no finite number");
    says("\"w\"", "\"w\\n\"", 25, 22, "a backslash has no place");
}

TEST_CASE("numbers and effects that are wrong are told") {
    says("[0.5, 2] g", "[2, 0.5] g", 17, 16, "the lower bound is above");
    says("\"[-1000, 1000] rad\"", "\"[1000, -1000] rad\"", 12, 10, "the lower bound is above");
    says("\"20 A\"", "\"0 A\"", 13, 6, "the range of the state 'i' is 0 alone");
    says("\"20 A\"", "inf", 13, 5, "a decimal number is needed");
    says("\"20 A\"", "[-inf, nan]", 13, 6, "a decimal number is needed");
    says("\"20 A\"", "20 A", 13, 8, "saw 'A'");
    says("\"20 A\"", "\"A\"", 13, 6, "a number is needed here");
    says("value = \"10", "value = \"30", 23, 19, "the value is outside the prior");
    says("T0/J", "T1/J", 31, 20, "unknown name 'T1'; did you mean 'T0'?");
    says("w' += T0", "w += T0", 31, 14, "the equations of an effect change rates");
    says("= \"[-0.1, 0.1] N m\"", "= \"[0.1, 0.2] N m\"", 30, 16, "does not contain the neutral");
    says("u *= 1 + k", "v *= 1 + k", 35, 11, "'v' is no input and no constant");
    says("u *= 1 + k", "torque.T0 *= 1 + k", 35, 11, "'torque.T0' is no input");
    says("effect.gain", "effect.u", 32, 9, "an input is called so, too");
    says("T0/J", "T0/J + 1 [rad/s^2]", 28, 9, "changes w' where its constants are neutral");
    says("T0/J", "T0/J*log(-1 - T0^2/c^2)", 28, 9, "log of what is not above 0 over the whole");
    says("T0/J", "T0/(J - J)", 28, 9, "a division by 0");
    says("kind = \"sensor_bias\"", "kind = \"sensor_latency\"", 42, 10, "is in A, not in s");
    says("prior = \"[-1, 1] A\"", "prior = \"[-1, 1] s\"\nkind = \"sensor_latency\"", 43, 8,
         "cannot redefine");
    says("\"sensor_bias\"", "\"sensor_bais\"", 40, 8, "did you mean 'sensor_bias'?");
    says("of = \"i\"", "of = \"j\"", 41, 6, "'j' is no output");
    says("shown(speed)", "shown(sped)", 38, 29, "did you mean 'speed'?");
}

TEST_CASE("disturbances that are wrong are told") {
    auto const plain = texts::with(texts::motor, ", delay = \"late\"", "");
    auto const motor =
        plain.substr(0, plain.find("late =")) + plain.substr(plain.find("[outputs]"));
    auto const told = [&](std::string const& table, std::string const& line, std::size_t column,
                          std::string const& what) {
        auto const text = motor + "[" + table + "]\n" + line + "\n";
        auto const last = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
        auto const error = error_of(text, "motor.toml");
        CAPTURE(table, line);
        REQUIRE(error);
        CAPTURE(error->what());
        CHECK(error->place().line == last);
        CHECK(error->place().column == column);
        CHECK_THAT(std::string(error->what()), ContainsSubstring(what));
    };
    CHECK_FALSE(error_of(motor + "[disturbance]\nw = \"2 rad/s^2\"\n[error]\ni = \"1 mA\"\n", "m"));
    told("disturbance", "thta = \"1 rad/s\"", 1, "'thta' is no state; did you mean 'theta'?");
    told("disturbance", "angle = \"1 rad/s\"", 1, "'angle' is no state");
    told("error", "sped = \"1 rpm\"", 1, "'sped' is no output; did you mean 'speed'?");
    told("disturbance", "w = \"2 rad/s\"", 6, "the bound of 'w' has the unit rad/s^2");
    told("disturbance", "w = 2", 5, "the bound of 'w' has the unit rad/s^2");
    told("error", "i = \"1 V\"", 6, "the bound of 'i' has the unit A");
    told("error", "i = \"-1 A\"", 6, "a number above 0 is needed here");
    told("error", "i = \"0 A\"", 6, "write the largest size, as in \"0.2 A\"");
    told("error", "i = \"[1, 2] A\"", 6, "a number above 0 is needed here");
    told("error", "i = nan", 5, "a decimal number is needed");
    told("error", "i = inf", 5, "a decimal number is needed");
    told("error", "i = \"nan A\"", 6, "a number is needed here");
    told("error", "i = \"1e400 A\"", 6, "beyond all doubles");
    told("error", "i = \"1e308 GA\"", 6, "beyond all doubles");
    told("error", "i = \"1 A\"\ni = \"2 A\"", 5, "redefine");
    auto const late = error_of(texts::motor + "[disturbance]\nw = \"2 rad/s^2\"\n", "motor.toml");
    REQUIRE(late);
    CHECK_THAT(std::string(late->what()), ContainsSubstring("the model has delays"));
    auto const unseen =
        texts::with(motor, "angle = { equation = \"theta\", unit = \"deg\" }\n", "");
    auto const hidden = error_of(unseen + "[disturbance]\ntheta = \"1 rad/s\"\n", "motor.toml");
    REQUIRE(hidden);
    CHECK_THAT(std::string(hidden->what()), ContainsSubstring("no channel depends on 'theta'"));
}

TEST_CASE("files that are no text are refused") {
    auto const refuses = [](std::string const& text, std::string const& what) {
        auto const error = error_of(text);
        REQUIRE(error);
        CHECK_THAT(std::string(error->what()), ContainsSubstring(what));
    };
    std::string wide = "\xFF\xFE";
    for (char const c : texts::motor) wide += std::string{c, '\0'};
    refuses(wide, "UTF-16");
    refuses(wide.substr(2), "UTF-16");
    refuses(texts::motor + std::string(1, '\0'), "a NUL character");
    refuses(texts::motor + "\xC0", "not UTF-8");
    refuses("", "no file in the format");
    refuses(std::string(300'000, '#'), "larger than 200 kB");
    refuses("# " + std::string(20'000, 'x'), "a line of more than 10000 bytes");
    refuses(texts::with(texts::motor, "20 A", std::string(9000, '[')), "a number is needed");
    refuses("a = " + std::string(9000, '['), "no TOML");
    refuses(texts::with(texts::motor, "20 A", std::string(5'000'000, '1')), "larger than 200 kB");
    refuses(texts::motor + "[states]\nq = 1\n", "cannot redefine existing table 'states'");
    refuses("[.]\n", "the name of a table is needed");
    refuses("[[", "the name of a table is needed");
    refuses("a = [}", "this bracket closes what is not open");
    CHECK_THROWS_AS(read_model("nowhere.toml"), input_error);

    io_support::temporary_folder const folder;
    folder.write("large.toml", std::string(300'000, '\n'));
    CHECK_THROWS_AS(read_model(folder.path() / "large.toml"), model_text_error);

    std::string windows = "\xEF\xBB\xBF"; // a byte-order mark, and CRLF
    for (char const c : texts::motor) windows += c == '\n' ? std::string("\r\n") : std::string{c};
    CHECK_FALSE(error_of(windows));
}

TEST_CASE("effects that are ready made have sizes that can be") {
    auto const refuses = [](std::string const& kind, std::string const& what) {
        auto const error = error_of(texts::motor + "[effect.more]\nkind = " + kind);
        INFO(kind);
        REQUIRE(error);
        CHECK_THAT(std::string(error->what()), ContainsSubstring(what));
    };
    refuses("\"input_delay\"\nof = \"u\"\nprior = \"[-1, 1] s\"\n", "this time may be below 0");
    refuses("\"input_backlash\"\nof = \"u\"\nprior = \"[-1, 1] V\"\n",
            "the prior of b goes below 0");
    refuses("\"sensor_clock_drift\"\nof = \"i\"\nprior = [-1, 1]\n", "the prior of r goes below 0");
    refuses("\"input_lag\"\nof = \"u\"\nprior = \"[0, 1] s\"\nlimit = \"0 V\"\n", "not above 0");
    refuses("\"sensor_rotation\"\nof = [\"i\", \"i\"]\nprior = \"[-1, 1] rad\"\n",
            "'i' stands twice");
}

TEST_CASE("many of everything is read or refused, and in time") {
    auto const model = [](std::size_t n, auto const& equation) {
        std::string equations, states;
        for (std::size_t i = 0; i < n; ++i) {
            equations += equation(i) + "\n";
            states += "s" + std::to_string(i) + " = 1\n";
        }
        return "format = \"sivid-model-1\"\nname = \"m\"\nequations = \"\"\"\n" + equations +
               "\"\"\"\n[states]\n" + states + "[outputs]\ny = \"s0\"\n";
    };
    auto const s = [](std::size_t i) { return "s" + std::to_string(i); };
    CHECK_FALSE(error_of(model(1500, [&](auto i) { return s(i) + "' = s0/(1 [s])"; })));
    CHECK_FALSE(error_of(model(
        150, [&](auto i) { return "2*" + s(i) + "' + " + s((i + 1) % 150) + "' = s0/(1 [s])"; })));
    auto const error = error_of(model(300, [&](auto i) { return "2*" + s(i) + "' = s0/(1 [s])"; }));
    REQUIRE(error);
    CHECK(error->place().line == 4);
    CHECK_THAT(std::string(error->what()), ContainsSubstring("more than 200 states"));
}

TEST_CASE("a text that was cut off is read or refused at a place") {
    for (std::size_t n = 0; n < texts::motor.size(); n += 3)
        if (auto const error = error_of(texts::motor.substr(0, n)); error)
            CHECK(error->place().line > 0);
}

TEST_CASE("damage makes a text that is read, or refused at a place") {
    std::mt19937 random(20261129);
    auto const below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    std::string const signs = "\"'[]{}()=+-*/^.,;#\n 0123456789eEabwkt_\\\xC3\xA9";
    std::size_t refused = 0, read = 0;
    for (auto const& whole :
         {texts::motor, texts::of_file("examples/hovercraft/hovercraft.toml")}) {
        REQUIRE(whole.size() > 100);
        for (int k = 0; k < 1500; ++k) {
            auto text = whole;
            for (std::size_t times = 1 + below(4); times > 0; --times) {
                auto const at = below(text.size());
                switch (below(4)) {
                case 0:
                    text[at] = signs[below(signs.size())];
                    break;
                case 1:
                    text.erase(at, 1 + below(12));
                    break;
                case 2:
                    text.insert(at, 1, signs[below(signs.size())]);
                    break;
                default: // a part once more somewhere else
                    text.insert(below(text.size()), text.substr(at, 1 + below(40)));
                }
            }
            auto const error = error_of(text); // nothing else is thrown
            if (error) CHECK(error->place().file == "m.toml");
            ++(error ? refused : read);
        }
    }
    CHECK(refused > 1000);
    CHECK(read > 20);
}
