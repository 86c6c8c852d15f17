// SPDX-License-Identifier: MIT
#include <sivid/paving/identify_options.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/verifier/claim/detail/paving_check.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"
#include "support/problems.hpp"
#include "support/sweep.hpp"

#include <algorithm>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

using namespace sivid;
using outcome = check_finding::outcome;
using support::draws;

namespace {

/// What a check of all says where a part of the prior is said to be excluded.
outcome excluded(identification_problem const& problem, box const& part, double seconds = 3) {
    std::vector<paved_box> rows;
    for (auto const& rest : difference(problem.prior, part))
        rows.push_back({rest, box_verdict::undecided});
    identification_check_options options;
    options.all = true;
    options.seconds = seconds;
    paving_check<interval> check(problem, problem.choice.unknown, rows, {}, options);
    (void)check.covering("cover");
    return check.outside("excluded").found;
}

} // namespace

TEST_CASE("what is excluded is proved next to the feasible set and what is feasible never") {
    for (std::size_t const outliers : {0U, 2U}) {
        auto const problem = plain_problem::make(outliers, outliers);
        auto const f = plain_problem::feasible();
        double const a = f.lower(), b = f.upper();
        auto const says = [&](double low, double high) {
            return excluded(problem, box{interval(low, high)});
        };
        CAPTURE(outliers);
        CHECK(says(0.25, outliers > 0 ? 0.4 : a - 1e-6) == outcome::verified);
        CHECK(says(outliers > 0 ? 0.7 : b + 1e-6, 1) == outcome::verified);
        CHECK(says(a - 0.01, a + 1e-6) != outcome::verified);
        CHECK(says(b - 1e-6, b + 0.01) != outcome::verified);
        CHECK(says(a, b) == outcome::refuted);
    }
    CHECK(excluded(plain_problem::make(), box{interval(0.9, 1.0)}, -1) == outcome::undecided);
}

TEST_CASE("no box with a planted truth is excluded but most without one are") {
    draws d(4471);
    std::size_t proved = 0, all = 0;
    for (std::size_t model = 0; model < support::planted_models; ++model) {
        for (std::size_t const outliers : {std::size_t{0}, std::size_t{1}}) {
            for (double const spread : {0.0, 0.02}) {
                bool const both = spread > 0 && outliers > 0, none = spread == 0 && outliers == 0;
                if (!support::swept(both || none, true)) continue;
                auto const planted = support::plant(
                    d, model,
                    {.experiments = 2, .samples = 12, .outliers = outliers, .spread = spread});
                auto const& prior = planted.problem.prior;
                auto const around = [&](double share) {
                    auto x = prior;
                    for (std::size_t j = 0; j < x.size(); ++j) {
                        double const w = share * width(prior[j]);
                        x[j] = intersect(prior[j],
                                         interval(planted.truth[j] - w, planted.truth[j] + w));
                    }
                    return x;
                };
                for (auto const& rest : difference(prior, around(0.2))) {
                    ++all;
                    proved += excluded(planted.problem, rest) == outcome::verified ? 1 : 0;
                }
                for (double const share : {1e-6, 0.05 * d.uniform(0, 1), 0.1})
                    REQUIRE(excluded(planted.problem, around(share), 1) != outcome::verified);
            }
        }
    }
    CHECK(proved > all / 4);
}

TEST_CASE("a proof is followed and whatever is forged in it no feasible point is lost") {
    draws d(4472);
    std::size_t steps = 0, told = 0;
    for (std::size_t model = 0; model < support::planted_models; ++model) {
        auto const planted = support::plant(d, model,
                                            {.experiments = 2,
                                             .samples = 12,
                                             .outliers = model % 2,
                                             .spread = model % 3 == 0 ? 0.02 : 0.0});
        auto problem = planted.problem;
        auto const& prior = problem.prior;
        identify_options options;
        options.search.seconds = 60; // the boxes end it
        options.search.boxes = 60;
        feasibility_test test(problem, options.test);
        options.search.proof_bytes = 1U << 24;
        auto const found = invert(test, prior, options.search);
        REQUIRE_FALSE(found.proof.empty());
        std::vector<box> rows, without;
        for (auto const& b : found.paving.boxes()) {
            if (b.verdict == box_verdict::outside) continue;
            rows.push_back(b.set);
            if (!contains(b.set, planted.truth)) without.push_back(b.set);
        }
        certificate_options effort;
        effort.seconds = 60;
        run_options fine;
        fine.tolerance = 1e-9;
        fine.relative_tolerance = 1e-6;
        exclusion_check<interval> check(problem, effort, fine);
        (void)check.follow(found.proof, rows);
        steps += check.steps();
        told += static_cast<std::size_t>(
            std::ranges::count_if(found.proof, [](proof_step const& s) { return !s.why.empty(); }));
        CHECK(check.contradictions() == 0);
        for (int forgery = 0; forgery < 12; ++forgery) {
            auto proof = found.proof;
            auto const chance = [&] { return d.below(3) == 0; };
            for (auto& s : proof) {
                if (forgery < 2) break; // the very proof, rows apart
                if (s.what == proof_step::kind::leaf) s.what = proof_step::kind::empty;
                if (chance()) s.at += d.uniform(-0.3, 0.3) * width(prior[s.index % prior.size()]);
                if (chance()) s.upper = !s.upper;
                if (s.what != proof_step::kind::run && chance()) s.index = d.below(4);
                for (auto& group : s.why) {
                    for (auto& w : group) {
                        if (chance()) w.value *= d.uniform(-2, 2);
                        if (chance()) w.experiment = d.below(3);
                        if (chance()) w.output = d.below(13);
                    }
                }
                if (chance()) std::swap(s.why, proof[d.below(proof.size())].why);
            }
            if (forgery > 6)
                std::shuffle(proof.begin(), proof.end(),
                             std::mt19937(static_cast<unsigned>(forgery)));
            exclusion_check<interval> forged(problem, effort);
            auto const open = forged.follow(proof, without);
            REQUIRE(std::any_of(open.begin(), open.end(),
                                [&](box const& x) { return contains(x, planted.truth); }));
        }
    }
    CAPTURE(steps, told);
    CHECK(2 * steps > told);
}
