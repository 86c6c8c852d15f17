// SPDX-License-Identifier: MIT
#include <sivid/importing/table/detail/matlab_table.hpp>

#include <sivid/importing/matlab_reader.hpp>

#include "io/import_support.hpp"
#include "io/matlab_support.hpp"

#include <limits>
#include <random>

using namespace sivid;
using namespace io_support;

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
matlab_writer const w;

import_tools with_matio() {
    import_tools tools;
    tools.read_matlab = read_matlab;
    return tools;
}
imported_dataset import_matlab(std::string const& mapping, std::string const& file) {
    return import_csv(mapping, file, with_matio());
}

std::string mapping(std::string const& time, std::string const& u, std::string const& h) {
    auto text = replaced(csv_mapping, "\"kind\": \"csv\"", "\"kind\": \"matlab\"");
    text = replaced(text, R"("time": { "column": "time", "unit": "ms", "offset": 0 })", time);
    return replaced(replaced(text, "\"pump\"", "\"" + u + "\""), "\"level\"", "\"" + h + "\"");
}
std::string const by_t = R"("time": { "column": "t", "unit": "s", "offset": 0 })";
std::string const recorded =
    w.file(w.doubles("t", 1, 4, {0, 0.1, 0.2, 0.3}) +
           w.doubles("X", 4, 2, {1, 2, 3, 4, 100, missing, 102, 103.5}) +
           w.structure("log", {{"h", w.doubles("", 2, 4, {0, 100, 0, 101, 0, 102, 0, 103})}}) +
           w.doubles("short", 3, 1, {1, 2, 3}) + w.matrix(4, "s", 1, 2, w.element(16, "ab")) +
           w.object("T", "timetable"));

} // namespace

TEST_CASE("vectors, columns, rows and fields become a table") {
    auto const r = import_matlab(mapping(by_t, "X(:,1)", "X(:,2)"), recorded);
    auto const& s = r.data.scenarios.at(0);
    CHECK(s.duration == 0.3);
    REQUIRE(s.stated.size() == 3);
    CHECK(s.stated[2].value == dec("1.035"));
    CHECK(s.stated[2].error == dec("0.02"));
    CHECK(s.measurements[1].time == 0.2);
    CHECK(noted(r.protocol, "no reading") == std::vector<std::size_t>{2});
    auto const rows = import_matlab(
        mapping(R"("time": { "sample_time": 100, "unit": "ms" })", "t", "log.h(2,:)"), recorded);
    CHECK(rows.data.scenarios.at(0).stated.at(3).value == dec("1.03"));
    CHECK(rows.data.scenarios.at(0).measurements.at(3).time == 0.3);
}

TEST_CASE("the digits of a double that are cut go into the bound") {
    auto const text = w.file(w.doubles("t", 1, 2, {0, 1}) + w.doubles("y", 1, 2, {0.1, 0.2}));
    auto const s = import_matlab(mapping(by_t, "t", "y"), text).data.scenarios.at(0);
    auto const truth = exact_decimal::of(0.1).times(dec("0.01"));
    CHECK_FALSE(s.stated[0].value + s.stated[0].error < truth + dec("0.02"));
    CHECK_FALSE(truth - dec("0.02") < s.stated[0].value - s.stated[0].error);
}

TEST_CASE("times are what they were computed from: integers as they are, singles by their digits") {
    auto const y = w.doubles("y", 4, 1, {1, 2, 3, 4});
    auto const times_of = [&](std::string const& unit, std::string const& t) {
        auto const time =
            R"("time": { "column": "t", "unit": ")" + unit + R"(", "offset": "first" })";
        return import_matlab(mapping(time, "y", "y"), w.file(t + y));
    };
    // Nanoseconds since 1970, 100 ns apart: doubles are 256 ns apart there.
    std::vector<std::int64_t> ticks;
    std::vector<float> seconds;
    for (int k = 0; k < 4; ++k) {
        ticks.push_back(1'700'000'000'000'000'037 + 100 * k);
        seconds.push_back(static_cast<float>(1000 + 0.001 * k));
    }
    auto const fine = times_of("ns", w.matrix(14, "t", 4, 1, w.element(12, w.numbers(ticks))));
    REQUIRE(fine.data.scenarios.at(0).measurements.size() == 4);
    for (std::size_t k = 0; k < 4; ++k)
        CHECK(fine.data.scenarios[0].measurements[k].time == *nearest(dec("1e-7").times(k)));
    CHECK_FALSE(has_note(fine.protocol, "single precision"));
    auto const coarse = times_of("s", w.matrix(7, "t", 4, 1, w.element(7, w.numbers(seconds))));
    for (std::size_t k = 0; k < 4; ++k)
        CHECK(coarse.data.scenarios.at(0).measurements.at(k).time ==
              *nearest(dec("0.001").times(k)));
    CHECK(has_note(coarse.protocol, "no bound allows for steps of 0.000062 s"));
    CHECK(std::any_of(coarse.data.assumptions.begin(), coarse.data.assumptions.end(),
                      [](auto const& a) { return a.find("single precision") != a.npos; }));
}

TEST_CASE("references that do not fit are refused at their place") {
    auto const has = [](std::string const& m, std::string const& message) {
        CHECK_THAT(refusal(m, recorded, with_matio()), ContainsSubstring(message));
    };
    has(mapping(by_t, "t", "y"), "channels/h/column: ");
    has(mapping(by_t, "t", "y"), "has no variable 'y', or it is an object");
    has(mapping(by_t, "t", "y"), "it has: 't' (double 1x4)");
    has(mapping(by_t, "t", "X"), "no vector; write \"X(:,1)\"");
    has(mapping(by_t, "t", "X(:,3)"), "not to be read by '(:,3)'");
    has(mapping(by_t, "t", "X(1,2)"), "write (:,k)");
    has(mapping(by_t, "t", "X(:,:)"), "write (:,k)");
    has(mapping(by_t, "t", "X(:,0)"), "write (:,k)");
    has(mapping(by_t, "t", "s"), "no full real matrix of numbers");
    for (auto const* inside : {"T", "T.h"}) {
        has(mapping(by_t, "t", inside), "or it is an object, such as a table, which MATLAB");
        has(mapping(by_t, "t", inside), "save vectors of numbers there: t = T.t of a table T");
    }
    has(mapping(by_t, "t", "short"), "'short' has 3 numbers, 't' has 4");
    has(replaced(mapping(by_t, "t", "t"), "\"column\": \"t\", \"factor\"",
                 "\"column\": 2, \"factor\""),
        "a variable has no number");
    has(mapping(by_t, "t", "log.h("), "has no variable");
    auto const wrong = [](double a, double b, std::string const& message) {
        CHECK_THAT(
            refusal(mapping(by_t, "t", "t"), w.file(w.doubles("t", 1, 2, {a, b})), with_matio()),
            ContainsSubstring(message));
    };
    wrong(1, 0, "line 2 (t): the time goes back from 1 to 0 s; the recorder began again");
    wrong(0, missing, "line 2 (t): the time is missing");
    wrong(0, std::numeric_limits<double>::infinity(), "line 2 (t): an infinite number");
}

TEST_CASE("damaged MATLAB files are imported validly or refused") {
    std::mt19937_64 random{11};
    temporary_folder const folder;
    folder.write("mapping.json", mapping(by_t, "X(:,1)", "log.h(2,:)"));
    for (int i = 0; i < 300; ++i) {
        auto text = recorded;
        for (auto times = 1 + random() % 3; times > 0; --times)
            text[128 + random() % (text.size() - 128)] = static_cast<char>(random());
        folder.write("a.csv", text);
        try {
            (void)import_in(folder, with_matio());
            fs::remove_all(folder.path() / "out");
        } catch (input_error const& e) {
            REQUIRE(unprintable_in(e.what()).empty());
            REQUIRE_FALSE(fs::exists(folder.path() / "out"));
        }
    }
}
