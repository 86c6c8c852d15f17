// SPDX-License-Identifier: MIT
#include "support/catch.hpp"

#include <sivid/report/draw/svg.hpp>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

using namespace sivid::report;

namespace {

double luminance(std::string_view colour) {
    double out = 0;
    double const weight[3] = {0.2126, 0.7152, 0.0722};
    for (std::size_t i = 0; i < 3; ++i) {
        double const c = std::stoi(std::string{colour.substr(1 + 2 * i, 2)}, nullptr, 16) / 255.0;
        out += weight[i] * (c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return out;
}

double contrast(std::string_view a, std::string_view b) {
    double const x = luminance(a) + 0.05, y = luminance(b) + 0.05;
    return x > y ? x / y : y / x;
}

} // namespace

TEST_CASE("palette: regions stay apart by lightness alone, text is readable") {
    CHECK(contrast(palette::inside, palette::undecided) > 2);
    CHECK(contrast(palette::inside, palette::pending) > 2);
    CHECK(contrast(palette::inside, palette::outside) > 3);
    CHECK(contrast(palette::undecided, palette::outside) > 1.4);
    CHECK(contrast(palette::ink, palette::paper) > 7);
    CHECK(contrast(palette::muted_ink, palette::paper) > 4.5);
    CHECK(contrast(palette::muted_ink, palette::outside) > 4.5);
}

TEST_CASE("palette: ramps are ordered by lightness and clamp") {
    for (colour_ramp const& ramp : {blue_ramp, orange_ramp}) {
        for (int i = 0; i < 20; ++i) {
            CHECK(luminance(ramp.at(i / 20.0)) > luminance(ramp.at((i + 1) / 20.0)));
        }
        CHECK(ramp.at(-5) == ramp.at(0));
        CHECK(ramp.at(7) == ramp.at(1));
        CHECK(ramp.at(NAN) == ramp.at(0));
        CHECK(ramp.at(0.3).size() == 7);
    }
}
