// SPDX-License-Identifier: MIT
#include <sivid/paving/static/detail/static_survey.hpp>

#include "paving/static_models.hpp"
#include "support/catch.hpp"

#include <random>

using namespace sivid;

namespace {

struct bench {
    static_problem problem;
    static_program program;
    static_samples samples;
    static_survey<> survey;

    explicit bench(static_problem p)
        : problem(std::move(p)),
          program(problem),
          samples(problem),
          survey(program, samples, problem.outliers) {}
    [[nodiscard]] static_box whole(box x) const {
        return {std::move(x),
                std::make_shared<std::vector<static_samples::index> const>(samples.all()), 0};
    }
};

} // namespace

TEST_CASE("one box is judged by all measurements as by each") {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> place(-2.9, 2.9), size(0.001, 0.5), share(-1, 1);
    int decided = 0;
    for (int round = 0; round < 600; ++round) {
        auto const spoilt = static_cast<std::size_t>(round % 3);
        double const p = place(random), q = place(random);
        bench b(static_models::mixed_problem(p, q, spoilt, spoilt));
        if (b.problem.measurements.size() <= spoilt) continue;
        double const w = size(random), x = p + 2 * w * share(random), y = q + 2 * w * share(random);
        auto now = b.whole({interval(x - w, x + w), interval(y - w, y + w)});
        auto const former = now.set;
        auto const found = b.survey(now);
        decided += found == box_verdict::undecided ? 0 : 1;
        INFO(round);
        for (int k = 0; k < 40; ++k) {
            double const u = k == 0 ? p : x + w * share(random);
            double const v = k == 0 ? q : y + w * share(random);
            if (!contains(former[0], u) || !contains(former[1], v)) continue;
            bool const is = static_models::approximately_feasible(b.problem, u, v);
            bool const in = contains(now.set[0], u) && contains(now.set[1], v);
            if (is) REQUIRE(found != box_verdict::outside);
            if (is) REQUIRE(in);
            if (in && found == box_verdict::inside) REQUIRE(is);
            if (in && b.survey.explains(now, {u, v})) REQUIRE(is);
        }
    }
    CHECK(decided > 100);
}

TEST_CASE("what is decided is not asked again, and few are asked of a box that is far off") {
    auto problem = static_models::ring_problem();
    problem.measurements.assign(100'000, problem.measurements[0]);
    bench b(problem);
    auto far = b.whole({interval(3, 4), interval(3, 4)});
    CHECK(b.survey(far) == box_verdict::outside);
    CHECK(b.survey.asked() < 2000);
    auto near = b.whole({interval(1.1, 1.2), interval(0, 0.1)});
    CHECK(b.survey(near) == box_verdict::inside);
    CHECK(b.survey.asked() < 120'000);
    CHECK(near.open->empty());
    auto const before = b.survey.asked();
    CHECK(b.survey(near) == box_verdict::inside);
    CHECK(b.survey.asked() == before);
    // A large box is left to be split after a few.
    auto large = b.whole({interval(0, 3), interval(0, 3)});
    CHECK(b.survey(large, false) == box_verdict::undecided);
    CHECK(b.survey.asked() < before + 10'000);
}
