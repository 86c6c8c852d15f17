// SPDX-License-Identifier: MIT
#include <sivid/paving/observer/detail/observer_contraction.hpp>

#include "diagnosis/planted_records.hpp"
#include "support/catch.hpp"
#include "support/sweep.hpp"

#include <algorithm>

using namespace diagnosis_support;

namespace {

/// A box in the prior that contains a point, as it may come up in a search.
box part_about(draws& d, std::vector<double> const& point, box const& prior) {
    box b(point.size());
    for (std::size_t j = 0; j < b.size(); ++j) {
        double const size = width(prior[j]) * d.uniform(0, 1);
        double const low = point[j] - size * d.uniform(0, 1);
        b[j] = between(std::clamp(low, prior[j].lower(), point[j]),
                       std::clamp(low + size, point[j], prior[j].upper()));
    }
    return b;
}

} // namespace

TEST_CASE("shaving by observers removes no parameter that explains the data") {
    draws d(730);
    auto const count = support::swept(std::size_t{3}, std::size_t{60});
    std::size_t contracted = 0;
    for (auto const& what : all_planted()) {
        auto const m = model_of(what.shape, what.rate);
        for (std::size_t n = 0; n < count; ++n) {
            auto const r = record_of(d, what, m);
            observer_contraction shave(r.problem);
            INFO(what.name << " " << n);
            auto const left = shave(r.problem.prior);
            CHECK(contains(left, r.truth));
            contracted += relative_volume(left, r.problem.prior).upper() < 0.9 ? 1 : 0;
            for (int k = 0; k < 4; ++k) {
                auto const part = part_about(d, r.truth, r.problem.prior);
                auto const rest = shave(part);
                CHECK(contains(rest, r.truth));
                CHECK(subset(rest, part));
            }
        }
    }
    CHECK(contracted > 0);
}

TEST_CASE("shaving by observers takes much off where friction is a kink, and all of a wrong box") {
    draws d(731);
    auto const problem = two_records(d, {1, 1.5, 0.4});
    observer_contraction shave(problem);
    auto const left = shave(problem.prior);
    CHECK(contains(left, std::vector<double>{1, 1.5, 0.4}));
    CHECK(relative_volume(left, problem.prior).upper() < 0.6);
    // A quarter of the force.
    box const wrong{between(0.2, 0.25), between(1.4, 1.6), between(0.35, 0.45)};
    CHECK(is_empty(shave(wrong)));
}

TEST_CASE("shaving by observers that is told to stop leaves a box as it is") {
    draws d(732);
    auto const problem = two_records(d, {1, 1.5, 0.4});
    observer_contraction stopped(problem, {.keep_going = [] { return false; }});
    CHECK(subset(problem.prior, stopped(problem.prior)));
    observer_contraction none(problem, {.rounds = 0});
    CHECK(subset(problem.prior, none(problem.prior)));
}
