// SPDX-License-Identifier: MIT
#include <sivid/importing/table/detail/turns.hpp>

#include "io/import_support.hpp"

#include <cmath>
#include <numbers>

using namespace sivid;
using namespace io_support;

namespace {
std::vector<std::size_t> which(std::vector<bool> const& flags) {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < flags.size(); ++i)
        if (flags[i]) result.push_back(i);
    return result;
}
using list = std::vector<std::size_t>;
} // namespace

TEST_CASE("a leap that a recorder averaged over is recognised, in any unit") {
    for (double const unit : {1.0, std::numbers::pi / 180, 4096.0 / 360}) {
        auto const scaled = [&](std::vector<double> r) {
            for (double& x : r) x *= unit;
            return which(smeared_leaps(r, 360 * unit));
        };
        CAPTURE(unit);
        CHECK(scaled({355, 357, 359, 180, 1, 3, 5}) == list{3});
        CHECK(scaled({5, 3, 1, 180, 359, 357, 355}) == list{3});
        CHECK(scaled({355, 357, 359, 310, 1, 3, 5}) == list{3});
        CHECK(scaled({176, 178, -60, -178, -176, -174}) == list{2});
        CHECK(scaled({355, 357, 359, 239, 120, 1, 3, 5}) == list{3, 4});
        // Two leaps.
        CHECK(scaled({355, 357, 359, 180, 1, 3, 5, 3, 1, 200, 359, 357}) == list{3, 9});
        // No leap: a plain wrap, noise at north, a turn by great steps, a bad reading elsewhere.
        CHECK(scaled({355, 357, 359, 1, 3, 5}).empty());
        CHECK(scaled({359, 1, 358.5, 0.5, 359.5, 1.5, 359}).empty());
        CHECK(scaled({10, 250, 130, 10, 250, 130, 10}).empty());
        CHECK(scaled({10, 100, 190, 280, 10, 100}).empty());
        CHECK(scaled({20, 22, 200, 26, 28}).empty());
    }
    CHECK(smeared_leaps({}, 360).empty());
    CHECK(which(smeared_leaps({1}, 360)).empty());
}

TEST_CASE("an averaged leap is left out, and the turn is counted") {
    std::string text = "time,pump,level\n";
    std::string const readings[] = {"355", "357", "359", "180", "1", "3", "5"};
    for (int i = 0; i < 7; ++i) text += std::to_string(100 * i) + ",1," + readings[i] + "\n";
    auto const mapping = replaced(csv_mapping, "\"factor\": 0.01", "\"period\": 360");
    auto const r = import_csv(mapping, text);
    auto const& s = r.data.scenarios.at(0);
    REQUIRE(s.stated.size() == 6);
    CHECK(s.stated[2].value == dec("359"));
    CHECK(s.stated[3].value == dec("361"));
    CHECK(s.stated[5].value == dec("365"));
    CHECK(noted(r.protocol, "averaged over the leap") == list{5});
    // Of a counter.
    auto const counter = replaced(csv_mapping, "\"factor\": 0.01", "\"counter_bits\": 12");
    std::string counts = "time,pump,level\n";
    int const raw[] = {4050, 4070, 4090, 2000, 14, 34, 54};
    for (int i = 0; i < 7; ++i)
        counts += std::to_string(100 * i) + ",1," + std::to_string(raw[i]) + "\n";
    auto const c = import_csv(counter, counts);
    REQUIRE(c.data.scenarios.at(0).stated.size() == 6);
    CHECK(c.data.scenarios[0].stated[5].value == dec("4150"));
}

TEST_CASE("whole turns may be lost where a gap is long for the rate that was seen") {
    // 100 degrees a second; two seconds without a reading are 200 degrees.
    CHECK(doubtful_turns({0, 1, 2, 3, 5, 6}, {0, 100, 200, 300, 500, 600}, 360) == list{4});
    CHECK(doubtful_turns({0, 1, 2, 3, 5, 6}, {0, 80, 160, 240, 400, 480}, 360).empty());
    // In milliseconds the same.
    CHECK(doubtful_turns({0, 1e3, 2e3, 3e3, 5e3, 6e3}, {0, 100, 200, 300, 500, 600}, 360) ==
          list{4});
    CHECK(doubtful_turns({}, {}, 360).empty());
    std::string text = "time,pump,level\n";
    for (int i = 0; i < 20; ++i)
        text += std::to_string(100 * i) + ",1," + (i == 10 ? "" : std::to_string((100 * i) % 360)) +
                "\n"; // leap + missing sample
    auto const r = import_csv(replaced(csv_mapping, "\"factor\": 0.01", "\"period\": 360"), text);
    CHECK(noted(r.protocol, "whole turns may be lost where readings are missing") == list{13});
    bool reaches = false;
    for (auto const& a : r.data.assumptions)
        reaches = reaches || a.find("whole turns may be lost") != std::string::npos;
    CHECK(reaches);
}

TEST_CASE("a wrap that nobody stated is suspected: angles, averaged leaps, counters") {
    CHECK(suspected_period({150, 170, -170, -150})->entry == "\"period\": 360");
    CHECK(suspected_period({355, 357, 359, 180, 1, 3})->at == 4);
    CHECK(suspected_period({3.0, -3.1, -2.9})->words == "2 pi");
    CHECK(suspected_period({65500, 65520, 4, 24})->entry == "\"counter_bits\": 16");
    CHECK(suspected_period({4000, 4080, 30, 100})->entry == "\"counter_bits\": 12");
    CHECK_FALSE(suspected_period({0, 0, 255, 255, 0, 0})); // a switched input
    CHECK_FALSE(suspected_period({0, 300, 10, 200}));
    CHECK_FALSE(suspected_period({0, 90, 170, 250}));
    CHECK_FALSE(suspected_period({}));
}
