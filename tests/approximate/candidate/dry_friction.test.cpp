// SPDX-License-Identifier: MIT
// Over most of a wide prior dry friction lets nothing move, and nothing there has a slope: a fit
// begins where the effect hardly acts, too.
#include <sivid/approximate/candidate/screening.hpp>
#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/model/effects.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <cmath>
#include <memory>
#include <vector>

using namespace sivid;
using namespace sivid::literals;

namespace {

/// psi' = r, J r' = u - d r, with a noise that the bounds hold.
identification_problem turning(recorded_model const& machine, std::vector<double> const& truth) {
    identification_problem p;
    p.model =
        support::model_of({2, 2, 1}, [](auto const&, auto const& x, auto const& c, auto const& u) {
            return std::vector{x[1] + 0 * x[0], (u[0] - c[1] * x[1]) / c[0]};
        });
    p.choice.unknown = {"p0", "p1"};
    p.prior = box{interval(0.03, 0.07), interval(0.01, 0.1)};
    std::vector<double> at, push;
    for (int k = 0; k <= 150; ++k) {
        at.push_back(0.02 * k);
        push.push_back(0.0375 * 2 * std::sin(1.7 * 2.2 * 0.02 * k + 4.6));
    }
    experiment e;
    e.name = "E";
    e.inputs = {sampled_signal(at, push, interpolation::hold)};
    e.initial = box{interval(0.0), interval(0.0)};
    parameter_choice const all{{"p0", "p1", "p2"}, {}};
    auto const plain = std::make_shared<approximate_model const>(machine, all, e.inputs);
    auto const seen = simulate(plain, e.inputs, {0, 0}, truth, 0, at).states;
    for (std::size_t k = 1; k < at.size(); ++k) {
        double const middle = seen[k][0] + 0.0005 * std::sin(31.0 * static_cast<double>(k));
        e.measurements.push_back({at[k], 0, interval(middle - 0.001, middle + 0.001)});
    }
    p.experiments = {e};
    return p;
}

} // namespace

TEST_CASE("friction is found below a prior over which nothing moves") {
    auto const machine =
        support::model_of({2, 3, 1}, [](auto const&, auto const& x, auto const& c, auto const& u) {
            return std::vector{x[1] + 0 * x[0], (u[0] - c[1] * x[1]) / c[0] - c[2] * sign(x[1])};
        });
    namespace any = effects;
    screening s(turning(machine, {0.053, 0.053, 0.85}),
                {any::dry_friction("friction", "x1", "1", {0_dec, 30_dec}, 0_dec),
                 any::constant_rate("push", "x1", "1", {-1_dec, 1_dec})});
    s.run();
    for (auto const& set : {std::vector<std::size_t>{0}, {0, 1}}) {
        auto const* found = s.find(set);
        REQUIRE(found != nullptr);
        CHECK(found->figures.explains());
        CHECK(found->figures.squares < 150); // the fit's own, not those of a descent that was stuck
        CHECK(std::abs(found->fit.parameters[2] - 0.85) < 0.02);
    }
}
