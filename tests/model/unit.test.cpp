// SPDX-License-Identifier: MIT
#include <sivid/model/unit.hpp>

#include <string>

#include "support/catch.hpp"

using sivid::rate_unit;
using sivid::unit;
using ratio = unit::ratio;

TEST_CASE("units are read, multiplied and written") {
    CHECK(unit("kg m^2/s").text() == "kg m^2/s");
    CHECK(unit("m kg m/s").text() == "kg m^2/s");
    CHECK(unit("1").text() == "1");
    CHECK(unit("").text() == "1");
    CHECK(unit("1/s").text() == "1/s");
    CHECK(unit("1/(m s)").text() == "1/(m s)");
    CHECK(unit("m/s/s").text() == "m/s^2");
    CHECK(unit("s^-2 m").text() == "m/s^2");
    CHECK(unit("V^0.5/s").text() == "V^0.5/s");
    CHECK(unit("m^(1/3) m").text() == "m^(4/3)");
    CHECK(unit("N\xC2\xB7m\xC2\xB2").text() == "N m^2");
    CHECK(unit("m") == unit("m^1"));
    CHECK(unit("m/m").text() == "1");
    CHECK(unit("kg m/s").times(unit("s"), 1).text() == "kg m");
    CHECK(unit("m^2").times(unit("m"), -2).text() == "1");
    CHECK(unit("m").times(unit("kg/s^2"), 3).text() == "kg^3 m/s^6");
    CHECK_FALSE(unit("m") == unit("s"));
}

TEST_CASE("what is written is read again") {
    for (auto const* text : {"kg m^2/s", "1/(m s^2)", "A/(V s)", "rad", "1", "kg^3 m/s^6",
                             "V^0.5/s", "m^(1/3)", "m^2.75/counts"}) {
        CHECK(unit(text).fault().empty());
        CHECK(unit(unit(text).text()) == unit(text));
    }
}

TEST_CASE("a rate is a quotient of units") {
    CHECK(rate_unit("m/ms", "ms") == "m/ms^2");
    CHECK(rate_unit("m", "s") == "m/s");
    CHECK(rate_unit("", "h") == "1/h");
    CHECK(rate_unit("m s", "s") == "m");
    CHECK(rate_unit("error bounds", "ms") == "(error bounds)/ms");
}

TEST_CASE("units of one dimension convert by an exact factor") {
    auto const in = [](char const* a, char const* b) { return unit(a).in(unit(b)); };
    CHECK(in("m", "m") == ratio{});
    CHECK(in("km", "mm") == ratio{.ten = 6});
    CHECK(in("h", "s") == ratio{2, 2, 2, 0});
    CHECK(in("d", "h") == ratio{.two = 3, .three = 1});
    CHECK(in("km/h", "m/s") == ratio{-2, -2, 1, 0});
    CHECK(in("deg", "rad") == ratio{-1, -2, -1, 1});
    CHECK(in("\xC2\xB0", "deg") == ratio{});
    CHECK(in("rpm", "rad/s") == ratio{0, -1, -1, 1});
    CHECK(in("rev/min", "rpm") == ratio{});
    CHECK(in("rev", "deg") == ratio{.two = 2, .three = 2, .ten = 1});
    CHECK(in("mrad", "1") == ratio{.ten = -3});
    CHECK(in("N m/rad", "N m") == ratio{});
    CHECK(in("N m s", "kg m^2/s") == ratio{});
    CHECK(in("mbar", "Pa") == ratio{.ten = 2});
    CHECK(in("L/min", "m^3/s") == ratio{-1, -1, -4, 0});
    CHECK(in("%", "") == ratio{.ten = -2});
    CHECK(in("g", "kg") == ratio{.ten = -3});
    CHECK(in("mV", "V") == ratio{.ten = -3});
    CHECK(in("\xC2\xB5s", "us") == ratio{});
    CHECK(in("counts/ms", "counts/s") == ratio{.ten = 3});
    CHECK(in("cm^0.5", "m^0.5") == ratio{.ten = -1});
    CHECK(in("degC", "degC") == ratio{});
}

TEST_CASE("nothing else converts") {
    for (auto const& [a, b] : {std::pair{"m", "s"},
                               {"deg", "m"},
                               {"degC", "K"},
                               {"dB", "1"},
                               {"counts", "1"},
                               {"counts", "ticks"},
                               {"mV^0.5", "V^0.5"},
                               {"Hz", "rad/s"},
                               {"rpm", "1/s"},
                               {"rev", "1"},
                               {"hours of sleep", "rad"},
                               {"hours", "h"},
                               {"kg", "m"},
                               {"Nm", "N m"}}) {
        INFO(a << " in " << b);
        CHECK_FALSE(unit(a).in(unit(b)));
        CHECK_FALSE(unit(b).in(unit(a)));
    }
}

TEST_CASE("what is no unit says why") {
    for (auto const* text :
         {"hours of sleep", "rad/s^2 V", "m/", "(m", "m)", "3.6 km/h", "m^x", "m^0.3", "m^1000",
          "(m s)^2", "m^(1/7)", "m^(1/0)", "m!", "m^", "m^."}) {
        INFO(text);
        CHECK_FALSE(unit(text).fault().empty());
        CHECK_FALSE(unit(text).in(unit(text)));
    }
    CHECK_FALSE(unit(std::string(10'000, '(')).fault().empty());
    CHECK_FALSE(unit(std::string(10'000, 'm')).fault().empty());
    for (auto const* text : {"", "1", "-", "m", "counts", "counts/s", "pixel/frame", "rad/(s^2 V)",
                             "1/s", "%", "kg*m^2/s"}) {
        INFO(text);
        CHECK(unit(text).fault().empty());
    }
}

TEST_CASE("a unit has powers and roots that are whole twelfths") {
    CHECK(unit("m^2/s^4").power(1, 2) == unit("m/s^2"));
    CHECK(unit("kg m").power(-2) == unit("1/(kg^2 m^2)"));
    CHECK(unit("m").power(1, 2)->power(2) == unit("m"));
    CHECK(unit("m").power(0) == unit());
    CHECK_FALSE(unit("m").power(1, 5));
    CHECK_FALSE(unit("m^50").power(2));
    CHECK(unit("1").power(1'000'000) == unit());
}
