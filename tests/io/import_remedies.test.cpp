// SPDX-License-Identifier: MIT
// Each refusal of an import says what to do. Here that is done, and the import then passes.
#include "io/import_support.hpp"

using namespace sivid;
using namespace io_support;

namespace {

/// A refused import, what its message has to say, and what somebody does who follows it.
struct refusal_case {
    std::string mapping, file, says;
    std::string mended_mapping, mended_file;
};

void check(std::vector<refusal_case> const& all) {
    for (auto const& c : all) {
        CAPTURE(c.mapping, c.file, c.says);
        auto const message = refusal(c.mapping, c.file);
        CHECK_THAT(message, ContainsSubstring(c.says));
        temporary_folder const folder;
        CAPTURE(message, c.mended_mapping, c.mended_file);
        folder.write("mapping.json", c.mended_mapping);
        folder.write("a.csv", c.mended_file);
        folder.write("a.log", c.mended_file);
        CHECK_NOTHROW(import_in(folder));
    }
}

std::string csv(std::string const& keys) {
    return replaced(csv_mapping, "\"kind\": \"csv\"", "\"kind\": \"csv\", " + keys);
}
std::string csv_time(std::string const& time) {
    return replaced(csv_mapping, R"("column": "time", "unit": "ms", "offset": 0)", time);
}
std::string serial(std::string const& keys) {
    return replaced(serial_mapping, "\"longest_gap\": 0.05", "\"longest_gap\": 0.05, " + keys);
}
std::string const plain{csv_mapping}, table{small_table}, stream{serial_mapping};
std::string const head = "time,pump,level\n";

std::string utf16(std::string const& text) {
    std::string result = "\xFF\xFE";
    for (char const c : text) result += std::string{c, '\0'};
    return result;
}
std::string without_line(std::string text, std::string const& line) {
    return replaced(text, line + "\n", "");
}

} // namespace

TEST_CASE("remedies: files that are no lines of text") {
    auto cr = table;
    std::replace(cr.begin(), cr.end(), '\n', '\r');
    auto const nbsp = replaced(table, ",101,",
                               ",\xC2\xA0"
                               "101,");
    check({{plain, utf16(table), "the file is UTF-16; convert it to UTF-8", plain, table},
           {plain, utf16(table).substr(2), "UTF-16", plain, table},
           {plain, cr, "end with CR alone; convert the line ends", plain, table},
           {plain, table + std::string(4, '\0'), "line 6: the line holds a NUL byte", plain, table},
           {plain, replaced(table, "101,2\n", "101,2\r"), "line 3: the line holds a CR", plain,
            table},
           {plain, nbsp, "it holds a no-break space (U+00A0): remove it", plain, table},
           {stream, utf16(serial_lines(0, 9)), "UTF-16", stream, serial_lines(0, 9)},
           {plain, replaced(table, "level", "level\xC2\xA0"), "one of them holds a no-break space",
            plain, table}});
}

TEST_CASE("remedies: lines of several kinds") {
    auto const kinds = "kind,time,pump,level\nIMU,0,1,100\nGPS,50,1,57\nIMU,100,1,101\n";
    auto const says = "in a column that is not mapped: 'IMU' (2 lines), 'GPS' (1 line); state";
    auto const log = "IMU,0,1,100\nGPS,5,1,57\nIMU,10,1,101\nMODE,15,1,4\nIMU,20,1,101\n";
    auto const fields = replaced(stream, "[\"t_ms\"", "[\"_\", \"t_ms\"");
    auto const chosen = replaced(fields, "0.05", R"(0.05, "lines": {"column": 1, "is": "IMU"})");
    check(
        {{plain, kinds, says, csv(R"("lines": {"column": 1, "is": "IMU"})"), kinds},
         {plain, kinds, says, csv(R"("lines": {"column": "kind", "is": ["GPS", "IMU"]})"), kinds},
         {plain, kinds, "or \"lines\": \"all\"", csv(R"("lines": "all")"), kinds},
         {csv(R"("lines": {"column": 1, "is": "MOT"})"), kinds,
          "no line has 'MOT' in this column; write one of these: 'GPS' (1 line), 'IMU' (2 lines)",
          csv(R"("lines": {"column": 1, "is": "IMU"})"), kinds},
         {fields, log, "'IMU' (3 lines), 'GPS' (1 line), 'MODE' (1 line); state", chosen, log},
         {fields, "1,0,1,100\n2,5,1,57\n1,10,1,101\n2,15,1,58\n",
          "whole numbers take turns in a column that is not mapped: '1' (2 lines), '2' (2 lines)",
          replaced(fields, "0.05", R"(0.05, "lines": {"column": 1, "is": 1})"),
          "1,0,1,100\n2,5,1,57\n1,10,1,101\n2,15,1,58\n"},
         {csv(R"("lines": "some")"), table, "write \"all\" or", csv(R"("lines": "all")"), table}});
}

TEST_CASE("remedies: a mode that changes seldom is no kind of lines") {
    auto const fields = replaced(stream, "[\"t_ms\"", "[\"_\", \"t_ms\"");
    std::string modes;
    for (int i = 0; i < 12; ++i)
        modes += std::to_string(i / 4 % 2) + "," + std::to_string(10 * i) + ",1,100\n";
    temporary_folder const folder;
    folder.write("mapping.json", fields);
    folder.write("a.log", modes);
    CHECK_NOTHROW(import_in(folder));
}

TEST_CASE("remedies: headings") {
    auto const by_number =
        replaced(replaced(replaced(plain, "\"time\",", "1,"), "\"pump\"", "2"), "\"level\"", "3");
    auto const keyed = [&](std::string const& keys) {
        return replaced(by_number, "\"kind\": \"csv\"", "\"kind\": \"csv\", " + keys);
    };
    auto const rows = table.substr(table.find('\n') + 1);
    auto const units = replaced(table, "bound\n", "bound\n[ms],V,cm,cm\n");
    auto const dashes = replaced(table, "bound\n", "bound\n[s],-,[cm],\n");
    auto const commented = "# recorded by hand\n#" + table;
    check({{plain, "Logger 3\n" + table, "skip_lines", csv("\"skip_lines\": 1"),
            "Logger 3\n" + table},
           {plain, commented,
            "line 2 was skipped as a comment: if it is the heading, name the columns "
            "as they stand there: '#time', 'pump'",
            replaced(plain, "\"column\": \"time\"", "\"column\": \"#time\""), commented},
           {by_number, rows, "state \"heading\"", keyed("\"heading\": false"), rows},
           {plain, units,
            "line 2: no mapped cell of the first line below the heading is a number: it "
            "may name units; state \"skip_after_heading\": 1",
            csv("\"skip_after_heading\": 1"), units},
           {plain, dashes, "state \"skip_after_heading\": 1", csv("\"skip_after_heading\": 1"),
            dashes},
           {plain, table + "time,pump,level,bound\n400,1,1,1\n",
            "line 6: the heading stands here again: files were joined; remove the line", plain,
            table + "400,1,1,1\n"},
           {plain, "time,pump,pump,level\n0,1,1,2\n1,1,1,2\n", "name the column by its number",
            replaced(plain, "\"pump\"", "2"), "time,pump,pump,level\n0,1,1,2\n1,1,1,2\n"},
           {replaced(plain, "\"level\",", "9,"), table, "has 4 columns, not 9",
            replaced(plain, "\"level\",", "3,"), table},
           {keyed("\"heading\": false, \"skip_after_heading\": 1"), "x\n" + rows,
            "count these lines under \"skip_lines\"",
            keyed("\"heading\": false, \"skip_lines\": 1"), "x\n" + rows}});
}

TEST_CASE("remedies: lines with cells too few or too many") {
    auto const cut = replaced(table, "300,2.5,103.5,4", "300,2.5,103.5");
    auto const more = replaced(table, "300,2.5,103.5,4", "300,2.5,103.5,4,5");
    auto const says = "3 cells in a table of 4 columns; state \"short_lines\": \"missing\"";
    auto const as_log = replaced(
        plain, "\"kind\": \"csv\"",
        R"("kind": "serial", "fields": ["time", "pump", "level", "bound"], "longest_gap": 0.5)");
    check(
        {{plain, cut, says, csv("\"short_lines\": \"missing\""), cut},
         {plain, cut, "correct the line", plain, table},
         {plain, more, "5 cells in a table of 4 columns; correct the line", plain, table},
         {plain, more, "or import the file as a serial log, which drops such lines", as_log, more},
         {plain, replaced(table, "1.5,101", "\"1.5,101"), "quote whole cells", plain,
          replaced(table, "1.5,101", "\"1.5\",101")}});
}

TEST_CASE("remedies: cells that are no numbers") {
    std::vector<refusal_case> all;
    for (std::string const text : {"NaN", "inf", "-", "N/A", "---", "overflow"}) {
        auto const with = replaced(table, ",101,", "," + text + ",");
        all.push_back({plain, with, "list the text under \"missing\"",
                       csv("\"missing\": [\"" + text + "\"]"), with});
    }
    auto const comma = "time;pump;level\n0;1,5;100\n100;1,5;101\n";
    auto const thousands = "time;pump;level\n0;1,5;1.000,5\n100;1,5;101\n";
    auto const german = csv(R"("separator": ";", "decimal": ",")");
    all.push_back({csv("\"separator\": \";\""), comma, "state the mark of decimals (\"decimal\"",
                   german, comma});
    all.push_back({german, thousands, "no marks between thousands", german,
                   replaced(thousands, "1.000,5", "1000,5")});
    all.push_back({plain, replaced(table, ",101,", ",0x65,"),
                   "it may be hexadecimal: write decimal", plain, table});
    all.push_back({plain, replaced(table, "100,1.5", ",1.5"),
                   "the time is missing; state it or remove", plain, table});
    all.push_back({plain, replaced(table, "100,1.5", "1oo,1.5"),
                   "is no time of the unit that the mapping states; correct it, or remove the line",
                   plain, without_line(table, "100,1.5,101,2")});
    // A field of a log that often holds no number.
    std::string hexadecimal, decimal;
    for (int i = 0; i < 20; ++i) {
        hexadecimal += std::to_string(10 * i) + ",1," + "0123456789ABCDEF"[i % 16] + "0\n";
        decimal += std::to_string(10 * i) + ",1," + std::to_string(16 * (i % 16)) + "\n";
    }
    all.push_back({stream, hexadecimal,
                   "'A0' is no number, and 6 of 20 lines have none there; it may be hexadecimal",
                   stream, decimal});
    auto const named = replaced(stream, "[\"t_ms\"", "[\"tag\", \"t_ms\"");
    all.push_back({named, "IMU,0,1,2\nIMU,10,1,2\nIMU,20,1,2\n", "call the field \"_\"",
                   replaced(stream, "[\"t_ms\"", "[\"_\", \"t_ms\""),
                   "IMU,0,1,2\nIMU,10,1,2\nIMU,20,1,2\n"});
    check(all);
}

TEST_CASE("remedies: times") {
    auto const zoned = csv_time(R"("column": "time", "unit": "iso8601", "offset": "first")");
    auto const clock = csv_time(R"("column": "time", "unit": "hh:mm:ss", "offset": "first")");
    auto const rows = [](std::vector<std::string> const& times) {
        std::string text = head;
        for (auto const& t : times) text += t + ",1,100\n";
        return text;
    };
    auto const dates = rows({"2026-11-29T12:00:00Z", "2026-11-29T12:00:01Z"});
    auto const bare = rows({"2026-11-29T12:00:00", "2026-11-29T12:00:01"});
    auto const slashed = rows({"11/12/2026 12:00:00", "11/12/2026 12:00:01"});
    auto const zones = rows({"2026-11-29T12:00:00+01:00", "2026-11-29T13:00:01+02:00"});
    auto const leap =
        rows({"2026-11-29T12:00:00Z", "2026-12-31T23:59:60Z", "2027-01-01T00:00:00Z"});
    auto const log = R"("source": { "kind": "serial", "fields": ["time", "pump", "level"],
                        "longest_gap": 0.2, "restart": "drop" })";
    auto const as_log = replaced(plain, R"("source": { "kind": "csv" })", log);
    auto const wrapping = replaced(replaced(as_log, ", \"restart\": \"drop\"", ""),
                                   "\"unit\": \"ms\"", "\"unit\": \"ms\", \"counter_bits\": 16");
    auto const back = head + "0,1,100\n100,1,101\n200,1,102\n0,1,100\n100,1,101\n";
    auto const wrapped = head + "65400,1,100\n65500,1,101\n64,1,102\n164,1,103\n";
    auto const twice = head + "0,1,100\n100,1,101\n100,1,105\n200,1,102\n";
    auto const says_back =
        "line 5, column 1 (time): the time goes back from 0.2 to 0 s; the recorder";
    auto const says_twice = "the time '0.1' s is that of line 3, with other readings; state";
    check(
        {{plain, dates, "is a date; state \"unit\": \"iso8601\"", zoned, dates},
         {plain, rows({"9:00:00", "9:00:01"}), "is a time of day; state \"unit\": \"hh:mm:ss\"",
          clock, rows({"9:00:00", "9:00:01"})},
         {zoned, rows({"9:00:00", "9:00:01"}), "is a time of day; state \"unit\": \"hh:mm:ss\"",
          clock, rows({"9:00:00", "9:00:01"})},
         {plain, bare, "is a date without an offset from UTC; write Z or the offset behind each",
          zoned, dates},
         {plain, slashed,
          "nobody knows the order of day, month and year; write it as ISO 8601 does", zoned, dates},
         {zoned, zones, "another offset from UTC than the times before; write all times with one",
          zoned, rows({"2026-11-29T11:00:00Z", "2026-11-29T11:00:01Z"})},
         {zoned, leap, "is a leap second: seconds of a day do not count it; leave the line out",
          zoned, without_line(leap, "2026-12-31T23:59:60Z,1,100")},
         {plain, back, says_back, plain, head + "0,1,100\n100,1,101\n200,1,102\n"},
         {plain, back, "as a serial log (\"kind\": \"serial\") with \"restart\"", as_log, back},
         {replaced(plain, "\"offset\": 0", "\"offset\": -65.4"), wrapped, "\"counter_bits\"",
          replaced(wrapping, "\"offset\": 0", "\"offset\": \"first\""), wrapped},
         {plain, twice, says_twice, csv("\"same_time\": \"first\""), twice},
         {plain, twice, "\"first\" or \"last\" for which of them counts",
          csv("\"same_time\": \"last\""), twice},
         {plain, twice, "state the time's \"sample_time\" instead of its column",
          csv_time(R"("sample_time": 0.05)"), twice},
         {csv("\"same_time\": \"none\""), table, "write refuse, first or last",
          csv("\"same_time\": \"last\""), table},
         {csv_time(R"("column": "time", "unit": "fortnight", "offset": 0)"), table,
          "write s, ms, us, ns, min, h or d", plain, table},
         {csv_time(R"("column": "time", "unit": "ms", "offset": 0, "counter_bits": 16)"), table,
          "counters that wrap need a serial source", plain, table},
         {csv_time(R"("column": "time", "unit": "ms", "offset": 0, "sample_time": 1)"), table,
          "keep one of the two", plain, table}});
}

TEST_CASE("remedies: logs") {
    auto const gap = serial_lines(0, 9) + serial_lines(500, 9);
    auto const bridged = [](std::string const& mapping) {
        return replaced(mapping, "\"column\": \"pwm\"", "\"column\": \"pwm\", \"bridge\": 0.5");
    };
    auto const restart = serial_lines(1000, 20) + serial_lines(7, 10);
    auto const uncounted = replaced(stream, "\"counter_bits\": 16, ", "");
    auto const wide = "0,1,2,9\n10,1,2,9\n20,1,2,9\n";
    auto const same = "0,1,100\n10,1,101\n10,1,105\n20,1,102\n";
    auto const step = "0,1,100\n10,1,101\n10,2,101\n20,2,102\n";
    auto const linear = replaced(stream, "\"hold\"", "\"linear\"");
    auto const dates = "2026-11-29T12:00:00Z,1,2\n2026-11-29T12:00:00.01Z,1,3\n"
                       "2026-11-29T12:00:00.02Z,1,4\n";
    check(
        {{stream, gap, "state \"gap\" in the mapping's source: keep or split",
          bridged(serial("\"gap\": \"keep\"")), gap},
         {stream, gap, "keep or split", serial("\"gap\": \"split\""), gap},
         {stream, restart, "state \"restart\" in the mapping's source: drop, or split",
          serial("\"restart\": \"drop\""), restart},
         {stream, restart, "or split with the time's \"offset\": \"first\"",
          serial("\"restart\": \"split\""), restart},
         {uncounted, serial_lines(65000, 99),
          "if it is a counter that wraps there, the time's "
          "\"counter_bits\": 16",
          stream, serial_lines(65000, 99)},
         {stream, wide, "most have 4 cells, and 3 fields are named; name each cell",
          replaced(stream, "\"enc\"]", "\"enc\", \"_\"]"), wide},
         {stream, dates, "is a date, and 3 of 3 lines have none there; state \"unit\": \"iso8601\"",
          replaced(stream, "\"unit\": \"ms\", \"counter_bits\": 16", "\"unit\": \"iso8601\""),
          dates},
         {stream, same, "the channel 'x' has another value in line 2",
          serial("\"same_time\": \"last\""), same},
         {stream, same, "\"same_time\": \"first\"", serial("\"same_time\": \"first\""), same},
         {linear, step, "or \"interpolation\": \"hold\", which steps there", stream, step},
         {replaced(stream, "[\"t_ms\", \"pwm\"", "[\"t_ms\", \"_\""), wide, "has no column 'pwm'",
          replaced(stream, "\"enc\"]", "\"enc\", \"_\"]"), wide},
         {replaced(serial("\"gap\": \"split\""), "\"first\"", "0"), gap,
          "state \"offset\": \"first\"", serial("\"gap\": \"split\""), gap}});
}

TEST_CASE("remedies: inputs, windows and starts") {
    std::string rows = head;
    for (int i = 0; i < 60; ++i)
        rows += std::to_string(100 * i) + "," + (i % 20 == 7 ? "" : "1") + "," +
                std::to_string(100 + i % 7) + "\n";
    auto const full = [] {
        std::string text = head;
        for (int i = 0; i < 60; ++i)
            text += std::to_string(100 * i) + ",1," + std::to_string(100 + i % 7) + "\n";
        return text;
    }();
    auto const pump = [](std::string const& keys) {
        return replaced(csv_mapping, "\"column\": \"pump\"", "\"column\": \"pump\", " + keys);
    };
    auto const says =
        "3 samples of this input are missing, first before line 10; the longest time from "
        "a sample to the next is 0.2 s; nobody knows what it did there: state \"bridge\": "
        "0.2 if a straight line stands there";
    auto const window = [](std::string const& keys) {
        return replaced(csv_mapping, "\"initial\": { \"h\": [0, 1] }",
                        "\"initial\": { \"h\": [0, 1] }, \"windows\": { " + keys + " }");
    };
    auto const offset = [](std::string const& t) {
        return replaced(csv_mapping, "\"offset\": 0", "\"offset\": " + t);
    };
    auto const start = [](std::string const& h) { return replaced(csv_mapping, "[0, 1]", h); };
    auto const late = replaced(full, "0,1,100\n", "0,1,\n");
    check({{plain, rows, says, pump("\"bridge\": 0.2"), rows},
           {pump("\"bridge\": 0.1"), rows, "longer than \"bridge\" allows", pump("\"bridge\": 0.2"),
            rows},
           {plain, rows, "\"bridge\": {\"longest\": 0.2, \"error\": E}",
            pump(R"("bridge": {"longest": 0.2, "error": 3}, "error": 0.1)"), rows},
           {pump(R"("bridge": {"longest": 0.2, "error": 3})"), rows,
            "state the \"error\" of its readings as well",
            pump(R"("bridge": {"longest": 0.2, "error": 3}, "error": 0.1)"), rows},
           {replaced(plain, "\"error\": 0.02", "\"error\": 0.02, \"bridge\": 1"), table,
            "a channel is measured where it has readings alone; remove this key", plain, table},
           {offset("1"), full, "or \"first\"", offset("\"first\""), full},
           {replaced(plain, "\"interpolation\"", "\"duration\": 9, \"interpolation\""), full,
            "state a shorter duration, or none", plain, full},
           {offset("-9"), full, "check the time's offset", plain, full},
           {window("\"length\": 9"), full, "state a shorter \"length\"", window("\"length\": 2"),
            full},
           {window("\"length\": 1e-4"), full, "state a longer \"every\", or a \"count\"",
            window("\"length\": 0.5, \"every\": 1"), full},
           {window("\"length\": 2, \"every\": 1"), full, "state at least the length",
            window("\"length\": 2, \"every\": 2"), full},
           {window("\"length\": 1, \"holdout\": [99]"), full, "correct \"holdout\"",
            window("\"length\": 1, \"holdout\": [2]"), full},
           {start("\"propose\""), late, "state its box", start("[0, 2]"), late},
           {start("\"propose\""), late, "\"rate\": ...}", start(R"({"channel": "h", "rate": 5})"),
            late},
           {replaced(plain, "\"error\": 0.02", "\"error\": \"propose\""), table,
            "state it as a number", plain, table},
           {pump("\"factor\": [0.9, 1.1]"), full, "state an \"error\"",
            pump("\"factor\": [0.9, 1.1], \"error\": 0.1"), full},
           {pump("\"factor\": 0"), full, "a reading times 0 says nothing", pump("\"factor\": 1"),
            full}});
}
