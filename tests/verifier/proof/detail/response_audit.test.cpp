// SPDX-License-Identifier: MIT
#include <sivid/paving/run/experiment_run.hpp>
#include <sivid/paving/run/further_runs.hpp>
#include <sivid/verifier/proof/detail/exclusion_check.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <cstddef>
#include <memory>

using namespace sivid;

TEST_CASE("an enclosure that misses what another integrator encloses is noticed") {
    auto const problem = plain_problem::make(0, 0, interval(1.9, 2.1));
    auto const& e = problem.experiments[0];
    flow const f(problem.model, problem.choice, e.inputs);
    auto const samples = sorted(e.measurements);
    auto const run = make_scalar_run(f, e, samples, e.initial, problem.prior, {});
    auto const right = (*run)(e.initial, problem.prior);
    response_audit<interval> audit(problem, {});
    for (int k = 0; k < 50; ++k) CHECK(audit(*right, 0, problem.prior));
    // Defects of all kinds: of a constant, of a slope, of a nonlinear term, a radius too small.
    for (std::size_t m = 0; m < right->table->size(); ++m) {
        auto wrong = *right;
        auto& c = wrong.coefficients[m * wrong.outputs() + 2];
        c += c > 0 ? 0.05 : -0.05;
        bool noticed = false;
        for (int k = 0; k < 50 && !noticed; ++k) noticed = !audit(wrong, 0, problem.prior);
        CAPTURE(m);
        CHECK(noticed);
    }
    auto thin = *right;
    thin.radius.assign(thin.outputs(), 0.0);
    bool noticed = false;
    for (int k = 0; k < 50 && !noticed; ++k) noticed = !audit(thin, 0, problem.prior);
    CHECK(noticed);
}

TEST_CASE("outputs at a point are those of the polynomial") {
    auto const problem = plain_problem::make();
    auto const& e = problem.experiments[0];
    flow const f(problem.model, problem.choice, e.inputs);
    auto const samples = sorted(e.measurements);
    auto const found = (*make_scalar_run(f, e, samples, e.initial, problem.prior, {}))(
        e.initial, box{interval(0.45, 0.55)});
    auto const y = outputs_at(*found, {2.0}, {0.5});
    REQUIRE(y.size() == samples.size());
    for (std::size_t k = 0; k < y.size(); ++k) {
        double const x = 2 * std::exp(-0.5 * samples[k].time);
        CHECK(y[k].lower() <= x);
        CHECK(x <= y[k].upper());
        CHECK(width(y[k]) < 1e-3);
    }
}
