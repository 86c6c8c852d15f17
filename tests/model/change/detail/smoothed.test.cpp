// SPDX-License-Identifier: MIT
#include <sivid/model/change/detail/smoothed.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <sivid/model/graph/graph_range.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace sivid;

namespace {

/// Every operation with a kink, of a state, of an input, of both, and of a constant.
struct kinked {
    static constexpr auto name = "kinked";
    static constexpr auto states = sivid::states({{"x", "m", 5}, {"v", "m/s", 5}});
    static constexpr auto inputs = sivid::inputs({{"u", "N"}});
    static constexpr auto channels = sivid::channels({{"y", "m"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"c", "N", 0.5_dec}});
    }();
    template <class T>
    vec<T, 2> rate(T const&, vec<T, 2> const& x, vec<T, 1> const& c, vec<T, 1> const& u) const {
        using std::abs, std::max, std::min;
        return {x[1] * abs(x[1]) + abs(c[0]), min(u[0], c[0]) - max(x[0], u[0])};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 2> const& x, vec<T, 1> const&, vec<T, 1> const&) const {
        using std::abs;
        return {abs(x[0])};
    }
};

struct smooth_model : kinked {
    static constexpr auto name = "smooth";
    template <class T>
    vec<T, 2> rate(T const&, vec<T, 2> const& x, vec<T, 1> const& c, vec<T, 1> const& u) const {
        using std::abs;
        return {x[1] * abs(c[0]), u[0] - x[0]};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 2> const& x, vec<T, 1> const&, vec<T, 1> const&) const {
        return {x[0]};
    }
};

/// Rates and channels at a point, by folding; further inputs are `w`.
std::vector<interval> values(recorded_model const& m, std::vector<double> const& x,
                             interval const& u, std::vector<interval> const& w) {
    auto outputs = m.rate;
    outputs.insert(outputs.end(), m.observe.begin(), m.observe.end());
    graph g;
    auto const at = copy_into(g, m.g, outputs, [&](node const& n, graph& to) {
        auto const k = static_cast<std::size_t>(n.index);
        if (n.op == operation::state) return to.constant(x[k]);
        if (n.op == operation::constant) return to.constant(-0.5);
        REQUIRE(n.op == operation::input);
        auto const& value = k == 0 ? u : w[k - 1];
        return to.constant(literal{value, mid(value)});
    });
    std::vector<interval> result;
    for (auto const n : at) {
        REQUIRE(g[n].op == operation::literal);
        result.push_back(g.value(g[n]).enclosure);
    }
    return result;
}

} // namespace

TEST_CASE("a smoothed model holds the model it came from, and no kink") {
    auto const original = record_model<kinked>();
    auto const smooth = smoothed(original, 0.01);
    double const of_state = 0.00390625, of_input = of_state * 0x1p-20; // 2^-7 is nearest to 0.01
    REQUIRE(smooth.bounds.size() == 4);
    CHECK(std::count(smooth.bounds.begin(), smooth.bounds.end(), of_state) == 3);
    CHECK(std::count(smooth.bounds.begin(), smooth.bounds.end(), of_input) == 1);
    CHECK(smooth.model.about.inputs.size() == 5);
    auto outputs = smooth.model.rate;
    outputs.push_back(smooth.model.observe[0]);
    auto const needed = operands_of(smooth.model.g, outputs);
    std::size_t kinks = 0;
    for (std::size_t k = 0; k < needed.size(); ++k) {
        auto const& n = smooth.model.g.nodes()[k];
        if (needed[k] && has_kink(n.op)) {
            ++kinks;
            CHECK(smooth.model.g.depends(n.a) == on_constant);
        }
    }
    CHECK(kinks == 1);

    std::vector<interval> any, none(4, interval(0.0));
    for (double const b : smooth.bounds) any.emplace_back(-b, b);
    support::draws random(11);
    for (int k = 0; k < 2000; ++k) {
        // Mostly near the kinks, often at one.
        auto const draw = [&] {
            double const sizes[] = {0, 0.01, 2};
            return sizes[random.below(3)] * random.uniform(-1, 1);
        };
        std::vector<double> const x{draw(), draw()};
        interval const u(draw() + (k % 2 == 0 ? x[0] : -0.5));
        auto const exact = values(original, x, u, {});
        auto const whole = values(smooth.model, x, u, any);
        auto const middle = values(smooth.model, x, u, none);
        for (std::size_t i = 0; i < exact.size(); ++i) {
            CHECK(subset(exact[i], whole[i]));
            CHECK(width(whole[i]) < 0.02); // at most two kinks, and |v| < 2 beside one
            CHECK(std::abs(mid(middle[i]) - mid(exact[i])) <= 2.001 * of_state);
        }
    }
}

TEST_CASE("constants that follow from others do so in a smoothed model") {
    auto model = record_model(kinked());
    auto const two = expression(2).in(model.g);
    model.about.constants.push_back({"twice", "N", {interval(1.0), 1}});
    auto const twice = model.g.mul(two, model.g.leaf(operation::constant, 0));
    model.derived.push_back({1, twice, false});
    auto const smooth = smoothed(model, 1e-6).model;
    graph_range formula(smooth.g, {smooth.derived[0].value});
    formula.evaluate({interval(0.0), {}, box{interval(0.75), interval(0.0)}, {}});
    CHECK(contains(formula.value(smooth.derived[0].value), 1.5));
    CHECK(width(formula.value(smooth.derived[0].value)) < 1e-12);
}

TEST_CASE("a model without moving kinks has nothing to smooth") {
    auto const smooth = smoothed(record_model<smooth_model>(), 1e-6);
    CHECK(smooth.bounds.empty());
    CHECK(smooth.model.about.inputs.size() == 1);
}

TEST_CASE("a kink is rounded off over a width whose square is exact") {
    auto const model = record_model<kinked>();
    for (double const width : {0.0, -1.0, 1e-101, 1e101, std::nan("")}) {
        CHECK_THROWS_AS(smoothed(model, width), std::invalid_argument);
    }
    for (double const width : {1e-100, 1e100}) {
        auto const smooth = smoothed(model, width);
        REQUIRE(smooth.bounds.size() == 4);
        for (double const b : smooth.bounds) CHECK(b > 0);
    }
}
