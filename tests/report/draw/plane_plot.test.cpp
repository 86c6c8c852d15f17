// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/draw/paving_plot.hpp>

#include <cmath>

using namespace sivid::report;
using namespace sivid_tests;

TEST_CASE("plane plot: tube, measurements, reference and headings") {
    plane_series s;
    for (int k = 0; k < 50; ++k) {
        double const x = 0.1 * k, y = std::sin(x);
        s.tube.push_back({{x, x + 0.1}, {y - 0.1, y + 0.1}});
        s.reference.push_back({x, y});
        if (k % 10 == 5) {
            s.measured.push_back({{x - 0.02, x + 0.02}, {y - 0.02, y + 0.02}});
            s.poses.push_back({x, y, std::cos(x)});
        }
    }
    std::string const text = draw_plane_plot(s).str();
    CHECK(markup_error(text) == "");
    CHECK_THAT(text, ContainsSubstring(">start</text>"));
    CHECK(plane_plot_legend(s).size() == 4);
    CHECK(plane_plot_legend({}).empty());
}

TEST_CASE("plane plot: joining boxes keeps all of them covered") {
    std::vector<plane_box> boxes;
    for (int k = 0; k < 1001; ++k) {
        boxes.push_back({{k * 1.0, k + 1.0}, {-1.0 * k, 0}});
    }
    auto const few = merged(boxes, 100);
    CHECK(few.size() <= 100);
    for (plane_box const& b : boxes) {
        bool covered = false;
        for (plane_box const& f : few) {
            covered = covered || (f.x.lo <= b.x.lo && b.x.hi <= f.x.hi && f.y.lo <= b.y.lo &&
                                  b.y.hi <= f.y.hi);
        }
        REQUIRE(covered);
    }
    CHECK(merged(std::vector<plane_box>{}, 0).empty());
}

TEST_CASE("plane plot: many boxes stay small, wild ones stay finite") {
    plane_series s;
    for (int k = 0; k < 100'000; ++k) {
        s.tube.push_back({{0.001 * k, 0.001 * k + 1}, {0, 1}});
    }
    s.tube.push_back({{-INFINITY, INFINITY}, {NAN, 2}});
    s.tube.push_back({{-INFINITY, INFINITY}, {-1e308, 1e308}});
    s.reference = {{NAN, 0}, {0, 0}, {1, INFINITY}};
    s.poses = {{0, 0, NAN}};
    std::string const text = draw_plane_plot(s).str();
    CHECK(markup_error(text) == "");
    CHECK(text.size() < 250'000);
    CHECK_THAT(draw_plane_plot({}).str(), ContainsSubstring("no data"));
}
