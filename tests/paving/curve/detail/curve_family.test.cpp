// SPDX-License-Identifier: MIT
#include <sivid/paving/curve/detail/curve_family.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/sweep.hpp"

#include <sivid/measurement/signal.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/paving/curve/curve_shapes.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

/// A family of curves: recorded over x0 with three parameters, and in doubles.
struct example {
    recorded_model model;
    std::function<double(double, std::vector<double> const&)> value;
    box prior;
    interval range;
};

template <class Curve>
example example_of(Curve const& curve, box prior, interval const& range) {
    auto model = support::model_of(
        {1, prior.size(), 0}, [&](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector<std::decay_t<decltype(x[0])>>{curve(x[0], p)};
        });
    return {std::move(model),
            [curve](double z, std::vector<double> const& p) { return curve(z, p); },
            std::move(prior), range};
}
std::vector<example> examples() {
    auto const tyre = [](auto const& z, auto const& p) {
        using std::atan, std::sin;
        return p[2] * sin(p[1] * atan(p[0] * z));
    };
    auto const monod = [](auto const& z, auto const& p) { return p[0] * z / (p[1] + z); };
    auto const decay = [](auto const& z, auto const& p) {
        using std::exp;
        return exp(-(p[0] * z));
    };
    return {example_of(tyre, {interval(7.2, 10.8), interval(1.12, 1.68), interval(6240.0, 9360.0)},
                       interval(-0.08, 0.085)),
            example_of(monod, {interval(0.8, 1.2), interval(2.0, 3.0)}, interval(0.5, 4.0)),
            example_of(decay, {interval(0.5, 1.5)}, interval(0.0, 2.0))};
}
struct shaped {
    bound_model model;
    unknown_curve curve;
    curve_family family;
    std::vector<double> visited;
    std::optional<curve_shapes> shapes;

    /// The coefficients of a curve, up to rounding.
    [[nodiscard]] std::vector<double> theta(example const& f, std::vector<double> const& p) const {
        std::vector<double> result;
        for (auto const& weights : shapes->weights) {
            double sum = 0;
            for (std::size_t i = 0; i < weights.size(); ++i)
                sum += weights[i] * (f.value(shapes->nodes[i], p) - shapes->middles[i]);
            result.push_back(sum);
        }
        return result;
    }
};
shaped shapes_of(example const& f, double negligible = 1e-7) {
    auto model = bind(f.model, {support::all_constants(f.prior.size()), {}}, {});
    auto const curves = find_curves(model);
    REQUIRE(curves.size() == 1);
    std::vector<double> visited;
    for (int k = 0; k < 100; ++k)
        visited.push_back(mid(f.range) + 0.9 * rad(f.range) * std::sin(k));
    curve_family all(model, curves[0], f.prior, f.range);
    auto shapes = all.shapes(visited, negligible);
    return {std::move(model), curves[0], std::move(all), visited, std::move(shapes)};
}
std::vector<double> point_of(box const& b) {
    std::vector<double> p;
    for (auto const& side : b) p.push_back(mid(side));
    return p;
}
double size_of(example const& f) {
    auto const p = point_of(f.prior);
    return std::max(std::abs(f.value(f.range.lower(), p)), std::abs(f.value(f.range.upper(), p)));
}
std::vector<double> drawn(draws& d, box const& b) {
    std::vector<double> p;
    for (auto const& side : b) {
        int const end = static_cast<int>(d.below(4));
        p.push_back(end == 0   ? side.lower()
                    : end == 1 ? side.upper()
                               : d.uniform(side.lower(), side.upper()));
    }
    return p;
}
/// Sum of the first shapes with these coefficients, at z.
interval sum_at(curve_shapes const& s, double z, std::vector<interval> const& theta) {
    graph g;
    std::vector<node_id> leaves;
    for (std::size_t j = 0; j < theta.size(); ++j) leaves.push_back(g.leaf(operation::constant, j));
    auto const sum = s.in(g, g.leaf(operation::time, 0), leaves);
    graph_range range(g, {sum});
    box constants(theta.size());
    for (std::size_t j = 0; j < theta.size(); ++j) constants[j] = theta[j];
    range.evaluate({interval(z), {}, constants, {}});
    return range.value(sum);
}

/// How far a curve leaves the sum of its shapes, at a value of z.
double away_from(shaped const& s, example const& f, std::vector<double> const& p, double z) {
    std::vector<interval> theta;
    for (double const t : s.theta(f, p)) theta.push_back(interval(t));
    auto const sum = sum_at(*s.shapes, z, theta);
    return std::max(sum.lower() - f.value(z, p), f.value(z, p) - sum.upper());
}
/// A box about coefficients, ends included, so wide as shares of the family's say.
box about(draws& d, std::vector<double> const& theta, box const& all, double share) {
    box result(theta.size());
    for (std::size_t j = 0; j < theta.size(); ++j) {
        double const r = share * width(all[j]) + 1e-9;
        double const low = d.below(4) == 0 ? 1e-9 : r * d.uniform(0, 1);
        double const high = d.below(4) == 0 ? 1e-9 : r * d.uniform(0, 1);
        result[j] = interval(theta[j] - low, theta[j] + high);
    }
    return result;
}

} // namespace

TEST_CASE("shapes hold every curve of a family, up to what they say they leave") {
    draws d(3);
    for (auto const& f : examples()) {
        for (double const negligible : {1e-2, 1e-4, 1e-7}) {
            auto const s = shapes_of(f, negligible);
            REQUIRE(s.shapes);
            double const size = size_of(f);
            CAPTURE(s.shapes->count(), s.shapes->error, size);
            CHECK(s.shapes->error < 40 * negligible * size);
            double attained = 0;
            for (int k = 0; k < support::swept(60, 2000); ++k) {
                auto const p = drawn(d, f.prior);
                auto const theta = s.theta(f, p);
                for (std::size_t j = 0; j < theta.size(); ++j) {
                    auto const& side = s.shapes->coefficients[j];
                    REQUIRE(side.lower() - 1e-9 <= theta[j]);
                    REQUIRE(theta[j] <= side.upper() + 1e-9);
                }
                for (int i = 0; i < 20; ++i) {
                    double const away =
                        away_from(s, f, p, d.uniform(f.range.lower(), f.range.upper()));
                    REQUIRE(away <= s.shapes->error + 1e-11 * size);
                    attained = std::max(attained, away / s.shapes->error);
                }
            }
            if (negligible > 1e-5) CHECK(attained > 0.3); // the error is no mere guess
        }
    }
}

TEST_CASE("what coefficients leave of a family keeps the curve that has them, and its shapes too") {
    draws d(5);
    for (auto const& f : examples()) {
        for (int k = 0; k < support::swept(4, 100); ++k) {
            auto s = shapes_of(f);
            REQUIRE(s.shapes);
            auto const p = drawn(d, f.prior);
            double wide = std::pow(10.0, -d.uniform(0.5, 2));
            for (int round = 0; round < 3; ++round) {
                CAPTURE(k, round, wide, s.shapes->count());
                auto const theta = about(d, s.theta(f, p), s.shapes->coefficients, wide);
                REQUIRE(s.family.contract(f.prior, *s.shapes, theta));
                REQUIRE(contains(s.family.parameters(), p));
                CHECK(subset(s.family.parameters(), f.prior));
                // In parts, of which the true one keeps its coefficients.
                auto const parts = s.family.parts(*s.shapes, 1 + d.below(6));
                std::vector<box> left;
                for (auto const& part : parts) {
                    auto const t = s.theta(f, p);
                    bool mine = true;
                    for (std::size_t j = 0; j < t.size(); ++j)
                        mine = mine && part[j].lower() - 1e-9 <= t[j] &&
                               t[j] <= part[j].upper() + 1e-9;
                    left.push_back(mine ? intersect(part, about(d, t, s.shapes->coefficients, wide))
                                        : box(std::vector<interval>(
                                              t.size(), interval_traits<interval>::empty())));
                }
                REQUIRE(s.family.contract_parts(*s.shapes, left));
                REQUIRE(contains(s.family.parameters(), p));
                s.shapes = s.family.shapes(s.visited, 1e-7);
                if (!s.shapes) break;
                for (int i = 0; i < 40; ++i) {
                    double const z = d.uniform(f.range.lower(), f.range.upper());
                    REQUIRE(away_from(s, f, p, z) <=
                            s.shapes->error + 1e-11 * std::abs(f.value(z, p)));
                }
                auto const own = s.theta(f, p);
                for (std::size_t j = 0; j < own.size(); ++j) {
                    REQUIRE(s.shapes->coefficients[j].lower() - 1e-7 <= own[j]);
                    REQUIRE(own[j] <= s.shapes->coefficients[j].upper() + 1e-7);
                }
                wide *= 0.3;
            }
            if (s.shapes) CHECK(s.shapes->error < 40 * 1e-7 * size_of(f));
            CHECK(relative_volume(s.family.parameters(), f.prior).upper() < 0.9);
        }
        // Coefficients that no curve of the family has.
        auto s = shapes_of(f);
        auto theta = s.shapes->coefficients;
        theta[0] = interval(theta[0].upper() + width(theta[0]));
        CHECK_FALSE(s.family.contract(f.prior, *s.shapes, theta));
        CHECK(is_empty(s.family.parameters()));
        CHECK_FALSE(s.family.shapes(s.visited, 1e-7));
    }
}

TEST_CASE("no shapes where a curve is not smooth enough, undefined, or known") {
    auto const steep = example_of(
        [](auto const& z, auto const& p) {
            using std::tanh;
            return tanh(1e4 * p[0] * z);
        },
        {interval(0.5, 1.5)}, interval(-1.0, 1.0));
    CHECK_FALSE(shapes_of(steep).shapes);
    auto const pole = example_of([](auto const& z, auto const& p) { return z / (p[0] + z); },
                                 {interval(0.5, 1.5)}, interval(-1.0, 1.0));
    CHECK_FALSE(shapes_of(pole).shapes);
    auto const known = example_of([](auto const& z, auto const& p) { return z / (p[0] + z); },
                                  {interval(0.5)}, interval(1.0, 2.0));
    CHECK_FALSE(shapes_of(known).shapes);
}

TEST_CASE("a search for shapes stops when it is told to") {
    auto const f = examples()[0];
    auto const s = shapes_of(f);
    CHECK_FALSE(s.family.shapes(s.visited, 1e-7, [] { return false; }));
}
