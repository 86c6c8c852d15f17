// SPDX-License-Identifier: MIT
#include <sivid/space/box_cover.hpp>

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace sivid;

namespace {

double volume(box const& x) {
    double v = 1;
    for (auto const& s : x) v *= s.upper() - s.lower();
    return v;
}
bool within(box const& x, std::vector<double> const& p) { return contains(x, p); }

/// Cuts a box into parts at random, at dyadic places so that volumes are exact.
void shatter(box const& x, int depth, std::mt19937& random, std::vector<box>& parts) {
    if (depth == 0 || random() % 8 == 0) {
        parts.push_back(x);
        return;
    }
    auto const [low, high] = [&] {
        auto const side = random() % x.size();
        return bisect(x, side, mid(x[side]));
    }();
    shatter(low, depth - 1, random, parts);
    shatter(high, depth - 1, random, parts);
}

} // namespace

TEST_CASE("gaps are exactly what is missing") {
    std::mt19937 random(7);
    box const whole{interval(0, 1), interval(0, 2), interval(-1, 1)};
    std::vector<box> parts, kept, removed;
    shatter(whole, 11, random, parts);
    for (auto const& p : parts) (random() % 3 == 0 ? removed : kept).push_back(p);
    REQUIRE(kept.size() > 200);
    auto const found = cover(whole, kept);
    CHECK(found.overlaps.empty());
    double missing = 0, gaps = 0;
    for (auto const& p : removed) missing += volume(p);
    for (auto const& g : found.gaps) gaps += volume(g);
    CHECK(gaps == missing);
    std::uniform_real_distribution<double> place(0, 1);
    for (int k = 0; k < 2000; ++k) {
        std::vector<double> const p{place(random), 2 * place(random), 2 * place(random) - 1};
        auto const has = [&](std::vector<box> const& list) {
            return std::any_of(list.begin(), list.end(),
                               [&](box const& b) { return within(b, p); });
        };
        CHECK((has(kept) || has(found.gaps)));
        if (has(removed) && !has(kept)) CHECK(has(found.gaps));
    }
}

TEST_CASE("nothing missing, everything missing") {
    box const whole{interval(0, 1), interval(0, 1)};
    CHECK(cover(whole, {whole}).gaps.empty());
    CHECK(cover(whole, {}).gaps.size() == 1);
    std::mt19937 random(3);
    std::vector<box> parts;
    shatter(whole, 12, random, parts);
    auto const found = cover(whole, parts);
    CHECK(found.gaps.empty());
    CHECK(found.overlaps.empty());
}

TEST_CASE("overlaps are seen, rounding is not") {
    box const whole{interval(0, 1), interval(0, 1)};
    box const left{interval(0, 0.5), interval(0, 1)};
    CHECK(cover(whole, {left, box{interval(0.25, 1), interval(0, 1)}}).overlaps.size() == 1);
    CHECK(cover(whole, {left, left}).overlaps.size() == 1);
    double const just_below = std::nextafter(0.5, 0.0);
    auto const rounded = cover(whole, {left, box{interval(just_below, 1), interval(0, 1)}});
    CHECK(rounded.overlaps.empty());
    CHECK(rounded.gaps.empty());
    std::vector<box> many;
    for (int k = 0; k < 20; ++k) many.push_back(left);
    CHECK_FALSE(cover(whole, many).overlaps.empty());
}

TEST_CASE("sides of no width do not matter") {
    box const whole{interval(0, 1), interval(3)};
    auto const found = cover(whole, {box{interval(0, 0.25), interval(3)}});
    REQUIRE(found.gaps.size() == 1);
    CHECK(found.gaps[0][0].lower() == 0.25);
    CHECK(found.gaps[0][1].upper() == 3);
}

TEST_CASE("neighbours that rounding makes overlap leave no more gaps than exact ones") {
    std::mt19937 random(7);
    box whole(6);
    for (std::size_t i = 0; i < whole.size(); ++i) whole[i] = interval(1, 2);
    std::vector<box> parts, exact, rounded;
    shatter(whole, 12, random, parts);
    for (auto const& p : parts) {
        if (random() % 3 == 0) continue;
        exact.push_back(p);
        auto q = p;
        for (std::size_t i = 0; i < q.size(); ++i) {
            q[i] = interval(std::nextafter(q[i].lower(), 0.0), std::nextafter(q[i].upper(), 9.0));
        }
        rounded.push_back(q);
    }
    REQUIRE(exact.size() > 200);
    auto const thick = [](box_cover const& found) {
        return std::count_if(found.gaps.begin(), found.gaps.end(), [](box const& gap) {
            return std::all_of(gap.begin(), gap.end(),
                               [](interval const& s) { return s.upper() - s.lower() > 1e-14; });
        });
    };
    auto const of_rounded = cover(whole, rounded);
    CHECK(of_rounded.overlaps.empty());
    CHECK(thick(of_rounded) <= 2 * thick(cover(whole, exact)));
    // What is missing of the exact ones by more than rounding is missing of these.
    double missing = 0, gaps = 0;
    for (auto const& g : cover(whole, exact).gaps) missing += volume(g);
    for (auto const& g : of_rounded.gaps) gaps += volume(g);
    CHECK(std::abs(gaps - missing) < 1e-10);
}
