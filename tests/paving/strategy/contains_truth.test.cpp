// SPDX-License-Identifier: MIT
#include <sivid/paving/strategy/contains_truth.hpp>

#include "support/catch.hpp"
#include "support/pendulum.hpp"

using namespace sivid;

namespace {

/// Cuts off what lies above a share of the first side, of the first start, or of parts.
struct cutting : contractor {
    double side = 1, start = 1, part = 1;

    cutting(double of_side, double of_start, double of_part)
        : side(of_side), start(of_start), part(of_part) {}
    [[nodiscard]] static interval lower_part(interval const& x, double share) {
        return interval(x.lower(), x.lower() + share * width(x));
    }
    [[nodiscard]] std::string name() const override { return "cutting"; }
    [[nodiscard]] leftover operator()(inquiry& asked, work_limit const&,
                                      contraction_record&) const override {
        auto left = asked.left();
        left.parameters[0] = lower_part(left.parameters[0], side);
        left.starts[0][0] = lower_part(left.starts[0][0], start);
        return left;
    }
    [[nodiscard]] part_test for_parts(identification_problem const&,
                                      std::function<bool()> const&) const override {
        return [share = part](box const& x) {
            assessment<> says{.rest = x};
            says.rest[0] = lower_part(x[0], share);
            return says;
        };
    }
};

} // namespace

TEST_CASE("a contractor that loses the truth is found out, and one that keeps it is not") {
    auto const p = support::swinging(1, 0.5, 4, 0.1);
    std::vector<double> const truth{support::pendulum_truth[0], support::pendulum_truth[1],
                                    support::pendulum_truth[2]};
    contractor_trial const how{.starts = {{0.5, 0}}};
    CHECK(contains_truth(cutting(1, 1, 1), p, truth, how));
    CHECK(contains_truth(cutting(0.999, 1, 1), p, truth, {.parts = 0, .repeats = 1}));
    CHECK_FALSE(contains_truth(cutting(0.3, 1, 1), p, truth, how));
    CHECK_FALSE(contains_truth(cutting(1, 0.3, 1), p, truth, how));
    CHECK_FALSE(contains_truth(cutting(1, 1, 0.3), p, truth, how));
    // Once is not enough for it, over all of the prior.
    CHECK_FALSE(contains_truth(cutting(0.8, 1, 1), p, truth, {.repeats = 20}));
}
