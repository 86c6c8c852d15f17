// SPDX-License-Identifier: MIT
#include <sivid/importing/table/detail/time_text.hpp>

#include "io/import_support.hpp"

using namespace sivid;
using namespace io_support;

namespace {
std::string seconds(std::string_view text) {
    auto const date = read_date(text);
    return date ? date->seconds.text() : "none";
}
std::string of_day(std::string_view text) {
    auto const clock = read_time_of_day(text);
    return clock ? clock->text() : "none";
}
} // namespace

TEST_CASE("dates of ISO 8601 are seconds, exactly") {
    CHECK(seconds("1970-01-01T00:00:00Z") == "0");
    CHECK(seconds("2026-11-29T04:44:58Z") == "1795927498"); // date -u -d ... +%s
    CHECK(seconds("2026-11-29 05:44:58+01:00") == "1795927498");
    CHECK(seconds("2026-11-28t23:14:58-0530") == "1795927498");
    CHECK(seconds("2026-11-29T05:44:58+01") == "1795927498");
    CHECK(seconds("2024-02-29T00:00:00.1Z") == "1709164800.1");
    CHECK(seconds("2024-02-29T00:00:00,000000001Z") == "1709164800.000000001");
    CHECK(seconds("2026-11-28T24:00:00Z") == seconds("2026-11-29T00:00:00Z"));
    CHECK(seconds("1969-12-31T23:59:59.5Z") == "-0.5");
    CHECK_FALSE(read_date("2026-11-29T04:44:58")->offset);
    for (auto const* bad :
         {"", "2026-11-29", "2026-02-29T00:00:00Z", "2026-13-01T00:00:00Z", "2026-11-29T24:00:01Z",
          "2026-11-29T25:00:00Z", "2026-11-29T12:60:00Z", "2026-12-31T23:59:60Z",
          "29/11/2026 12:00:00", "11/29/2026 12:00:00", "2026-11-29T12:00:00.Z",
          "2026-11-29T12:00:00+1", "2026-11-29T12:00:00+01:", "2026-11-29T12:00:00Zx",
          "2026-11-29T12:00:00+25:00", "-2026-11-29T12:00:00Z", "12:00:00"}) {
        CAPTURE(bad);
        CHECK(seconds(bad) == "none");
    }
}

TEST_CASE("times of day are seconds since midnight, exactly") {
    CHECK(of_day("00:00:00") == "0");
    CHECK(of_day("9:05:07") == "32707");
    CHECK(of_day("23:59:59.999") == "86399.999");
    CHECK(of_day("23:59:59,5") == "86399.5");
    CHECK(of_day("24:00:00") == "86400");
    for (auto const* bad : {"", "12:00", "24:00:01", "24:00:00.1", "1:2:3", "12:00:60", "12:00:00 ",
                            "12:00:00.", "-1:00:00", "12h00"}) {
        CAPTURE(bad);
        CHECK(of_day(bad) == "none");
    }
}

TEST_CASE("the zone of dates stays, and what is no time is named") {
    time_mapping time;
    time.form = time_form::date;
    stamp_reader dates{time, '.'};
    CHECK_FALSE(dates.other_offset("2026-11-29T12:00:00+01:00"));
    CHECK_FALSE(dates.other_offset("2026-11-29T12:00:01+0100"));
    CHECK(dates.other_offset("2026-11-29T12:00:01Z"));
    CHECK_FALSE(dates("2026-11-29T12:00:00"));
    CHECK_FALSE(dates("17"));
    stamp_reader const plain{{}, ','};
    CHECK(*plain("1,5") == dec("1.5"));
    CHECK_THAT(plain.about("2026-11-29T12:00:00Z")->remedy, ContainsSubstring("iso8601"));
    CHECK_THAT(plain.about("12:00:00")->remedy, ContainsSubstring("hh:mm:ss"));
    CHECK_THAT(plain.about("29/11/2026 12:00")->problem, ContainsSubstring("the order of day"));
    CHECK_THAT(plain.about("11/29/2026")->problem, ContainsSubstring("the order of day"));
    CHECK_THAT(plain.about("29.11.2026 12:00:00")->problem, ContainsSubstring("the order of day"));
    CHECK_THAT(plain.about("2026-11-29")->problem, ContainsSubstring("no complete date"));
    CHECK_THAT(plain.about("23:59:60")->problem, ContainsSubstring("leap second"));
    CHECK_FALSE(plain.about("1o0"));
    CHECK_FALSE(plain.about("1.5"));
}

namespace {
std::string table(std::vector<std::string> const& times) {
    std::string text = "time,pump,level\n";
    for (auto const& t : times) text += "\"" + t + "\",1,100\n";
    return text;
}
std::vector<double> times_of(imported_dataset const& r) {
    std::vector<double> times;
    for (auto const& m : r.data.scenarios.at(0).measurements) times.push_back(m.time);
    return times;
}
} // namespace

TEST_CASE("tables and logs with dates and clocks have the same times as with seconds") {
    using list = std::vector<double>;
    auto const with = [](std::string const& unit) {
        return replaced(csv_mapping, R"("unit": "ms", "offset": 0)",
                        "\"unit\": \"" + unit + "\", \"offset\": \"first\"");
    };
    CHECK(times_of(
              import_csv(with("iso8601"), table({"2026-10-24T23:59:59.9Z", "2026-10-25T00:00:00,1Z",
                                                 "2026-10-25T00:00:00.3Z"}))) == list{0, 0.2, 0.4});
    auto const r = import_csv(with("hh:mm:ss"),
                              table({"23:59:59.9", "00:00:00.1", "0:00:00.3", "00:00:00.5"}));
    CHECK(times_of(r) == list{0, 0.2, 0.4, 0.6});
    CHECK(noted(r.protocol, "one midnight has passed") == std::vector<std::size_t>{3});
    CHECK(times_of(import_csv(with("hh:mm:ss"), table({"23:59:59", "24:00:00", "00:00:01"}))) ==
          list{0, 1, 2});
    // Twice round the clock.
    CHECK(times_of(import_csv(with("hh:mm:ss"), table({"00:00:00", "12:00:00", "23:00:00",
                                                       "10:00:00", "21:00:00", "08:00:00"}))) ==
          list{0, 43200, 82800, 122400, 162000, 201600});
    CHECK_THAT(refusal(with("hh:mm:ss"), table({"12:00:00", "12:00:02", "12:00:01"})),
               ContainsSubstring("goes back"));
    auto const log = [](std::string const& unit) {
        return replaced(replaced(serial_mapping, R"("unit": "ms", "counter_bits": 16)",
                                 "\"unit\": \"" + unit + "\""),
                        "0.05", "2");
    };
    auto const lines = [](std::vector<std::string> const& times) {
        std::string text;
        for (auto const& t : times) text += t + ",1,100\n";
        return text;
    };
    auto const midnight =
        import_serial(log("hh:mm:ss"), lines({"23:59:58", "23:59:59", "00:00:00", "00:00:01.25"}));
    CHECK(times_of(midnight) == list{0, 1, 2, 3.25});
    CHECK(has_note(midnight.protocol, "the clock wraps from 86399 to 0"));
    CHECK(times_of(import_serial(log("iso8601"),
                                 lines({"2026-11-29T23:59:59Z", "2026-11-30T00:00:00Z", "garbled",
                                        "2026-11-30T00:00:01Z"}))) == list{0, 1, 2});
    CHECK_THAT(
        refusal(log("iso8601"), lines({"2026-11-29T23:59:59Z", "2026-11-30T01:00:00+01:00"})),
        ContainsSubstring("another offset from UTC"));
}
