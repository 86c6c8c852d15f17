// SPDX-License-Identifier: MIT
// A scenario of several files: what a second clock shows, and what its error does to bounds.
#include <sivid/importing/scenario/detail/scenario_import.hpp>

#include "io/import_support.hpp"

#include <cmath>
#include <random>

using namespace sivid;
using namespace io_support;

namespace {

constexpr std::string_view two_files = R"({
  "format": "sivid-mapping-1", "id": "two", "model": "cart",
  "parameters": { "k": {"prior": [0.1, 0.2]} },
  "max_outlier_fraction": 0,
  "scenarios": [
    { "name": "A", "file": "motor.csv", "time": { "column": "t", "unit": "s", "offset": "first" },
      "interpolation": "linear",
      "inputs": { "u": { "column": "duty" } },
      "channels": { "x": { "column": "encoder", "error": 0.01 } },
      "further_files": [
        { "file": "imu.csv", "time": { "column": "ms", "unit": "ms", "offset": 0 },
          "clock": CLOCK,
          "channels": { "w": { "column": "gyro", "error": 0.02, "time_error": {"acceleration": 9} } }
        } ],
      "initial": {} } ]
}
)";
constexpr char const* by_encoder = R"({ "offset": [90, 110], "drift": [-0.001, 0.001],
  "same": { "here": { "column": "copy", "error": 0.01 }, "there": { "column": "encoder", "error": 0.01 },
            "rate": 3.5 } })";
constexpr char const* by_pulse = R"({ "offset": [99.5, 100.8], "drift": [-0.001, 0.001],
  "same": { "here": { "column": "pulse", "error": 0.1 }, "there": { "column": "sync", "error": 0.1 },
            "level": 0.5 } })";

double place(double t) { return std::sin(2 * t) + std::sin(0.7 * t); }
double rate(double t) { return 2 * std::cos(2 * t) + 0.7 * std::cos(0.7 * t); }
double pulse(double t) { return std::fmod(t + 7, 3.1) < 0.4 || std::fmod(t + 7, 5.3) < 0.3; }

/// Times t of the motor's clock begin at 1000; the other one shows what the motor's shows less
/// `late`, and goes faster by `drift`.
struct recorded {
    double late = 900 - 0.0137, drift = 4e-4; // at its middle, 910
    std::string motor = "t,duty,encoder,sync\n", imu = "ms,gyro,copy,pulse\n";

    explicit recorded(std::mt19937_64& random) {
        std::uniform_real_distribution<double> unit{-1, 1};
        auto const text = [](double x) { return exact_decimal::rounded(x, 9).text(); };
        for (int k = 0; k <= 2000; ++k) {
            double const t = 0.01 * k;
            motor += text(1000 + t) + "," + text(std::sin(t)) + "," +
                     text(place(t) + 0.0099 * unit(random)) + "," + text(pulse(t)) + "\n";
        }
        for (int k = -100; k <= 1100; ++k) {
            double const shown = 900 + 0.02 * k, t = real(shown);
            imu += text(1000 * shown) + "," + text(rate(t) + 0.0199 * unit(random)) + "," +
                   text(place(t) + 0.0099 * unit(random)) + "," + text(pulse(t)) + "\n";
        }
    }
    /// The scenario's time, when the second clock shows so much.
    [[nodiscard]] double real(double shown) const { return shown - late + drift * (shown - 910); }
};

imported_dataset import_two(recorded const& of, std::string const& clock,
                            std::string const& mapping = std::string{two_files}) {
    temporary_folder const folder;
    folder.write("mapping.json", replaced(mapping, "CLOCK", clock));
    folder.write("motor.csv", of.motor);
    folder.write("imu.csv", of.imu);
    return import_in(folder);
}
/// How many readings of the second channel there are; all hold what the sensor saw at their time.
std::size_t contained(imported_dataset const& r, double most) {
    std::size_t count = 0;
    for (auto const& m : r.data.scenarios.at(0).measurements) {
        if (r.names.channels.at(m.channel).name != "w") continue;
        ++count;
        CHECK(in(rate(m.time), m.bound));
        CHECK(width(m.bound) < 2 * most);
    }
    return count;
}

} // namespace

TEST_CASE("a second file is on the first one's time axis, with bounds for what its clock leaves") {
    std::mt19937_64 random{3};
    recorded const of(random);
    std::string const stated = R"({ "offset": [100.01, 100.02], "drift": [0.0003, 0.0005] })";
    auto const r = import_two(of, stated);
    CHECK(contained(r, 0.07) > 990);
    CHECK(has_note(r.protocol, "the times of the file are off by 0.0062 s at most"));
    auto const found = import_two(of, by_encoder);
    CHECK(contained(found, 0.065) > 990);
    CHECK(has_note(found.protocol, "which changes by 3.5 a second at most"));
    CHECK(contained(import_two(of, by_pulse), 0.12) > 990);
    // An exact clock needs no slope.
    auto const plain =
        replaced(std::string{two_files}, ", \"time_error\": {\"acceleration\": 9}", "");
    auto const exact = import_two(of, R"({ "offset": 100.0137, "drift": 0.0004 })", plain);
    CHECK(contained(exact, 0.0201) > 990);
}

TEST_CASE("inputs of a second file are within what its clock leaves of their course") {
    std::mt19937_64 random{4};
    recorded const of(random);
    auto const swapped = [](std::string const& more) {
        auto text = replaced(std::string{two_files},
                             "\"inputs\": { \"u\": { \"column\": \"duty\" } },", "");
        return replaced(text, "\"channels\": { \"w\"",
                        "\"inputs\": { \"u\": { \"column\": \"gyro\"" + more +
                            " } }, \"channels\": { \"w\"");
    };
    std::string const clock = R"({ "offset": [100.01, 100.02], "drift": 0.0004 })";
    CHECK_THROWS_AS(import_two(of, clock, swapped("")), input_error); // it is said to be exact
    for (auto between : {"linear", "hold"}) {
        auto text = swapped(", \"error\": 0.021");
        text = replaced(text, "\"interpolation\": \"linear\"",
                        "\"interpolation\": \"" + std::string{between} + "\"");
        auto const r = import_two(of, clock, text);
        auto const& u = r.data.scenarios.at(0).inputs.at(0);
        auto const& times = u.signal.times();
        REQUIRE(times.size() > 990);
        CHECK(times.front() <= 0);
        for (std::size_t k = 0; k + 1 < times.size(); ++k) {
            for (double const share : {0.0, 0.3, 0.7, 0.999}) {
                double const t = times[k] + share * (times[k + 1] - times[k]);
                if (t < 0.1 || t > 19.9) continue;
                // What the clock shows at t, and what the file says of it then.
                double const shown = (t + of.late + 910 * of.drift) / (1 + of.drift);
                double const own = shown - 900, row = std::floor(own / 0.02 + 1e-9);
                auto const at = [&](double n) { return rate(of.real(900 + 0.02 * n)); };
                double const part = between == std::string{"hold"} ? 0 : own / 0.02 - row;
                double const value = at(row) + part * (at(row + 1) - at(row));
                double const here = u.signal.approximate(t);
                CHECK(std::abs(value - here) <= std::min(u.error[k], u.error[k + 1]) + 1e-9);
            }
            CHECK(u.error[k] < (between == std::string{"hold"} ? 0.35 : 0.06));
        }
    }
}

TEST_CASE("samples that an input of a second file lacks are refused, or bounded") {
    std::mt19937_64 random{6};
    recorded of(random);
    std::string const first = "\n908000,", last = "\n908200,";
    of.imu.erase(of.imu.find(first), of.imu.find(last) - of.imu.find(first));
    auto text =
        replaced(std::string{two_files}, "\"inputs\": { \"u\": { \"column\": \"duty\" } },", "");
    text = replaced(text, "\"channels\": { \"w\"",
                    "\"inputs\": { \"u\": { \"column\": \"copy\", \"error\": 0.01 } }, "
                    "\"channels\": { \"w\"");
    std::string const clock = R"({ "offset": [100.01, 100.02] })";
    try {
        (void)import_two(of, clock, text);
        FAIL("a gap is bridged, and nobody has said how");
    } catch (input_error const& e) {
        CHECK_THAT(e.what(), ContainsSubstring("imu.csv: 10 samples of this input are missing"));
    }
    auto const r = import_two(of, clock,
                              replaced(text, "\"copy\", ",
                                       "\"copy\", \"bridge\": {\"longest\": 0.3, "
                                       "\"error\": 0.5}, "));
    auto const& u = r.data.scenarios.at(0).inputs.at(0);
    std::size_t wide = 0;
    for (double const e : u.error) wide += e > 0.5 ? 1 : 0; // with what the clock leaves
    CHECK(wide == 2);
}

TEST_CASE("clocks that cannot be are refused, and slopes that are not stated") {
    std::mt19937_64 random{5};
    recorded const of(random);
    auto const refused = [&](std::string const& clock, std::string const& why,
                             std::string const& mapping = std::string{two_files}) {
        try {
            (void)import_two(of, clock, mapping);
        } catch (input_error const& e) {
            CAPTURE(e.what(), why);
            CHECK(std::string{e.what()}.find(why) != std::string::npos);
            return true;
        }
        return false;
    };
    CHECK(refused(replaced(std::string{by_pulse}, "[99.5, 100.8]", "[100.1, 100.8]"),
                  "with no offset and drift as stated"));
    CHECK(refused(replaced(std::string{by_encoder}, "[90, 110]", "[90, 100]"),
                  "with no offset and drift as stated"));
    CHECK(refused(R"({ "offset": [100, 100.1] })", "is not stated",
                  replaced(std::string{two_files}, ", \"time_error\": {\"acceleration\": 9}", "")));
    CHECK(refused(
        R"({ "offset": [100, 100.1] })", "is not stated", // nor any reading
        replaced(replaced(std::string{two_files}, ", \"time_error\": {\"acceleration\": 9}", ""),
                 "\"error\": 0.02", "\"error\": 0.02, \"range\": [900, 901]")));
    CHECK(refused(R"({ "offset": 100 })", "time_error: the key 'within' is missing",
                  replaced(std::string{two_files}, "\"encoder\",",
                           "\"encoder\", \"time_error\": {\"rate\": 3},")));
    CHECK(refused(R"({ "drift": 0 })", "/clock/offset"));
    CHECK(refused(R"({ "offset": 100, "same": { "here": {"column": "copy", "error": "propose"},
                       "there": {"column": "encoder", "error": 1}, "level": 0 } })",
                  "no bound of its error"));
    CHECK(refused(
        R"({ "offset": 100 })", "stands in two files",
        replaced(std::string{two_files}, "\"channels\": { \"w\"", "\"channels\": { \"x\"")));
    CHECK(
        refused(R"({ "offset": 100 })", "no column",
                replaced(std::string{two_files}, "\"column\": \"gyro\"", "\"column\": \"giro\"")));
}
