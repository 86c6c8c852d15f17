// SPDX-License-Identifier: MIT
#include <sivid/model/manoeuvre.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace {

std::vector<sivid::signal> three_constants() {
    return std::vector<sivid::signal>(
        3, sivid::sampled_signal({0.0}, {7.0}, sivid::interpolation::hold));
}

} // namespace

TEST_CASE("shapes keep their limits whatever their settings are") {
    std::vector<sivid::varied_input> const varied{{0, "u", "N", -1, 3}, {2, "w", "rad", 0.1, 0.2}};
    auto const menu = sivid::manoeuvre_shapes(varied, three_constants(), {1, 2}, 5, "s");
    CHECK(menu.size() == 6 + 2 * 5);
    std::set<std::string> names;
    support::draws d{7};
    for (auto const& m : menu) {
        names.insert(m.name);
        CHECK(m.duration == 5);
        CHECK(m.start == std::vector<double>{1, 2});
        for (int n = 0; n < 50; ++n) {
            std::vector<double> settings;
            for (auto const& s : m.settings) {
                CHECK(s.lower < s.upper);
                auto const ends = d.below(4);
                settings.push_back(ends == 0   ? s.lower
                                   : ends == 1 ? s.upper
                                               : d.uniform(s.lower, s.upper));
            }
            auto const inputs = m.inputs(settings);
            REQUIRE(inputs.size() == 3);
            CHECK(std::get<sivid::sampled_signal>(inputs[1]).values() == std::vector<double>{7});
            for (auto const& u : varied) {
                auto const& s = std::get<sivid::sampled_signal>(inputs[u.index]);
                CHECK(s.kind() == sivid::interpolation::linear);
                CHECK(s.times().front() == 0);
                CHECK(s.times().back() == 5);
                for (double const v : s.values()) CHECK((u.lower <= v && v <= u.upper));
            }
        }
    }
    CHECK(names.size() == menu.size());
    CHECK(sivid::manoeuvre_shapes({varied[0]}, three_constants(), {1, 2}, 5, "s").size() == 6);
}

TEST_CASE("inputs that cannot be varied are refused") {
    auto const make = [](sivid::varied_input const& u) {
        return sivid::manoeuvre_shapes({u}, three_constants(), {0}, 1, "s");
    };
    CHECK_THROWS_AS(make({0, "u", "N", 1, 1}), std::invalid_argument);
    CHECK_THROWS_AS(make({0, "u", "N", 2, 1}), std::invalid_argument);
    CHECK_THROWS_AS(make({0, "u", "N", 0, HUGE_VAL}), std::invalid_argument);
    CHECK_THROWS_AS(make({3, "u", "N", 0, 1}), std::invalid_argument);
    CHECK_THROWS_AS(sivid::manoeuvre_shapes({}, three_constants(), {0}, 1, "s"),
                    std::invalid_argument);
}
