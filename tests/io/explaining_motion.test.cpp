// SPDX-License-Identifier: MIT
#include <sivid/io/explaining_motion.hpp>

#include "io/small_identification.hpp"
#include "support/catch.hpp"

#include <sivid/enclosure/tube.hpp>

#include <cmath>

using namespace sivid;
using io_support::two_rates_problem;
using io_support::two_rates_result;

TEST_CASE("the motion of an inside box meets every measurement and contains its members") {
    auto const problem = two_rates_problem();
    auto const found = two_rates_result(problem);
    auto const motion = find_explaining_motion(problem, found, 50);
    REQUIRE(motion);
    CHECK(motion->source == motion_source::inside_box);
    REQUIRE(motion->tubes.size() == 1);
    CHECK(motion->tubes[0]->complete());
    CHECK(motion->tubes[0]->steps().size() >= 50);
    auto const& samples = problem.experiments[0].measurements;
    auto const outputs = motion->outputs.at(0); // they come in order
    auto const p = mid(motion->parameters);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        CHECK(subset(outputs[i], samples[i].bound));
        CHECK(contains(outputs[i], 2 * std::exp(-p[0] * p[1] * samples[i].time)));
    }
    bool part_of_inside = false;
    for (auto const& b : found.paving.boxes()) {
        part_of_inside = part_of_inside ||
                         (b.verdict == box_verdict::inside && subset(motion->parameters, b.set));
    }
    CHECK(part_of_inside);
}

TEST_CASE("without an inside box the witness is shown, without a witness the best guess") {
    auto const problem = two_rates_problem();
    auto found = two_rates_result(problem);
    REQUIRE(found.witness);
    found.paving = subpaving(problem.prior);
    auto motion = find_explaining_motion(problem, found, 10);
    REQUIRE(motion);
    CHECK(motion->source == motion_source::witness);
    CHECK(contains(motion->parameters, found.witness->parameters));

    found.witness.reset();
    REQUIRE(found.guess);
    motion = find_explaining_motion(problem, found, 10);
    REQUIRE(motion);
    CHECK(motion->source == motion_source::best_guess);

    found.guess.reset();
    CHECK_FALSE(find_explaining_motion(problem, found, 10));
}

TEST_CASE("what is told to stop claims nothing beyond") {
    auto const problem = two_rates_problem();
    auto found = two_rates_result(problem);
    auto const& samples = problem.experiments[0].measurements;
    int cut = 0;
    for (bool const inside : {true, false}) {
        if (!inside) found.paving = subpaving(problem.prior); // the witness
        for (int const most : {0, 1, 3, 10, 11, 12, 14, 1000}) {
            int asked = 0;
            auto const motion =
                find_explaining_motion(problem, found, 10, [&] { return ++asked <= most; });
            if (!motion) continue;
            auto const p = mid(motion->parameters);
            auto const& outputs = motion->outputs.at(0);
            REQUIRE(outputs.size() == samples.size());
            for (std::size_t i = 0; i < samples.size(); ++i) {
                CHECK(contains(outputs[i], 2 * std::exp(-p[0] * p[1] * samples[i].time)));
                if (samples[i].time > motion->tubes[0]->end_time()) {
                    CHECK(outputs[i].lower() == -HUGE_VAL);
                    CHECK(outputs[i].upper() == HUGE_VAL);
                    ++cut;
                }
            }
        }
    }
    CHECK(cut > 0);
    CHECK_FALSE(find_explaining_motion(problem, found, 10, [] { return false; }));
}
