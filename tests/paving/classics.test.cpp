// SPDX-License-Identifier: MIT
// Published estimation problems with a known truth: what is proved of them, against simulation.
#include <sivid/approximate/fit/fit.hpp>
#include <sivid/paving/identify.hpp>

#include "../../benchmarks/paving/classics.hpp"
#include "support/catch.hpp"
#include "support/reference.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

using namespace sivid;
using paving_benchmark::classic;
using support::extended;
using support::extended_state;

namespace {

/// The states at the times of the measurements.
template <class Rate>
std::vector<extended_state> solved(classic const& c, Rate const& rate,
                                   std::vector<double> const& start) {
    std::vector<double> times;
    for (auto const& m : c.problem.experiments[0].measurements) times.push_back(m.time);
    return support::reference_states(rate, extended_state(start.begin(), start.end()),
                                     extended_state(c.truth.begin(), c.truth.end()), 0, times, {},
                                     1e-15L);
}

bool within(interval const& bound, extended y) {
    return static_cast<extended>(bound.lower()) <= y && y <= static_cast<extended>(bound.upper());
}

identification identified(classic const& c, double accuracy, std::size_t boxes,
                          std::optional<double> longest_step = 1) {
    identify_options o;
    o.search.accuracy = accuracy;
    o.search.boxes = boxes;
    o.search.seconds = 1e9;
    o.only_hulls = true;
    o.test.maximum_step = longest_step; // 1: a twenty-fifth of the longest record
    return identify(c.problem, o);
}

bool is_left(identification const& found, std::vector<double> const& p) {
    auto const& boxes = found.paving.boxes();
    return contains(found.hull, p) &&
           std::any_of(boxes.begin(), boxes.end(), [&](paved_box const& b) {
               return b.verdict != box_verdict::outside && contains(b.set, p);
           });
}

/// Looks for parameters near the ends of a hull that explain the data, by fits with one of them
/// held: they must be left. @returns the widths that they span, as shares of the hull's
std::vector<double> spanned(classic const& c, identification const& found) {
    std::vector<double> shares;
    for (std::size_t j = 0; j < found.hull.size(); ++j) {
        double ends[2] = {c.truth[j], c.truth[j]};
        for (int side = 0; side < 2; ++side) {
            double const end = side == 0 ? found.hull[j].lower() : found.hull[j].upper();
            for (double const share : {0.005, 0.01, 0.02, 0.04, 0.06, 0.08, 0.1, 0.2, 0.4}) {
                auto pinned = c.problem;
                double const inward = share * width(found.hull[j]);
                double const value = side == 0 ? end + inward : end - inward;
                pinned.prior[j] = interval(value);
                approximate_fitter fit(pinned);
                auto here = fit();
                if (!(here.inflation < 0.9999)) here = fit({c.truth});
                if (!(here.inflation < 0.9999)) continue;
                CHECK(is_left(found, here.parameters));
                ends[side] = value;
                break;
            }
        }
        shares.push_back((ends[1] - ends[0]) / width(found.hull[j]));
    }
    return shares;
}

void check(classic const& c, identification const& found, double tightness) {
    CHECK(found.verdict == verdict::consistent);
    CHECK(found.witness);
    CHECK(is_left(found, c.truth));
    for (double const share : spanned(c, found)) CHECK(share > tightness);
}

} // namespace

TEST_CASE("the data of the classics are those of their truths") {
    auto const compartments = paving_benchmark::two_compartments_problem();
    auto const x = solved(
        compartments,
        [](auto const&, auto const& s, auto const& p, auto const&) {
            return std::vector{p[1] * s[1] - (p[0] + p[2]) * s[0], p[0] * s[0] - p[1] * s[1]};
        },
        {1, 0});
    auto const& levels = compartments.problem.experiments[0].measurements;
    for (std::size_t k = 0; k < x.size(); ++k) CHECK(within(levels[k].bound, x[k][1]));

    auto const exponentials = paving_benchmark::two_exponentials_problem();
    auto const& p = exponentials.truth;
    for (auto const& m : exponentials.problem.experiments[0].measurements) {
        CHECK(within(m.bound, p[0] * std::exp(extended(-p[1] * m.time)) +
                                  p[2] * std::exp(extended(-p[3] * m.time))));
    }
    for (unsigned seed = 1; seed < 20; ++seed) {
        auto const prey = paving_benchmark::lotka_volterra_problem(seed);
        auto const y =
            solved(prey,
                   [](auto const&, auto const& s, auto const& c, auto const&) {
                       return std::vector{(1 - c[0] * s[1]) * s[0], (c[1] * s[0] - 1) * s[1]};
                   },
                   {50, 50});
        auto const& counts = prey.problem.experiments[0].measurements;
        for (std::size_t k = 0; k < y.size(); ++k) CHECK(within(counts[k].bound, y[k][0]));
    }
}

TEST_CASE("two compartments: both sets of rates are kept, and the hulls are tight") {
    auto const c = paving_benchmark::two_compartments_problem();
    auto const found = identified(c, 0.01, 20000);
    check(c, found, 0.9);
    CHECK(is_left(found, {0.6, 0.35, 0.15})); // p2 and p3 may be exchanged
    // The paving knows what the hulls do not: that there is nothing between the two.
    CHECK_FALSE(is_left(found, {0.6, 0.25, 0.25}));
}

TEST_CASE("two compartments: an unknown start widens the hulls by what it explains, no more") {
    auto const c = paving_benchmark::two_compartments_problem(true);
    auto const found = identified(c, 0.02, 30000);
    check(c, found, 0.85);
    CHECK(found.hull[0].lower() < 0.49); // 0.58 with the known start
}

TEST_CASE("two exponentials: hulls as they were published") {
    auto const c = paving_benchmark::two_exponentials_problem();
    auto const found = identified(c, 0.01, 20000);
    check(c, found, 0.85);
    // By steps of a tenth of the record, too, the search goes on while sides still shrink.
    auto const by_default = identified(c, 0.01, 20000, std::nullopt);
    for (std::size_t j = 0; j < found.hull.size(); ++j)
        CHECK(width(by_default.hull[j]) < 1.05 * width(found.hull[j]));
}

TEST_CASE("Lotka and Volterra: hulls are tight in a prior with explosions") {
    for (unsigned seed = 1; seed < 6; ++seed) {
        auto const c = paving_benchmark::lotka_volterra_problem(seed);
        CAPTURE(seed);
        check(c, identified(c, 0.01, 2000), 0.9);
    }
}
