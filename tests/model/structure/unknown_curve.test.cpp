// SPDX-License-Identifier: MIT
#include <sivid/model/structure/unknown_curve.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <sivid/measurement/signal.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/arithmetic.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;

namespace {

/// The curves of x0' = rate(t, x, p, u) with two states, three parameters and an input.
template <class Rate>
std::vector<unknown_curve> curves_of(Rate const& rate, bound_model* where = nullptr) {
    auto const m = support::model_of(
        {2, 3, 1}, [&](auto const& t, auto const& x, auto const& p, auto const& u) {
            return std::vector<std::decay_t<decltype(x[0])>>{rate(t, x, p, u), x[0]};
        });
    auto const bound = bind(m, {support::all_constants(3), {}},
                            {sampled_signal({0.0}, {0.0}, interpolation::linear)});
    if (where != nullptr) *where = bound;
    return find_curves(bound);
}

} // namespace

TEST_CASE("a curve is a function of one moving quantity that is bent in its constants") {
    bound_model m;
    auto found = curves_of(
        [](auto const&, auto const& x, auto const& p, auto const& u) {
            return u[0] * (p[0] * sin(p[1] * atan(p[2] * (x[0] - 2 * x[1])))) + x[1];
        },
        &m);
    REQUIRE(found.size() == 1);
    CHECK(found[0].parameters == std::vector<std::size_t>{0, 1, 2});
    CHECK(m.g[found[0].argument].op == operation::sub);
    CHECK(m.g[found[0].value].op == operation::mul);
    // Monod's growth: the state itself is the argument, and the factor the input beside it.
    found = curves_of([](auto const&, auto const& x, auto const& p, auto const& u) {
        return u[0] * x[1] * (p[0] * x[0] / (p[1] + x[0]));
    });
    REQUIRE(found.size() == 1);
    CHECK(found[0].parameters == std::vector<std::size_t>{0, 1});
    // Over time.
    found = curves_of([](auto const& t, auto const& x, auto const& p, auto const&) {
        return x[0] * exp(-(p[0] * t));
    });
    REQUIRE(found.size() == 1);
    CHECK(found[0].parameters == std::vector<std::size_t>{0});
}

TEST_CASE("polynomials in constants, two moving quantities and kinks make no curve") {
    CHECK(curves_of([](auto const&, auto const& x, auto const& p, auto const&) {
              return p[0] * sin(x[0]) + p[1] * p[1] * x[1] / p[2];
          }).size() <= 1); // by p2 at most: a quotient of constants is no moving quantity
    CHECK(curves_of([](auto const&, auto const& x, auto const& p, auto const&) {
              return p[0] * sin(x[0]) + p[1] * p[1] * x[1];
          }).empty());
    CHECK(curves_of([](auto const&, auto const& x, auto const& p, auto const&) {
              return sin(p[0] * x[0] + p[1] * x[1]);
          }).empty());
    CHECK(curves_of([](auto const&, auto const& x, auto const& p, auto const&) {
              return sin(p[0] * abs(p[1] - x[0]));
          }).empty());
}

TEST_CASE("a curve that stands in several equations with other factors is one") {
    auto const m =
        support::model_of({2, 3, 0}, [](auto const&, auto const& x, auto const& p, auto const&) {
            auto const force = p[0] * atan(p[1] * x[0]);
            return std::vector<std::decay_t<decltype(x[0])>>{1.5 * force - x[1], force / p[2]};
        });
    auto const bound = bind(m, {support::all_constants(3), {}}, {});
    auto const found = find_curves(bound);
    REQUIRE(found.size() == 1);
    CHECK(found[0].parameters == std::vector<std::size_t>{0, 1});
}

TEST_CASE("a curve is computed alone, by its argument and its own parameters") {
    auto const recorded =
        support::model_of({2, 4, 0}, [](auto const&, auto const& x, auto const& p, auto const&) {
            using std::atan, std::sin;
            auto const z = x[0] * x[1];
            return std::vector{p[3] * sin(p[2] * atan(p[0] * z)), -p[1] * x[1]};
        });
    auto const model = bind(recorded, {support::all_constants(4), {}}, {});
    auto const curves = find_curves(model);
    REQUIRE(curves.size() == 1);
    auto const& own = curves[0].parameters;
    auto const g = map_of(model.g, curves[0]);
    CHECK(g.arguments() == own.size() + 1);
    auto const of = [](auto const& z, auto const& q) {
        return [&z, &q](std::size_t i) { return i == 0 ? z : q[i - 1]; };
    };
    std::vector<double> const all{2, 3, 1.4, 5};
    std::vector<double> p;
    for (auto const j : own) p.push_back(all[j]);
    double const factor = own.size() == 3 ? all[3] : 1;
    for (double const z : {-0.7, 0.0, 0.2, 3.0}) {
        auto const value = g.at<approximate_arithmetic>(of(z, p));
        REQUIRE(value);
        CHECK(std::abs(value->front() - factor * std::sin(1.4 * std::atan(2 * z))) <
              1e-14 * factor);
    }
    auto const rooted =
        support::model_of({1, 1, 0}, [](auto const&, auto const& x, auto const& p, auto const&) {
            using std::sqrt;
            return std::vector{sqrt(p[0] - x[0])};
        });
    auto const root = bind(rooted, {support::all_constants(1), {}}, {});
    auto const h = map_of(root.g, find_curves(root).at(0));
    CHECK_FALSE(h.over({interval(2.0, 3.0), interval(1.0)}));
    CHECK(h.over({interval(-3.0, 0.5), interval(1.0)}));
}
