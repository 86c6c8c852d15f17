// SPDX-License-Identifier: MIT
// Random damage to mappings and recorded files: the import refuses them with input_error, or gives
// a data set that the reader accepts. Nothing else happens.
#include <sivid/importing/import_writer.hpp>

#include "io/damaged_text.hpp"
#include "io/import_support.hpp"
#include "support/sweep.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

using namespace sivid;
using namespace io_support;

namespace {

using generator = std::mt19937_64;

std::string rich_mapping(generator& random, bool serial) {
    bool const windows = random() % 2 == 0;
    if (!serial) {
        auto text = replaced(
            replaced(csv_mapping, "\"column\": \"pump\"",
                     "\"column\": \"pump\", \"error\": 0.1, \"factor\": [0.9, 1.1], \"bridge\": 1"),
            "\"error\": 0.02", "\"error\": {\"column\": \"bound\"}");
        if (!windows) return text;
        return replaced(
            text, "\"initial\": { \"h\": [0, 1] }",
            R"("initial": { "h": "propose", "v": { "rate_of": "h", "acceleration": 9e9 } },
        "thin": 2, "windows": { "length": 0.04, "every": 0.05, "first": 0.01, "count": 3,
                                "holdout": [2], "initial": { "w": [0, 1] } })");
    }
    auto text =
        replaced(serial_mapping, "\"longest_gap\": 0.05",
                 R"("missing": ["nan"], "longest_gap": 0.05, "gap": "split", "restart": "split")");
    text = replaced(
        text, "\"column\": \"enc\", \"error\": 1",
        R"("column": "enc", "counter_bits": 16, "factor": 2, "divisor": 3, "error": "propose")");
    text = replaced(text, "\"column\": \"pwm\"",
                    random() % 2 == 0 ? "\"column\": \"pwm\", \"bridge\": 9"
                                      : "\"column\": \"pwm\", \"error\": 1, \"bridge\": "
                                        "{\"longest\": 9, \"error\": 5}");
    if (!windows) return text;
    return replaced(text, "\"initial\": {}",
                    R"("initial": { "x": { "channel": "x", "rate": 2e6 } },
        "windows": { "length": 0.25, "holdout": 2 })");
}

std::string rich_log(generator& random) {
    std::string text = "booting\nt_ms,pwm,enc\n";
    unsigned t = 65000;
    for (int i = 0; i < 80; ++i) {
        t = i == 60 ? 3 : (t + 10) % 65536;
        auto const count = (65400u + 8u * static_cast<unsigned>(i) + random() % 4) % 65536;
        text += std::to_string(t) + "," + std::to_string(i % 256) + "," +
                (i % 17 == 5 ? std::string{"nan"} : std::to_string(count)) + "\r\n";
    }
    return text;
}
std::string rich_table(generator& random) {
    std::string text = "time,pump,level,bound\n";
    for (int i = 0; i < 40; ++i)
        text += std::to_string(5 * i) + "," + std::to_string(i % 7) + ".5," +
                (i % 9 == 3 ? std::string{} : std::to_string(random() % 1000) + "e-2") + ",1\n";
    return text;
}

/// What holds for every import: the reader accepts it (write_import read it back), the bounds are
/// what the values state, the protocol is JSON.
void check(imported_dataset const& r) {
    REQUIRE_FALSE(nlohmann::json::parse(r.protocol.json()).empty());
    auto lines = r.protocol.text();
    std::erase(lines, '\n');
    REQUIRE(unprintable_in(lines).empty());
    for (auto const& s : r.data.scenarios) {
        REQUIRE_FALSE(s.measurements.empty());
        for (std::size_t k = 0; k < s.measurements.size(); ++k) {
            REQUIRE_FALSE(is_empty(s.measurements[k].bound));
            REQUIRE(s.stated[k].error.is_positive());
            REQUIRE(contains(s.measurements[k].bound, *nearest(s.stated[k].value)));
        }
    }
}

void run(unsigned seed, int count, bool serial) {
    generator random{seed};
    temporary_folder const folder;
    int accepted = 0, refused = 0;
    for (int i = 0; i < count; ++i) {
        auto mapping = rich_mapping(random, serial);
        auto recorded = serial ? rich_log(random) : rich_table(random);
        if (random() % 4 == 0)
            mapping = damaged(mapping, random, 3);
        else
            recorded = damaged(recorded, random, serial ? 25 : 3);
        folder.write("mapping.json", mapping);
        folder.write(serial ? "a.log" : "a.csv", recorded);
        CAPTURE(seed, i, mapping, recorded);
        try {
            check(import_in(folder));
            ++accepted;
            fs::remove_all(folder.path() / "out");
        } catch (input_error const& e) {
            ++refused;
            REQUIRE_FALSE(e.problem().empty());
            REQUIRE_FALSE(e.place().file.empty());
            REQUIRE(unprintable_in(e.what()).empty());
            REQUIRE(std::string_view{e.what()}.size() < 2600);
            REQUIRE_FALSE(fs::exists(folder.path() / "out"));
        } // anything else ends the test
    }
    CHECK(accepted > count / 20);
    CHECK(refused > count / 20);
}

} // namespace

TEST_CASE("damaged tables and mappings are imported validly or refused") { run(1, 500, false); }
TEST_CASE("damaged logs and mappings are imported validly or refused") { run(2, 500, true); }

TEST_CASE("random bytes are refused or dropped") {
    generator random{3};
    temporary_folder const folder;
    for (int i = 0; i < support::swept(70, 200); ++i) {
        std::string bytes;
        auto const length = random() % 3000;
        for (std::size_t k = 0; k < length; ++k)
            bytes +=
                random() % 5 == 0 ? "\n,0123456789"[random() % 12] : static_cast<char>(random());
        folder.write("a.csv", bytes);
        folder.write("a.log", "0,1,2\n10,1,3\n" + bytes + "\n20,1,4\n30,1,5\n");
        for (auto const mapping : {csv_mapping, serial_mapping}) {
            folder.write("mapping.json", mapping);
            try {
                check(import_in(folder));
                fs::remove_all(folder.path() / "out");
            } catch (input_error const&) {
            }
        }
        folder.write("mapping.json", bytes);
        CHECK_THROWS_AS(import_in(folder), input_error);
    }
}

TEST_CASE("huge and tiny numbers never give an invalid data set") {
    generator random{4};
    temporary_folder const folder;
    folder.write("mapping.json", rich_mapping(random, false));
    std::array<std::string, 12> const numbers{"1e308",
                                              "-1.7e308",
                                              "4.9e-324",
                                              "1e-400",
                                              "1e-4999",
                                              "0",
                                              "-0",
                                              "1",
                                              "1e-300",
                                              "1e-3000",
                                              std::string(350, '9'),
                                              "0." + std::string(380, '3')};
    int accepted = 0;
    for (int i = 0; i < support::swept(150, 400); ++i) {
        std::string text = "time,pump,level,bound\n";
        for (int k = 0; k < 5; ++k)
            text += std::to_string(k) + "," + numbers[random() % 12] + "," +
                    numbers[random() % 12] + "," + numbers[random() % 12] + "\n";
        folder.write("a.csv", text);
        CAPTURE(text);
        try {
            check(import_in(folder));
            ++accepted;
            fs::remove_all(folder.path() / "out");
        } catch (input_error const&) {
        }
    }
    CHECK(accepted > support::swept(3, 10));
}

TEST_CASE("many damaged files are imported validly or refused", "[.long]") {
    run(77, 10000, false);
    run(78, 10000, true);
}
