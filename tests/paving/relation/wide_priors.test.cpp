// SPDX-License-Identifier: MIT
// Sums that are conserved and sides that states keep, told without a trajectory over priors that
// are far too wide for one.
#include "paving/relation/planted_balances.hpp"
#include "support/catch.hpp"
#include "support/sweep.hpp"

#include <sivid/paving/identify.hpp>
#include <sivid/paving/observer/detail/observer_contraction.hpp>
#include <sivid/paving/relation/relation_contraction.hpp>

using namespace relation_support;

namespace {

/// Growth from about (0.2, 8, 0) with mu = 0.3, K = 3, Yxs = 0.2, Yps = 0.5.
identification_problem batch(double bias) {
    double const t[] = {2, 4, 6, 8, 10, 12};
    double const x[] = {0.308, 0.473, 0.714, 1.050, 1.445, 1.729};
    experiment e;
    e.name = "batch";
    e.initial = {around(0.2, 0.1), around(8, 0.5), around(0, 0.05)};
    for (std::size_t k = 0; k < 6; ++k) {
        double const p = 0.5 * (x[k] - 0.2) + (k == 4 ? bias : 0);
        e.measurements.push_back({t[k], 0, around(x[k], 0.06)});
        e.measurements.push_back({t[k], 1, around(8 - (x[k] - 0.2) / 0.2, 0.6)});
        e.measurements.push_back({t[k], 2, around(p, 0.03)});
    }
    return {support::model_of({3, 4, 0}, growth),
            {support::all_constants(4), {}},
            box{between(0.05, 1), between(0.5, 15), between(0.05, 0.5), between(0.1, 3)},
            {e}};
}
/// An infection in shares of a population; beta - gamma = 0.2 as long as s is 1.
identification_problem region(double most) {
    experiment e;
    e.name = "region";
    e.initial = {interval(1), interval(1e-6)};
    for (int k = 1; k <= 10; ++k) {
        double const i = 1e-6 * std::exp(0.2 * k);
        e.measurements.push_back({1. * k, 0, interval(0.9 * i, 1.1 * i)});
    }
    auto const shown = [](expression const&, terms const& x, terms const&, terms const&) {
        return terms{x[1]};
    };
    return {support::model_of({2, 2, 0, 10}, epidemic, shown),
            {support::all_constants(2), {}},
            box{between(0, most), between(0, 1)},
            {e}};
}

} // namespace

TEST_CASE("no parameter is removed from priors that are far too wide") {
    draws d(751);
    auto const count = support::swept(4, 200);
    for (auto const& what : all_balanced()) {
        auto const m = support::model_of(what.system.shape, what.system.rate);
        double left = 0;
        for (int n = 0; n < count; ++n) {
            auto r = record_of(d, what, m);
            INFO(what.system.name << " " << n);
            // From the prior or a part of it, by equations and observers in any order.
            auto& x = r.problem.prior;
            if (d.coin()) x = part_about(d, x, r.truth);
            auto const whole = x;
            relation_test const equations(
                r.problem, {.rounds = 1 + d.below(4), .cells_per_gap = 1 + d.below(6)});
            observer_contraction observers(r.problem, {.rounds = 2});
            for (auto turns = 1 + d.below(3); turns > 0; --turns) {
                auto const found = equations(x);
                CHECK(found.verdict != box_verdict::outside);
                x = found.rest;
                if (d.below(4) == 0) x = observers(x);
                if (d.coin()) x = part_about(d, x, r.truth);
                REQUIRE(contains(x, r.truth));
            }
            left += relative_volume(x, whole).upper();
        }
        // Of the prior, or of the part of it that was taken.
        CHECK(left / count < (what.system.name == "prey and hunter" ? 0.8 : 0.6));
    }
}

TEST_CASE("a conserved sum bounds its weights and refutes, whatever the rate law is") {
    auto const fits = contract_by_relations(batch(0));
    CHECK((fits[2].lower() > 0.15 && fits[2].lower() < 0.2));
    CHECK((fits[2].upper() < 0.26 && fits[2].upper() > 0.2));
    CHECK((fits[3].lower() > 0.42 && fits[3].lower() < 0.5));
    CHECK((fits[3].upper() < 0.6 && fits[3].upper() > 0.5));
    CHECK(is_empty(contract_by_relations(batch(-0.5))));
    // A law with further constants that nobody knows.
    auto problem = batch(0);
    auto const law = [](expression const&, terms const& x, terms const& p, terms const&) {
        auto const g = p[0] * sqr(x[0]) * log(1 + x[1] / p[1]) * exp(-p[0] * x[2]);
        return terms{g, -g / p[2], p[3] * g};
    };
    problem.model = support::model_of({3, 4, 0}, law);
    auto const other = contract_by_relations(problem);
    CHECK((other[2].lower() > 0.15 && other[2].upper() < 0.26));
    CHECK((other[3].lower() > 0.42 && other[3].upper() < 0.6));
}

TEST_CASE("one reading refutes nearly all of a prior that is far too wide") {
    for (double const most : {1.5, 100., 1e7}) {
        auto const rest = contract_by_relations(region(most));
        CAPTURE(most, rest[0].lower(), rest[0].upper());
        CHECK((rest[0].lower() <= 0.2 && rest[0].upper() < 4 && rest[0].upper() > 1.2));
    }
}

TEST_CASE("identify bounds yields by conserved sums, and refutes a sum that is broken") {
    identify_options o;
    o.search.seconds = 3;
    auto const fits = identify(batch(0), o), broken = identify(batch(-0.5), o);
    CHECK((fits.hull[2].lower() > 0.15 && fits.hull[2].upper() < 0.26));
    CHECK((fits.hull[3].lower() > 0.42 && fits.hull[3].upper() < 0.6));
    CHECK(contains(fits.hull, std::vector<double>{0.3, 3, 0.2, 0.5}));
    CHECK(broken.verdict == verdict::inconsistent);
    CHECK(broken.integrations < 10);
    // No sound bound ends at 0.25: this explains the data.
    auto high = batch(0);
    high.prior = point_box({0.445379, 5.03549, 0.2503, 0.464475});
    high.experiments[0].initial = {interval(0.146981), interval(7.5), interval(0.002495)};
    CHECK(identify(high, o).verdict == verdict::consistent);
}

TEST_CASE("identify halves what the equations leave of a prior that is far too wide") {
    identify_options o;
    o.search.seconds = 20;
    auto const found = identify(region(1e7), o);
    CHECK(found.hull[0].upper() < 1.3);
    CHECK(found.hull[0].lower() <= 0.2);
    CHECK(found.integrations < 1000);
}
