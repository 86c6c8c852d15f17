// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/window_integrals.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"

using namespace diagnosis_support;

namespace {

/// A cell of lines without drift.
time_cell still(double from, double to, leaf_ranges const& at) {
    time_cell result{from, to, at, {}};
    for (auto const& x : at.states) result.lines.push_back(cell_line::still(x));
    for (auto const& u : at.inputs) result.lines.push_back(cell_line::still(u));
    result.lines.push_back(cell_line::still(at.time));
    return result;
}

/// Cells of width `h` around x0 = sin t, x1 = cos t = x0', x2 = 1 + t/4, each to within e.
std::vector<time_cell> circle(draws& d, double end, double h, double e0, double e1) {
    std::vector<time_cell> cells;
    auto const count = std::lround(end / h);
    for (long k = 0; k < count; ++k) {
        double const from = static_cast<double>(k) * h;
        double const to = static_cast<double>(k + 1) * h;
        auto const off = [&d](double e) { return d.uniform(-0.9, 0.9) * e; };
        auto const side = [&](double a, double b, double e) {
            double const shift = off(e);
            return between(std::min(a, b) - e + shift - h * h, std::max(a, b) + e + shift + h * h);
        };
        cells.push_back(still(
            from, to,
            {between(from, to),
             box{side(std::sin(from), std::sin(to), e0), side(std::cos(from), std::cos(to), e1),
                 side(1 + from / 4, 1 + to / 4, 0.01)},
             {},
             {}}));
    }
    return cells;
}
struct bench {
    graph g;
    std::vector<expression> x;
    std::vector<node_id> functions;
    std::vector<std::function<double(double)>> values;

    bench() {
        for (std::size_t i = 0; i < 3; ++i) x.emplace_back(g, g.leaf(operation::state, i));
        auto const put = [this](expression const& e, std::function<double(double)> f) {
            functions.push_back(e.in(g));
            values.push_back(std::move(f));
        };
        put(x[1], [](double t) { return std::cos(t); });
        put(x[2] * x[1], [](double t) { return (1 + t / 4) * std::cos(t); });
        put(x[0] * x[1] - sqr(x[2]),
            [](double t) { return std::sin(t) * std::cos(t) - (1 + t / 4) * (1 + t / 4); });
        put(x[2] * abs(x[1]) * x[1],
            [](double t) { return (1 + t / 4) * std::abs(std::cos(t)) * std::cos(t); });
        put(sign(x[1]) * x[2] + x[1],
            [](double t) { return (std::cos(t) > 0 ? 1 : -1) * (1 + t / 4) + std::cos(t); });
        put(expression(g, g.leaf(operation::time, 0)) * x[2],
            [](double t) { return t * (1 + t / 4); });
    }
};
double exact(std::function<double(double)> const& f, double from, double to) {
    double sum = 0;
    int const n = 4000;
    for (int k = 0; k < n; ++k) sum += f(from + (to - from) * (k + 0.5) / n);
    return sum * (to - from) / n;
}

} // namespace

TEST_CASE("windows enclose the integrals, directly and by parts") {
    draws d(12);
    for (int n = 0; n < 12; ++n) {
        bench b;
        auto const set = integrand_set::of(b.g, b.functions, 3, 0);
        auto const cells = circle(d, 6, 0.025, d.uniform(0, 0.05), d.uniform(0, 0.1));
        std::vector<derivative_pair> const pairs{{1, 0}};
        window_integrals const integrals(set, cells, pairs, 0, 0.5);
        auto const q_at = [](std::size_t, std::size_t k) {
            return around(std::sin(0.025 * static_cast<double>(k)), 0.01);
        };
        for (int m = 0; m < 20; ++m) {
            auto const from = d.below(240);
            auto const to = from + 1 + d.below(240 - from);
            for (std::size_t j = 0; j < b.functions.size(); ++j) {
                double const truth = exact(b.values[j], 0.025 * static_cast<double>(from),
                                           0.025 * static_cast<double>(to));
                auto const direct = integrals.direct(j, from, to);
                CHECK(direct.lower() - 1e-3 <= truth);
                CHECK(truth <= direct.upper() + 1e-3);
                if (!integrals.has_parts(j)) continue;
                auto const parts = integrals.by_parts(j, from, to, q_at);
                CHECK(parts.lower() - 1e-3 <= truth);
                CHECK(truth <= parts.upper() + 1e-3);
            }
        }
        CHECK(integrals.has_parts(0));
        CHECK_FALSE(integrals.has_parts(5));
    }
}

TEST_CASE("by parts, an error along the window becomes one at its ends") {
    draws d(13);
    bench b;
    auto const set = integrand_set::of(b.g, b.functions, 3, 0);
    auto const cells = circle(d, 6, 0.025, 0.01, 0.1);
    window_integrals const integrals(set, cells, {{1, 0}}, 0, 0.5);
    auto const q_at = [](std::size_t, std::size_t k) {
        return around(std::sin(0.025 * static_cast<double>(k)), 0.01);
    };
    CHECK(width(integrals.direct(0, 0, 240)) > 1.1);
    CHECK(width(integrals.by_parts(0, 0, 240, q_at)) < 0.05);
    CHECK(width(integrals.direct(1, 0, 240)) > 1.9);
    CHECK(width(integrals.by_parts(1, 0, 240, q_at)) < 0.5);
    // A jump: only the natural range is used, and by parts nothing is claimed.
    CHECK(is_bounded(integrals.direct(4, 0, 240)));
    CHECK(is_entire(integrals.by_parts(4, 0, 240, q_at)));
}

TEST_CASE("a cell in which nothing is known spoils the windows that contain it, no others") {
    draws d(14);
    bench b;
    auto const set = integrand_set::of(b.g, b.functions, 3, 0);
    auto cells = circle(d, 1, 0.1, 0.01, 0.1);
    cells[5].at.states[2] = interval_traits<interval>::entire();
    cells[5] = still(cells[5].from, cells[5].to, cells[5].at);
    window_integrals const integrals(set, cells, {{1, 0}}, 0, 0.5);
    CHECK(is_bounded(integrals.direct(1, 0, 5)));
    CHECK(is_entire(integrals.direct(1, 3, 7)));
    CHECK(is_bounded(integrals.direct(1, 6, 10)));
    CHECK(is_bounded(integrals.direct(0, 3, 7)));
    window_integrals const none(set, {}, {{1, 0}});
    CHECK(none.has_parts(0));
}

TEST_CASE("a drift averages out, a departure counts by its mean") {
    draws d(15);
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    auto const f = sqr(x).in(g);
    auto const set = integrand_set::of(g, {f}, 1, 0);
    for (int n = 0; n < 200; ++n) {
        // x(t) = a + b t + c(t) + e on [0, 1], |c| at most m on the average.
        double const a = d.uniform(-2, 2), b = d.uniform(-1, 1), m = d.uniform(0, 0.2);
        double const e = d.uniform(-0.1, 0.1);
        double const shape = d.uniform(0.1, 1); // c is 0 but for a share of the time
        double const height = (d.coin() ? 1 : -1) * m / shape;
        time_cell cell{0, 1, {between(0, 1), box{between(-6, 6)}, {}, {}}, {}};
        cell.lines = {cell_line::of(a, a + b, between(-0.1, 0.1), m),
                      cell_line::of(0, 1, interval(0.0))};
        window_integrals const integrals(set, {cell}, {});
        double sum = 0;
        for (int k = 0; k < 2000; ++k) {
            double const t = (k + 0.5) / 2000;
            double const v = a + b * t + e + (t < shape ? height : 0.0);
            sum += v * v / 2000;
        }
        auto const range = integrals.direct(0, 0, 1);
        CHECK(range.lower() - 1e-3 <= sum);
        CHECK(sum <= range.upper() + 1e-3);
    }
    // Without spread: second order in the drift.
    time_cell thin{0, 1, {between(0, 1), box{between(1, 1.01)}, {}, {}}, {}};
    thin.lines = {cell_line::of(1, 1.01, interval(0.0)), cell_line::of(0, 1, interval(0.0))};
    CHECK(width(window_integrals(set, {thin}, {}).direct(0, 0, 1)) < 1e-4);
}

TEST_CASE("weighted integrals are enclosed, of what constants move in time, too") {
    draws d(13);
    for (int n = 0; n < 12; ++n) {
        bench b;
        // Slopes by constants are taken somewhere in the prior, elsewhere at each time.
        expression const c(b.g, b.g.leaf(operation::constant, 0));
        double const pace = d.uniform(1, 40);
        auto const moving = [pace](double t) { return std::sin(pace * t); };
        b.functions.push_back((c * b.x[2]).in(b.g));
        b.values.emplace_back([moving](double t) { return moving(t) * (1 + t / 4); });
        auto const set = integrand_set::of(b.g, b.functions, 3, 0);
        double const h = 0.05;
        auto cells = circle(d, 6, h, d.uniform(0, 0.05), d.uniform(0, 0.1));
        for (auto& cell : cells) cell.at.constants = box{between(-1, 1)};
        double const growth = d.uniform(0.1, 20);
        window_integrals const integrals(set, cells, {}, growth);
        for (int k = 0; k < 20; ++k) {
            auto const first = d.below(119);
            auto const last = first + 1 + d.below(120 - first);
            double const from = static_cast<double>(first) * h;
            double const to = static_cast<double>(last) * h;
            auto const weight = [growth](double t) { return std::exp(growth * (t - 6)); };
            for (std::size_t j = 0; j < b.functions.size(); ++j) {
                auto const f = [&](double t) { return weight(t) * b.values[j](t); };
                double const truth = exact(f, from, to);
                double const slack = 1e-4 * weight(to) + 1e-14;
                auto const found = integrals.direct(j, first, last);
                CHECK(found.lower() <= truth + slack);
                CHECK(truth - slack <= found.upper());
            }
            CHECK_THAT(mid(integrals.weight_at(last)), WithinRel(weight(to), 1e-9));
        }
    }
}
