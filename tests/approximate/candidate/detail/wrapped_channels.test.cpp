// SPDX-License-Identifier: MIT
#include <sivid/approximate/candidate/detail/wrapped_channels.hpp>

#include "diagnosis/small_campaign.hpp"
#include "support/catch.hpp"

#include <sivid/model/affected_problem.hpp>
#include <sivid/model/effects.hpp>
#include <sivid/model/named_effects.hpp>

#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

using namespace sivid;

namespace {

/// The cart, whose position is read modulo a length.
identification_problem within(double length) {
    auto problem = small_campaign::problem();
    for (auto& e : problem.experiments) {
        for (auto& m : e.measurements) {
            if (m.channel != 0) continue;
            double const y = mid(m.bound), turns = std::floor((y + 0.1) / length);
            m.bound =
                interval(y - turns * length - rad(m.bound), y - turns * length + rad(m.bound));
        }
    }
    return problem;
}

} // namespace

TEST_CASE("a channel whose readings wrap joins the catalogue, others do not") {
    CHECK(with_wrapped_channels(small_campaign::problem(), {}).empty());
    auto const all = with_wrapped_channels(within(0.9), {});
    REQUIRE(all.size() == 1);
    CHECK(all[0].name.starts_with("sensor_wrap(p)~"));
    CHECK(contains(all[0].parameters.at(0).prior(), 0.9));
    CHECK(with_wrapped_channels(within(0.9), all).size() == 1); // it has one
    // By its name it is the same, as every effect is.
    auto const named = effects_named({}, {all[0].name});
    REQUIRE(named.at(0).wraps);
    CHECK(named[0].wraps->channel == "p");
    CHECK(named[0].wraps->least == all[0].wraps->least);
}

TEST_CASE("readings that wrap are those of the model with the effect, in each experiment") {
    auto const problem = within(0.9);
    auto const plain = small_campaign::problem();
    auto const all = with_wrapped_channels(problem, {});
    auto const p = affected(problem, all);
    REQUIRE(p.model.about.inputs.back().name == all[0].name + ".wraps");
    for (std::size_t e = 0; e < p.experiments.size(); ++e) {
        auto const& n = p.experiments[e].inputs.back();
        for (std::size_t k = 0; k < problem.experiments[e].measurements.size(); ++k) {
            auto const &wrapped = problem.experiments[e].measurements[k],
                       &real = plain.experiments[e].measurements[k];
            if (real.channel != 0) continue;
            double const turns = std::holds_alternative<sampled_signal>(n)
                                     ? std::get<sampled_signal>(n).approximate(real.time)
                                     : 0;
            CHECK(std::abs(mid(wrapped.bound) + 0.9 * turns - mid(real.bound)) < 1e-9);
        }
    }
    // An experiment that begins two turns away begins with them, if T is known so well.
    using namespace sivid::literals;
    auto far = problem;
    far.experiments[0].initial[0] = interval(1.8);
    CHECK(with_wrapped_channels(far, {}).empty());
    auto const posed =
        affected(far, {effects::sensor_wrap("known", "p", "m", {0.85_dec, 0.95_dec}, 0.45)});
    auto const& first = posed.experiments[0].inputs.back();
    REQUIRE(std::holds_alternative<sampled_signal>(first));
    CHECK(std::get<sampled_signal>(first).values()[0] == 2);
    // In some experiments only it has a switch, too.
    auto const some = affected(problem, {only_within(all[0], {"E2"})});
    CHECK(some.model.about.inputs.size() == p.model.about.inputs.size() + 1);
}
