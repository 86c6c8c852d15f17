// SPDX-License-Identifier: MIT
#include <sivid/paving/strategy/detail/aided_test.hpp>

#include "diagnosis/planted_records.hpp"
#include "support/catch.hpp"
#include "support/sweep.hpp"

#include <sivid/paving/invert.hpp>
#include <sivid/paving/strategy/detail/without_runs.hpp>

#include <memory>

using namespace diagnosis_support;
using paving_detail::aided_test;

namespace {

strategy without_runs() {
    return {{{{std::make_shared<paving_detail::equation_contractor>(),
               std::make_shared<paving_detail::observer_contractor>()}}}};
}

} // namespace

TEST_CASE("runs and equations together remove no parameter that explains the data") {
    draws d(720);
    auto const count = support::swept(std::size_t{2}, std::size_t{100});
    for (auto const& what : all_planted()) {
        auto const m = model_of(what.shape, what.rate);
        for (std::size_t n = 0; n < count; ++n) {
            auto const r = record_of(d, what, m);
            feasibility_test runs(r.problem, {});
            // Always asked, or where runs end early.
            aided_test test(runs, r.problem, without_runs(), {}, d.coin() ? 2 : 0.5);
            auto const found =
                invert(test, r.problem.prior,
                       {.accuracy_of_hull = true, .boxes = 40, .keep_outside = false});
            INFO(what.name << " " << n);
            REQUIRE(found.paving.has_outer());
            CHECK(contains(found.paving.outer_hull(), r.truth));
        }
    }
}

TEST_CASE("runs that end early leave a wind to the equations") {
    draws d(721);
    std::vector<double> const truth{0.8, -0.6, 0.4};
    auto const problem = windy_record(d, truth);
    feasibility_test runs(problem, {});
    REQUIRE(runs.reached(problem.prior) < 0.5);
    aided_test test(runs, problem, without_runs(), {});
    CHECK(test.at_once() == 1);
    inversion_options options{.accuracy_of_hull = true, .boxes = 60, .keep_outside = false};
    auto const hull = invert(test, problem.prior, options).paving.outer_hull();
    CHECK(test.at_once() == runs.at_once()); // once runs go far
    feasibility_test alone(problem, {});
    auto const by_runs = invert(alone, problem.prior, options).paving.outer_hull();
    CHECK(contains(hull, truth));
    for (std::size_t j = 0; j < 3; ++j) {
        CAPTURE(hull[j], by_runs[j]);
        CHECK(width(hull[j]) < 0.5 * width(by_runs[j]));
    }
}

TEST_CASE("models with delays are left to runs") {
    draws d(722);
    auto problem = windy_record(d, {0.8, -0.6, 0.4});
    feasibility_test runs(problem, {});
    problem.model.input_memory.push_back({});
    aided_test const test(runs, problem, without_runs(), {});
    CHECK(test.at_once() == runs.at_once());
}
