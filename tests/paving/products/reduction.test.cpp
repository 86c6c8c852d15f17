// SPDX-License-Identifier: MIT
// Problems with fewer parameters: the same trajectories, and maps of boxes that lose nothing.
#include <sivid/paving/products/reduction.hpp>

#include "support/catch.hpp"
#include "support/power_series.hpp"
#include "support/problems.hpp"

#include <sivid/enclosure/tube.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/paving/products/dependence.hpp>
#include <sivid/paving/products/detail/drawing.hpp>

using namespace sivid;
using support::between;
using support::draws;
using support::mp;

namespace {

struct sample {
    identification_problem problem;
    dependence_structure structure;
};
template <class Rate>
sample make(std::size_t constants, Rate const& rate, box const& prior) {
    sample s;
    s.problem.model = support::model_of({1, constants}, rate);
    s.problem.choice.unknown = support::all_constants(constants);
    s.problem.prior = prior;
    experiment e;
    e.name = "E";
    e.initial = box{interval(1.0)};
    e.measurements = {{1, 0, between(-100, 100)}};
    s.problem.experiments = {e};
    s.structure = dependence_of(s.problem);
    return s;
}
/// x' = p3 - p0 p1 x + p2/4: p0 and p1 act through their product only.
sample products() {
    return make(
        4,
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[3] - p[0] * p[1] * x[0] + p[2] * 0.25};
        },
        box{between(0.5, 2), between(0.5, 1.5), between(1, 3), between(-1, 1)});
}
/// x' = p2 - p0 p1 p2 x: p2 stands in the product and alone.
constexpr auto shared_rate = [](auto const&, auto const& x, auto const& p, auto const&) {
    return std::vector{p[2] - p[0] * p[1] * p[2] * x[0]};
};
box const shared_prior{between(0.5, 2), between(0.5, 1.5), between(0.4, 1.2)};
sample shared_factor() { return make(3, shared_rate, shared_prior); }
/// x' = p0 - p2 x: p1 and p3 stand nowhere.
constexpr auto idle_rate = [](auto const&, auto const& x, auto const& p, auto const&) {
    return std::vector{p[0] - p[2] * x[0]};
};
box const idle_prior{between(0.5, 2), between(-1, 3), between(0.4, 1.2), between(5, 6)};
sample idle() { return make(4, idle_rate, idle_prior); }

/// The reduced problem has the original's trajectory at a point.
void check_trajectory(sample const& s, reduction const& map, box const& p) {
    auto const flow_of = [](identification_problem const& of) {
        return std::make_shared<flow const>(of.model, of.choice, std::vector<signal>{});
    };
    auto const r = map.forward(p);
    REQUIRE_FALSE(is_empty(r));
    CHECK(subset(r, map.problem().prior));
    auto const a = integrate<interval>(flow_of(s.problem), box{interval(1.0)}, p, 0, 2);
    auto const b = integrate<interval>(flow_of(map.problem()), box{interval(1.0)}, r, 0, 2);
    REQUIRE((a.complete() && b.complete()));
    CHECK_FALSE(disjoint(a.at(2)[0], b.at(2)[0]));
    CHECK(width(b.at(2)[0]) < 1e-10);
}

} // namespace

TEST_CASE("a reduced problem has the trajectories of the original one") {
    draws d(371);
    for (auto const& s : {products(), shared_factor(), idle()}) {
        auto const map = reduction::find(s.problem, s.structure);
        REQUIRE(map);
        auto const& small = map->problem();
        CHECK(small.prior.size() < s.problem.prior.size());
        CHECK(small.choice.unknown.size() == small.prior.size());
        CHECK_NOTHROW(small.require_valid());
        for (int round = 0; round < 60; ++round)
            check_trajectory(s, *map, point_box(d.in(s.problem.prior)));
    }
}

TEST_CASE("a sum is one parameter, forward and backward, with the same trajectories") {
    draws d(374);
    auto const rate = [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{(p[0] - p[3] * p[1] * x[0]) / (p[2] + p[4])};
    };
    box const prior{between(0.5, 2), between(0.5, 1.5), between(1, 2), between(0.4, 1.2),
                    between(0.25, 0.5)};
    auto const s = make(5, rate, prior);
    CHECK_FALSE(reduction::find(s.problem, s.structure)->problem().prior.size() == 3);
    auto const sums = sums_in(s.problem);
    REQUIRE(sums.size() == 1);
    auto const map = reduction::find(s.problem, s.structure, sums);
    REQUIRE(map);
    auto const& small = map->problem();
    CHECK(small.prior.size() == 3); // p0, p1*p3, p2 + p4
    CHECK_NOTHROW(small.require_valid());
    for (int round = 0; round < 60; ++round) {
        auto const p = point_box(d.in(prior));
        check_trajectory(s, *map, p);
        auto const r = map->forward(p);
        // What maps into a part stays.
        auto part = small.prior;
        for (std::size_t k = 0; k < part.size(); ++k)
            part[k] = hull(r[k], between(part[k].lower(), d.in(part[k])));
        auto const back = map->backward(prior, part);
        REQUIRE_FALSE(is_empty(back));
        CHECK(subset(p, back));
    }
    auto const known = map->products_over(small.prior);
    auto const sum =
        std::find_if(known.begin(), known.end(), [](auto const& k) { return k.what.is_sum(); });
    REQUIRE(sum != known.end());
    CHECK(subset(between(1.25, 2.5), sum->hull));
    // Two sums with a term in common cannot both be one parameter.
    auto twice = sums;
    twice.push_back(sums[0]);
    CHECK(reduction::find(s.problem, s.structure, twice)->problem().prior.size() == 3);
}

TEST_CASE("what a search in sums leaves is told where no time is left to draw it") {
    auto const rate = [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{(p[0] - p[1] * x[0]) / (p[2] + p[3])};
    };
    auto const s =
        make(4, rate, {between(0.5, 2), between(0.5, 1.5), between(1, 2), between(0.25, 0.5)});
    auto const map = reduction::find(s.problem, s.structure, sums_in(s.problem));
    REQUIRE(map);
    auto const& small = map->problem().prior;
    auto part = small;
    std::vector<std::size_t> own;
    for (std::size_t k = 0; k < part.size(); ++k)
        if (!map->sides()[k].product) {
            own.push_back(map->sides()[k].parameter);
            part[k] = between(part[k].lower(), mid(part[k]));
        }
    REQUIRE_FALSE(own.empty());
    subpaving reduced(small);
    reduced.add(part, box_verdict::undecided);
    for (double const seconds : {0.0, 1.0}) {
        identification found(s.problem.prior);
        paving_detail::draw(found, *map, reduced, s.problem.prior, {.seconds = seconds}, 100);
        for (auto const j : own) CHECK(width(found.hull[j]) < 0.6 * width(s.problem.prior[j]));
        CHECK(found.paving.outer_volume().upper() < 0.6);
        CHECK(subset(map->backward(s.problem.prior, part), found.hull));
    }
}

TEST_CASE("ranges of products go to and fro with the box of the reduced problem") {
    draws d(373);
    auto const s = products();
    auto const map = reduction::find(s.problem, s.structure);
    REQUIRE(map);
    auto part = map->forward(s.problem.prior);
    for (std::size_t k = 0; k < part.size(); ++k) part[k] = between(mid(part[k]), part[k].upper());
    auto const known = map->products_over(part);
    REQUIRE_FALSE(known.empty());
    auto const back = map->forward(map->backward(s.problem.prior, part), known);
    CHECK(subset(back, part));
    CHECK(subset(part, back));
    auto const without = map->forward(map->backward(s.problem.prior, part));
    CHECK_FALSE(subset(without, part));
}

TEST_CASE("forward keeps the image of each point, backward each point that maps into the box") {
    draws d(372);
    auto const s = products();
    auto const map = reduction::find(s.problem, s.structure);
    REQUIRE(map);
    int kept = 0;
    int contracted = 0;
    for (int round = 0; round < 400; ++round) {
        box p(4);
        for (std::size_t j = 0; j < 4; ++j) {
            auto const& side = s.problem.prior[j];
            double const a = d.in(side);
            double const b = d.in(side);
            p[j] = between(std::min(a, b), std::max(a, b));
        }
        auto const whole = map->forward(p);
        auto part = whole;
        for (std::size_t k = 0; k < part.size(); ++k) {
            double const a = d.in(whole[k]);
            double const b = d.in(whole[k]);
            part[k] = between(std::min(a, b), std::max(a, b));
        }
        auto const back = map->backward(p, part);
        if (!is_empty(back)) {
            CHECK(subset(back, p));
            contracted += width(back) < 0.9 * width(p) ? 1 : 0;
        }
        for (int member = 0; member < 10; ++member) {
            auto const x = d.in(p);
            auto const image = map->forward(point_box(x));
            CHECK(subset(image, whole));
            if (!subset(image, part)) continue;
            ++kept;
            CHECK((!is_empty(back) && contains(back, x)));
        }
    }
    CHECK(kept > 50);
    CHECK(contracted > 50);
}

TEST_CASE("nothing is reduced where no product can stand for its factors") {
    auto const alone = make(
        2,
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * x[0] + p[1]};
        },
        box{between(0, 1), between(0, 1)});
    CHECK_FALSE(reduction::find(alone.problem, alone.structure));
    auto const squares = make( // only p0^2 p1^2: the product's sign is open
        2,
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{sqr(p[0] * p[1]) * x[0]};
        },
        box{between(-1, 1), between(-1, 1)});
    if (auto const map = reduction::find(squares.problem, squares.structure)) {
        // If one is offered it must be true for either sign.
        auto const r = map->forward(box{interval(-0.5), interval(1.0)});
        CHECK_FALSE(is_empty(r));
    }
    auto const pole = make( // p0/p1 with 0 among the divisors is unbounded
        2,
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] / p[1] * x[0]};
        },
        box{between(0.5, 1), between(-1, 1)});
    CHECK_FALSE(reduction::find(pole.problem, pole.structure));
}

TEST_CASE("a reduced prior is filled unless two products share a factor") {
    auto const filled = [](auto const& s) {
        auto const map = reduction::find(s.problem, s.structure);
        REQUIRE(map);
        return map->fills();
    };
    CHECK(filled(products()));
    CHECK(filled(idle()));
    CHECK(filled(shared_factor())); // of one product and p2
    CHECK_FALSE(filled(make(
        3,
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * p[1] - p[1] * p[2] * x[0]};
        },
        shared_prior)));
}

TEST_CASE("parameters that act nowhere are spared without any product") {
    auto const s = idle();
    auto const map = reduction::find(s.problem, s.structure);
    REQUIRE(map);
    CHECK(map->side_names() == std::vector<std::string>{"p0", "p2"});
    for (std::size_t j = 0; j < 4; ++j) CHECK(map->acts(j) == (j % 2 == 0));
    auto const none = [](std::size_t constants) {
        return make(
            constants,
            [](auto const&, auto const& x, auto const&, auto const&) { return std::vector{-x[0]}; },
            box(std::vector<interval>(constants, between(1, 2))));
    };
    auto const still = none(3); // one is kept: a search needs a side
    auto const last = reduction::find(still.problem, still.structure);
    REQUIRE(last);
    CHECK(last->side_names() == std::vector<std::string>{"p0"});
    CHECK_FALSE(reduction::find(none(1).problem, none(1).structure));
    CHECK(reduction::find(products().problem, products().structure)->acts(0));
}

TEST_CASE("unknowns that act nowhere cost the search nothing") {
    draws d(377);
    std::size_t inside = 0;
    for (int round = 0; round < 6; ++round) {
        auto const planted =
            support::plant(d, {1, 4, 0, 10}, idle_rate, idle_prior, {1},
                           {.experiments = 2, .samples = 8, .noise = d.uniform(0.01, 0.1)});
        auto plain = planted.problem;
        for (std::size_t const j : {1u, 3u}) {
            plain.choice.fixed[planted.problem.choice.unknown[j]] = interval(planted.truth[j]);
        }
        plain.choice.unknown = {"p0", "p2"};
        plain.prior = {idle_prior[0], idle_prior[2]};
        identify_options options;
        options.search.boxes = 300;
        options.search.seconds = 1e9;
        auto const found = identify(planted.problem, options);
        auto const alone = identify(plain, options);
        CHECK(found.verdict == verdict::consistent);
        CHECK(contains(found.hull, planted.truth));
        CHECK(found.integrations <= alone.integrations + 4);
        CHECK(width(found.hull[0]) <= 1.05 * width(alone.hull[0]));
        CHECK(width(found.hull[2]) <= 1.05 * width(alone.hull[1]));
        CHECK(found.paving.outer_volume().upper() <= 1.05 * alone.paving.outer_volume().upper());
        for (auto const& b : found.paving.boxes()) {
            CHECK(subset(idle_prior[1], b.set[1])); // never cut there
            CHECK(subset(idle_prior[3], b.set[3]));
            if (b.verdict != box_verdict::inside) continue;
            ++inside;
            auto const p = d.in(b.set);
            for (std::size_t e = 0; e < 2; ++e) {
                CHECK(planted.violated(e, p, planted.starts[e], 1e-10) == 0);
            }
        }
    }
    CHECK(inside > 0);
}

TEST_CASE("identification through a reduction contains the truth and claims nothing false") {
    draws d(373);
    for (int round = 0; round < 8; ++round) {
        auto const planted = support::plant(d, 2,
                                            {.experiments = 2,
                                             .samples = 8,
                                             .outliers = d.below(2),
                                             .noise = d.uniform(0.03, 0.2)});
        auto const allowed = planted.problem.experiments[0].outliers;
        identify_options options;
        options.search.accuracy = 1.0 / 32;
        options.search.boxes = 400;
        options.search.sufficient_ratio = 1;
        auto const found = identify(planted.problem, options);
        CHECK(contains(found.hull, planted.truth));
        CHECK(found.verdict != verdict::inconsistent);
        for (auto const& b : found.paving.boxes()) {
            if (b.verdict == box_verdict::outside) CHECK_FALSE(contains(b.set, planted.truth));
            if (b.verdict != box_verdict::inside || d.below(8) != 0) continue;
            auto const p = d.in(b.set);
            for (std::size_t e = 0; e < 2; ++e) {
                CHECK(planted.violated(e, p, planted.starts[e], 1e-10) <= allowed);
            }
        }
    }
}

TEST_CASE("a factor that is known alone, too, costs no truth") {
    draws d(376);
    for (int round = 0; round < 12; ++round) {
        auto const planted =
            support::plant(d, {1, 3, 0, 10}, shared_rate, shared_prior, {1},
                           {.experiments = 2, .samples = 10, .noise = d.uniform(0.01, 0.1)});
        identify_options options;
        options.search.boxes = 200;
        auto const found = identify(planted.problem, options);
        CHECK(found.verdict != verdict::inconsistent);
        CHECK(contains(found.hull, planted.truth));
        REQUIRE(found.combinations.size() == 1);
        CHECK(found.combinations[0].what.formula == "p0*p1");
        auto const exact = mp(planted.truth[0]) * mp(planted.truth[1]);
        CHECK(support::encloses(found.combinations[0].hull, exact));
        CHECK(width(found.hull[2]) < 0.7 * width(shared_prior[2]));
    }
}

TEST_CASE("every reduced point has an original one close to its image") {
    draws d(375);
    auto const s = products();
    auto const map = reduction::find(s.problem, s.structure);
    REQUIRE(map);
    for (int trial = 0; trial < 50; ++trial) {
        auto const r = mid(map->forward(point_box(d.in(s.problem.prior))));
        auto const p = map->approximate_preimage(s.problem.prior, r);
        CHECK(contains(s.problem.prior, p));
        auto const back = mid(map->forward(point_box(p)));
        REQUIRE(back.size() == r.size());
        for (std::size_t k = 0; k < r.size(); ++k) CHECK_THAT(back[k], WithinAbs(r[k], 1e-8));
    }
    // A point that is the image of none: still within the prior.
    auto const far = map->approximate_preimage(
        s.problem.prior, std::vector<double>(map->problem().prior.size(), 99));
    CHECK(contains(s.problem.prior, far));
}
