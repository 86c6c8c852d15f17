// SPDX-License-Identifier: MIT
// How far the data let a parameter go, as the scorer finds it.
#include "reach.hpp"
#include "campaign_files.hpp"
#include "catalogue.hpp"

#include "io/support.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <random>

using namespace withheld;
using io_support::temporary_folder;

TEST_CASE("linear programs about a simulation end at the farthest corner") {
    // Two variables: the corners of the polygon are few enough to be tried one by one.
    std::mt19937 random{5};
    std::uniform_real_distribution<double> any{-1, 1};
    for (int trial = 0; trial < 40; ++trial) {
        fit_problem::linear_model model;
        model.slope.resize(2);
        std::vector<double> const x{0.3, 0.6};
        for (int m = 0; m < 12; ++m) {
            model.misfit.push_back(0.9 * any(random));
            for (auto& s : model.slope) s.push_back(9 * any(random));
        }
        struct line {
            double a, b, c; // a d0 + b d1 <= c
        };
        std::vector<line> lines{{1, 0, 0.7}, {-1, 0, 0.3}, {0, 1, 0.4}, {0, -1, 0.6}};
        for (std::size_t m = 0; m < model.misfit.size(); ++m)
            for (double const s : {1.0, -1.0})
                lines.push_back(
                    {s * model.slope[0][m], s * model.slope[1][m], 1 - s * model.misfit[m]});
        double best = -1;
        for (auto const& p : lines)
            for (auto const& q : lines) {
                double const det = p.a * q.b - p.b * q.a;
                if (std::abs(det) < 1e-12) continue;
                double const d0 = (p.c * q.b - p.b * q.c) / det;
                double const d1 = (p.a * q.c - p.c * q.a) / det;
                bool inside = true;
                for (auto const& l : lines) inside = inside && l.a * d0 + l.b * d1 <= l.c + 1e-9;
                if (inside) best = std::max(best, d0);
            }
        auto const found = farthest(model, x, {1, 0});
        REQUIRE(found);
        CHECK(std::abs((*found)[0] - best) < 1e-6);
    }
    // Nothing is within both of these.
    CHECK_FALSE(farthest({{3, -3}, {{1, 1}}}, {0.5}, {1}));
}

TEST_CASE("what the data allow holds the truth, and is attained") {
    temporary_folder const folder;
    for (std::size_t i = 0; i < 6; ++i) {
        auto const c = draw_campaign(17, i, {family::single, family::pair});
        auto const at = folder.path() / std::to_string(i);
        write_dataset(c, at);
        auto const data = read_recording(at);
        std::vector<effect const*> effects;
        for (auto const& name : c.effects) effects.push_back(effect_named(name));
        fit_problem const problem(data, effects);
        std::vector<std::pair<std::string, double>> truth;
        for (auto const& u : data.unknown)
            truth.emplace_back(u.name, c.true_constants.*constant_named(u.name));
        for (auto const* e : effects)
            for (auto const& p : e->parameters)
                truth.emplace_back(std::string{e->name} + '.' + std::string{p.name},
                                   c.true_effects.*p.member);
        auto const x = problem.start(truth);
        REQUIRE(problem.inflation(x) <= 1);
        for (std::size_t k = 0; k < x.size(); ++k) {
            if (problem.variables()[k].effect == nullptr) continue;
            auto const r = reach(problem, x, k);
            CAPTURE(i, problem.variables()[k].name, x[k], r.lower, r.upper);
            CHECK(r.lower < x[k]);
            CHECK(x[k] < r.upper);
            // The parameter alone cannot go as far as with all else.
            auto alone = x;
            alone[k] = r.upper;
            if (r.upper < 1) CHECK(problem.inflation(alone) >= 1 - 1e-3);
        }
        // Held-out data, too: points that explain what was fitted to miss them by more.
        auto const worst = worst_held_out(problem, x);
        REQUIRE(worst.size() > 1);
        double most = 0;
        for (auto const& point : worst) {
            CHECK(problem.inflation(point) <= 1);
            most = std::max(most, problem.inflation(point, true));
        }
        CHECK(most > problem.inflation(x, true));
    }
}
