// SPDX-License-Identifier: MIT
// Problems of the ARCH-COMP competition (benchmarks/decision/arch_comp.cpp has all of them): wide
// starts, and stiffness.
#include <sivid/decision/prediction.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/decision/verification.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <sivid/model/model.hpp>
#include <sivid/number/decimal.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace {

using namespace sivid;

struct coupled_oscillators {
    static constexpr auto name = "coupled van der Pol oscillators";
    static constexpr auto states =
        sivid::states({{"x1", "", 3}, {"y1", "", 4}, {"x2", "", 3}, {"y2", "", 4}});
    static constexpr auto inputs = no_inputs;
    static constexpr auto channels = sivid::channels({{"y1", ""}, {"y2", ""}});
    static constexpr auto constants = sivid::constants({{"b", "", 2_dec}});

    template <class T>
    vec<T, 4> rate(T const&, vec<T, 4> const& s, vec<T, 1> const& c, vec<T, 0> const&) const {
        auto const& [x1, y1, x2, y2] = s;
        auto const pull = c[0] * (x2 - x1);
        return {y1, (1 - x1 * x1) * y1 + pull - x1, y2, (1 - x2 * x2) * y2 - pull - x2};
    }
    template <class T>
    vec<T, 2> observe(T const&, vec<T, 4> const& s, vec<T, 1> const&, vec<T, 0> const&) const {
        return {s[1], s[3]};
    }
};

struct reaction {
    static constexpr auto name = "Robertson";
    static constexpr auto states = sivid::states({{"x", "", 1}, {"y", "", 1}, {"z", "", 1}});
    static constexpr auto inputs = no_inputs;
    static constexpr auto channels = sivid::channels({{"sum", ""}});
    static constexpr auto constants =
        sivid::constants({{"b", "", 1000_dec}, {"g", "", 100000_dec}});

    template <class T>
    vec<T, 3> rate(T const&, vec<T, 3> const& s, vec<T, 2> const& c, vec<T, 0> const&) const {
        auto const& [x, y, z] = s;
        auto const slow = 0.4_dec * x, back = c[0] * y * z, fast = c[1] * y * y;
        return {back - slow, slow - back - fast, fast};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 3> const& s, vec<T, 2> const&, vec<T, 0> const&) const {
        return {s[0] + s[1] + s[2]};
    }
};

prediction_problem oscillators(interval const& b) {
    prediction_problem p;
    p.model = record_model<coupled_oscillators>();
    p.choice = {{"b"}, {}};
    p.sets = {box{b}};
    interval const x(1.25, 1.55), y = hull(2.35_dec, 2.45_dec);
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
    p.model = record_model<reaction>();
    p.sets = {box(0)};
    p.initial = {interval(1), interval(0), interval(0)};
    p.end = 40;
    auto const found = predict(p, {.seconds = 600});
    CHECK(found.complete);
    auto const& sum = found.channels[0]; // no reaction changes it
    for (std::size_t s = 0; s < sum.low.size(); ++s) {
        CHECK(sum.low[s] <= 1);
        CHECK(sum.high[s] >= 1);
    }
    CHECK(sum.high.back() - sum.low.back() < 1e-6);
}
