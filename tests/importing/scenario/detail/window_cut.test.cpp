// SPDX-License-Identifier: MIT
#include <sivid/importing/scenario/detail/window_cut.hpp>

#include "io/import_support.hpp"

#include <cmath>
#include <set>

using namespace sivid;
using namespace io_support;

namespace {

/// A table every 10 ms for 10 s: pump holds the time in ms, level the number of the row.
std::string long_table(unsigned rows = 1001) {
    std::string text = "time,pump,level,other\n";
    for (unsigned i = 0; i < rows; ++i) {
        auto const t = std::to_string(10 * i);
        text += t;
        text += "," + t + "," + (i % 7 == 3 ? std::string{} : std::to_string(i)) + "," + t + "\n";
    }
    return text;
}
std::string mapping(std::string const& more) {
    return replaced(replaced(csv_mapping, "\"initial\": { \"h\": [0, 1] }", more),
                    "\"factor\": 0.01, ", "");
}
std::vector<std::string> values(scenario const& s) {
    std::vector<std::string> result;
    for (auto const& m : s.stated) result.push_back(m.value.text());
    return result;
}

} // namespace

TEST_CASE("windows: no measurement in two of them, none lost, inputs as in the record") {
    auto const whole = import_csv(mapping("\"initial\": {}"), long_table()).data.scenarios.at(0);
    auto const r =
        import_csv(mapping(R"("windows": { "length": 2.5, "first": 0.035 })"), long_table());
    REQUIRE(r.data.scenarios.size() == 3); // the fourth would end at 10.035 s
    std::set<std::string> seen;
    for (std::size_t i = 0; i < 3; ++i) {
        auto const& s = r.data.scenarios[i];
        CHECK(s.name == "A-w" + std::to_string(i + 1));
        CHECK(s.duration == 2.5);
        for (auto const& v : values(s)) CHECK(seen.insert(v).second);
        double const begin = 0.035 + 2.5 * static_cast<double>(i);
        for (std::size_t k = 0; k < s.measurements.size(); ++k) // row i was read at 10 i ms
            CHECK(std::abs(s.measurements[k].time + begin - *nearest(s.stated[k].value) / 100) <
                  1e-12);
        for (double t = 0; t <= 2.5; t += 0.001)
            CHECK(s.inputs[0].signal.piece(t) + 1 < s.inputs[0].signal.times().size());
        auto const& u = s.inputs[0].signal;
        for (std::size_t k = 0; k < u.times().size(); ++k)
            CHECK(std::abs(u.values()[k] - 1000 * (u.times()[k] + begin)) < 1e-9);
        CHECK(u.times().front() <= 0);
        CHECK(u.times().back() >= 2.5);
    }
    // All readings from the first window's start to the last one's end.
    std::size_t expected = 0;
    for (auto const& m : whole.measurements) expected += m.time >= 0.035 && m.time <= 7.535 ? 1 : 0;
    CHECK(seen.size() == expected);
}

TEST_CASE("a reading that ends a window and begins the next is the next one's") {
    auto const r =
        import_csv(mapping(R"("windows": { "length": 0.05, "count": 2 })"), long_table());
    REQUIRE(r.data.scenarios.size() == 2);
    CHECK(values(r.data.scenarios[0]) == std::vector<std::string>{"0", "1", "2", "4"});
    CHECK(values(r.data.scenarios[1]) == std::vector<std::string>{"5", "6", "7", "8", "9"});
    CHECK(r.data.scenarios[1].measurements.back().time == 0.04);
    // With room between them, an end is the window's own.
    auto const apart = import_csv(
        mapping(R"("windows": { "length": 0.05, "every": 0.1, "count": 1 })"), long_table());
    CHECK(values(apart.data.scenarios[0]).back() == "5");
}

TEST_CASE("windows that begin with a reading are moved to it, and still share nothing") {
    auto const r = import_csv(mapping(R"("initial": "propose",
        "windows": { "length": 0.031, "every": 0.031, "first": 0.001 })"),
                              long_table(31));
    std::set<std::string> seen;
    for (auto const& s : r.data.scenarios) {
        CHECK(s.measurements.front().time == 0);
        CHECK(s.initial.at(0).stated->lower == s.stated[0].value - dec("0.02"));
        for (auto const& v : values(s)) CHECK(seen.insert(v).second);
    }
    CHECK(r.data.scenarios.size() == 9);
}

TEST_CASE("windows lie where a column is in a range") {
    std::string table = "time,pump,level,motor\n"; // off from 0.2 to 0.5 s and from 0.8 s on
    for (int i = 0; i <= 100; ++i)
        table += std::to_string(10 * i) + ",1," + std::to_string(i) + "," +
                 (i == 90                           ? ""
                  : (i >= 20 && i <= 50) || i >= 80 ? "0"
                                                    : "1") +
                 "\n";
    auto const cut = [&](std::string const& more) {
        std::vector<std::string> result;
        auto const r =
            import_csv(mapping(R"("windows": { "length": 0.1, "while": {"column": "motor",
                                             "within": [0, 0.5]})" +
                               more + " }"),
                       table);
        for (auto const& s : r.data.scenarios) {
            auto const all = values(s);
            result.push_back(s.name.substr(2) + ":" + all.front() + "-" + all.back());
        }
        return result;
    };
    // Where there is no reading of the motor, it is as before.
    CHECK(cut("") ==
          std::vector<std::string>{"w1:20-29", "w2:30-39", "w3:40-50", "w4:80-89", "w5:90-100"});
    CHECK(cut(R"(, "first": 0.05, "every": 0.15)") ==
          std::vector<std::string>{"w1:25-35", "w2:40-50", "w3:85-95"});
    auto const r = import_csv(mapping(R"("windows": { "length": 0.1, "while": {"column": "motor",
                                         "within": [0, 0.5]} })"),
                              table);
    CHECK(noted(r.protocol, "holds where it did in the row before") ==
          std::vector<std::size_t>{92});
    CHECK_THAT(refusal(mapping(R"("windows": { "length": 0.4, "while": {"column": "motor",
                                   "within": [0, 0.5]} })"),
                       table),
               ContainsSubstring("where \"while\" holds"));
    CHECK_THAT(refusal(mapping(R"("windows": { "length": 0.4, "while": {"column": "engine",
                                   "within": [0, 0.5]} })"),
                       table),
               ContainsSubstring("has no column"));
}

TEST_CASE("a window without a reading to begin with is left out, with a note") {
    std::string table = "time,pump,level\n";
    for (int i = 0; i <= 100; ++i)
        table += std::to_string(10 * i) + ",1," + (i > 20 && i < 45 ? "" : "5") + "\n";
    auto const propose = import_csv(
        mapping(R"("initial": "propose", "windows": { "length": 0.1, "holdout": 5 })"), table);
    CHECK(has_note(propose.protocol, "window 4: no reading to begin with"));
    std::vector<std::string> names;
    for (auto const& s : propose.data.scenarios) names.push_back(s.name);
    // The third begins with the last reading before the gap, the fifth is moved behind it.
    CHECK(names == std::vector<std::string>{"A-w1", "A-w2", "A-w3", "A-w5", "A-w6", "A-w7", "A-w8",
                                            "A-w9", "A-w10"});
    CHECK(propose.data.scenarios[3].role == scenario_role::holdout);
    auto const any = import_csv(mapping(R"("windows": { "length": 0.1 })"), table);
    CHECK(has_note(any.protocol, "window 4: no measurement"));
}

TEST_CASE("roles, and what does not fit") {
    auto const roles = [](std::string const& holdout) {
        auto const r = import_csv(
            mapping(R"("windows": { "length": 1, "every": 2, "holdout": )" + holdout + " }"),
            long_table());
        std::string text;
        for (auto const& s : r.data.scenarios) text += s.role == scenario_role::holdout ? 'h' : 'f';
        return text;
    };
    CHECK(roles("2") == "fhfhf");
    CHECK(roles("[1, 5]") == "hfffh");
    auto const refused = [](std::string const& windows) {
        return refusal(mapping("\"windows\": " + windows), long_table());
    };
    CHECK_THAT(refused(R"({ "length": 1, "every": 2, "holdout": [6] })"),
               ContainsSubstring("window 6 is to be held out, and there are 5"));
    CHECK_THAT(refused(R"({ "length": 11 })"), ContainsSubstring("no window of 11 s fits into") &&
                                                   ContainsSubstring("which lasts 10 s"));
    CHECK_THAT(refused(R"({ "length": 1e-300 })"), ContainsSubstring("more than 10000 windows"));
    CHECK_THAT(refused(R"({ "length": 1, "first": 1e308 })"),
               ContainsSubstring("no window of 1 s"));
    CHECK_THAT(refused(R"({ "length": 1, "holdout": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10] })"),
               ContainsSubstring("no scenario with the role fit is left"));
}

TEST_CASE("a servo's log: bounds and starts of windows hold what was planted") {
    // q = sin(3 t), in counts of 0.001, read up to 1 ms beside the time that the log says; the
    // input acts in the first three windows alone.
    std::mt19937_64 random{11};
    std::uniform_real_distribution<double> unit{-1, 1};
    std::string text = "time,pump,level\n";
    std::vector<double> times;
    for (int k = 0; k < 460; ++k) {
        double const ms = k == 0 ? 0 : 5 * k + std::round(unit(random) * 10) / 10;
        times.push_back(ms / 1000);
        double const q = std::sin(3 * (ms + unit(random) * 0.999) / 1000);
        text += exact_decimal::rounded(ms, 1).text() + (k < 300 ? ",1," : ",0,") +
                exact_decimal::rounded(std::round(q * 1000), 0).text() + "\n";
    }
    auto const with = [](std::string const& start, std::string const& error) {
        auto const m = replaced(csv_mapping, "\"initial\": { \"h\": [0, 1] }",
                                R"("windows": { "length": 0.5, "first": 0.05, "holdout": [1, 3],
                                   "initial": { "h": "propose", "v": )" +
                                    start + " } }");
        return replaced(replaced(m, "\"factor\": 0.01, \"error\": 0.02",
                                 "\"divisor\": 1000, \"error\": 0.0005, " + error),
                        "\"offset\": 0 }", "\"offset\": 0 }");
    };
    std::string const clock = R"("time_error": { "within": 0.001, "acceleration": 9.1 })";
    double widest = 0;
    for (std::string const start : {R"({ "rate_of": "h", "jerk": 27.1, "within": 0.1 })",
                                    R"({ "rate_of": "h", "jerk": 27.1 })",
                                    R"({ "rate_of": "h", "acceleration": 9.1, "within": 0.1 })"}) {
        auto const r = import_csv(with(start, clock + ", \"model_error\": 0.01"), text);
        REQUIRE(r.data.scenarios.size() == 4);
        for (auto const& s : r.data.scenarios) {
            double const t0 = 0.05 + 0.5 * static_cast<double>(s.name.back() - '1');
            double const begin =
                *std::lower_bound(times.begin(), times.end(), t0 - 1e-9); // its first reading
            auto const& v = s.initial.at(*index_of(r.names.states, "v"));
            REQUIRE(v.stated);
            CHECK(contains(v.range, 3 * std::cos(3 * begin)));
            if (start.find("jerk") != start.npos) widest = std::max(widest, width(v.range));
            for (auto const& m : s.stated) CHECK(dec("0.0105") < m.error);
            auto const& h = s.initial.at(*index_of(r.names.states, "h"));
            CHECK(width(h.range) < 0.02); // no model error
        }
        CHECK(has_note(r.protocol, "window 5: does not fit"));
        CHECK(has_note(r.protocol, "is 0 in 1 scenarios to fit and in none held out"));
        CHECK(has_note(r.protocol, "the model may be off by 0.01"));
        CHECK(has_note(r.protocol, "was taken within 0.001 s of its time"));
    }
    CHECK(widest < 0.5);
    CHECK_THAT(refusal(with(R"({ "rate_of": "h", "jerk": 0.1, "within": 0.25 })", clock), text),
               ContainsSubstring("within their error bounds and the jerk"));
    auto const wild = replaced(with(R"({ "rate_of": "h", "jerk": 27.1 })", clock),
                               "\"max_outlier_fraction\": 0", "\"max_outlier_fraction\": 0.1");
    CHECK_THAT(refusal(wild, text), ContainsSubstring("some may be outliers"));
    auto back = text;
    back.replace(back.find("\n", 200) + 1, 0, "1,1,0\n"); // a clock that runs backwards
    CHECK_THAT(refusal(with(R"({ "rate_of": "h", "jerk": 27.1 })", clock), back),
               ContainsSubstring("a.csv:"));
}
