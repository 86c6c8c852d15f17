// SPDX-License-Identifier: MIT
// Derivatives of measured outputs against closed forms: x' = -a x, y = x.
#include <sivid/paving/identifiability/detail/output_sensitivities.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/reference.hpp"

#include <cmath>

using namespace sivid;
using support::between;

namespace {

auto const rate = [](auto const&, auto const& x, auto const& p, auto const&) {
    return std::vector{-(p[0] * x[0])};
};
auto const output = [](auto const&, auto const& x, auto const&, auto const&) { return x; };

identification_problem decay() {
    identification_problem problem;
    problem.model = support::model_of({1, 1, 0}, rate, output);
    problem.choice.unknown = support::all_constants(1);
    problem.prior = {between(0.2, 2)};
    experiment e;
    e.name = "E";
    e.initial = {between(1, 3)};
    e.measurements = {{1.0, 0, between(0.5, 0.7)},
                      {0.5, 0, between(0.5, 0.9)},
                      {2.0, 0, interval_traits<interval>::entire()}};
    problem.experiments = {e};
    return problem;
}

} // namespace

TEST_CASE("what is unknown has a name and a prior, decimals are known") {
    auto problem = decay();
    CHECK(unknowns_of(problem, false).size() == 1);
    auto const both = unknowns_of(problem, true);
    REQUIRE(both.size() == 2);
    CHECK(both[1].name.ends_with("(E)"));
    CHECK(both[1].experiment == 0);
    CHECK(both[0].relative());
    problem.experiments[0].initial = {interval(0.1, std::nextafter(0.1, 1.0))};
    CHECK(unknowns_of(problem, true).size() == 1);
    problem.prior = {between(-1, 1)};
    CHECK_FALSE(unknowns_of(problem, true)[0].relative());
}

TEST_CASE("rows are the derivatives of outputs with a bound, in the order of time") {
    auto const problem = decay();
    sensitivity_runs const runs(problem, unknowns_of(problem, true), {});
    for (double const a : {0.3, 1.0, 1.7}) {
        for (double const s : {1.0, 2.5}) {
            auto const found = runs({interval(a)}, {box{interval(s)}});
            CHECK(found.missing == 0);
            REQUIRE(found.values.rows() == 2);
            REQUIRE(found.values.cols() == 2);
            CHECK(std::abs(found.weights[0] - 1 / 0.2) < 1e-9);
            CHECK(std::abs(found.weights[1] - 1 / 0.1) < 1e-9);
            double const times[] = {0.5, 1.0};
            for (std::size_t k = 0; k < 2; ++k) {
                long double const t = times[k], x = std::exp(-static_cast<long double>(a) * t);
                CHECK(support::encloses_reference(found.values(k, 0), -t * s * x));
                CHECK(support::encloses_reference(found.values(k, 1), x));
                CHECK(width(found.values(k, 0)) < 1e-3);
            }
        }
    }
}

TEST_CASE("over a box every member's derivatives are enclosed") {
    auto const problem = decay();
    sensitivity_runs const runs(problem, unknowns_of(problem, true), {});
    auto const found = runs({between(0.9, 1.0)}, {box{between(2, 2.1)}});
    REQUIRE(found.values.rows() == 2);
    for (double const a : {0.9, 0.95, 1.0}) {
        for (double const s : {2.0, 2.1}) {
            long double const x = std::exp(-static_cast<long double>(a));
            CHECK(support::encloses_reference(found.values(1, 0), -s * x));
            CHECK(support::encloses_reference(found.values(1, 1), x));
        }
    }
}
