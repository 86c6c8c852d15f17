// SPDX-License-Identifier: MIT
// Static problems of many measurements and several parameters: truths, outliers, hulls, growth.
#include <sivid/paving/static_inversion.hpp>

#include "../../benchmarks/paving/problems.hpp"
#include "paving/static_models.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <random>

using namespace sivid;

namespace {

/// Exponentials, a second channel that is not defined everywhere (and has an infinite slope), a
/// third that jumps.
struct wild {
    static constexpr auto name = "wild";
    static constexpr auto channels = sivid::channels({{"y", "1"}, {"z", "1"}, {"s", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"a", "1", 1_dec}, {"b", "1", 1_dec}, {"c", "1", 1_dec}});
    }();
    template <class T>
    channels_of<wild, T> observe(T const& t, constants_of<wild, T> const& p) const {
        return {p[0] * exp(-p[1] * t) + p[2] * t, log(p[0] - p[2] * t) + sqrt(p[1]),
                p[0] + sign(p[1] - p[2]) * t + abs(p[0] - p[1] * t)};
    }
};
double of_wild(std::size_t channel, double t, std::vector<double> const& p) {
    if (channel == 0) return p[0] * std::exp(-p[1] * t) + p[2] * t;
    if (channel == 1) return std::log(p[0] - p[2] * t) + std::sqrt(p[1]); // NaN outside
    double const d = p[1] - p[2];
    return p[0] + (d > 0 ? t : d < 0 ? -t : 0) + std::abs(p[0] - p[1] * t);
}

/// Not defined for q <= 0, at time 0 either, where its slope by q vanishes.
struct vanishing {
    static constexpr auto name = "vanishing";
    static constexpr auto channels = sivid::channels({{"y", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"p", "1", 1_dec}, {"q", "1", 1_dec}});
    }();
    template <class T>
    channels_of<vanishing, T> observe(T const& t, constants_of<vanishing, T> const& c) const {
        return {c[0] * c[0] - c[0] + t * log(c[1])};
    }
};

std::vector<std::string> names_of(recorded_model const& m) {
    std::vector<std::string> names;
    for (auto const& c : m.about.constants) names.push_back(c.name);
    return names;
}

/// Samples in no order, some times twice; `spoilt` of them are far off.
static_problem wild_problem(std::mt19937& random, std::vector<double> const& truth, std::size_t n,
                            std::size_t spoilt, std::size_t budget) {
    std::uniform_real_distribution<double> u(-1, 1), start(0, 3);
    static_problem p{record_static_model<wild>(), {{"a", "b", "c"}, {}}, {}, {}, budget};
    std::vector<interval> sides;
    for (double const v : truth) {
        double const r = 0.05 + std::abs(u(random)), m = v + 0.9 * r * u(random);
        sides.push_back(interval(m - r, m + r));
    }
    p.prior = box(sides);
    double const e = std::pow(10.0, -1.5 + u(random));
    double t = 0;
    while (p.measurements.size() < n) {
        if (p.measurements.size() % 5 != 4) t = start(random);
        std::size_t const channel = static_cast<std::size_t>(random() % 5) % 3;
        double y = of_wild(channel, t, truth);
        if (!std::isfinite(y)) continue;
        y += 0.99 * e * u(random);
        p.measurements.push_back({t, channel, interval(y - e, y + e)});
    }
    for (std::size_t k = 0; k < spoilt; ++k) {
        auto& b = p.measurements[random() % n].bound;
        b = interval(b.lower() + 2.5 * e, b.upper() + 4 * e);
    }
    return p;
}

bool within(flat_paving const& found, std::vector<double> const& p) {
    for (auto const* boxes : {&found.inside, &found.open}) {
        for (std::size_t i = 0; i < boxes->size(); ++i) {
            bool in = true;
            for (std::size_t j = 0; j < p.size(); ++j) {
                in = in && boxes->lower(i, j) <= p[j] && p[j] <= boxes->upper(i, j);
            }
            if (in) return true;
        }
    }
    return false;
}

template <std::size_t n>
static_problem polynomial_problem(std::size_t samples, unsigned seed) {
    static_problem p{record_static_model<paving_benchmark::polynomial<n>>(), {}, {}, {}};
    p.choice.unknown = names_of(p.model);
    p.prior = box(std::vector<interval>(n, interval(0, 2)));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(-1, 1);
    for (std::size_t k = 0; k < samples; ++k) {
        double const t = static_cast<double>(k) / static_cast<double>(samples - 1);
        double y = 0;
        for (std::size_t j = n; j-- > 0;) y = y * t + 1;
        y += 0.0999 * u(random);
        p.measurements.push_back({t, 0, interval(y - 0.1, y + 0.1)});
    }
    return p;
}

void check_planted(int problems, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0.2, 2);
    std::size_t narrowed = 0, some = 0;
    for (int round = 0; round < problems; ++round) {
        std::vector<double> const truth{place(random), place(random), place(random)};
        std::size_t const sizes[] = {3, 20, 64, 65, 200, 1500};
        auto const n = sizes[static_cast<std::size_t>(round) % 6];
        std::size_t const budgets[] = {0, 0, 1, 2, 12};
        auto const budget = std::min(budgets[static_cast<std::size_t>(round) % 5], n / 3);
        auto const problem = wild_problem(random, truth, n, budget, budget);
        static_inversion_options o;
        o.accuracy = 0.1;
        o.boxes = 300;
        o.only_hulls = round % 2 == 1;
        auto const found = invert_static(problem, o);
        INFO(round << " of seed " << seed << ", " << n << " measurements, budget " << budget);
        REQUIRE(within(found, truth));
        auto const hull = found.hull();
        for (std::size_t j = 0; j < 3; ++j) {
            narrowed += width(hull[j]) < 0.5 * width(problem.prior[j]) ? 1 : 0;
            ++some;
        }
        // What is called inside is feasible.
        for (std::size_t i = 0; i < found.inside.size(); i += 1 + found.inside.size() / 5) {
            auto const p = mid(found.inside.at(i));
            std::size_t missed = 0;
            for (auto const& m : problem.measurements) {
                double const y = of_wild(m.channel, m.time, p);
                missed += y >= m.bound.lower() - 1e-9 && y <= m.bound.upper() + 1e-9 ? 0 : 1;
            }
            REQUIRE(missed <= budget);
        }
    }
    CHECK(4 * narrowed > some);
}

/// Points that are proved feasible reach nearly as far as the hull: it is nearly exact.
template <std::size_t n>
void check_polynomial() {
    for (unsigned seed = 0; seed < 5; ++seed) {
        auto const problem = polynomial_problem<n>(100, seed);
        static_inversion_options o;
        o.only_hulls = true;
        auto const found = invert_static(problem, o);
        auto const hull = found.hull();
        REQUIRE(found.inside.size() > 0);
        CHECK(found.tested < 10);
        CHECK(within(found, std::vector<double>(n, 1.0)));
        auto const inner = found.inside.hull();
        for (std::size_t j = 0; j < n; ++j) {
            INFO(n << " coefficients, seed " << seed << ", " << j);
            CHECK(width(hull[j]) <= 1.01 * width(inner[j]));
        }
    }
}

} // namespace

TEST_CASE("planted truths are never lost in problems that jump and are not defined everywhere") {
    check_planted(600, 1);
}
TEST_CASE("planted truths in thousands of problems", "[.long]") {
    for (unsigned seed = 2; seed < 12; ++seed) check_planted(1000, seed);
}

TEST_CASE("hulls of models that are linear in their parameters are exact within one per cent") {
    check_polynomial<3>();
    check_polynomial<6>();
    check_polynomial<8>();
}

TEST_CASE("work grows no faster than the measurements") {
    static_inversion_options o;
    o.only_hulls = true;
    std::size_t former = 0;
    for (std::size_t const n : {1000U, 10'000U, 100'000U}) {
        auto problem = polynomial_problem<3>(n, 1);
        auto const found = invert_static(problem, o);
        CHECK(found.asked < 20'000 + 2 * n);
        CHECK(found.asked > former);
        former = found.asked;
        o.only_hulls = false; // and no more boxes than before are tested
        o.boxes = 1;
        CHECK(invert_static(problem, o).asked < 20'000 + 2 * n);
        o = {};
        o.only_hulls = true;
    }
}

TEST_CASE("the hull is that of the whole paving") {
    auto const problem = static_models::mixed_problem(1.2, 0.7);
    static_inversion_options o;
    o.accuracy = 1.0 / 256;
    auto const fine = invert_static(problem, o);
    o.only_hulls = true;
    auto const quick = invert_static(problem, o);
    CHECK(quick.tested < fine.tested);
    for (std::size_t j = 0; j < 2; ++j) {
        CHECK(std::abs(quick.hull()[j].lower() - fine.hull()[j].lower()) < 0.08);
        CHECK(std::abs(quick.hull()[j].upper() - fine.hull()[j].upper()) < 0.08);
    }
    // Both halves of a ring, and nothing at all.
    auto const ring = invert_static(static_models::ring_problem(), o).hull();
    CHECK(ring[0].lower() <= -std::sqrt(2.0));
    CHECK(ring[0].upper() >= std::sqrt(2.0));
    CHECK(width(ring[1]) < 2 * std::sqrt(2.0) + 0.15);
    auto const none = invert_static(static_models::ring_problem(interval(60, 61)), o);
    CHECK(is_empty(none.hull()));
    CHECK(none.reason == stop_reason::decided);
}

TEST_CASE("where an output is not defined it is violated, also times nothing") {
    for (std::size_t const n : {1U, 64U, 65U, 3000U}) {
        static_problem problem{record_static_model<vanishing>(),
                               {{"p", "q"}, {}},
                               {interval(0, 1), interval(-1, 1)},
                               record(n, {0, 0, interval(-0.3, 0.05)})};
        for (bool const hulls : {false, true}) {
            static_inversion_options o;
            o.accuracy = 0.1;
            o.only_hulls = hulls;
            auto const found = invert_static(problem, o);
            INFO(n << " measurements");
            CHECK(within(found, {0.5, 0.5}));
            for (std::size_t i = 0; i < found.inside.size(); ++i) {
                CHECK(found.inside.lower(i, 1) > 0);
            }
        }
    }
}

TEST_CASE("a static inversion that may hold little ends early and loses nothing") {
    auto const problem = polynomial_problem<3>(100, 3);
    for (std::size_t const memory : {1U, 100'000U}) {
        static_inversion_options o;
        o.memory = memory;
        o.accuracy = 1e-4;
        auto const found = invert_static(problem, o);
        CHECK(found.reason == stop_reason::memory_budget);
        CHECK(within(found, std::vector<double>(3, 1.0)));
    }
}

TEST_CASE("degenerate problems of many measurements") {
    auto const entire = interval_traits<interval>::entire();
    auto const problem = polynomial_problem<3>(100, 3);
    std::vector<double> const truth(3, 1.0);
    static_inversion_options o;
    o.boxes = 200;
    auto free = problem;
    for (auto& m : free.measurements) m.bound = entire;
    CHECK(contains(invert_static(free, o).inner_volume(), 1.0));
    auto spared = problem;
    for (std::size_t const q : {99U, 100U, 1000U}) {
        spared.outliers = q;
        auto const found = invert_static(spared, o);
        CHECK(within(found, truth));
        if (q >= 100) CHECK(contains(found.inner_volume(), 1.0));
    }
    // Bounds on one side, and one that nothing fulfils.
    auto half = problem;
    for (std::size_t k = 0; k < 100; k += 2) {
        half.measurements[k].bound =
            interval_traits<interval>::bounds(-HUGE_VAL, half.measurements[k].bound.upper());
    }
    auto const one_sided = invert_static(half, o).hull();
    for (std::size_t j = 0; j < 3; ++j) {
        CHECK(contains(one_sided[j], 1.0));
        CHECK(width(one_sided[j]) < 0.5);
    }
    half.measurements[7].bound = interval(1e300, 1e301);
    CHECK(is_empty(invert_static(half, o).hull()));
    half.outliers = 1;
    CHECK(within(invert_static(half, o), truth));
    // Priors without width, and vast ones.
    auto thin = problem;
    thin.prior[1] = interval(1.0);
    CHECK(within(invert_static(thin, o), truth));
    thin.prior = point_box(truth);
    CHECK(invert_static(thin, o).inside.size() == 1);
    auto vast = problem;
    vast.prior = box(std::vector<interval>(3, interval(-1e150, 1e150)));
    o.only_hulls = true;
    auto const found = invert_static(vast, o);
    CHECK(within(found, truth));
    CHECK(width(found.hull()[0]) < 1); // of 2e150
    o.accuracy = 0;                    // until the numbers or the boxes end
    CHECK(within(invert_static(problem, o), truth));
    o.keep_going = [] { return false; };
    CHECK(invert_static(problem, o).reason == stop_reason::cancelled);
}
