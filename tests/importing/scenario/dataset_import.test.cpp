// SPDX-License-Identifier: MIT
#include <sivid/importing/scenario/dataset_import.hpp>

#include "io/import_support.hpp"

#include <cmath>

using namespace sivid;
using namespace io_support;

namespace {

/// A smooth level with 0.01 of noise on a grid of 0.01, every 10 ms.
std::string smooth(unsigned n, double noise, unsigned seed = 1) {
    std::mt19937_64 random{seed};
    std::uniform_real_distribution<double> draw{-noise, noise};
    std::string text = "time,pump,level\n";
    for (unsigned i = 0; i < n; ++i)
        text += std::to_string(10 * i) + ",1," +
                exact_decimal::rounded(100 * std::sin(0.02 * i) + draw(random), 2).text() + "\n";
    return text;
}

bool contains_word(std::string const& text, std::string const& word) {
    return (" " + text + " ").find(" " + word + " ") != std::string::npos;
}

} // namespace

TEST_CASE("decimals are scaled exactly") {
    auto const r = import_csv(csv_mapping, small_table);
    auto const& s = r.data.scenarios.at(0);
    REQUIRE(s.stated.size() == 3);
    CHECK(s.stated[1].value == dec("1.01"));
    CHECK(s.stated[2].value == dec("1.035"));
    CHECK(s.stated[2].error == dec("0.02"));
    CHECK(s.measurements[1].time == 0.1);
    CHECK(s.inputs.at(0).signal.values() == std::vector<double>{1.5, 1.5, 2.5, 2.5});
    CHECK(s.inputs.at(0).error.empty());
    CHECK(r.data.fixed.size() == 1);
    CHECK(s.initial.at(0).stated->upper == dec("1"));
    CHECK(r.protocol.scenarios.at(0).measurements == 3);
    CHECK(r.protocol.scenarios.at(0).file == "a.csv");
}

TEST_CASE("fixed values and stated starts are read in the units that the mapping states") {
    auto const with = [](std::string const& g, std::string const& h) {
        auto const text = replaced(csv_mapping, "\"g\": 9.81", "\"g\": " + g);
        return replaced(text, "\"h\": [0, 1]", "\"h\": " + h);
    };
    auto const stated =
        with(R"({"value": 981, "unit": "cm/s^2"})", R"({"range": [10, 100], "unit": "cm"})");
    temporary_folder const folder;
    folder.write("mapping.json", stated);
    folder.write("a.csv", small_table);
    auto names = import_in(folder).names;
    for (auto& c : names.constants)
        if (c.name == "g") c.unit = "m/s^2";
    for (auto& x : names.states) x.unit = "m";
    auto const data = read_dataset(folder.path() / "out", names);
    CHECK(contains(data.fixed.at(0).value, 9.81));
    CHECK(width(data.fixed.at(0).value) < 1e-14);
    auto const& h = data.scenarios.at(0).initial.at(0);
    CHECK(h.stated->lower == dec("0.1"));
    CHECK(h.stated->upper == dec("1"));
    names.states.at(0).unit = "s";
    CHECK_THROWS_WITH(read_dataset(folder.path() / "out", names),
                      ContainsSubstring("'cm' is the unit of the state 'h'"));
    // Without a unit the long forms mean the short ones.
    auto const plain = import_csv(with(R"({"value": 9.81})", R"({"range": [0, 1]})"), small_table);
    CHECK(plain.data.fixed.at(0).stated == dec("9.81"));
    CHECK(plain.data.scenarios.at(0).initial.at(0).stated->upper == dec("1"));
    CHECK_THAT(refusal(with(R"({"value": 981, "unit": "hours of sleep"})", "[0, 1]"), small_table),
               ContainsSubstring("mapping.json: /fixed/g/unit: 'hours of sleep' is no unit"));
    CHECK_THAT(refusal(with("9.81", R"({"range": [0, 1], "unit": "hours of sleep"})"), small_table),
               ContainsSubstring("/scenarios/0/initial/h/unit: 'hours of sleep' is no unit"));
    CHECK_THAT(refusal(with("9.81", R"({"range": [0, 1], "rate": 2})"), small_table),
               ContainsSubstring("unknown key 'rate'"));
}

TEST_CASE(
    "an input that steps between two times that are one double, or in one tick, has stepped") {
    // u = 0 until 1.01 s, then 5; what is measured is the level + u.
    auto const hold = replaced(csv_mapping, "\"linear\"", "\"hold\"");
    auto const table =
        "time,pump,level\n0,0,100\n1010,0,100\n1010.0000000000001,5,105\n2000,5,105\n";
    auto const check = [](imported_dataset const& r, double at) {
        auto const& s = r.data.scenarios.at(0);
        auto const& u = s.inputs.at(0).signal;
        CHECK(u.approximate(at - 0.001) == 0);
        CHECK(u.approximate(at) == 5);
        CHECK(u.approximate(at + 0.5) == 5);
        REQUIRE(s.measurements.size() == 3);
        CHECK(s.measurements[1].time == at);
        return mid(s.measurements[1].bound);
    };
    CHECK_THAT(check(import_csv(hold, table), 1.01), WithinAbs(1.05, 1e-9));
    CHECK_THAT(refusal(csv_mapping, table),
               ContainsSubstring("a.csv: line 4: the input 'u' has another value in line 3"));
    auto const log = replaced(serial_mapping, "0.05", "2");
    auto const lines = "0,0,100\n1000,0,100\n1000,5,105\n2000,5,105\n";
    CHECK(check(import_serial(log, lines), 1) == 105);
    CHECK_THAT(refusal(replaced(log, "\"hold\"", "\"linear\""), lines),
               ContainsSubstring("a.log: line 3: the input 'u' has another value in line 2"));
}

TEST_CASE("bounds of a column, in the unit of the readings") {
    auto const r =
        import_csv(replaced(csv_mapping, "\"error\": 0.02", "\"error\": {\"column\": \"bound\"}"),
                   small_table);
    auto const& s = r.data.scenarios.at(0);
    CHECK(s.stated[0].error == dec("0.01"));
    CHECK(s.stated[2].error == dec("0.04"));
}

TEST_CASE("what is rounded is in the bound") {
    auto const third =
        replaced(csv_mapping, "\"factor\": 0.01", "\"factor\": [0.0099, 0.0101], \"divisor\": 3");
    auto const s = import_csv(third, small_table).data.scenarios.at(0);
    auto const& m = s.stated.at(1); // 101 * 0.0099 / 3 = 0.3333, 101 * 0.0101 / 3 = 0.34003..
    CHECK_FALSE(m.value.times(3) + m.error.times(3) <
                dec("101").times(dec("0.0101")) + dec("0.06"));
    CHECK_FALSE(dec("101").times(dec("0.0099")) - dec("0.06") <
                m.value.times(3) - m.error.times(3));
    CHECK(m.error < dec("0.024"));
    // An input means the nearest double; its bound covers the difference.
    auto const input = replaced(csv_mapping, "\"column\": \"pump\"",
                                "\"column\": \"pump\", \"factor\": 0.1, \"error\": 1e-20");
    auto const u = import_csv(input, small_table).data.scenarios.at(0).inputs.at(0);
    REQUIRE(u.stated_error.size() == 4);
    auto const exact = dec("0.15"), stated = exact_decimal::of(u.signal.values()[0]);
    CHECK_FALSE(u.stated_error[0] < magnitude(exact - stated) + dec("1e-20"));
    CHECK(u.stated_error[0] < magnitude(exact - stated).times(2));
    CHECK(u.stated_error[2] == dec("1e-20")); // 0.25 is a double
}

TEST_CASE("a proposed bound: once for each channel, from the fit scenarios alone") {
    auto two = replaced(csv_mapping, "\"error\": 0.02", "\"error\": \"propose\"");
    auto const from = two.find("    { \"name\"");
    auto const scenario = two.substr(from, two.rfind(" ]") - from);
    auto second = replaced(replaced(scenario, "\"A\"", "\"B\""), "\"fit\"", "\"holdout\"");
    second = replaced(second, "a.csv", "b.csv");
    two.insert(two.rfind(" ]"), ", " + second);
    temporary_folder const folder;
    folder.write("mapping.json", two);
    folder.write("a.csv", smooth(300, 1));
    folder.write("b.csv", smooth(300, 5, 2));
    auto const r = import_in(folder);
    REQUIRE(r.protocol.bounds.size() == 1);
    for (auto const& c : r.protocol.bounds[0].candidates)
        for (auto const& words : c.rests_on) CHECK_FALSE(contains_word(words, "B")); // held out
    auto const& error = r.data.scenarios.at(0).stated.at(0).error;
    CHECK(error.text() == r.protocol.bounds[0].bound);
    CHECK(error == r.data.scenarios.at(1).stated.at(0).error);
    CHECK_FALSE(error < dec("0.01"));
    CHECK(error < dec("0.03"));
    CHECK_THAT(r.protocol.text(), ContainsSubstring("error bound of h, proposed"));
}

TEST_CASE("more outliers than the data set allows are told") {
    auto table = smooth(300, 1);
    for (auto const* spike : {"\n500,1,", "\n1500,1,"})
        table = replaced(table, spike, std::string{spike} + "9");
    auto const proposing = replaced(csv_mapping, "\"error\": 0.02", "\"error\": \"propose\"");
    auto const r = import_csv(proposing, table);
    CHECK(has_note(r.protocol, "2 samples may violate the proposed bound"));
    auto const allowed = import_csv(
        replaced(proposing, "\"max_outlier_fraction\": 0", "\"max_outlier_fraction\": 0.01"),
        table);
    CHECK_FALSE(has_note(allowed.protocol, "may violate"));
}

TEST_CASE("a stated bound of less than half a step is told") {
    auto const table = smooth(300, 1);
    auto const with = [&](std::string const& error) {
        return import_csv(replaced(csv_mapping, "\"error\": 0.02", "\"error\": " + error), table);
    };
    CHECK(has_note(with("0.00002").protocol, "0.00002 is less than half a step of its readings"));
    CHECK_FALSE(has_note(with("0.00005").protocol, "half a step"));
}

TEST_CASE("candidates for a stated bound hold a planted error where what they rest on is so") {
    // Twice the same command; the first 40 readings at rest; errors up to 0.05 m, steps of 0.01 m.
    auto const table = [](unsigned seed) {
        std::mt19937_64 random{seed};
        std::uniform_real_distribution<double> draw{-5, 5};
        std::string text = "time,pump,level\n";
        for (int i = 0; i < 400; ++i) {
            double const level = i < 40 ? 100 : 100 + 60 * std::sin(0.015 * (i - 40));
            text += std::to_string(10 * i) + "," + (i < 40 ? "0" : "1") + "," +
                    exact_decimal::rounded(level + draw(random), 0).text() + "\n";
        }
        return text;
    };
    auto two = replaced(csv_mapping, "\"linear\"", "\"hold\"");
    auto const from = two.find("    { \"name\"");
    auto const scenario = two.substr(from, two.rfind(" ]") - from);
    auto const second = replaced(replaced(scenario, "\"A\"", "\"B\""), "a.csv", "b.csv");
    two.insert(two.rfind(" ]"), ", " + second);
    temporary_folder const folder;
    folder.write("mapping.json", two);
    folder.write("a.csv", table(1));
    folder.write("b.csv", table(2));
    auto const r = import_in(folder);
    REQUIRE(r.protocol.bounds.size() == 1); // the input is taken as exact
    auto const& b = r.protocol.bounds[0];
    CHECK(b.bound.empty());
    REQUIRE(b.candidates.size() == 4);
    auto const at = [&](std::size_t k, char const* from) {
        CHECK(b.candidates[k].from == from);
        CHECK_FALSE(b.candidates[k].rests_on.empty());
        return b.candidates[k].bound;
    };
    CHECK_THAT(at(0, "step"), WithinAbs(0.005, 1e-9));
    double const rest = at(1, "rest"), runs = at(2, "repeated"), near = at(3, "neighbours");
    CHECK((rest > 0.03 && rest <= 0.055));
    CHECK((runs > 0.03 && runs <= 0.055)); // no less than half of the largest difference
    CHECK((near >= 0.05 && near < 0.15));
    CHECK_THAT(b.candidates[1].rests_on[0], ContainsSubstring("nothing moves in"));
    CHECK(b.candidates[3].beyond > 0);
    CHECK(b.candidates[3].beyond < 0.01);
    // Other commands are no repetition.
    auto other = table(2);
    folder.write("b.csv", replaced(other, "\n500,1,", "\n500,2,"));
    CHECK(import_in(folder).protocol.bounds[0].candidates.size() == 3);
}

TEST_CASE("no bound is made up") {
    auto const proposing = replaced(csv_mapping, "\"error\": 0.02", "\"error\": \"propose\"");
    CHECK_THAT(
        refusal(proposing, small_table),
        ContainsSubstring("/scenarios/0/channels/h/error: no error bound of 'h' can be proposed"));
    std::string constant = "time,pump,level\n";
    for (int i = 0; i < 100; ++i) constant += std::to_string(i) + ",1,7\n";
    CHECK_THAT(refusal(proposing, constant), ContainsSubstring("different readings"));
}

TEST_CASE("inputs may have proposed bounds too") {
    auto const mapping = replaced(replaced(csv_mapping, "\"column\": \"pump\"",
                                           "\"column\": \"level\", \"error\": \"propose\""),
                                  "\"error\": 0.02", "\"error\": \"propose\"");
    auto const r = import_csv(mapping, smooth(200, 1));
    CHECK(r.protocol.bounds.size() == 2);
    CHECK_FALSE(r.data.scenarios[0].inputs[0].error.empty());
}

TEST_CASE("a restart makes a second scenario, with its own start") {
    auto const mapping = replaced(
        replaced(serial_mapping, "\"longest_gap\": 0.05",
                 "\"longest_gap\": 0.05, \"restart\": \"split\""),
        "\"initial\": {}", R"("initial": {"x": [99, 101]}, "initial_after_break": {"v": [-1, 1]})");
    auto const r = import_serial(mapping, serial_lines(1000, 20) + serial_lines(7, 10));
    REQUIRE(r.data.scenarios.size() == 2);
    CHECK(r.data.scenarios[0].name == "A-1");
    CHECK(r.data.scenarios[1].name == "A-2");
    CHECK(r.data.scenarios[0].duration == 0.19);
    CHECK(r.data.scenarios[1].duration == 0.09);
    CHECK(r.data.scenarios[0].initial[0].stated);
    CHECK_FALSE(r.data.scenarios[0].initial[1].stated);
    CHECK_FALSE(r.data.scenarios[1].initial[0].stated);
    CHECK(r.data.scenarios[1].initial[1].stated);
    CHECK(has_note(r.protocol, "begins after a break"));
}

TEST_CASE("stretches that make no scenario are dropped with a note, not silently") {
    auto const mapping = replaced(serial_mapping, "\"longest_gap\": 0.05",
                                  "\"longest_gap\": 0.05, \"restart\": \"split\"");
    // The second stretch has no count at all.
    auto const r = import_serial(mapping, serial_lines(1000, 20) + "5,1,\n15,1,\n25,1,\n");
    REQUIRE(r.data.scenarios.size() == 1);
    CHECK(noted(r.protocol, "no scenario can be made") == std::vector<std::size_t>{21, 22, 23});
    // No stretch is left.
    CHECK_THAT(refusal(mapping, "1000,1,\n1010,1,\n5,1,\n15,1,\n25,1,\n"),
               ContainsSubstring("no stretch of the log makes a scenario"));
}

TEST_CASE("names that collide and values beyond double are refused") {
    auto text = replaced(serial_mapping, "\"longest_gap\": 0.05",
                         "\"longest_gap\": 0.05, \"restart\": \"split\"");
    auto const from = text.find("    { \"name\"");
    auto const scenario = text.substr(from, text.rfind(" ]") - from);
    text.insert(text.rfind(" ]"),
                ", " + replaced(replaced(scenario, "\"A\"", "\"A-2\""), "split", "drop"));
    CHECK_THAT(refusal(text, serial_lines(1000, 20) + serial_lines(7, 10)),
               ContainsSubstring("two scenarios are called"));
    CHECK_THAT(refusal(replaced(csv_mapping, "\"error\": 0.02", "\"error\": 1.7e308"),
                       "time,pump,level\n0,1,1e307\n1,1,1e310\n"),
               ContainsSubstring("finite number"));
    CHECK_THAT(refusal(replaced(csv_mapping, "0.01, \"error\": 0.02", "100, \"error\": 1.7e308"),
                       "time,pump,level\n0,1,1e306\n1,1,1e306\n"),
               ContainsSubstring("line 2: value and error bound are beyond the range"));
    CHECK_THAT(refusal(csv_mapping, ""), ContainsSubstring("no heading line"));
}

TEST_CASE("measured machines: bounds as their descriptions say") {
    namespace fs = std::filesystem;
    fs::path const records{SIVID_MEASURED_DATA};
    if (!fs::exists(records / "emps") || !fs::exists(records / "cascaded_tanks"))
        SIVID_SKIP("no emps and cascaded_tanks in '" << records.string()
                                                     << "' (see docs/machines.md)");
    temporary_folder const folder;
    auto const import_one = [&](std::string const& file, std::string const& u,
                                std::string const& y) {
        auto mapping = replaced(csv_mapping, "a.csv", (records / file).string());
        mapping =
            replaced(replaced(mapping, "\"time\", \"unit\": \"ms\"", "\"t_s\", \"unit\": \"s\""),
                     "\"pump\"", "\"" + u + "\"");
        mapping = replaced(mapping, "\"level\", \"factor\": 0.01, \"error\": 0.02",
                           "\"" + y + "\", \"error\": \"propose\"");
        folder.write("mapping.json", mapping);
        return import_in(folder);
    };
    // At 200 Hz the samples do not tell the axis' motion from errors (0.65 um at 1 kHz).
    try {
        (void)import_one("emps/estimation_200Hz.csv", "force_N", "position_m");
        FAIL("a bound was proposed");
    } catch (input_error const& e) {
        CHECK_THAT(e.what(), ContainsSubstring("ask for a bound of at least 4.32e-06") &&
                                 ContainsSubstring("state it as a number"));
    }
    auto const tanks =
        import_one("cascaded_tanks/estimation.csv", "pump_voltage_V", "level_lower_tank_V");
    auto const& q = tanks.protocol.bounds.at(0).candidates.back();
    CHECK(q.from == "neighbours");
    CHECK(q.bound > 0.09); // 0.15 V is suggested
    CHECK(q.bound < 0.2);
    CHECK(tanks.data.scenarios[0].measurements.size() == 1024);
}

TEST_CASE("the servo's mappings: logs of their form become windows that hold the motion") {
    // q = 0.5 sin(4 t) in counts of 2 pi/4096, each read up to 0.49 ms beside its time.
    std::mt19937_64 random{17};
    std::uniform_real_distribution<double> unit{-1, 1};
    temporary_folder const folder;
    for (std::string const kp : {"100", "200", "800"})
        for (std::string const what :
             {"lift_and_drop", "up_and_down", "sin_sin", "sin_time_square"}) {
            std::string text = "time_s,goal_rad,position_rad,speed_rad_s,duty,supply_V,torque_on\n";
            bool const lift = what == "lift_and_drop";
            for (double t = 0.0036; t < 6; t += lift && t > 2 ? 0.0035 : 0.0054) {
                double const count = std::acos(-1.0) / 2048;
                double const q = 0.5 * std::sin(4 * (t - 0.0036 + 0.00049 * unit(random)));
                text += exact_decimal::rounded(t, 9).text() + ",0," +
                        exact_decimal::shortest(std::round(q / count) * count).text() +
                        (lift && t > 2 ? ",0,0,7.3,0\n" : ",0,0.1,7.3,1\n");
            }
            folder.write("kp" + kp + "_" + what + ".csv", text);
        }
    for (auto const& [file, windows] :
         {std::pair{"released", 3u}, {"swinging", 8u}, {"driven", 12u}, {"all", 23u}}) {
        auto const mapping = read_text(std::filesystem::path{SIVID_SOURCE_DIR} / "examples/servo" /
                                       (std::string{file} + ".json"));
        folder.write("mapping.json", mapping);
        auto const r = import_in(folder);
        REQUIRE(r.data.scenarios.size() == windows);
        for (std::size_t i = 0; i < windows; ++i) {
            auto const& s = r.data.scenarios[i];
            double const begin = std::stod(r.protocol.scenarios[i].begin);
            auto const& w = s.initial.at(*index_of(r.names.states, "w"));
            CHECK(contains(w.range, 2 * std::cos(4 * begin)));
            CHECK(width(w.range) < 0.6);
            for (auto const& m : s.measurements)
                CHECK(contains(m.bound, 0.5 * std::sin(4 * (m.time + begin))));
        }
    }
}
