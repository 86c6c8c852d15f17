// SPDX-License-Identifier: MIT
#include "record.hpp"
#include "io/support.hpp"
#include "support/catch.hpp"

#include <fstream>
#include <string>

namespace {

servo::recording record_from(std::string const& text) {
    io_support::temporary_folder const folder;
    auto const file = folder.path() / "record.csv";
    std::ofstream{file} << text;
    return servo::read_recording(file);
}

} // namespace

TEST_CASE("the velocity filter is exact on cubics and damps noise", "[servo_axis]") {
    servo::recording r;
    auto const motion = [](double t) { return 1 + 2 * t - 3 * t * t + 5 * t * t * t; };
    for (int k = 0; k <= 40; ++k) {
        double const t = 0.005 * k;
        r.time.push_back(t);
        r.nearest_position.push_back(motion(t));
    }
    for (std::size_t const half : {2u, 3u, 5u, 8u}) {
        double const t = r.time[20];
        CHECK_THAT(servo::approximate_velocity(r, 20, half),
                   WithinAbs(2 - 6 * t + 15 * t * t, 1e-10));
    }
    auto const quiet = servo::approximate_velocity(r, 20, 5);
    for (std::size_t k = 0; k <= 40; k += 2) r.nearest_position[k] += 1e-6;
    for (std::size_t k = 1; k <= 40; k += 2) r.nearest_position[k] -= 1e-6;
    // A difference of neighbours would be wrong by 4e-4 m/s.
    CHECK(std::abs(servo::approximate_velocity(r, 20, 5) - quiet) < 6e-5);
}

TEST_CASE("a record is read by its headings", "[servo_axis]") {
    auto const r = record_from("force_N,extra,position_m,t_s\n1.5,x,0.10,0\n2.5,y,0.2,0.005\n");
    REQUIRE(r.size() == 2);
    CHECK(r.time[1] == 0.005);
    CHECK(r.force[0] == 1.5);
    CHECK(r.position[0].text() == "0.1");
    CHECK(r.nearest_position[1] == 0.2);
}

TEST_CASE("a bad record is refused with file, line and column", "[servo_axis]") {
    CHECK_THROWS_WITH(record_from("t_s,position_m\n0,1\n"), ContainsSubstring("'force_N'"));
    CHECK_THROWS_WITH(record_from("t_s,force_N,position_m\n0,1,1\n0,2,1\n"),
                      ContainsSubstring("line 3, column 1"));
    CHECK_THROWS_WITH(record_from("t_s,force_N,position_m\n0,1,1\n0.005,nan,1\n"),
                      ContainsSubstring("line 3, column 2"));
    CHECK_THROWS_WITH(record_from("t_s,force_N,position_m\n0,1\n"), ContainsSubstring("line 2"));
    CHECK_THROWS_AS(servo::read_recording("nowhere/record.csv"), sivid::input_error);
}

TEST_CASE("windows lie on the grid asked for, and within the record", "[servo_axis]") {
    servo::recording r;
    for (int k = 0; k <= 1000; ++k) {
        r.time.push_back(k / 200.0);
        r.nearest_position.push_back(0);
    }
    auto const windows = servo::cut_windows(r, {}, "record.csv");
    REQUIRE(windows.size() == 2); // 1 to 2 and 3 to 4 s; the next would end at 6
    CHECK(r.time[windows[0].from] == 1);
    CHECK(r.time[windows[0].to] == 2);
    CHECK(r.time[windows[1].from] == 3);
    // At 0 s there are no samples before the start for the filter.
    auto const all = servo::cut_windows(r, {.first = 0, .every = 1}, "record.csv");
    REQUIRE(all.size() == 4);
    CHECK(r.time[all[0].from] == 1);
    CHECK(r.time[all[3].to] == 5);
    CHECK_THROWS_AS(servo::cut_windows(r, {.length = 7}, "record.csv"), sivid::input_error);
    r.time[201] += 0.002;
    CHECK_THROWS_WITH(servo::cut_windows(r, {}, "record.csv"), ContainsSubstring("evenly"));
}
