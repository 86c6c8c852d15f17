// SPDX-License-Identifier: MIT
#include <sivid/decision/requirement/robustness.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

sivid::requirement read(std::string const& text, double end) {
    auto m = support::model_of(
        {.states = 2},
        [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{x[1], -x[0]};
        },
        [](auto const&, auto const& x, auto const&, auto const&) { return x; });
    return sivid::parse_requirement(text, m, end);
}

using function = std::function<double(double)>;

/// Bounds of functions on a grid with those instants: exact at instants; between them widened by
/// what `blur` says of a cell.
sivid::margin_bounds bounds_of(std::vector<double> const& times, std::vector<function> const& f,
                               double steepest) {
    sivid::margin_bounds b{times, {}, {}};
    for (auto const& margin : f) {
        auto& low = b.low.emplace_back(b.segments());
        auto& high = b.high.emplace_back(b.segments());
        for (std::size_t s = 0; s < b.segments(); ++s) {
            if (s % 2 == 0) {
                low[s] = high[s] = margin(times[s / 2]);
                continue;
            }
            double const h = b.end_of(s) - b.begin_of(s);
            double const a = margin(b.begin_of(s)), c = margin(b.end_of(s));
            low[s] = (a + c - steepest * h) / 2; // the cone of Lipschitz functions
            high[s] = (a + c + steepest * h) / 2;
        }
    }
    return b;
}
std::vector<double> grid(double end, std::size_t cells, std::vector<double> more = {}) {
    for (std::size_t k = 0; k <= cells; ++k)
        more.push_back(end * static_cast<double>(k) / static_cast<double>(cells));
    std::sort(more.begin(), more.end());
    more.erase(std::unique(more.begin(), more.end()), more.end());
    return more;
}

/// The robustness by brute force on a fine grid of instants, at instant k.
class brute_force {
public:
    brute_force(sivid::requirement const& what, std::vector<function> const& f, double end,
                std::size_t cells)
        : what_(what), f_(f), h_(end / static_cast<double>(cells)), last_(cells) {}
    [[nodiscard]] double operator()() const { return at(what_.parts.size() - 1, 0); }

private:
    [[nodiscard]] double at(std::size_t index, std::size_t k) const {
        using kind = sivid::requirement::kind;
        auto const& p = what_.parts[index];
        auto const place = [&](double t) {
            return std::min(last_, static_cast<std::size_t>(std::lround(t / h_)));
        };
        auto const from = k + place(p.from);
        auto const to = std::isinf(p.to) ? last_ : std::min(last_, k + place(p.to));
        double result = 0;
        switch (p.what) {
        case kind::comparison:
            return f_[p.comparison](h_ * static_cast<double>(k));
        case kind::negation:
            return -at(p.first, k);
        case kind::conjunction:
        case kind::provided:
            return std::min(at(p.first, k), at(p.second, k));
        case kind::disjunction:
            return std::max(at(p.first, k), at(p.second, k));
        case kind::at:
            return at(p.first, place(p.from));
        case kind::always:
            result = infinity;
            for (auto j = from; j <= to; ++j) result = std::min(result, at(p.first, j));
            return result;
        case kind::eventually:
            result = -infinity;
            for (auto j = from; j <= to; ++j) result = std::max(result, at(p.first, j));
            return result;
        case kind::until: {
            result = -infinity;
            double before = infinity;
            for (auto j = k; j <= to; ++j) {
                if (j >= from) result = std::max(result, std::min(before, at(p.second, j)));
                before = std::min(before, at(p.first, j));
            }
            return result;
        }
        }
        return result;
    }
    sivid::requirement const& what_;
    std::vector<function> const& f_;
    double h_;
    std::size_t last_;
};

} // namespace

TEST_CASE("a margin is certain, possible or neither") {
    auto const t = [](double low, double high, bool strict) {
        return sivid::truth_of_margin(low, high, strict, {});
    };
    CHECK(t(0.1, 1, true).proved());
    CHECK(t(-1, -0.1, true).refuted());
    CHECK_FALSE(t(0, 1, true).proved());
    CHECK(t(0, 1, false).proved());
    CHECK(t(-1, 0, true).refuted());
    CHECK_FALSE(t(-1, 0, false).refuted());
    for (auto const& nothing :
         {t(NAN, 1, true), t(1, NAN, true), t(NAN, NAN, false), t(-infinity, infinity, true)}) {
        CHECK_FALSE(nothing.proved());
        CHECK_FALSE(nothing.refuted());
        CHECK(nothing.low == -infinity);
        CHECK(nothing.high == infinity);
    }
}

TEST_CASE("nothing is refuted where what it is provided for is not proved") {
    struct known {
        double low, high;
    };
    known const holds{1, 2}, fails{-2, -1}, open{-1, 1};
    auto const asked = read("x0 > 0 provided always(x1 > 0)", 1);
    for (auto const& first : {holds, fails, open}) {
        for (auto const& second : {holds, fails, open}) {
            sivid::margin_bounds bounds{{0, 1}, {}, {}};
            for (auto const* side : {&first, &second}) {
                bounds.low.push_back(std::vector<double>(3, side->low));
                bounds.high.push_back(std::vector<double>(3, side->high));
            }
            auto const says = sivid::evaluate(asked, bounds);
            bool const kept = second.low > 0;
            CHECK(says.kept == kept);
            CHECK(says.proved() == (kept && first.low > 0));
            CHECK(says.refuted() == (kept && first.high < 0));
            CHECK(says.hopeless() == (first.high < 0 || second.high < 0));
        }
    }
}

TEST_CASE("bounds of a robustness hold the true one and close on it") {
    std::vector<function> const f{[](double t) { return std::sin(2 * t) - 0.2; },
                                  [](double t) { return std::cos(t) + 0.1 * t; },
                                  [](double t) { return 0.7 - std::abs(t - 2.3); }};
    for (std::string const text :
         {"always x0 > 0", "eventually x0 > 0", "always[1, 3] eventually[0.5, 2] x0 > 0",
          "eventually[0, 2] always[0.25, 1] x0 > 0", "x0 > 0 until x1 > 0",
          "x0 > 0 until[1, 3] x1 > 0", "not (x0 > 0 until[0.5, 2] x1 > 0)",
          "always[0, 3] (x0 > 0 or eventually[0, 1] x1 > 0)",
          "(x0 > 0 and x1 > 0) at 2.5 or always(x0 + x1 > 0)",
          "eventually[0.5, 4.5] (x0 > 0 until[0.25, 0.5] (x1 > 0 or x0 > 0))",
          "always[0, 1] (x1 > 0 until[0, 4] x0 > 0)"}) {
        auto const what = read(text, 5);
        CAPTURE(text);
        REQUIRE(what.margins.size() <= f.size());
        double const exact = brute_force(what, f, 5, 400)();
        double width = infinity;
        for (std::size_t const cells : {20u, 200u}) {
            auto const b = bounds_of(grid(5, cells, what.times), f, 2.01);
            auto const says = sivid::evaluate(what, b);
            double const slack = 2.01 * 5.0 / 400; // of brute force itself
            CHECK(says.low <= exact + slack);
            CHECK(says.high >= exact - slack);
            CHECK(says.low <= says.high);
            CHECK(says.high - says.low <= width);
            if (says.low > 0) CHECK(says.proved());
            if (says.high < 0) CHECK(says.refuted());
            width = says.high - says.low;
        }
        CHECK(width < 0.2);
    }
}

TEST_CASE("a dip between two instants is not overlooked") {
    auto const what = read("always x0 > 0", 1);
    sivid::margin_bounds b{{0, 0.5, 1}, {{1, 1, 1, -0.1, 1}}, {{1, 1, 1, 1, 1}}};
    auto const says = sivid::evaluate(what, b);
    CHECK_FALSE(says.proved());
    CHECK(says.low == -0.1);
    CHECK(says.low_from.segment == 3);
    CHECK(says.high == 1);
}

TEST_CASE("what is unknown at the end keeps an answer open") {
    sivid::margin_bounds const b{
        {0, 0.5, 1}, {{1, 1, 1, -infinity, -infinity}}, {{1, 1, 1, infinity, infinity}}};
    CHECK_FALSE(sivid::evaluate(read("always x0 > 0", 1), b).proved());
    CHECK(sivid::evaluate(read("always[0, 0.5] x0 > 0", 1), b).proved());
    CHECK(sivid::evaluate(read("eventually x0 > 0", 1), b).proved());
    CHECK_FALSE(sivid::evaluate(read("x0 > 0 at end", 1), b).proved());
    CHECK_FALSE(sivid::evaluate(read("not always x0 > 0", 1), b).refuted());
}

TEST_CASE("a comparison that may be equal holds at its bound") {
    sivid::margin_bounds const b{{0, 1}, {{0, 0, 0}}, {{0, 0, 0}}};
    CHECK(sivid::evaluate(read("always x0 >= 0", 1), b).proved());
    CHECK(sivid::evaluate(read("always x0 > 0", 1), b).refuted());
    CHECK(sivid::evaluate(read("not eventually x0 > 0", 1), b).proved());
}

TEST_CASE("bounds that do not fit a requirement are refused") {
    auto const what = read("always x0 > 0", 1);
    CHECK_THROWS_AS(sivid::evaluate(what, {{0, 1}, {}, {}}), std::invalid_argument);
    CHECK_THROWS_AS(sivid::evaluate(what, {{0, 1}, {{1.0}}, {{1.0}}}), std::invalid_argument);
    CHECK_THROWS_AS(sivid::evaluate(what, {{0}, {{1.0}}, {{1.0}}}), std::invalid_argument);
}
