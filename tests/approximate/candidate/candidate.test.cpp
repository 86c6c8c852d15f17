// SPDX-License-Identifier: MIT
#include <sivid/approximate/candidate/candidate.hpp>

#include "support/catch.hpp"

using namespace sivid;

namespace {
constexpr std::size_t samples = 1000; // ln N = 6.9
}

TEST_CASE("nothing is chosen when nothing explains") {
    CHECK_FALSE(choose({}, samples).explained);
    CHECK_FALSE(choose({{{}, 3, 5, 900}, {{1}, 4, 1.01, 300}}, samples).explained);
}

TEST_CASE("fewest effects first, then the likelier") {
    std::vector<candidate> const all{{{}, 3, 5, 900},       {{0}, 4, 0.99, 330},
                                     {{1}, 4, 0.97, 320},   {{2}, 4, 1.5, 400},
                                     {{0, 1}, 5, 0.9, 319}, {{1, 2}, 5, 0.96, 319}};
    auto const c = choose(all, samples);
    CHECK(c.explained);
    CHECK(c.best == 2);
    CHECK(c.others.empty()); // 3 * 10 worse; pairs gain less than they cost
    auto with_base = all;
    with_base[0].inflation = 0.999;
    with_base[0].squares = 322;
    CHECK(choose(with_base, samples).best == 0);
}

TEST_CASE("what the data cannot tell apart is listed, the likeliest first, no more than asked") {
    std::vector<candidate> all{{{}, 3, 5, 900}};
    for (std::size_t e = 0; e < 5; ++e) {
        all.push_back({{e}, 4, 0.99, 320 + 0.5 * static_cast<double>(4 - e)});
    }
    auto const c = choose(all, samples);
    CHECK(c.best == 5);
    CHECK(c.others == std::vector<std::size_t>{4, 3});
    CHECK(choose(all, samples, {.most_others = 9}).others.size() == 4);
}

TEST_CASE("a pair for which the data speak clearly is an alternative to a single effect") {
    std::vector<candidate> const all{
        {{}, 3, 5, 900}, {{0}, 4, 0.99, 330}, {{0, 1}, 5, 0.9, 310}, {{0, 2}, 5, 0.95, 328}};
    auto const c = choose(all, samples);
    CHECK(c.best == 1);
    CHECK(c.others == std::vector<std::size_t>{2});
}

TEST_CASE("the closest candidate has few effects where more buy little") {
    auto const tried = [](std::vector<std::size_t> effects, double inflation) {
        candidate c;
        c.effects = std::move(effects);
        c.inflation = inflation;
        return c;
    };
    CHECK(closest_candidate({tried({}, 9)}) == 0);
    CHECK(closest_candidate(
              {tried({}, 9), tried({0}, 5), tried({0, 1}, 2.64), tried({0, 1, 2}, 2.57)}) == 2);
    CHECK(closest_candidate(
              {tried({}, 9), tried({0}, 5), tried({0, 1}, 2.64), tried({0, 1, 2}, 2.0)}) == 3);
    CHECK(closest_candidate({candidate{}, candidate{}}) == 0); // no fit succeeded
    CHECK(closest_candidate({}) == 0);
}

TEST_CASE("what was tried is complete when nothing planned is left") {
    tried_candidates t;
    CHECK(t.complete());
    t.singles = {4, 4};
    t.pairs = {0, 6};
    CHECK_FALSE(t.complete());
    CHECK(t.planned() == 10);
    t.pairs.tried = 6;
    CHECK(t.complete());
}
