// SPDX-License-Identifier: MIT
// Problems of the ARCH-COMP competition (benchmarks/decision/arch_comp.cpp has all of them): wide
// starts, and stiffness.
#include <sivid/decision/prediction.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/decision/verification.hpp>

#include "../../benchmarks/enclosure/problems.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <sivid/model/model.hpp>
#include <sivid/number/decimal.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace {

using namespace sivid;

prediction_problem oscillators(interval const& b) {
    prediction_problem p;
    p.model = record_model<problems::coupled_oscillators>();
    p.choice = {{"b"}, {}};
    p.sets = {box{b}};
    auto const x = hull(1.25_dec, 1.55_dec), y = hull(2.35_dec, 2.45_dec);
    p.initial = {x, y, x, y};
    p.end = 7;
    return p;
}
/// The largest y along a motion, by the classical method.
double largest(std::array<double, 4> s, double b) {
    using state = std::array<double, 4>;
    auto const rate = [b](state const& v) {
        double const pull = b * (v[2] - v[0]);
        return state{v[1], (1 - v[0] * v[0]) * v[1] + pull - v[0], v[3],
                     (1 - v[2] * v[2]) * v[3] - pull - v[2]};
    };
    auto const moved = [](state v, state const& by, double h) {
        for (std::size_t i = 0; i < 4; ++i) v[i] += h * by[i];
        return v;
    };
    double const h = 0.002;
    double most = std::max(s[1], s[3]);
    for (int k = 0; k < 3500; ++k) {
        auto const a = rate(s), c = rate(moved(s, a, h / 2)), d = rate(moved(s, c, h / 2)),
                   e = rate(moved(s, d, h));
        for (std::size_t i = 0; i < 4; ++i) s[i] += h / 6 * (a[i] + 2 * c[i] + 2 * d[i] + e[i]);
        most = std::max({most, s[1], s[3]});
    }
    return most;
}

} // namespace

TEST_CASE("wide starts are halved along the sides that lose a motion") {
    // A side that moves a motion most need not be the one that loses it: by that rule 2000 boxes
    // did not reach the end.
    auto p = oscillators(interval(1, 3));
    auto const what = parse_requirement("always(y1 < 2.75 and y2 < 2.75)", p.model, p.end);
    auto const found = verify(p, what, {}, {.seconds = 600, .parts = 1000});
    CHECK(found.answer == requirement_answer::proved);
    support::draws d{11};
    double most = 0;
    for (int k = 0; k < 40; ++k) {
        auto const x = [&] { return d.in(interval(1.25, 1.55)); };
        auto const y = [&] { return d.in(interval(2.35, 2.45)); };
        most = std::max(most, largest({x(), y(), x(), y()}, d.in(interval(1, 3))));
    }
    CHECK(2.75 - most >= found.found.low);
}

TEST_CASE("a stiff point is predicted whole, between the instants as well") {
    prediction_problem p;
    p.model = record_model<problems::robertson>();
    p.choice = {{}, {{"beta", interval(1e3)}, {"gamma", interval(1e5)}}};
    p.sets = {box(0)};
    p.initial = {interval(1), interval(0), interval(0)};
    p.end = 40;
    auto const total = problems::sum_of_states(p.model);
    auto const found = predict(p, {.seconds = 600}, {total});
    CHECK(found.complete);
    auto const& sum = found.further[0]; // no reaction changes it
    for (std::size_t s = 0; s < sum.low.size(); ++s) {
        CHECK(sum.low[s] <= 1);
        CHECK(sum.high[s] >= 1);
    }
    CHECK(sum.high.back() - sum.low.back() < 1e-6);
}
