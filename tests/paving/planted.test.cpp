// SPDX-License-Identifier: MIT
// Thousands of random problems with a planted truth: nothing that `identify` proves may contradict
// it. One seed is one problem; SIVID_PLANTED=first:count selects others than the default ones.
#include <sivid/paving/identify.hpp>

#include "support/catch.hpp"
#include "support/planted_problems.hpp"
#include "support/power_series.hpp"
#include "support/some_start.hpp"
#include "support/sweep.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string_view>

using namespace sivid;
using support::draws;
using support::planted_problem;

namespace {

constexpr double slack = 1e-10; // the reference is better than that, kinks included

/// How often each kind of claim was made: a sweep that makes none proves nothing.
struct tally {
    std::size_t problems = 0, consistent = 0, witnesses = 0, inside_points = 0, forced = 0,
                combinations = 0, excluded = 0, feasible_points = 0,
                other_starts = 0; ///< points of inside boxes that neither known start explains
};

/// Whether p explains the data for one of the known starts.
bool explains(planted_problem const& planted, identification const& found,
              std::vector<double> const& p, double room) {
    for (std::size_t e = 0; e < planted.starts.size(); ++e) {
        auto const allowed = planted.problem.experiments[e].outliers;
        bool holds = planted.violated(e, p, planted.starts[e], room) <= allowed;
        if (!holds && found.guess) {
            holds = planted.violated(e, p, found.guess->starts[e], room) <= allowed;
        }
        if (!holds) return false;
    }
    return true;
}

/// Whether p explains the data for some starts: those are found by fits.
bool explains_from_some(planted_problem const& planted, identification const& found,
                        std::vector<double> const& p) {
    for (std::size_t e = 0; e < planted.starts.size(); ++e) {
        std::vector<std::vector<double>> tries{planted.starts[e]};
        if (found.guess) tries.push_back(found.guess->starts[e]);
        if (!support::some_start_explains(planted, e, p, tries, slack)) return false;
    }
    return true;
}

bool is_covered(subpaving const& paving, std::vector<double> const& p) {
    return std::any_of(paving.boxes().begin(), paving.boxes().end(), [&](auto const& b) {
        return b.verdict != box_verdict::outside && contains(b.set, p);
    });
}

void check_witness(planted_problem const& planted, verified_witness const& w) {
    CHECK(contains(planted.problem.prior, w.parameters));
    for (std::size_t e = 0; e < planted.starts.size(); ++e) {
        auto const& own = planted.problem.experiments[e];
        CHECK(contains(own.initial, w.starts[e]));
        auto const y = planted.simulate(e, w.parameters, w.starts[e]);
        auto const samples = sorted(own.measurements);
        REQUIRE(w.violated[e].size() == samples.size());
        auto const violated = std::count(w.violated[e].begin(), w.violated[e].end(), true);
        CHECK(static_cast<std::size_t>(violated) <= own.outliers);
        for (std::size_t k = 0; k < samples.size(); ++k) {
            if (w.violated[e][k]) continue;
            CHECK(samples[k].bound.lower() - slack <= y[k]);
            CHECK(y[k] <= samples[k].bound.upper() + slack);
        }
    }
}

identify_options small_budget(draws& d) {
    identify_options o;
    o.search.accuracy = d.coin() ? 1.0 / 16 : 1.0 / 128;
    o.search.boxes = 20 + d.below(100);
    o.search.seconds = 20;
    o.search.sufficient_ratio = d.coin() ? 0.5 : 1;
    o.search.keep_outside = d.coin();
    o.only_hulls = d.below(4) == 0;
    o.drawn_boxes = 30 + d.below(200);
    o.test.cut = d.below(5) > 0;
    if (d.below(6) == 0) o.test.set = carried_set::doubleton;
    if (d.below(12) == 0) o = by_bisection(o);
    return o;
}

/// Starts known to a few bounds' widths instead; the truth may lie at an end.
void widen_starts(draws& d, planted_problem& planted) {
    for (std::size_t e = 0; e < planted.starts.size(); ++e) {
        auto& own = planted.problem.experiments[e];
        double const wide = d.uniform(0.5, 3) * rad(own.measurements[0].bound);
        for (std::size_t i = 0; i < own.initial.size(); ++i) {
            if (d.below(4) == 0) continue;
            double const at = planted.starts[e][i];
            double const below = d.below(5) == 0 ? 0 : d.uniform(0, wide);
            own.initial[i] = hull(own.initial[i], support::between(at - below, at + wide - below));
        }
    }
}

/// Everything that a result claims, against the truth and against the reference.
void check_seed(std::uint64_t seed, tally& t, bool wide_starts) {
    CAPTURE(seed);
    draws d(seed);
    auto planted = planted::plant_by_seed(d);
    if (wide_starts) widen_starts(d, planted);
    auto const& truth = planted.truth;
    auto const options = small_budget(d);
    auto const found = identify(planted.problem, options);
    ++t.problems;
    CHECK(found.verdict != verdict::inconsistent);
    CHECK(contains(found.hull, truth));
    CHECK(is_covered(found.paving, truth));
    for (auto const& c : found.combinations) {
        support::mp exact = 1;
        for (std::size_t j = 0; j < truth.size(); ++j) {
            exact *= support::real::pown(support::mp(truth[j]), c.what.exponents[j]);
        }
        CAPTURE(c.what.formula);
        CHECK(support::encloses(c.hull, exact, 1e-30));
        ++t.combinations;
    }
    for (auto const& f : found.forced) {
        CHECK(planted.outliers[f.experiment].count(f.measurement) == 1);
        ++t.forced;
    }
    if (found.witness) {
        CHECK(found.verdict == verdict::consistent);
        check_witness(planted, *found.witness);
        ++t.witnesses;
    }
    t.consistent += found.verdict == verdict::consistent ? 1 : 0;
    t.excluded += found.paving.outer_volume().upper() < 0.99 ? 1 : 0;
    CHECK(found.paving.inner_volume().lower() <= found.paving.outer_volume().upper());
    std::vector<box const*> inside;
    for (auto const& b : found.paving.boxes()) {
        if (b.verdict == box_verdict::inside) inside.push_back(&b.set);
    }
    for (int sample = 0; sample < 12 && !inside.empty(); ++sample) {
        auto const p = d.in(*inside[d.below(inside.size())]);
        CAPTURE(p);
        bool const known_starts = explains(planted, found, p, slack);
        CHECK((known_starts || explains_from_some(planted, found, p)));
        t.other_starts += known_starts ? 0 : 1;
        ++t.inside_points;
    }
    // Other feasible points, near the truth, may be lost no more than the truth itself.
    for (int sample = 0; sample < 12; ++sample) {
        auto p = truth;
        double const share = std::pow(10.0, d.uniform(-3, 0));
        for (std::size_t j = 0; j < p.size(); ++j) {
            p[j] += share * (d.in(planted.problem.prior[j]) - p[j]);
        }
        if (!contains(planted.problem.prior, p) || !explains(planted, found, p, -slack)) continue;
        CAPTURE(p);
        CHECK(contains(found.hull, p));
        CHECK(is_covered(found.paving, p));
        ++t.feasible_points;
    }
}

tally sweep(std::uint64_t first, std::uint64_t count, bool wide_starts) {
    tally t;
    for (auto seed = first; seed < first + count; ++seed) check_seed(seed, t, wide_starts);
    UNSCOPED_INFO("of " << t.problems << " problems " << t.consistent << " consistent, "
                        << t.witnesses << " witnesses, " << t.excluded << " with parts excluded; "
                        << t.inside_points << " points of inside boxes, " << t.other_starts
                        << " of them from starts of their own, " << t.feasible_points
                        << " feasible points, " << t.forced << " forced outliers, "
                        << t.combinations << " combinations");
    CHECK(3 * t.consistent > t.problems);
    CHECK(2 * t.excluded > t.problems);
    CHECK(t.inside_points > t.problems);
    CHECK(t.feasible_points > t.problems);
    CHECK(10 * t.forced > t.problems);
    CHECK(20 * t.combinations > t.problems); // a tenth in the mean; of 500, 40 to 70 have some
    return t;
}

} // namespace

TEST_CASE("no claim contradicts a planted truth") { sweep(1, support::swept(25U, 60U), false); }

TEST_CASE("no claim contradicts a planted truth with uncertain starts") {
    auto const t = sweep(201, support::swept(25U, 40U), true);
    CHECK(2 * t.other_starts > t.problems); // neither the fit's starts nor the true ones
}

TEST_CASE("no claim contradicts a planted truth, ten thousand problems", "[.long]") {
    std::uint64_t first = 1000, count = 10'000;
    if (auto const* const chosen = std::getenv("SIVID_PLANTED")) {
        std::string_view const text = chosen;
        auto const colon = text.find(':');
        REQUIRE(colon != text.npos);
        std::from_chars(text.data(), text.data() + colon, first);
        std::from_chars(text.data() + colon + 1, text.data() + text.size(), count);
    }
    sweep(first, count, false);
    sweep(first, count / 10, true);
}
