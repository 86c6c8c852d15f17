// SPDX-License-Identifier: MIT
#include <sivid/io/dataset/stated_unit.hpp>

#include <sivid/io/dataset/detail/dataset_tables.hpp>

#include "io/support.hpp"
#include "support/catch.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>

using namespace sivid;
using boost::multiprecision::cpp_int;
using boost::multiprecision::cpp_rational;
using Catch::Matchers::ContainsSubstring;

namespace {

exact_decimal dec(std::string const& text) { return exact_decimal::parse(text).value(); }

/// The unit as a file would state it.
stated_unit in(std::string const& text, std::string const& own) {
    return {parse_json("dataset.json", "\"" + text + "\""), own, "the channel 'psi'"};
}

/// n / 10^4.
cpp_rational ten_thousandth(std::int64_t n) { return {cpp_int(n), cpp_int(10000)}; }
std::string text_of_thousandth(std::int64_t n) { return std::to_string(n) + "e-4"; }

/// pi to 60 digits, from below.
cpp_rational const
    pi_below(cpp_int("314159265358979323846264338327950288419716939937510582097494"),
             cpp_int("100000000000000000000000000000000000000000000000000000000000"));
cpp_rational const pi_above =
    pi_below +
    cpp_rational(1, cpp_int("100000000000000000000000000000000000000000000000000000000000"));

/// Whether [lower, upper] of doubles is the tightest one around the two numbers, or wider by less
/// than a double on either side.
void check_tight(interval const& x, cpp_rational const& low, cpp_rational const& high) {
    CHECK(cpp_rational(x.lower()) <= low);
    CHECK(high <= cpp_rational(x.upper()));
    CHECK(cpp_rational(std::nextafter(x.lower(), HUGE_VAL)) > low);
    CHECK(cpp_rational(std::nextafter(x.upper(), -HUGE_VAL)) < high);
}

} // namespace

TEST_CASE("measurements in another unit are enclosed as tightly as in the model's") {
    struct factor {
        char const *stated, *own;
        cpp_rational below, above;
    };
    factor const factors[] = {
        {"deg", "rad", pi_below / 180, pi_above / 180},
        {"rpm", "rad/s", pi_below / 30, pi_above / 30},
        {"rad", "deg", 180 / pi_above, 180 / pi_below},
        {"km/h", "m/s", cpp_rational(5, 18), cpp_rational(5, 18)},
        {"mm", "m", cpp_rational(1, 1000), cpp_rational(1, 1000)},
        {"L/min", "m^3/s", cpp_rational(1, 60000), cpp_rational(1, 60000)},
        {"rad", "1", 1, 1},
    };
    model_names model;
    model.channels = {{"y", ""}};
    std::mt19937_64 random{5};
    for (auto const& f : factors) {
        model.channels[0].unit = f.own;
        for (int i = 0; i < 200; ++i) {
            INFO(f.stated << " in " << f.own << ", case " << i);
            auto const value = static_cast<std::int64_t>(random() % 40'000'001) - 20'000'000;
            auto const error = static_cast<std::int64_t>(random() % 30'000) + 1;
            csv_table const table{"a.csv", "t,y,y_err\n0," + text_of_thousandth(value) + "," +
                                               text_of_thousandth(error) + "\n"};
            stated_units units;
            units.channels = {in(f.stated, f.own)};
            scenario s;
            read_measurements(table, model, s, units);
            auto const low = ten_thousandth(value - error), high = ten_thousandth(value + error);
            REQUIRE(s.measurements.size() == 1);
            check_tight(s.measurements[0].bound, low * (low < 0 ? f.above : f.below),
                        high * (high < 0 ? f.below : f.above));
        }
    }
}

TEST_CASE("times and exact inputs are the nearest doubles") {
    CHECK(in("h", "s").nearest(dec("0.1")) == 360.0);
    CHECK(in("min", "s").nearest(dec("0.35")) == 21.0);
    CHECK(in("ms", "s").nearest(dec("300")) == 0.3);
    CHECK(in("s", "h").nearest(dec("1")) == 1.0 / 3600);
    CHECK(in("deg", "rad").nearest(dec("180")) == 3.141592653589793);
    CHECK(in("deg", "rad").nearest(dec("0")) == 0.0);
    CHECK_FALSE(in("km", "um").nearest(dec("1e300")));
}

TEST_CASE("error bounds of inputs cover what rounding their values moved") {
    model_names model;
    model.inputs = {{"u", "rad"}};
    stated_units units;
    units.inputs = {in("deg", "rad")};
    csv_table const table{"a.csv", "t,u,u_err\n0,77,1e-17\n1,78,0.5\n"};
    auto const u = read_inputs(table, model, interpolation::linear, 1, units).at(0);
    for (std::size_t k = 0; k < 2; ++k) {
        auto const degrees = k == 0 ? 77 : 78;
        auto const width =
            k == 0 ? cpp_rational(1, cpp_int("100000000000000000")) : cpp_rational(1, 2);
        cpp_rational const read(u.signal.values()[k]), error(u.error[k]);
        CHECK(read - error <= (degrees - width) * pi_below / 180);
        CHECK(read + error >= (degrees + width) * pi_above / 180);
    }
    CHECK(u.error[1] < 0.5000001 * 3.1415926535897936 / 180);
}

TEST_CASE("ranges go outward, and exact ones stay exact") {
    auto const a = in("cm", "m").range(dec("-20"), dec("30"));
    REQUIRE(a);
    CHECK(a->lower == dec("-0.2"));
    CHECK(a->upper == dec("0.3"));
    auto const b = in("deg", "rad").range(dec("-180"), dec("180"));
    REQUIRE(b);
    check_tight(b->enclosure, -pi_above, pi_above);
    CHECK_FALSE(in("km", "um").range(dec("0"), dec("1e305")));
}

TEST_CASE("one unit in two spellings leaves numbers as they are") {
    for (auto const& [a, b] : {std::pair{"m/s", "m/s"},
                               {"", "1"},
                               {"-", ""},
                               {"rad", "1"},
                               {"m s^-1", "m/s"},
                               {"N m", "J"},
                               {"error bounds", "error bounds"}}) {
        INFO(a << " and " << b);
        CHECK(in(a, b).name().empty());
        stated_measurement const m{dec("0.123456789012345678901234567890123456"), dec("1e-3")};
        CHECK(in(a, b)(m)->value == m.value);
    }
}

TEST_CASE("what does not convert is refused, with both units and where it stands") {
    struct refusal {
        char const *stated, *own, *says;
    };
    for (auto const& r : {refusal{"m", "rad", "does not convert to the model's 'rad'"},
                          {"degC", "K", "'degC' is the unit of the channel 'psi'"},
                          {"dB", "", "the model's '1'"},
                          {"Hz", "rad/s", "'rad/s'"},
                          {"counts", "m", "'m'"},
                          {"hours of sleep", "rad", "'hours of sleep' is no unit"},
                          {"m", "error bounds", "does not convert"}}) {
        INFO(r.stated << " in " << r.own);
        CHECK_THROWS_WITH(in(r.stated, r.own),
                          ContainsSubstring("dataset.json") && ContainsSubstring(r.says));
    }
}
