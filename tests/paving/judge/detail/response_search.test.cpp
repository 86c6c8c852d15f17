// SPDX-License-Identifier: MIT
#include <sivid/paving/judge/detail/response_search.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

using namespace sivid;

namespace {

struct sized_box : explored_box {
    double size = 1;
    bool refuted = false;
};

/// Largest first; every measurement must be met.
struct feasible {
    using node = sized_box;

    box prior;
    std::size_t looks = 0;

    [[nodiscard]] static bool before(node const& a, node const& b) { return a.size > b.size; }
    [[nodiscard]] static bool drops(node const& x) { return x.refuted; }
    void judge(node& x) {
        ++looks;
        x.size = relative_volume(x.set, prior).upper();
        for (std::size_t s = 0; s < x.known.size(); ++s) {
            auto own = *x.known[s];
            own.allowed = 0;
            auto part = x.set;
            auto const says = assess(own, part);
            x.refuted = x.refuted || says.refuted;
            x.stale[s] = !(says.sharpness <= 0.1);
        }
    }
};

} // namespace

TEST_CASE(
    "the first box is looked at first, and feasible parameters stay in waiting or stuck boxes") {
    auto const problem = plain_problem::make();
    response_search<feasible> search(problem, {}, {problem.prior}, problem.prior);
    REQUIRE(search.next() != nullptr);
    CHECK(search.next()->is_blind());
    for (std::size_t k = 0; k < 40 && search.next() != nullptr; ++k) {
        double const largest = search.next()->size;
        for (auto const& x : search.waiting()) CHECK(x.size <= largest);
        search.step([] { return true; });
    }
    CHECK(search.tested() == search.policy().looks);
    CHECK(search.integrations() > 0);
    double left = 0;
    bool truth = false;
    for (auto const* list : {&search.waiting(), &search.stuck()}) {
        for (auto const& x : *list) {
            left += relative_volume(x.set, problem.prior).upper();
            truth = truth || contains(x.set, std::vector{plain_problem::truth});
        }
    }
    CHECK(truth);
    CHECK(left < 0.9);
}

TEST_CASE("a search that is not to go on integrates nothing and loses nothing") {
    auto const problem = plain_problem::make();
    response_search<feasible> search(problem, {}, {problem.prior}, problem.prior);
    for (std::size_t k = 0; k < 3; ++k) search.step([] { return false; });
    CHECK(search.integrations() == 0);
    CHECK(search.policy().looks == 0);
    double volume = 0;
    for (auto const& x : search.waiting()) volume += relative_volume(x.set, problem.prior).upper();
    CHECK_THAT(volume, WithinAbs(1, 1e-9));
}
