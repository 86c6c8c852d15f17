// SPDX-License-Identifier: MIT
// Domains that a polynomial's range would leave and the values do not, against doubles: in one lane
// and in eight, one of which touches the edge.

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/sweep.hpp"
#include "support/taylor_models.hpp"

#include <sivid/model/expression.hpp>
#include <sivid/model/series/series.hpp>
#include <sivid/model/series/taylor_arithmetic.hpp>
#include <sivid/number/pack/lanes.hpp>

#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

constexpr std::size_t variables = 2, degree = 3;
using value = taylor_model<double>;

/// A formula of a state and a parameter, and whether it is defined for all of them.
struct guarded {
    std::string name;
    std::function<expression(expression const&, expression const&)> recorded;
    std::function<double(double, double)> plain;
    bool everywhere;
};

template <class T>
T positive(T const& x) {
    using sivid::max;
    using std::max;
    return max(x, T(0.0));
}

#define SIVID_GUARDED(everywhere, ...)                                                             \
    guarded {                                                                                      \
#__VA_ARGS__,                                                                              \
            [](expression const& x, [[maybe_unused]] expression const& p) { return expression(__VA_ARGS__); },      \
            [](double x, double p) {                                                               \
                using std::abs, std::sqrt, std::exp, std::log, std::sin, std::tanh, std::min,      \
                    std::atan, std::max;                                                           \
                auto const sqr = [](double a) { return a * a; };                                   \
                auto const pown = [](double a, int n) { return std::pow(a, n); };                  \
                (void)sqr, (void)pown, (void)p;                                                    \
                return double(__VA_ARGS__);                                                        \
            },                                                                                     \
            everywhere       \
    }

std::vector<guarded> formulas() {
    return {
        SIVID_GUARDED(true, sqrt(positive(x))),
        SIVID_GUARDED(true, sqrt(abs(x - p))),
        SIVID_GUARDED(true, sqrt(sqr(x * p))),
        SIVID_GUARDED(true, sqrt(pown(x - p, 12))),
        SIVID_GUARDED(true, 1 / (1 + exp(3 * x))),
        SIVID_GUARDED(true, 1 / (0.01 + sqr(x + p))),
        SIVID_GUARDED(true, p / (1 + pown(x, 4))),
        SIVID_GUARDED(true, log(1 + abs(x))),
        SIVID_GUARDED(true, log(0.001 + sqr(x))),
        SIVID_GUARDED(true, sqrt(sqrt(positive(x)))),
        SIVID_GUARDED(true, sqrt(1 - sin(x))),
        SIVID_GUARDED(true, 1 / (1.001 + tanh(x + 4 * p))),
        SIVID_GUARDED(true, atan(4 * x) / (1 + sqrt(abs(p)))),
        SIVID_GUARDED(false, sqrt(positive(x) - 1e-12)),
        SIVID_GUARDED(false, log(abs(x))),
        SIVID_GUARDED(false, 1 / positive(x)),
        SIVID_GUARDED(false, sqrt(x)),
        SIVID_GUARDED(false, 1 / (abs(abs(x) - 1e-3))),
        SIVID_GUARDED(false, log(positive(x) * 2)),
        SIVID_GUARDED(false, 1 / (sqr(x) - x * x + positive(x))),
    };
}

} // namespace

namespace {

/// A polynomial in both unknowns whose range is about [middle - size, middle + size].
template <class C>
taylor_model<C> spread_about(draws& d, double middle, double size, std::size_t lane,
                             taylor_model<C> into) {
    auto a = support::random_model(d, model_shape<double>::of(variables, degree), 1, 0.6, 0.01);
    a.c()[0] = 0;
    a.finish();
    auto const width = range(a);
    a = scaled(a, size / mag(width));
    a.c()[0] = middle;
    a.finish();
    for (std::size_t i = 0; i < a.terms(); ++i) lane_traits<C>::put(into.c(i), lane, a.c(i));
    lane_traits<C>::put(into.r(), lane, a.r());
    into.finish();
    return into;
}

/// Order 0 and 1 of x' = 1 in each lane, where the state is wide in all lanes or in one.
/// @returns how many values were compared
template <class C>
int check(draws& d, guarded const& f, bool all_wide) {
    using model = taylor_model<C>;
    using side_by_side = lane_traits<C>;
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    expression const p(g, g.leaf(operation::constant, 0));
    tape const program(g, {f.recorded(x, p).in(g)});
    auto const& shape = model_shape<C>::of(variables, degree);
    model state(shape), parameter(shape);
    std::size_t const wide = d.below(side_by_side::count);
    for (std::size_t l = 0; l < side_by_side::count; ++l) {
        bool const touches = all_wide || l == wide;
        state =
            spread_about(d, touches ? d.uniform(-0.2, 0.2) : 1.5, touches ? 0.8 : 0.1, l, state);
        parameter = spread_about(d, touches ? 0.1 : 0.4, touches ? 0.6 : 0.05, l, parameter);
    }
    series<model> s(program, 1, shape);
    s.set_parameters(std::vector{parameter});
    s.start(model::constant(C(0.0)));
    for (std::size_t k = 0; k <= 1; ++k) {
        s.advance(
            k, [&](std::size_t, std::size_t j) { return j == 0 ? state : model::constant(C(1.0)); },
            [](std::size_t, std::size_t) { return model{}; });
    }
    int compared = 0;
    for (std::size_t l = 0; l < side_by_side::count; ++l) {
        CAPTURE(f.name, l, wide, all_wide);
        bool const touches = all_wide || l == wide;
        if (f.everywhere || !touches) {
            REQUIRE_FALSE(side_by_side::test(s.undefined(), l));
        } else {
            REQUIRE(side_by_side::test(s.undefined(), l));
            continue;
        }
        bool const smooth = !side_by_side::test(s.kinked(), l);
        auto const y = lane_of(s.output(0, 0), l), slope = lane_of(s.output(0, 1), l);
        REQUIRE(std::isfinite(y.r()));
        for (int sample = 0; sample < 20; ++sample) {
            auto const q = support::short_point(d, variables);
            double const at =
                static_cast<double>(support::value<support::mp>(lane_of(state, l), q));
            double const c =
                static_cast<double>(support::value<support::mp>(lane_of(parameter, l), q));
            double const exact = f.plain(at, c);
            CAPTURE(at, c, exact, y.r());
            REQUIRE(support::holds(y, q, support::mp(exact), 1e-12));
            ++compared;
            double const h = 1e-6, change = (f.plain(at + h, c) - f.plain(at - h, c)) / (2 * h);
            if (!smooth || !std::isfinite(change) || std::abs(change) > 1e3) continue;
            REQUIRE(support::holds(slope, q, support::mp(change), 1e-4 * (1 + std::abs(change))));
        }
    }
    return compared;
}

} // namespace

TEST_CASE("what is never negative stays in its domain, and what may be is reported") {
    draws d(211);
    int compared = 0;
    for (auto const& f : formulas()) {
        for (int trial = 0; trial < support::swept(8, 20); ++trial) {
            compared += check<double>(d, f, true);
            compared += check<lanes<8>>(d, f, trial % 2 == 0);
        }
    }
    CHECK(compared > support::swept(20000, 50000));
}

TEST_CASE("a root of 0 has a value, and no derivative") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    tape const program(g, {sqrt(positive(x)).in(g)});
    auto const flags = [&](value const& state) {
        series<value> s(program, 2);
        s.start(value::constant(0.0));
        for (std::size_t k = 0; k <= 2; ++k) {
            s.advance(
                k,
                [&](std::size_t, std::size_t j) { return j == 0 ? state : value::constant(1.0); },
                [](std::size_t, std::size_t) { return value{}; });
        }
        CHECK_FALSE(s.undefined());
        CHECK(std::isfinite(s.output(0, 0).norm()));
        CHECK(std::isfinite(s.output(0, 2).norm()));
        return s.kinked();
    };
    CHECK(flags(value::constant(0.0)));
    CHECK(flags(value::constant(-1.0))); // its root is 0 around there: a report too much
    CHECK(flags(widened(value::constant(1.0), 1.0)));
    CHECK_FALSE(flags(widened(value::constant(1.0), 0.5)));
}
