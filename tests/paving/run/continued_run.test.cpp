// SPDX-License-Identifier: MIT
#include <sivid/paving/run/continued_run.hpp>

#include "support/catch.hpp"
#include "support/power_series.hpp"
#include "support/problems.hpp"

#include <sivid/paving/response/local_response.hpp>
#include <sivid/paving/run/continued_run.hpp>

#include <vector>

using namespace sivid;
using support::draws;

namespace {

/// The family's outputs as a response, so that parts of the box can be looked at.
response response_of(continued_run const& run, continued_run::family f,
                     std::vector<output_polynomial> const& outputs) {
    response r{run.unknowns(f), run.table(f), {}, {}, {}, {}, outputs.size(), 0};
    response_builder rows(r.table->size());
    for (auto const& y : outputs) {
        rows.add([&](std::size_t m) { return y.coefficients[m]; }, y.radius,
                 interval_traits<interval>::entire());
    }
    std::move(rows).finish(r);
    return r;
}

/// Families that begin at different times are carried on in uneven turns; every member's output
/// lies in what is said of it.
void carry_on(draws& d, std::size_t model, support::planting how, run_options const& options) {
    how.samples = 12;
    auto planted = support::plant(d, model, how);
    auto const& problem = planted.problem;
    auto const& e = problem.experiments[0];
    flow const f(problem.model, problem.choice, e.inputs);
    auto const run = make_continued_run(f, e, problem.prior, options);
    struct member {
        continued_run::family family;
        box set;
        std::vector<double> p;
        support::extended_state exact;
    };
    std::vector<member> all;
    auto const samples = sorted(e.measurements);
    auto const add = [&] {
        box set(problem.prior.size());
        for (std::size_t j = 0; j < set.size(); ++j) {
            auto const at = d.in(problem.prior)[j];
            set[j] =
                intersect(support::around(at, 0.05 * width(problem.prior[j])), problem.prior[j]);
        }
        auto const p = d.in(set);
        all.push_back(
            {run->begin(e.initial, set), set, p, planted.simulate(0, p, planted.starts[0])});
    };
    for (int k = 0; k < 5; ++k) add();
    std::size_t reached = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        std::vector<continued_run::family> which;
        std::vector<std::size_t> whose;
        for (std::size_t k = 0; k < all.size(); ++k) {
            if (d.below(3) == 0) continue; // left where it is
            which.push_back(all[k].family);
            whose.push_back(k);
        }
        auto const seen = run->read(which, samples[i].time, {samples[i].channel});
        REQUIRE(seen.size() == which.size());
        for (std::size_t k = 0; k < which.size(); ++k) {
            if (seen[k].empty()) continue;
            ++reached;
            auto const& m = all[whose[k]];
            auto const whole = output_ranges(response_of(*run, which[k], seen[k]), m.set)[0];
            auto const at = output_ranges(response_of(*run, which[k], seen[k]), point_box(m.p))[0];
            CHECK(support::encloses(whole, m.exact[i], 1e-12));
            CHECK(support::encloses(at, m.exact[i], 1e-12));
        }
        if (i == 3) { // one ends, others take its place and begin at the begin
            run->end(all[2].family);
            all.erase(all.begin() + 2);
            for (int k = 0; k < 7; ++k) add();
        }
    }
    CHECK(reached > 50);
}

} // namespace

TEST_CASE("families that are carried on enclose their members, whenever each began") {
    draws d(741);
    run_options first_order;
    first_order.set = carried_set::doubleton;
    for (std::size_t model = 0; model < support::planted_models; ++model) {
        CAPTURE(model);
        carry_on(d, model, {}, {});
        carry_on(d, model, {.spread = 0.01}, {});
        carry_on(d, model, {.spread = 0.01}, first_order);
    }
}

TEST_CASE("carried on in many turns is as sharp as in one run") {
    draws d(742);
    auto const planted = support::plant(d, 4, {.samples = 40});
    auto const& problem = planted.problem;
    auto const& e = problem.experiments[0];
    flow const f(problem.model, problem.choice, e.inputs);
    box part(2);
    for (std::size_t j = 0; j < 2; ++j) {
        part[j] = intersect(support::around(planted.truth[j], 0.02), problem.prior[j]);
    }
    auto const samples = sorted(e.measurements);
    auto const once = (*make_run(f, e, samples, problem.prior, {}))(e.initial, part);
    REQUIRE(once->outputs() == samples.size());
    auto const expected = output_ranges(*once, part);
    auto const run = make_continued_run(f, e, problem.prior, {});
    auto const family = run->begin(e.initial, part);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        auto const seen = run->read({family}, samples[i].time, {samples[i].channel});
        REQUIRE(seen[0].size() == 1);
        auto const range = output_ranges(response_of(*run, family, seen[0]), part)[0];
        CHECK_FALSE(disjoint(range, expected[i]));
        CHECK(width(range) < 1.01 * width(expected[i]) + 1e-9);
    }
}

TEST_CASE("a family whose enclosure failed says nothing, the others go on") {
    // x' = p x^2 blows up at t = 1/(p x0).
    auto const m =
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * x[0] * x[0]};
        });
    parameter_choice const choice{{"p0"}, {}};
    experiment e;
    e.initial = box{interval(1.0)};
    flow const f(m, choice, {});
    auto const run = make_continued_run(f, e, box{support::between(0, 3)}, {});
    auto const wild = run->begin(e.initial, box{support::between(1.9, 2)});
    auto const tame = run->begin(e.initial, box{support::between(0.1, 0.11)});
    auto const early = run->read({wild, tame}, 0.25, {0});
    CHECK(early[0].size() == 1);
    for (double const t : {1.0, 2.0}) {
        auto const seen = run->read({wild, tame}, t, {0});
        CHECK(seen[0].empty());
        REQUIRE(seen[1].size() == 1);
        auto const range =
            output_ranges(response_of(*run, tame, seen[1]), box{support::between(0.1, 0.1)})[0];
        CHECK(support::encloses(range, 1 / (1 - support::mp(0.1) * t), 1e-12));
    }
}
