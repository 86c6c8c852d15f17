// SPDX-License-Identifier: MIT
#include <sivid/importing/table/detail/serial_log.hpp>

#include "io/import_support.hpp"

#include <algorithm>
#include <set>

using namespace sivid;
using namespace io_support;
using lines = std::vector<std::size_t>;

namespace {

struct cleaned {
    import_protocol protocol;
    std::vector<recorded_table> stretches;

    [[nodiscard]] lines kept(std::size_t stretch = 0) const {
        lines result;
        for (auto const& row : stretches.at(stretch).rows) result.push_back(row.line);
        return result;
    }
    [[nodiscard]] lines dropped(std::string const& reason) const { return noted(protocol, reason); }
};

std::string with(std::string const& policies) {
    return replaced(serial_mapping, "\"longest_gap\": 0.05", "\"longest_gap\": 0.05, " + policies);
}

/// Reads the log, and checks that every line is kept or dropped, and none both.
cleaned clean(std::string_view mapping, std::string const& log) {
    temporary_folder const folder;
    folder.write("mapping.json", mapping);
    auto const m = read_import_mapping(folder.path() / "mapping.json");
    cleaned result;
    result.stretches = read_serial_log(m.scenarios.at(0), log, result.protocol);
    std::multiset<std::size_t> seen;
    for (auto const& s : result.stretches)
        for (auto const& row : s.rows) seen.insert(row.line);
    for (auto const& n : result.protocol.notes())
        if (n.what == import_protocol::kind::dropped) seen.insert(n.lines.begin(), n.lines.end());
    std::multiset<std::size_t> all;
    for (auto const& l : lines_of(log)) all.insert(l.number);
    CHECK(seen == all);
    for (auto const& s : result.stretches)
        for (std::size_t i = 1; i < s.rows.size(); ++i)
            CHECK_FALSE(s.rows[i].time < s.rows[i - 1].time);
    return result;
}
std::string refused(std::string_view mapping, std::string const& log) {
    try {
        (void)clean(mapping, log);
    } catch (input_error const& e) {
        CHECK_FALSE(e.remedy().empty());
        return e.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("a clean log is taken as it is") {
    auto const c = clean(serial_mapping, "t_ms,pwm,enc\n# note\n\n" + serial_lines(500, 30));
    REQUIRE(c.stretches.size() == 1);
    CHECK(c.stretches[0].rows.size() == 30);
    CHECK(c.stretches[0].first_line == 4);
    CHECK(c.stretches[0].last_line == 33);
    CHECK(c.stretches[0].rows[0].time == dec("0.5"));
    CHECK(c.stretches[0].rows[29].time == dec("0.79"));
    CHECK(*c.stretches[0].rows[29].cells.at(1) == dec("129"));
    CHECK(c.dropped("heading") == lines{1});
    CHECK(c.dropped("blank or comment") == lines{2, 3});
}

TEST_CASE("garbled, cut and repeated lines are dropped with their numbers") {
    auto const c = clean(serial_mapping, "booting\n"
                                         "0,1,2\n"
                                         "10,1,2\n"
                                         "20,1\n"     // cut
                                         "30,1,2,3\n" // two lines in one
                                         "40,1,2\n"
                                         "40,1,2\n"        // repeated
                                         "40,1,7\n"        // same time, other readings
                                         "50,\x01\x02,2\n" // garbled
                                         "60,1,\n"         // missing reading
                                         ",1,2\n"          // missing time
                                         "70000,1,2\n"     // more than 16 bits
                                         "70,1e999,2\n"
                                         "80,1,2\n"
                                         "90,\"1,2\n"
                                         "100,1,2"); // no line end
    CHECK(c.kept() == lines{2, 3, 6, 8, 10, 14});
    CHECK(c.stretches[0].rows[3].time == c.stretches[0].rows[2].time);
    CHECK(c.dropped("not as many cells") == lines{1, 4, 5});
    CHECK(c.dropped("repeats") == lines{7});
    CHECK(c.dropped("a cell is not a number") == lines{9, 13});
    CHECK(c.dropped("the time is missing") == lines{11});
    CHECK(c.dropped("cannot show this time") == lines{12});
    CHECK(c.dropped("quotation mark") == lines{15});
    CHECK(c.dropped("no end") == lines{16});
    CHECK_FALSE(c.stretches[0].rows[4].cells.at(1));
}

TEST_CASE("the counter wraps") {
    auto const c = clean(serial_mapping, serial_lines(65000, 200));
    REQUIRE(c.stretches.size() == 1);
    REQUIRE(c.stretches[0].rows.size() == 200);
    for (std::size_t i = 0; i < 200; ++i)
        CHECK(c.stretches[0].rows[i].time == dec(std::to_string(65000 + 10 * i) + "e-3"));
    CHECK(c.dropped("the counter wraps from 65530 to 4") == lines{55}); // decided, not dropped
    // 32 bits, and twice round with 8 bits.
    auto const wide = replaced(serial_mapping, "\"counter_bits\": 16", "\"counter_bits\": 32");
    auto const w = clean(wide, "4294967280,1,2\n4294967290,1,2\n4,1,2\n14,1,2\n");
    CHECK(w.stretches[0].rows[3].time == dec("4294967.310"));
    auto const narrow = replaced(serial_mapping, "\"counter_bits\": 16", "\"counter_bits\": 8");
    auto const n = clean(narrow, serial_lines(0, 60, 8));
    CHECK(n.stretches[0].rows[59].time == dec("0.59"));
}

TEST_CASE("one garbled time moves no other") {
    for (std::string const bad : {"30000", "3", "65535", "12", "25", "49", "20", "60000"}) {
        CAPTURE(bad);
        auto const c = clean(with(R"("gap": "split", "restart": "split")"),
                             "0,1,2\n10,1,2\n20,1,2\n" + bad + ",5,5\n40,1,2\n50,1,2\n60,1,2\n");
        REQUIRE(c.stretches.size() == 1);
        // 25 and 20 are plausible; where a time goes back by less than a usual step, both
        // neighbours go.
        auto const expected = bad == "25" || bad == "20" ? lines{1, 2, 3, 4, 5, 6, 7}
                              : bad == "12"              ? lines{1, 2, 5, 6, 7}
                              : bad == "49"              ? lines{1, 2, 3, 6, 7}
                                                         : lines{1, 2, 3, 5, 6, 7};
        CHECK(c.kept() == expected);
    }
    // Several in a row, and at the ends.
    auto const c =
        clean(with(R"("gap": "split", "restart": "split")"),
              "333,1,2\n0,1,2\n10,1,2\n900,5,5\n7777,5,5\n2,5,5\n20,1,2\n30,1,2\n9999,1,2\n");
    CHECK(c.kept() == lines{2, 3, 7, 8});
    CHECK(c.dropped("no start") == lines{1});
}

TEST_CASE("a restart does what the mapping says") {
    auto const log = serial_lines(1000, 20) + "boot\n" + serial_lines(7, 10);
    CHECK_THAT(
        refused(serial_mapping, log),
        ContainsSubstring("line 22, column 1 (t_ms): restart: time goes from 1190 back to 7 ms; "
                          "state \"restart\""));
    auto const split = clean(with(R"("restart": "split")"), log);
    REQUIRE(split.stretches.size() == 2);
    CHECK(split.stretches[0].rows.size() == 20);
    CHECK(split.stretches[1].rows.size() == 10);
    CHECK(split.stretches[1].rows[0].time == dec("0.007"));
    CHECK(split.dropped("a gap of 64353 ms through the counter's end would look the same") ==
          lines{22});
    auto const drop = clean(with(R"("restart": "drop")"), log);
    REQUIRE(drop.stretches.size() == 1);
    CHECK(drop.stretches[0].rows.size() == 20);
    CHECK(drop.dropped("after a restart").size() == 10);
    // Without a counter nothing wraps, and there is no doubt.
    auto const plain =
        clean(replaced(with(R"("restart": "split")"), "\"counter_bits\": 16, ", ""), log);
    CHECK(plain.stretches.size() == 2);
    CHECK_FALSE(has_note(plain.protocol, "would look the same"));
}

TEST_CASE(
    "wrap or restart: near the counter's end a usual step is a wrap, a longer one a restart") {
    auto const near =
        clean(with(R"("restart": "split")"), "65500,1,2\n65510,1,2\n20,1,2\n30,1,2\n");
    CHECK(near.stretches.size() == 1);
    CHECK(near.dropped("a restart just there would look the same") == lines{3});
    auto const far = clean(with(R"("restart": "split")"), "65470,1,2\n65480,1,2\n20,1,2\n30,1,2\n");
    CHECK(far.stretches.size() == 2);
    CHECK(far.dropped("a gap of 76 ms through the counter's end") == lines{3});
}

TEST_CASE("a drop-out does what the mapping says") {
    auto const log = serial_lines(0, 10) + serial_lines(500, 10);
    CHECK_THAT(refused(serial_mapping, log),
               ContainsSubstring("line 11, column 1 (t_ms): gap from 90 to 500 ms; state \"gap\""));
    auto const kept = clean(with(R"("gap": "keep")"), log);
    CHECK(kept.stretches.size() == 1);
    CHECK(kept.stretches[0].rows.size() == 20);
    CHECK(kept.dropped("the inputs stand as interpolated across it") == lines{11});
    CHECK(kept.dropped("whole turns of the counter") == lines{11});
    auto const split = clean(with(R"("gap": "split")"), log);
    CHECK(split.stretches.size() == 2);
}

TEST_CASE("the longest gap is in seconds, whatever the unit of the time") {
    using entry = std::pair<std::string, std::string>; // a unit, one and a half of it
    for (auto const& [unit, gap] :
         {entry{"ns", "1.5e-9"}, entry{"us", "1.5e-6"}, entry{"ms", "0.0015"}, entry{"s", "1.5"},
          entry{"min", "90"}, entry{"h", "5400"}}) {
        CAPTURE(unit);
        auto const mapping = replaced(replaced(with(R"("gap": "split")"), "0.05", gap),
                                      R"("ms", "counter_bits": 16)", "\"" + unit + "\"");
        auto const c = clean(mapping, "0,1,2\n1,1,2\n2.5,1,2\n4.1,1,2\n5.1,1,2\n");
        REQUIRE(c.stretches.size() == 2);
        CHECK(c.kept(0) == lines{1, 2, 3});
        CHECK(c.kept(1) == lines{4, 5});
    }
}

TEST_CASE("logs in seconds, with other separators and fields that do not matter") {
    auto mapping = replaced(
        serial_mapping, R"("fields": ["t_ms", "pwm", "enc"])",
        R"("separator": ";", "decimal": ",", "missing": ["nan"], "fields": ["_", "t_ms", "pwm", "enc", "_"])");
    mapping = replaced(mapping, R"("unit": "ms", "counter_bits": 16)", R"("unit": "s")");
    auto const c = clean(mapping, "D;0,01;1;2;ok\nD;0,02;nan;3;%$\nD;0,035;1;4;\n");
    REQUIRE(c.stretches[0].rows.size() == 3);
    CHECK(c.stretches[0].rows[2].time == dec("0.035"));
    CHECK_FALSE(c.stretches[0].rows[1].cells[0]);
}

TEST_CASE("a log without a line of the stream is refused") {
    for (std::string const log : {"", "\n\n", "boot\n", "0,1,2", "1;2;3\n4;5;6\n"})
        CHECK_THAT(refused(serial_mapping, log), ContainsSubstring("no line counts"));
    // The unit is wrong: no line goes on from another.
    CHECK_THAT(refused(replaced(serial_mapping, "\"unit\": \"ms\"", "\"unit\": \"s\""),
                       serial_lines(0, 9)),
               ContainsSubstring("longest_gap"));
    CHECK_THAT(
        refused(replaced(serial_mapping, "\"column\": \"pwm\"", "\"column\": \"pw\""), "0,1,2\n"),
        ContainsSubstring("/scenarios/0/inputs/u/column"));
    CHECK_THAT(
        refused(replaced(serial_mapping, "[\"t_ms\", \"pwm\"", "[\"t_ms\", \"_\""), "0,1,2\n"),
        ContainsSubstring("/scenarios/0/inputs/u/column"));
    auto by_number = replaced(serial_mapping, "[\"t_ms\", \"pwm\"", "[\"t_ms\", \"_\"");
    by_number = replaced(by_number, "\"column\": \"pwm\"", "\"column\": 2");
    CHECK_THAT(refused(by_number, "0,1,2\n"), ContainsSubstring("a field called _ is mapped"));
}

TEST_CASE("a long log takes no longer than its length") {
    std::string log;
    log = "0,1,2\n";
    for (int i = 0; i < 20000; ++i) log += "5,1,2\n"; // one time over and over
    for (int i = 0; i < 20000; ++i) log += i % 2 ? "9,1,2\n" : "60000,1,2\n"; // to and fro
    auto const c =
        clean(with(R"("gap": "keep", "restart": "drop")"), log + std::string(100000, '7'));
    CHECK(c.stretches[0].rows.size() >= 1);
}

TEST_CASE("lines with check sums: those of other implementations, and every single damage") {
    // CRC-16/CCITT-FALSE of "123456789" is 29B1, of nothing FFFF.
    CHECK(without_check_sum("123456789*29B1") == "123456789");
    CHECK(without_check_sum("123456789*29b1") == "123456789");
    CHECK(without_check_sum("*FFFF") == "");
    for (auto const* bad :
         {"", "*", "123456789", "123456789*29B", "123456789*29B2", "123456789 29B1",
          "123456789*-9B1", "123456789*29G1", "12345678*29B1", "*FFF"})
        CHECK_FALSE(without_check_sum(bad));
    std::string const line = "4294966296,80,-512,1023*";
    unsigned sum = 0;
    for (; sum < 0x10000; ++sum) { // found by trying, as a reader would
        constexpr char const* digits = "0123456789ABCDEF";
        std::string whole = line;
        for (int shift = 12; shift >= 0; shift -= 4) whole += digits[sum >> shift & 0xF];
        if (!without_check_sum(whole)) continue;
        for (std::size_t i = 0; i + 5 < whole.size(); ++i)
            for (int bit = 0; bit < 8; ++bit) {
                auto damaged = whole;
                damaged[i] = static_cast<char>(damaged[i] ^ (1 << bit));
                CHECK_FALSE(without_check_sum(damaged));
            }
        break;
    }
    CHECK(sum < 0x10000);
}
