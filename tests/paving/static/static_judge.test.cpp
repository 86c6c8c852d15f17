// SPDX-License-Identifier: MIT
#include <sivid/paving/static/static_judge.hpp>

#include "paving/static_models.hpp"
#include "support/catch.hpp"

using namespace sivid;

namespace {

template <std::size_t W>
struct bench {
    static_program program;
    static_samples samples;
    static_judge<W> judge;
    static_block block;

    bench(static_problem const& problem, std::vector<box> const& boxes)
        : program(problem),
          samples(problem),
          judge(program, samples, problem.outliers),
          block(problem.prior.size()) {
        block.list = std::make_shared<std::vector<static_samples::index> const>(samples.all());
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            for (std::size_t j = 0; j < boxes[i].size(); ++j) {
                block.boxes.lower(j)[i] = boxes[i][j].lower();
                block.boxes.upper(j)[i] = boxes[i][j].upper();
            }
            block.open_all(i);
        }
        block.count = boxes.size();
        block.pad(W);
    }
};

box square(double x, double y, double r) {
    return {interval(x - r, x + r), interval(y - r, y + r)};
}

template <std::size_t W>
void check_lanes() {
    std::vector<box> const boxes{square(1.2, 0, 0.1), square(0, 0, 0.5), square(0, 1, 0.1),
                                 square(3, 3, 1), square(-1.2, 0, 0.05)};
    bench<W> b(static_models::ring_problem(), boxes);
    std::uint64_t outside = 0, inside = 0;
    for (std::size_t i = 0; i < boxes.size(); i += W) {
        auto const found = b.judge(b.block, i);
        for (std::size_t l = 0; l < W && i + l < boxes.size(); ++l) {
            outside |= ((found.outside >> l) & 1U) << (i + l);
            inside |= ((found.inside >> l) & 1U) << (i + l);
        }
    }
    CHECK(inside == 0b10001U);
    CHECK(outside == 0b01010U);
}

} // namespace

TEST_CASE("lanes are judged each for itself") {
    check_lanes<8>();
    check_lanes<4>();
    check_lanes<1>();
}

TEST_CASE("a box at the inner circle is contracted from outside, and its core from inside") {
    bench<8> b(static_models::ring_problem(), {box{interval(0.9, 1.2), interval(-0.01, 0.01)}});
    auto const found = b.judge(b.block, 0);
    CHECK((found.inside & 1U) == 0);
    CHECK((found.outside & 1U) == 0);
    double const low = b.block.boxes.lower(0)[0];
    CHECK(low > 0.95); // what lies deeper in the hole is cut off
    CHECK(low <= std::sqrt(1 - 1e-4));
    double const core = b.judge.core_upper(0, 0);
    CHECK(core < 1.05); // from there on everything is feasible
    CHECK(core >= 1);
    CHECK(b.judge.slope(0, 0) > b.judge.slope(1, 0));
}

TEST_CASE("as many measurements as a word has bits") {
    auto problem = static_models::ring_problem();
    problem.measurements.assign(64, problem.measurements[0]);
    problem.measurements[63].bound = interval(1.4, 1.5);
    bench<8> b(problem, {square(1.2, 0, 0.005), square(1.3, 0, 0.001)});
    auto const found = b.judge(b.block, 0);
    CHECK((found.inside & 3U) == 1);
    CHECK((found.outside & 3U) == 2);
    CHECK(b.judge.asked() == 64 * 8);
    problem.outliers = 1;
    bench<8> spared(problem, {square(1.3, 0, 0.001)});
    CHECK((spared.judge(spared.block, 0).inside & 1U) == 1);
}

TEST_CASE("another list is another problem") {
    auto problem = static_models::ring_problem();
    problem.measurements.push_back({0, 0, interval(30, 40)});
    bench<8> b(problem, {square(1.2, 0, 0.005)});
    CHECK((b.judge(b.block, 0).outside & 1U) == 1);
    auto const first = std::vector<static_samples::index>{0};
    b.block.list = std::make_shared<std::vector<static_samples::index> const>(first);
    b.block.open_all(0);
    CHECK((b.judge(b.block, 0).inside & 1U) == 1);
    b.block.open_all(0, 1); // one that is not listed is missed
    CHECK((b.judge(b.block, 0).outside & 1U) == 1);
}
