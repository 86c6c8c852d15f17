// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/manoeuvre.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

#include <sivid/approximate/candidate/screening.hpp>

using namespace sivid;

namespace {

manoeuvre constant_push(std::string name, double from, double to) {
    return {std::move(name),
            2,
            {0, 0},
            {{"force", "N", from, to}},
            [](std::vector<double> const& s) -> std::vector<signal> {
                return {sampled_signal({0.0}, {s[0]}, interpolation::hold)};
            }};
}
manoeuvre rest() {
    return {"rest", 2, {0, 0}, {}, [](std::vector<double> const&) -> std::vector<signal> {
                return {sampled_signal({0.0}, {0.0}, interpolation::hold)};
            }};
}

} // namespace

TEST_CASE("the manoeuvre that parts rivals best is proposed, its settings at the best") {
    auto const problem = small_campaign::problem(small_campaign::with_drag(0.3));
    screening s(problem, small_campaign::catalogue());
    s.try_one({});
    s.try_one({0});
    std::vector<screened const*> const rivals{&s.candidates()[0], &s.candidates()[1]};
    auto const next = propose_experiment(
        rivals, {rest(), constant_push("push", 0.25, 2), constant_push("tap", 0, 0.1)}, problem);
    REQUIRE(next);
    CHECK(next->manoeuvre == "push");
    REQUIRE(next->settings.size() == 1);
    CHECK(next->settings[0].value > 1.9); // drag shows best at speed
    CHECK(next->separation > 5);
    CHECK_FALSE(next->recorded);
    // At rest the two are alike.
    CHECK_FALSE(propose_experiment(rivals, {rest()}, problem));
    CHECK_FALSE(propose_experiment({rivals[0]}, {rest()}, problem));
    CHECK_FALSE(propose_experiment(rivals, {}, problem));
}
