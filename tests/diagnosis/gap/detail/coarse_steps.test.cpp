// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/gap/detail/coarse_steps.hpp>

#include "diagnosis/small_campaign.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <cstddef>

using namespace sivid;

namespace {

/// The cart, whose velocity is read in steps.
identification_problem read_in(double step, double offset = 0) {
    auto problem = small_campaign::problem();
    for (auto& e : problem.experiments) {
        for (auto& m : e.measurements) {
            if (m.channel != 1) continue;
            double const y = step * (std::round(mid(m.bound) / step - offset));
            m.bound = interval(y - rad(m.bound), y + rad(m.bound));
        }
    }
    return problem;
}
identification_problem grown(identification_problem const& p, data_part const& part, double more) {
    return bound_growth::of(p, part, [more](auto, auto) { return more; })(p, 1);
}

} // namespace

TEST_CASE("bounds that grow by half a step of the readings, or a whole one, are told by it") {
    auto const p = read_in(0.125);
    data_part const v{1, {}}, of_one{1, {0}};
    for (auto const& part : {v, of_one}) {
        auto const half = coarse_steps(p, part, grown(p, part, 0.06));
        REQUIRE(half);
        CHECK_THAT(half->size, WithinRel(0.125, 1e-9));
        CHECK(half->unit == "m/s");
        CHECK_FALSE(half->cut_off);
        auto const whole = coarse_steps(p, part, grown(p, part, 0.12));
        REQUIRE(whole);
        CHECK(whole->cut_off);
        CHECK_FALSE(coarse_steps(p, part, grown(p, part, 0.126)));
    }
    // Bounds that grow elsewhere are not told by steps here.
    CHECK_FALSE(coarse_steps(p, of_one, grown(p, v, 0.06)));
}

TEST_CASE("no step is named where readings are of any size, or few") {
    auto const fine = small_campaign::problem();
    data_part const v{1, {}};
    CHECK_FALSE(coarse_steps(fine, v, grown(fine, v, 0.01)));
    auto few = read_in(0.125);
    few.experiments.resize(1);
    few.experiments[0].measurements.resize(12); // six of each channel
    CHECK_FALSE(coarse_steps(few, v, grown(few, v, 0.01)));
    CHECK_FALSE(coarse_steps(read_in(2), v, grown(read_in(2), v, 0.01))); // too few values
}
