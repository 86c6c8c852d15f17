// SPDX-License-Identifier: MIT
// What data can tell: models with known answers, planted structure that no proved rank may exceed,
// and directions against simulations in extended precision.
#include <sivid/paving/identifiability.hpp>

#include "support/catch.hpp"
#include "support/hovercraft_campaign.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/real_functions.hpp"
#include "support/reference.hpp"

#include <algorithm>
#include <cmath>

using namespace sivid;
using support::between;
using support::draws;

namespace {

constexpr double bound_of = 0.01; ///< half-width of every measurement's bound
std::vector<double> const times_seen{0.25, 0.5, 1, 1.5, 2};

/// One experiment that measures every channel at `times_seen`.
template <class Rate, class Observe>
identification_problem posed(support::shape const& s, Rate const& rate, Observe const& observe,
                             box const& prior, box const& initial) {
    identification_problem problem;
    problem.model = support::model_of(s, rate, observe);
    problem.choice.unknown = support::all_constants(s.constants);
    problem.prior = prior;
    experiment e;
    e.name = "E";
    e.initial = initial;
    for (double const t : times_seen) {
        for (std::size_t y = 0; y < problem.model.about.channels.size(); ++y) {
            e.measurements.push_back({t, y, support::around(0.5, bound_of)});
        }
    }
    problem.experiments = {e};
    return problem;
}
constexpr auto states_seen = [](auto const&, auto const& x, auto const&, auto const&) { return x; };

identifiability in_the_middle(identification_problem const& problem) {
    return identifiability_of(problem, point_box(mid(problem.prior)));
}
std::vector<std::string> texts(std::vector<fixed_formula> const& list) {
    std::vector<std::string> result;
    for (auto const& f : list) result.push_back(f.formula);
    return result;
}
bool all_proved(identifiability const& found) {
    return std::all_of(found.free.begin(), found.free.end(),
                       [](auto const& m) { return m.proved; });
}
void check_ranks(identifiability const& found, std::size_t rank) {
    CHECK(found.least_rank == rank);
    CHECK(found.approximate_rank == rank);
    CHECK(found.most_rank == rank);
    CHECK(found.free.size() == found.unknowns.size() - rank);
    CHECK(all_proved(found));
}

box const two_sides{between(0.5, 2), between(0.4, 1.1)};
box const from_one{interval(1.0)};

} // namespace

TEST_CASE("a product, a sum and a ratio are what the data tell, by proof") {
    auto const decay = [](auto const& coefficient) {
        return posed(
            {1, 2},
            [coefficient](auto const&, auto const& x, auto const& p, auto const&) {
                return std::vector{-(coefficient(p) * x[0])};
            },
            states_seen, two_sides, from_one);
    };
    auto const product = in_the_middle(decay([](auto const& p) { return p[0] * p[1]; }));
    check_ranks(product, 1);
    CHECK(texts(product.fixed) == std::vector<std::string>{"p0*p1"});
    CHECK(product.free[0].kind == motion_kind::scaling);
    CHECK(product.free[0].weights == std::vector{1, -1});
    CHECK(product.free[0].noticed < 1e-6);
    CHECK(product.directions[0].noticed > 10);
    CHECK(product.directions[1].noticed < 1e-6);
    CHECK_FALSE(product.tells_all_apart());

    auto const sum = in_the_middle(decay([](auto const& p) { return p[0] + p[1]; }));
    check_ranks(sum, 1);
    CHECK(texts(sum.fixed) == std::vector<std::string>{"p0 + p1"});
    CHECK(sum.fixed[0].proved);

    auto const ratio = in_the_middle(decay([](auto const& p) { return p[0] / sqr(p[1]); }));
    check_ranks(ratio, 1);
    CHECK(texts(ratio.fixed) == std::vector<std::string>{"p0/p1^2"});

    // A function of a product that is not multiplied out by the search for products.
    auto const inside = in_the_middle(decay([](auto const& p) { return exp(p[0] - 2 * p[1]); }));
    check_ranks(inside, 1);
    CHECK(texts(inside.fixed) == std::vector<std::string>{"p0 - 2*p1"});
}

TEST_CASE("products and sums together, and a parameter that does not act") {
    box const prior{between(0.5, 2), between(0.4, 1.1), between(-1, 1), between(-1, 2),
                    between(1, 3)};
    auto const both = in_the_middle(posed(
        {1, 5},
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[2] + p[3] - p[0] * p[1] * x[0]};
        },
        states_seen, prior, from_one));
    check_ranks(both, 2);
    CHECK(texts(both.fixed) == std::vector<std::string>{"p0*p1", "p2 + p3"});
    CHECK(std::any_of(both.free.begin(), both.free.end(), [](auto const& m) {
        return m.weights == std::vector{0, 0, 0, 0, 1};
    }));
}

TEST_CASE("what is identifiable has full rank, at a point and apart over a box") {
    auto const problem = posed(
        {2, 3},
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{x[1], -(p[0] * x[0]) - p[1] * x[1] + p[2]};
        },
        states_seen, box{between(1, 3), between(0.1, 0.6), between(0.2, 0.8)},
        box{interval(1.0), interval(0.0)});
    auto const found = in_the_middle(problem);
    check_ranks(found, 3);
    CHECK(found.tells_all_apart());
    CHECK((found.fixed.empty() && found.nearly_free.empty() && found.missing == 0));
    CHECK(found.outputs == 10);
    auto const around = identifiability_of(
        problem, box{between(1.995, 2.005), between(0.347, 0.353), between(0.497, 0.503)});
    CHECK(around.tells_all_apart());
    CHECK(around.least_rank == 3);
}

TEST_CASE("Michaelis and Menten at low substrate: nearly the ratio alone") {
    auto const problem = [](double substrate) {
        return posed(
            {1, 2},
            [](auto const&, auto const& x, auto const& p, auto const&) {
                return std::vector{-(p[0] * x[0] / (p[1] + x[0]))};
            },
            states_seen, box{between(4, 16), between(5, 20)}, box{interval(substrate)});
    };
    auto const low = in_the_middle(problem(0.1));
    CHECK(low.least_rank == 2);
    CHECK(low.free.empty());
    REQUIRE(low.nearly_free.size() == 1);
    CHECK(low.nearly_free[0].weights == std::vector{1, 1});
    CHECK(low.nearly_free[0].noticed < 0.2);
    CHECK_FALSE(low.nearly_free[0].proved);
    CHECK(texts(low.nearly_fixed) == std::vector<std::string>{"p0/p1"});
    auto const high = in_the_middle(problem(8));
    CHECK((high.least_rank == 2 && high.nearly_free.empty()));
}

TEST_CASE("unknown starts count, and may move along with a gain") {
    auto const problem = posed(
        {1, 2},
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{-(p[0] * x[0])};
        },
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[1] * x[0]};
        },
        two_sides, box{between(0.5, 1.5)});
    auto const found = in_the_middle(problem);
    check_ranks(found, 2);
    CHECK(found.unknowns[2].name == "x0(E)");
    CHECK(texts(found.fixed) == std::vector<std::string>{"p1*x0(E)"});
    auto const held = identifiability_of(problem, point_box(mid(problem.prior)), {.starts = false});
    check_ranks(held, 2);
    CHECK(held.unknowns.size() == 2);
}

TEST_CASE("the hovercraft's manoeuvre S3 tells L*Sg") {
    draws d(641);
    auto problem = support::hovercraft_campaign(d, {}, {});
    problem.experiments = {problem.experiments[2]};
    auto const found = in_the_middle(problem);
    check_ranks(found, 2);
    CHECK(texts(found.fixed) == std::vector<std::string>{"L*Sg"});
    CHECK(found.outputs == 180);
}

TEST_CASE("nine parameters and unknown starts of the hovercraft: the proved ranks meet") {
    draws d(643);
    support::hover_options options;
    options.priors = {
        {"Sv", between(0.2, 0.25)},   {"Sg", between(0.02, 0.06)}, {"L", between(0.25, 0.35)},
        {"m", between(1.1, 1.5)},     {"Iz", between(0.04, 0.08)}, {"D22", between(0.1, 0.3)},
        {"D33", between(0.05, 0.15)}, {"Ff", between(0.3, 0.7)},   {"Su", between(0.1, 0.15)}};
    options.uncertain_starts = true;
    auto const found = in_the_middle(support::hovercraft_campaign(d, {}, options));
    CHECK(found.unknowns.size() == 24);
    CHECK(found.outputs == 1560);
    check_ranks(found, 22);
    CHECK(texts(found.fixed) == std::vector<std::string>{"D33/(L*Sg)", "Iz/(L*Sg)"});
}

TEST_CASE("no proved rank exceeds what the planted structure allows") {
    draws d(642);
    int equal = 0, rounds = 0;
    for (int round = 0; round < 60; ++round) {
        std::size_t const n = 2 + d.below(3);
        // x' = sum_k c_k(p) x^k with few c, each a product or a sum of two parameters.
        struct coefficient {
            std::size_t a, b;
            std::size_t kind;
        };
        std::vector<coefficient> terms;
        for (std::size_t k = 0, m = 1 + d.below(3); k < m; ++k) {
            terms.push_back({d.below(n), d.below(n), d.below(3)});
        }
        auto const rate = [&terms](auto const&, auto const& x, auto const& p, auto const&) {
            auto sum = x[0] * 0;
            auto power = x[0] * 0 + 1;
            for (auto const& q : terms) {
                auto const c = q.kind == 0   ? p[q.a] * p[q.b]
                               : q.kind == 1 ? p[q.a] / p[q.b]
                                             : p[q.a] + p[q.b];
                sum = sum - c * power * 0.25;
                power = power * x[0];
            }
            return std::vector{sum};
        };
        box prior(n);
        for (std::size_t j = 0; j < n; ++j) {
            double const lo = d.uniform(0.3, 1);
            prior[j] = between(lo, lo + d.uniform(0.2, 1));
        }
        auto const problem = posed({1, n}, rate, states_seen, prior, from_one);
        box at(n);
        double const share = d.coin() ? 0 : d.uniform(0, 0.3);
        for (std::size_t j = 0; j < n; ++j) {
            double const p = d.uniform(prior[j].lower(), prior[j].upper());
            at[j] = between(p, p + share * width(prior[j]));
        }
        auto const found = identifiability_of(problem, at);
        // The outputs are functions of as many numbers as there are terms.
        REQUIRE(found.least_rank <= std::min(n, terms.size()));
        REQUIRE(found.least_rank <= found.most_rank);
        if (share == 0) {
            REQUIRE(found.least_rank <= found.approximate_rank);
            REQUIRE(found.approximate_rank <= found.most_rank);
            ++rounds;
            equal += found.least_rank == found.approximate_rank ? 1 : 0;
        }
        // What is called free changes nothing, by simulation.
        for (auto const& m : found.free) {
            support::extended_state here, there;
            for (std::size_t j = 0; j < n; ++j) {
                double const p = d.in(prior[j]);
                double const w = 0.1 * m.weights[j];
                here.push_back(p);
                there.push_back(m.kind == motion_kind::scaling ? p * std::exp(w) : p + w);
            }
            auto const a = support::reference_states(rate, {1}, here, 0, {1}, {}, 1e-14L)[0][0];
            auto const b = support::reference_states(rate, {1}, there, 0, {1}, {}, 1e-14L)[0][0];
            REQUIRE(std::abs(a - b) < 1e-6L);
        }
    }
    CHECK(equal > 0.9 * rounds);
}

TEST_CASE("directions are noticed as simulations say") {
    auto const rate = [](auto const&, auto const& x, auto const& p, auto const&) {
        using namespace support::real;
        return std::vector{x[1], -(p[0] * sin(x[0])) - p[1] * x[1] + p[2] * p[2]};
    };
    box const prior{between(1, 3), between(0.1, 0.6), between(-0.3, 0.5)};
    auto const problem = posed({2, 3}, rate, states_seen, prior, box{interval(1.0), interval(0.0)});
    auto const found = identifiability_of(problem, point_box({1.7, 0.3, 0.2}));
    REQUIRE(found.directions.size() == 3);
    double last = HUGE_VAL;
    for (auto const& direction : found.directions) {
        // Central differences along the direction, logarithmic where the prior does not touch 0.
        auto const outputs = [&](double s) {
            support::extended_state p{1.7L, 0.3L, 0.2L};
            for (std::size_t j = 0; j < 2; ++j) {
                p[j] *= std::exp(s * direction.components[j] *
                                 std::log(prior[j].upper() / prior[j].lower()));
            }
            p[2] += s * direction.components[2] * 0.8;
            return support::reference_states(rate, {1, 0}, p, 0, times_seen, {}, 1e-16L);
        };
        double const step = 1e-4;
        auto const ahead = outputs(step), behind = outputs(-step);
        double noticed = 0, largest = 0;
        for (std::size_t k = 0; k < ahead.size(); ++k) {
            for (std::size_t i = 0; i < 2; ++i) {
                auto const slope = std::abs(ahead[k][i] - behind[k][i]) / (2 * step);
                noticed = std::max(noticed, static_cast<double>(slope) / bound_of);
            }
        }
        for (double const c : direction.components) largest = std::max(largest, std::abs(c));
        CHECK(std::abs(largest - 1) < 1e-12);
        CHECK(std::abs(direction.noticed - noticed) < 1e-5 * noticed);
        last = std::min(last, direction.noticed);
    }
    CHECK(found.directions.back().noticed == last);
}

TEST_CASE(
    "where every prior touches 0 there is no product, and of nothing unknown there is nothing") {
    auto const sum = [](box const& prior) {
        return in_the_middle(posed(
            {1, 2},
            [](auto const&, auto const& x, auto const& p, auto const&) {
                return std::vector{(p[0] + p[1]) * (1 - x[0])};
            },
            states_seen, prior, box{interval(0.0)}));
    };
    auto const touching = sum(box{between(0, 2), between(-1, 1)});
    check_ranks(touching, 1);
    CHECK(texts(touching.fixed) == std::vector<std::string>{"p0 + p1"});
    auto const known = sum(box{interval(0.5), interval(0.25)});
    CHECK(known.unknowns.empty());
    CHECK(known.outputs == times_seen.size());
    CHECK(known.directions.empty());
    check_ranks(known, 0);
    CHECK(known.tells_all_apart());
}

TEST_CASE("what does not fit is refused") {
    auto const problem = posed(
        {1, 2},
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{-(p[0] * x[0]) + p[1]};
        },
        states_seen, two_sides, from_one);
    CHECK_THROWS_AS(identifiability_of(problem, box{interval(1.0)}), std::invalid_argument);
    CHECK_THROWS_AS(
        identifiability_of(problem, box{interval(1.0), interval_traits<interval>::empty()}),
        std::invalid_argument);
}
