// SPDX-License-Identifier: MIT
#include <sivid/paving/run/plain_run.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"
#include "support/interval_types.hpp"

#ifdef SIVID_HAS_MPFI
#include <sivid/number/mp_interval.hpp>
#endif

using namespace sivid;

namespace {

template <class I>
void check_forms() {
    using traits = interval_traits<I>;
    auto const problem = plain_problem::make();
    auto const& e = problem.experiments[0];
    plain_run<I> run(problem.model, problem.choice, e, {});
    box const region{interval(0.45, 0.55)};
    auto const known = run(e.initial, region);
    REQUIRE(known.outputs.size() == 6);
    for (double a = 0.45; a <= 0.55; a += 0.01) {
        for (std::size_t k = 0; k < 6; ++k) {
            double const exact = 2 * std::exp(-a * run.samples()[k].time);
            auto const& o = known.outputs[k];
            double const d = a - known.parameter_centre[0];
            double const low = traits::lower(o.rest) + o.gradient[1] * d;
            double const high = traits::upper(o.rest) + o.gradient[1] * d;
            CHECK(low <= exact + 1e-12);
            CHECK(exact <= high + 1e-12);
            CHECK(traits::lower(o.value) <= exact + 1e-12);
            CHECK(exact <= traits::upper(o.value) + 1e-12);
            CHECK(high - low < 0.05);
        }
    }
}

template <class I>
run_finding over(identification_problem const& problem, box const& region, box const& part) {
    auto const& e = problem.experiments[0];
    plain_run<I> run(problem.model, problem.choice, e, {});
    return decide(run(e.initial, region), run.samples(), part, e.outliers);
}

} // namespace

TEST_CASE("the affine forms hold the exact outputs") {
    check_forms<interval>();
#ifdef SIVID_HAS_MPFI
    check_forms<mp_interval>();
    check_forms<proven_interval>();
#endif
}

TEST_CASE("parts are decided as the closed form says") {
    auto const problem = plain_problem::make();
    auto const f = plain_problem::feasible();
    double const middle = mid(f);
    box const around{interval(f.lower() - 0.02, f.upper() + 0.02)};
    box const right{interval(middle - 5e-3, middle + 5e-3)};
    box const wrong{interval(f.upper() + 2e-3, f.upper() + 0.01)};
    CHECK(over<interval>(problem, right, right) == run_finding::explained);
    CHECK(over<interval>(problem, right, box{interval(middle)}) == run_finding::explained);
    CHECK(over<interval>(problem, wrong, wrong) == run_finding::refuted);
    CHECK(over<interval>(problem, around, around) == run_finding::open);
    CHECK(over<interval>(problem, box{interval(0.25, 1)}, box{interval(0.25, 1)}) ==
          run_finding::open);
}

TEST_CASE("outliers are spared, and no more than allowed") {
    box const truth{interval(0.49, 0.51)};
    CHECK(over<interval>(plain_problem::make(2, 2), truth, truth) == run_finding::explained);
    CHECK(over<interval>(plain_problem::make(2, 1), truth, truth) == run_finding::refuted);
    box const wrong{interval(0.7, 0.71)};
    CHECK(over<interval>(plain_problem::make(2, 2), wrong, wrong) == run_finding::refuted);
    CHECK(over<interval>(plain_problem::make(0, 6), wrong, wrong) == run_finding::explained);
}

TEST_CASE("an unknown start is eliminated by linear contraction") {
    auto const problem = plain_problem::make(0, 0, interval(1.5, 2.5));
    box const wrong{interval(0.8, 0.81)}, right{interval(0.495, 0.505)};
    CHECK(over<interval>(problem, wrong, wrong) == run_finding::refuted);
    CHECK(over<interval>(problem, right, right) == run_finding::open);
}

TEST_CASE("a measurement between the numbers of a type is not widened to call it met") {
    // In single precision the bound would be read as the wider set that the output may be in.
    using I = support::coarse;
    using t = interval_traits<I>;
    interval const bound(0.1, 0.3);
    I const output = t::bounds(0.1, 0.3);
    REQUIRE(t::lower(output) < bound.lower());
    plain_outputs<I> known;
    known.outputs.push_back({output, {0.0, 0.0}, output, true});
    known.deviation = {t::point(0), t::point(0)};
    known.parameter_centre = {0.0};
    CHECK(decide(known, record{{0, 0, bound}}, box{interval(0.0)}, 0) == run_finding::open);
    known.outputs[0].value = known.outputs[0].rest = t::bounds(0.125, 0.25);
    CHECK(decide(known, record{{0, 0, bound}}, box{interval(0.0)}, 0) == run_finding::explained);
}
