// SPDX-License-Identifier: MIT
#include <sivid/enclosure/flow.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <cmath>
#include <set>

using namespace sivid;

TEST_CASE("a flow has the structure of its equations") {
    // x0 <- x1 <- p0; x2 alone.
    auto const f = support::flow_of(
        support::model_of({3, 2}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{x[1], -x[1] * p[0], sin(x[2]) + p[1]};
        }));
    CHECK(f->states() == 3);
    CHECK(f->parameters() == 2);
    CHECK(f->channels() == 3);
    std::set<std::pair<std::size_t, std::size_t>> entries;
    for (auto const& e : f->entries()) {
        entries.insert({e.row, e.column});
        CHECK(e.output >= 3);
    }
    CHECK(entries ==
          std::set<std::pair<std::size_t, std::size_t>>{{0, 1}, {1, 1}, {1, 3}, {2, 2}, {2, 4}});
    bool const expected[3][5] = {{true, true, false, true, false},
                                 {false, true, false, true, false},
                                 {false, false, true, false, true}};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t c = 0; c < 5; ++c) CHECK(f->sensitive(i, c) == expected[i][c]);
    }
    CHECK(f->observe_entries().size() == 3);
    CHECK(f->next_knot(0) == HUGE_VAL);
}

TEST_CASE("knots of all sampled inputs count") {
    auto const m =
        support::model_of({1, 0, 3}, [](auto const&, auto const& x, auto const&, auto const& u) {
            return std::vector{u[0] + u[1] + u[2] - x[0]};
        });
    sampled_signal const a({0, 1, 2}, {0, 1, 0}, interpolation::linear);
    sampled_signal const b({0, 0.5, 3}, {0, 1, 0}, interpolation::hold);
    auto const formula = analytic_signal::from([](auto const& t) { return cos(t); });
    auto const f = support::flow_of(m, {a, formula, b});
    CHECK(f->sampled_inputs() == std::vector<std::size_t>{0, 2});
    CHECK(f->next_knot(0) == 0.5);
    CHECK(f->next_knot(0.5) == 1);
    CHECK(f->next_knot(2) == 3);
    CHECK(f->next_knot(3) == HUGE_VAL);
    CHECK(f->input(2).values()[1] == 1);
}
