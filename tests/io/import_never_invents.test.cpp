// SPDX-License-Identifier: MIT
// Records as loggers and people leave them: what is in the data set stands in the record, and what
// is not there is refused, or dropped with a note.
#include "io/import_support.hpp"

#include <sivid/measurement/error_bound.hpp>

#include <cmath>

using namespace sivid;
using namespace io_support;

namespace {

using lines = std::vector<std::size_t>;

std::string csv(std::string const& keys) {
    return replaced(csv_mapping, "\"kind\": \"csv\"", "\"kind\": \"csv\", " + keys);
}
/// A log of a time in milliseconds and one channel, no input.
std::string log_mapping(std::string const& fields, std::string const& keys = "") {
    return text_of(R"({"format": "sivid-mapping-1", "id": "m", "model": "m",
  "parameters": {"k": {"prior": [0, 1]}}, "max_outlier_fraction": 0,
  "scenarios": [{"name": "s", "file": "a.log",
    "source": {"kind": "serial", "longest_gap": 0.5, "fields": )",
                   fields, keys, R"(},
    "time": {"column": "t", "unit": "ms", "offset": "first"},
    "channels": {"a": {"column": "a", "error": 0.1}}}]})");
}
std::vector<std::string> values(imported_dataset const& r) {
    std::vector<std::string> result;
    for (auto const& m : r.data.scenarios.at(0).stated) result.push_back(m.value.text());
    return result;
}
using texts = std::vector<std::string>;

} // namespace

TEST_CASE("a tag that varies is a choice, wherever it stands") {
    auto const first = "IMU, 0, 1.00\nGPS, 0, 57.20\nIMU, 10, 1.02\nGPS, 10, 57.21\nIMU, 20, 1.01\n"
                       "MODE, 25, 4\nIMU, 30, 0.99\n";
    CHECK_THAT(refusal(log_mapping(R"(["_", "t", "a"])"), first),
               ContainsSubstring("'IMU' (4 lines), 'GPS' (2 lines), 'MODE' (1 line)"));
    auto const imu = R"(, "lines": {"column": 1, "is": "IMU"})";
    auto const r = import_serial(log_mapping(R"(["_", "t", "a"])", imu), first);
    CHECK(values(r) == texts{"1", "1.02", "1.01", "0.99"});
    CHECK(noted(r.protocol, "of another kind, as the mapping says: 'GPS'") == lines{2, 4});
    CHECK(noted(r.protocol, "'MODE'") == lines{6});
    // In the middle, last, by the field's name, quoted, with blanks and other separators.
    auto const middle = "0;\"IMU\";1,00\n5; GPS ;57,2\n10;IMU;1,02\n15;GPS;57,3\n";
    auto const german = R"(, "separator": ";", "decimal": ",")";
    CHECK_THAT(refusal(log_mapping(R"(["t", "_", "a"])", german), middle),
               ContainsSubstring("column 2: the lines are of several kinds"));
    CHECK(values(import_serial(
              log_mapping(R"(["t", "who", "a"])",
                          text_of(german, R"(, "lines": {"column": "who", "is": "IMU"})")),
              middle)) == texts{"1", "1.02"});
    CHECK_THAT(refusal(log_mapping(R"(["t", "a", "_"])"), "0,1,IMU\n5,57,GPS\n10,1,IMU\n"),
               ContainsSubstring("column 3"));
    // Numbers that take turns are tags, too; others show where times are equal.
    auto const numbers = "1,0,1.00\n2,0,57.2\n1,10,1.02\n2,10,57.3\n";
    CHECK_THAT(refusal(log_mapping(R"(["_", "t", "a"])"), numbers),
               ContainsSubstring("whole numbers take turns in a column that is not mapped: '1' (2 "
                                 "lines), '2' (2 lines)"));
    CHECK_THAT(refusal(log_mapping(R"(["_", "t", "a"])"), "1,0,1.00\n2,0,57.2\n1,10,1.02\n"),
               ContainsSubstring("the channel 'a' has another value in line 1") &&
                   ContainsSubstring("\"lines\" if they are of two kinds"));
    CHECK(values(import_serial(
              log_mapping(R"(["_", "t", "a"])", R"(, "lines": {"column": 1, "is": 1})"),
              numbers)) == texts{"1", "1.02"});
    // Lines of other kinds may have other cells.
    auto const uneven = "IMU,0,1\nGPS,5,57,8,9,\"x\"\nIMU,10,2\nEND\nIMU,20,3\n";
    auto const u = import_serial(log_mapping(R"(["_", "t", "a"])", imu), uneven);
    CHECK(values(u) == texts{"1", "2", "3"});
    // A tag that varies late.
    std::string late;
    for (int i = 0; i < 4000; ++i)
        late += text_of(i == 3900 ? "GPS," : "IMU,", std::to_string(10 * i), ",1\n");
    CHECK_THAT(refusal(log_mapping(R"(["_", "t", "a"])"), late),
               ContainsSubstring("'IMU' (3999 lines), 'GPS' (1 line)"));
    // One text, numbers, dates and notes are no kinds.
    for (auto const* same : {"D,0,1\nD,10,2\nD,20,3\n", "1,0,1\n2,10,2\n1,20,3\n",
                             "12:00:00,0,1\n12:00:01,10,2\n12:00:01,20,3\n",
                             "begin,0,1\n,10,2\n,20,3\n", "nan,0,1\n4,10,2\nnan,20,3\n"}) {
        CAPTURE(same);
        CHECK(values(import_serial(log_mapping(R"(["_", "t", "a"])"), same)) ==
              texts{"1", "2", "3"});
    }
    CHECK_THAT(refusal(log_mapping(R"(["_", "t", "a"])"), "D,0,1\n,10,2\nD,20,3\n"),
               ContainsSubstring("'D' (2 lines), blanks (1 line)"));
}

TEST_CASE("blanks are trimmed in cells, never across a separator") {
    auto mapping = log_mapping(R"(["a", "t", "b"])", R"(, "separator": "\t")");
    mapping = replaced(mapping, "\"error\": 0.1}",
                       "\"error\": 0.1}, \"b\": {\"column\": \"b\", \"error\": 0.1}");
    auto const r =
        import_serial(mapping, "1\t0\t5\n2\t5\t6\n\t10\t15\t7\n 4 \t 20\t8\n5\t25\t\n6\t30\t9\n");
    CHECK(noted(r.protocol, "not as many cells as fields") == lines{3});
    CHECK(noted(r.protocol, "no reading") == lines{5});
    texts a;
    for (std::size_t i = 0; i < r.data.scenarios[0].stated.size(); ++i)
        if (r.data.scenarios[0].measurements[i].channel == 0)
            a.push_back(r.data.scenarios[0].stated[i].value.text());
    CHECK(a == texts{"1", "2", "4", "5", "6"});
    // An empty first cell is a missing reading, not the next one's.
    auto const lacks = import_serial(mapping, "1\t0\t5\n\t5\t6\n2\t10\t7\n");
    CHECK(noted(lacks.protocol, "no reading") == lines{2});
    CHECK(lacks.data.scenarios[0].stated.size() == 5);
}

TEST_CASE("headings in comments, without a name, and lines that end early") {
    auto const cell = [](std::string const& keys) {
        return text_of(R"({"format": "sivid-mapping-1", "id": "c", "model": "m",
  "parameters": {"k": {"prior": [0, 1]}}, "max_outlier_fraction": 0, "scenarios": [{"name": "s",
  "file": "a.csv", "source": {"kind": "csv", "separator": "\t")",
                       keys, R"(},
  "time": {"column": "#t [s]", "unit": "s", "offset": 0},
  "channels": {"E": {"column": "E [V]", "error": 0.001}, "I": {"column": "I [mA]", "error": 0.1}}}]})");
    };
    auto const table = "#t [s]\tE [V]\tI [mA]\t\n0\t0.50\t1.0\n1\t0.52\t1.1\n2\t0.54\t\n3\t0.56\n";
    CHECK_THAT(refusal(cell(""), table),
               ContainsSubstring("line 5: 2 cells in a table of 3 columns; state \"short_lines\""));
    auto const r = import_csv(cell(R"(, "short_lines": "missing")"), table);
    CHECK(r.data.scenarios[0].measurements.size() == 6);
    CHECK(noted(r.protocol, "cells are missing at the end") == lines{5});
    CHECK(noted(r.protocol, "no reading") == lines{5, 4, 5}); // E, then I
    CHECK_THAT(refusal(replaced(cell(""), "#t [s]", "t [s]"), table),
               ContainsSubstring("line 1 was skipped as a comment: if it is the heading, name the "
                                 "columns as they stand there: '#t [s]'"));
    // A cell below no heading is one too many; separators at the ends of lines are not.
    CHECK_THAT(refusal(csv_mapping, "time,pump,level,\n0,1,2,3\n"),
               ContainsSubstring("4 cells in a table of 3 columns"));
    for (auto const* ends :
         {"time,pump,level,\n0,1,2,\n1,1,2,\n", "time,pump,level\n0,1,2,\n1,1,2,\n",
          "time,pump,level,\n0,1,2\n1,1,2\n"})
        CHECK(import_csv(csv_mapping, ends).data.scenarios[0].measurements.size() == 2);
}

TEST_CASE("readings at one time: the same are one, others are a choice") {
    auto const twice = "time,pump,level\n0,1,100\n100,1,101\n100,1,101\n200,1,102\n";
    auto const r = import_csv(csv_mapping, twice);
    CHECK(noted(r.protocol, "repeats the time and the readings") == lines{4});
    CHECK(values(r) == texts{"1", "1.01", "1.02"});
    // Lines that complete each other.
    auto const halves = "time,pump,level\n0,1,100\n100,1,\n100,,101\n200,1,102\n";
    CHECK(values(import_csv(csv_mapping, halves)) == texts{"1", "1.01", "1.02"});
    // Some channels differ; stamps of a second.
    auto const coarse = "time,pump,level\n0,1,100\n0,1,101\n1000,1,102\n1000,1,103\n2000,1,104\n";
    CHECK_THAT(refusal(csv_mapping, coarse),
               ContainsSubstring("is that of line 2, with other readings"));
    CHECK(values(import_csv(csv("\"same_time\": \"first\""), coarse)) ==
          texts{"1", "1.02", "1.04"});
    auto const last = import_csv(csv("\"same_time\": \"last\""), coarse);
    CHECK(values(last) == texts{"1.01", "1.03", "1.04"});
    CHECK(noted(last.protocol, "whose readings count, as the mapping says") == lines{2, 4});
    // In a log, with a held input that does not step there.
    auto const log = "0,1,100\n10,1,101\n10,1,105\n20,1,102\n";
    CHECK_THAT(refusal(serial_mapping, log),
               ContainsSubstring("the channel 'x' has another value"));
    // It steps: readings from before the step are left out, as ever.
    auto const steps = import_serial(serial_mapping, "0,1,100\n10,1,101\n10,2,105\n20,2,102\n");
    CHECK(values(steps) == texts{"100", "105", "102"});
    CHECK(import_csv(csv_mapping, "time,pump,level\n-0,1,100\n100,1,101\n")
              .data.scenarios[0]
              .duration == 0.1);
}

TEST_CASE("joined, cut and damaged files") {
    std::string const bom = "\xEF\xBB\xBF";
    auto const joined = bom + "t_ms,pwm,enc\n" + serial_lines(0, 9) + bom + "t_ms,pwm,enc\n" + bom +
                        serial_lines(90, 9);
    auto const r = import_serial(serial_mapping, joined);
    CHECK(r.data.scenarios[0].measurements.size() == 18);
    CHECK(noted(r.protocol, "heading") == lines{1, 11});
    auto const padded =
        import_serial(serial_mapping, serial_lines(0, 9) + "90,1" + std::string(500, '\0'));
    CHECK(noted(padded.protocol, "a NUL byte, as a loss of power leaves") == lines{10});
    CHECK(padded.data.scenarios[0].measurements.size() == 9);
    auto const cr = import_serial(
        serial_mapping, serial_lines(0, 9) + "boot 10%\rboot 99%\rready\n" + serial_lines(90, 9));
    CHECK(noted(cr.protocol, "a CR inside the line") == lines{10});
    CHECK(cr.data.scenarios[0].measurements.size() == 18);
}

TEST_CASE("samples that an input lacks reach the data set as what is bridged") {
    std::string table = "time,pump,level\n";
    for (int i = 0; i < 200; ++i) {
        bool const lost = i % 40 > 30;
        table += text_of(std::to_string(100 * i), lost ? ",," : ",2,", std::to_string(100 + i % 9),
                         "\n");
    }
    auto const with = [](std::string const& keys) {
        return replaced(csv_mapping, "\"column\": \"pump\"", "\"column\": \"pump\", " + keys);
    };
    CHECK_THAT(refusal(csv_mapping, table),
               ContainsSubstring("36 samples of this input are missing"));
    auto const r = import_csv(with("\"bridge\": 1"), table);
    auto const& u = r.data.scenarios[0].inputs[0];
    CHECK(u.missing == 36);
    REQUIRE(u.bridged.size() == 4);
    CHECK(u.bridged[0] == std::pair{3.0, 4.0});
    bool named = false;
    for (auto const& a : r.data.assumptions)
        named = named ||
                a.find("where samples are missing a straight line stands, though nobody knows") !=
                    std::string::npos;
    CHECK(named);
    auto const bounded =
        import_csv(with(R"("error": 0.1, "bridge": {"longest": 1, "error": 5})"), table);
    auto const& b = bounded.data.scenarios[0].inputs[0];
    CHECK(b.bridged.empty());
    CHECK(b.error[29] == 0.1);
    CHECK(b.error[30] == 5);
    CHECK(b.error[31] == 5);
    CHECK(b.error[32] == 0.1);
    auto const held =
        import_csv(replaced(with(R"("error": 0.1, "bridge": {"longest": 1, "error": 5})"),
                            "\"linear\"", "\"hold\""),
                   table);
    CHECK(held.data.scenarios[0].inputs[0].error[30] == 5);
    CHECK(held.data.scenarios[0].inputs[0].error[31] == 0.1);
    // Lines that a log lost, readings out of range, gaps; an input in every other line lacks none.
    auto const log = serial_lines(0, 9) + "9x,1,1\n" + serial_lines(100, 9);
    CHECK_THAT(refusal(serial_mapping, log),
               ContainsSubstring("1 sample of this input is missing"));
    auto const range =
        replaced(csv_mapping, "\"column\": \"pump\"", "\"column\": \"pump\", \"range\": [0, 9]");
    CHECK_THAT(refusal(range, "time,pump,level\n0,1,1\n1,1,1\n2,99,1\n3,1,1\n"),
               ContainsSubstring("1 sample of this input is missing, first before line 5"));
    CHECK(import_csv(csv_mapping, "time,pump,level\n0,1,1\n1,,1\n2,1,1\n3,,1\n4,1,1\n5,,1\n6,1,1\n")
              .data.scenarios[0]
              .inputs[0]
              .bridged.empty());
    // Windows: of each the gaps that lie in it.
    auto const windows =
        import_csv(replaced(with("\"bridge\": 1"), "\"initial\": { \"h\": [0, 1] }",
                            "\"initial\": {}, \"windows\": { \"length\": 2 }"),
                   table);
    CHECK(windows.data.scenarios[0].inputs[0].bridged.empty());
    CHECK(windows.data.scenarios[1].inputs[0].bridged == std::vector{std::pair{1.0, 2.0}});
}

TEST_CASE("the unit of times and of readings changes nothing but numbers") {
    std::mt19937_64 random{5};
    std::uniform_real_distribution<double> draw{-1, 1};
    std::vector<int> level;
    for (int i = 0; i < 400; ++i)
        level.push_back(static_cast<int>(std::lround(500 * std::sin(0.03 * i) + 4 * draw(random))));
    /// Times in a unit, `step` of it apart; readings with so many places after the point.
    auto const imported = [&](std::string const& unit, std::string const& step, int places) {
        std::string text = "time,pump,level\n";
        for (std::size_t i = 0; i < level.size(); ++i)
            text += text_of(dec(step).times(i).text(), i % 100 == 50 ? ",," : ",1,",
                            std::to_string(level[i]), "e", std::to_string(-places), "\n");
        auto mapping = replaced(csv_mapping, "\"ms\"", "\"" + unit + "\"");
        mapping = replaced(mapping, "\"factor\": 0.01, \"error\": 0.02", "\"error\": \"propose\"");
        mapping =
            replaced(mapping, "\"column\": \"pump\"", "\"column\": \"pump\", \"bridge\": 0.2");
        mapping = replaced(mapping, "\"initial\": { \"h\": [0, 1] }",
                           R"("thin": 3, "windows": { "length": 3, "every": 4, "holdout": 3 },
                              "initial": { "h": "propose" })");
        return import_csv(mapping, text);
    };
    auto const base = imported("ms", "100", 3);
    REQUIRE(base.data.scenarios.size() == 10);
    for (auto const& [unit, step] : {std::pair{"s", "0.1"}, {"us", "100000"}, {"ns", "1e8"}}) {
        auto const other = imported(unit, step, 3);
        REQUIRE(other.data.scenarios.size() == base.data.scenarios.size());
        for (std::size_t k = 0; k < base.data.scenarios.size(); ++k) {
            auto const &a = base.data.scenarios[k], &b = other.data.scenarios[k];
            CHECK(a.duration == b.duration);
            REQUIRE(a.measurements.size() == b.measurements.size());
            for (std::size_t i = 0; i < a.measurements.size(); ++i) {
                CHECK(a.measurements[i].time == b.measurements[i].time);
                CHECK(a.stated[i].value == b.stated[i].value);
                CHECK(a.stated[i].error == b.stated[i].error);
            }
            CHECK(a.inputs[0].bridged == b.inputs[0].bridged);
        }
    }
    for (int const places : {0, 6, 9, -3}) { // V, uV and so on
        CAPTURE(places);
        auto const other = imported("ms", "100", places);
        auto const scale = dec("1e" + std::to_string(3 - places));
        auto const &a = base.data.scenarios[1], &b = other.data.scenarios[1];
        REQUIRE(a.stated.size() == b.stated.size());
        CHECK(b.stated[0].error == a.stated[0].error.times(scale));
        CHECK(b.stated[7].value == a.stated[7].value.times(scale));
        auto const &p = base.protocol.bounds[0].candidates,
                   &q = other.protocol.bounds[0].candidates;
        REQUIRE(p.size() == q.size());
        for (std::size_t k = 0; k < p.size(); ++k) {
            CHECK_THAT(q[k].bound, WithinRel(p[k].bound * *nearest(scale), 1e-9));
            CHECK(p[k].from == q[k].from);
            CHECK(p[k].beyond == q[k].beyond);
        }
    }
}
