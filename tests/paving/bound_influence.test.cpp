// SPDX-License-Identifier: MIT
// What other error bounds would leave.
#include <sivid/paving/bound_influence.hpp>

#include "support/catch.hpp"

#include <sivid/model/model.hpp>
#include <sivid/model/problem.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

using namespace sivid;

namespace {

/// x' = -a x, v' = -b v: a is seen by x alone, b by v alone.
struct two_tanks {
    static constexpr auto name = "two tanks";
    static constexpr auto states = sivid::states({{"x", "m", 1}, {"v", "m", 1}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "m"}, {"v", "m"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"a", "1/s", 1_dec}, {"b", "1/s", 1_dec}});
    }();
    template <class T>
    vec<T, 2> rate(T const&, vec<T, 2> const& x, vec<T, 2> const& c, vec<T, 0> const&) const {
        return {-c[0] * x[0], -c[1] * x[1]};
    }
    template <class T>
    vec<T, 2> observe(T const&, vec<T, 2> const& x, vec<T, 2> const&, vec<T, 0> const&) const {
        return {x[0], x[1]};
    }
};

identification_problem tanks() {
    experiment e;
    e.name = "run";
    e.initial = {interval(1), interval(1)};
    for (int k = 1; k <= 8; ++k) {
        double const x = std::exp(-0.2 * k), v = std::exp(-0.15 * k);
        e.measurements.push_back({0.2 * k, 0, interval(x - 0.01, x + 0.012)});
        e.measurements.push_back({0.2 * k, 1, interval(v - 0.011, v + 0.01)});
    }
    return {
        record_model<two_tanks>(), {{"a", "b"}, {}}, {interval(0.1, 10), interval(0.1, 10)}, {e}};
}

} // namespace

TEST_CASE("each parameter follows the bounds of the channel that sees it") {
    auto const problem = tanks();
    identify_options options;
    options.search.seconds = 60;
    auto const lines = influence_of_bounds(problem, {0.5, 2}, options);
    REQUIRE(lines.size() == 7);
    auto const& stated = lines[0];
    CHECK(stated.found == verdict::consistent);
    CHECK((!stated.channel && stated.scale == 1));
    for (auto const& line : lines) {
        CAPTURE(line.channel.value_or(99), line.scale);
        REQUIRE(line.ended);
        CHECK(line.found == verdict::consistent);
        CHECK(contains(line.hull, {1, 0.75})); // the truth, near the middle of all bounds
        for (std::size_t j = 0; j < 2; ++j) {
            bool const concerned = !line.channel || *line.channel == j;
            double const share = width(line.hull[j]) / width(stated.hull[j]);
            if (!concerned || line.scale == 1)
                CHECK((share > 0.9 && share < 1.1));
            else
                CHECK((line.scale < 1 ? share > 0.35 && share < 0.65 : share > 1.6 && share < 2.4));
        }
    }
}

TEST_CASE("bounds that are too small for any parameter are said to leave none") {
    auto problem = tanks();
    auto& bound = problem.experiments[0].measurements[6].bound; // of x
    bound = interval(bound.lower() + 0.015, bound.upper() + 0.015);
    identify_options options;
    options.search.seconds = 60;
    auto const lines = influence_of_bounds(problem, {0.5}, options);
    REQUIRE(lines.size() == 4);
    CHECK(lines[0].found == verdict::consistent);
    for (auto const& line : {lines[1], lines[2]}) {
        CHECK(line.found == verdict::inconsistent);
        CHECK(is_empty(line.hull));
    }
    CHECK(lines[3].found == verdict::consistent); // those of v say nothing of x
}

TEST_CASE("scales of bounds are above 0") {
    auto problem = tanks();
    for (double const scale : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity()})
        CHECK_THROWS_AS(influence_of_bounds(problem, {scale}), std::invalid_argument);
    auto nothing_asked = influence_of_bounds(problem, {}, {});
    CHECK(nothing_asked.size() == 1);
}
