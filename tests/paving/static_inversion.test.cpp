// SPDX-License-Identifier: MIT
#include <sivid/paving/static_inversion.hpp>

#include "paving/static_models.hpp"
#include "support/catch.hpp"

#include <numbers>
#include <random>

using namespace sivid;
using static_models::mixed_problem;
using static_models::ring_problem;

namespace {

bool within(flat_boxes const& boxes, double p, double q) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (boxes.lower(i, 0) <= p && p <= boxes.upper(i, 0) && boxes.lower(i, 1) <= q &&
            q <= boxes.upper(i, 1)) {
            return true;
        }
    }
    return false;
}
static_inversion_options to(double accuracy) {
    static_inversion_options o;
    o.accuracy = accuracy;
    return o;
}
/// Samples of the prior agree with the paving.
void check_by_sampling(static_problem const& problem, flat_paving const& found, int samples) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-3, 3);
    int feasible = 0;
    for (int k = 0; k < samples; ++k) {
        double const p = place(random), q = place(random);
        bool const is = static_models::approximately_feasible(problem, p, q);
        feasible += is ? 1 : 0;
        if (is) CHECK((within(found.inside, p, q) || within(found.open, p, q)));
        if (within(found.inside, p, q)) CHECK(is);
    }
    CHECK(feasible > 0);
}

} // namespace

TEST_CASE("the area of the ring is pi") {
    auto const found = invert_static(ring_problem(), to(1.0 / 2048));
    double const inner = 100 * found.inner_volume().lower();
    double const open = 100 * found.uncertain_volume().upper();
    CHECK(inner < std::numbers::pi);
    CHECK(std::numbers::pi < inner + open);
    CHECK(open < 0.12);
    CHECK(found.reason == stop_reason::accuracy_reached);
    for (int k = 0; k < 1000; ++k) { // feasible points are never lost, others never inside
        double const a = 0.00628 * k;
        for (double const r : {1.0, 1.2, std::sqrt(2.0)}) {
            bool const some = within(found.inside, r * std::cos(a), r * std::sin(a)) ||
                              within(found.open, r * std::cos(a), r * std::sin(a));
            if (r * r > 1 && r * r < 2) CHECK(some);
        }
        for (double const r : {0.9999, 1.4143}) {
            CHECK_FALSE(within(found.inside, r * std::cos(a), r * std::sin(a)));
        }
    }
}

TEST_CASE("dense samples agree, with and without outliers, kinks and undefined outputs") {
    for (std::size_t const outliers : {0U, 1U, 3U}) {
        auto const problem = mixed_problem(1.2, 0.7, outliers, outliers);
        INFO(outliers);
        auto const found = invert_static(problem, to(1.0 / 256));
        CHECK(within(found.inside, 1.2, 0.7));
        check_by_sampling(problem, found, 3000);
    }
}

TEST_CASE("planted truths are never lost") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-2.9, 2.9);
    for (int k = 0; k < 60; ++k) {
        double const p = place(random), q = place(random);
        auto const spoilt = static_cast<std::size_t>(k % 3);
        auto const found = invert_static(mixed_problem(p, q, spoilt, spoilt), to(1.0 / 64));
        INFO(p << " " << q);
        CHECK((within(found.inside, p, q) || within(found.open, p, q)));
    }
}

TEST_CASE("first-order forms need few boxes for a small volume") {
    static_inversion_options o = to(0);
    o.uncertain = 1e-3;
    auto const contracted = invert_static(ring_problem(), o);
    CHECK(contracted.uncertain_volume().upper() < 1.001e-3);
    CHECK(3 * contracted.tested < 14'000); // which bisection alone takes
}

TEST_CASE("degenerate inputs") {
    // Nothing explains it, everything does.
    auto none = invert_static(ring_problem(interval(60, 61)), to(0.01));
    CHECK(none.open.size() + none.inside.size() == 0);
    CHECK(none.reason == stop_reason::decided);
    auto all = invert_static(ring_problem(interval(0, 60)), to(0.01));
    CHECK(contains(all.inner_volume(), 1.0));
    // Exact measurements: a curve.
    auto const curve = invert_static(ring_problem(interval(4.0)), to(1.0 / 128));
    CHECK(curve.inside.size() == 0);
    CHECK(within(curve.open, 2, 0));
    // Sides of no width, and a prior that is a point.
    auto problem = ring_problem();
    problem.prior[1] = interval(0.0);
    auto const line = invert_static(problem, to(1e-4));
    CHECK(std::abs(10 * line.inner_volume().lower() - 2 * (std::sqrt(2.0) - 1)) < 1e-2);
    problem.prior[0] = interval(1.2);
    CHECK(invert_static(problem, to(1e-4)).inside.size() == 1);
    problem.prior[0] = interval(0.5);
    CHECK(invert_static(problem, to(1e-4)).inside.size() == 0);
    // As many outliers as measurements.
    problem = ring_problem();
    problem.outliers = 1;
    CHECK(contains(invert_static(problem, to(0.1)).inner_volume(), 1.0));
    // Half-bounded measurements.
    problem = ring_problem(interval_traits<interval>::bounds(-HUGE_VAL, 1));
    auto const disc = invert_static(problem, to(1.0 / 1024));
    CHECK(100 * disc.inner_volume().lower() < std::numbers::pi);
    CHECK(100 * (disc.inner_volume().upper() + disc.uncertain_volume().upper()) > std::numbers::pi);
}

TEST_CASE("budgets leave the rest open") {
    auto few = to(1e-6);
    few.boxes = 100;
    auto const found = invert_static(ring_problem(), few);
    CHECK(found.reason == stop_reason::box_budget);
    CHECK(found.tested < 1000);
    CHECK(100 * (found.inner_volume().upper() + found.uncertain_volume().upper()) >
          std::numbers::pi);
    few = to(1e-6);
    few.seconds = -1;
    CHECK(invert_static(ring_problem(), few).reason == stop_reason::time_budget);
    few.seconds = 60;
    few.keep_going = [] { return false; };
    auto const stopped = invert_static(ring_problem(), few);
    CHECK(stopped.reason == stop_reason::cancelled);
    CHECK(stopped.open.size() == 1);
}
