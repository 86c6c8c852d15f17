// SPDX-License-Identifier: MIT
// The units of a model are the user's: microseconds or days, microns or kilometres, the same data
// leave the same set after the same work.
#include <sivid/paving/identify.hpp>

#include "support/catch.hpp"
#include "support/oscillator_in_units.hpp"

#include <sivid/paving/online_identification.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace sivid;

namespace {

/// x' = r x (1 - x/K)
struct growth {
    static constexpr auto name = "growth";
    static constexpr auto states = sivid::states({{"x", "1", 10}});
    static constexpr auto inputs = no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "1"}});
    static constexpr auto constants = sivid::constants({{"r", "1", 1_dec}, {"K", "1", 1_dec}});

    template <class T>
    vec<T, 1> rate(T const&, vec<T, 1> const& x, vec<T, 2> const& c, vec<T, 0> const&) const {
        return {c[0] * x[0] * (1 - x[0] / c[1])};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 1> const& x, vec<T, 2> const&, vec<T, 0> const&) const {
        return x;
    }
};

/// x'' = u - k x - d x'
struct plain_oscillator {
    static constexpr auto name = "oscillator";
    static constexpr auto states = sivid::states({{"x", "1", 10}, {"v", "1", 1e5}});
    static constexpr auto inputs = sivid::inputs({{"u", "1"}});
    static constexpr auto channels = sivid::channels({{"x", "1"}});
    static constexpr auto constants = sivid::constants({{"k", "1", 1_dec}, {"d", "1", 1_dec}});

    template <class T>
    vec<T, 2> rate(T const&, vec<T, 2> const& x, vec<T, 2> const& c, vec<T, 1> const& u) const {
        return {x[1], u[0] - c[0] * x[0] - c[1] * x[1]};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 2> const& x, vec<T, 2> const&, vec<T, 1> const&) const {
        return {x[0]};
    }
};

identify_options hulls_alone() {
    identify_options options;
    options.only_hulls = true;
    return options;
}

using support::in_units::scalings;
using support::in_units::units;
using support::in_units::units_of_time;

/// The oscillator, with dry friction in the data and in the model where that is asked for.
identification_problem posed_in(units const& in, bool friction,
                                support::in_units::sizes const& of) {
    if (!friction) return support::in_units::problem_in(in, {}, of);
    auto p = support::in_units::problem_in(in, {.friction = 0.35}, of);
    for (auto const& e : support::in_units::catalogue_in(in)) {
        if (e.name != "friction") continue;
        p.model = with(p.model, {e});
        p.choice.unknown.push_back("friction." + e.parameters[0].name);
        std::vector<interval> sides(p.prior.begin(), p.prior.end());
        sides.emplace_back(0.0, in.acceleration());
        p.prior = box(sides);
    }
    return p;
}
/// The sides of a box of its parameters, in base units.
std::vector<interval> in_base(box const& x, units const& in) {
    std::vector<double> const unit{in.acceleration() / in.input, 1 / (in.time * in.time),
                                   1 / in.time, in.acceleration()};
    std::vector<interval> result;
    for (std::size_t j = 0; j < x.size(); ++j)
        result.emplace_back(x[j].lower() / unit[j], x[j].upper() / unit[j]);
    return result;
}

struct work {
    std::string verdict;
    std::size_t boxes = 0, integrations = 0;
    std::vector<interval> hull;
};

/// Budgets that the machine's speed has no say in.
work identified(units const& in, bool friction, std::size_t boxes,
                support::in_units::sizes const& of) {
    identify_options options;
    options.search.seconds = 1e9;
    options.search.boxes = boxes;
    auto const found = identify(posed_in(in, friction, of), options);
    return {std::string(to_string(found.verdict)), found.effort ? found.effort->boxes : 0,
            found.integrations, in_base(found.hull, in)};
}
work identified_online(units const& in, support::in_units::sizes const& of) {
    auto problem = posed_in(in, false, of);
    auto const samples = problem.experiments.front().measurements;
    problem.experiments.front().measurements.clear();
    online_options options;
    options.refinement.boxes = 40;
    options.refinement.live = 16;
    options.refinement.seconds = 1e9;
    online_identification online(problem, options);
    work result;
    for (auto const& m : samples) {
        auto const& update = online.add({0, m});
        result.boxes += update.judged;
        result.integrations += update.integrations;
    }
    result.verdict = to_string(online.last().verdict);
    result.hull = in_base(online.last().hull, in);
    return result;
}

bool alike(std::size_t a, std::size_t b) {
    auto const more = std::max(a, b), less = std::min(a, b);
    return more - less <= std::max<std::size_t>(2, more / 10);
}

/// @param find   (units) -> work
template <class Find>
void compare(std::vector<units> const& all, Find const& find) {
    auto const base = find(units{});
    for (auto const& in : all) {
        CAPTURE(in.name, in.state, in.input);
        auto const found = find(in);
        CHECK(found.verdict == base.verdict);
        CHECK(alike(found.boxes, base.boxes));
        CHECK(alike(found.integrations, base.integrations));
        for (std::size_t j = 0; j < base.hull.size(); ++j)
            CHECK(std::abs(width(found.hull[j]) - width(base.hull[j])) <=
                  0.01 * width(base.hull[j]));
    }
}
std::vector<units> few() {
    return {{0x1p-12, 1, 1, "2^12 s"}, {1e3, 1, 1, "ms"}, {1.0 / 3600, 1e6, 1e-3, "h"}};
}
std::vector<units> many() {
    std::vector<units> all(units_of_time.begin(), units_of_time.end());
    for (double const size : scalings) {
        all.push_back({1, size, 1, "s"});
        all.push_back({1, 1, size, "s"});
        all.push_back({1e3, size, 1 / size, "ms"});
        all.push_back({1.0 / 86400, size, size, "d"});
    }
    return all;
}

} // namespace

TEST_CASE("the same data leave the same set after the same work, in any units") {
    compare(few(), [](units const& in) { return identified(in, false, 200, {4, 40}); });
    std::vector<units> const exact{{0x1p-12, 1, 1, "2^12 s"}, {0x1p10, 0x1p20, 0x1p-20, "2^-10 s"}};
    compare(exact, [](units const& in) { return identified_online(in, {2, 20}); });
}

TEST_CASE("with dry friction in the model, too") {
    compare({{1e3, 1, 1, "ms"}}, [](units const& in) { return identified(in, true, 24, {4, 40}); });
}

TEST_CASE("with dry friction in the model, a long record is searched alike, too", "[.long]") {
    std::vector<units> const all{
        {1e3, 1, 1, "ms"}, {1e6, 1, 1, "us"}, {1.0 / 3600, 1e-6, 1e6, "h"}};
    auto const after = [](std::size_t boxes) {
        return [boxes](units const& in) { return identified(in, true, boxes, {20, 200}); };
    };
    compare(all, after(128));
    compare(all, after(3000));
}

TEST_CASE("identification is the same in all units", "[.long]") {
    compare(many(), [](units const& in) { return identified(in, false, 1000, {20, 200}); });
}

TEST_CASE("a model may count in any unit of time") {
    double const r = 1.1, K = 0.9, x0 = 0.1;
    std::vector<interval> hulls;
    for (double const unit : {1.0, 0x1p-20, 0x1p-10, 0x1p10, 0x1p20}) { // a second in the unit
        experiment e;
        e.name = "culture";
        e.initial = box{interval(x0)};
        for (int k = 1; k <= 8; ++k) {
            double const t = k / 2.0, x = K / (1 + (K / x0 - 1) * std::exp(-r * t));
            e.measurements.push_back({t * unit, 0, {x - 0.01, x + 0.01}});
        }
        box const prior{interval(0.1 / unit, 3 / unit), interval(0.5, 2)};
        auto const found =
            identify({record_model<growth>(), {{"r", "K"}, {}}, prior, {e}}, hulls_alone());
        CAPTURE(unit);
        CHECK(found.verdict == verdict::consistent);
        CHECK(contains(found.hull[0], r / unit));
        CHECK(contains(found.hull[1], K));
        hulls.emplace_back(found.hull[0].lower() * unit, found.hull[0].upper() * unit);
        CHECK(width(hulls.back()) < 1.05 * width(hulls.front()));
    }
    CHECK(width(hulls.front()) < 0.05 * 2.9);
}

TEST_CASE("records of milliseconds and of hours with inputs are carried as those of seconds") {
    double const k = 4, d = 0.3;
    std::vector<double> widths;
    for (double const unit : {1.0, 0x1p-10, 0x1p10}) {
        experiment e;
        e.name = "step";
        e.initial = box{interval(0.0), interval(0.0)};
        std::vector<double> times, values;
        for (int n = 0; n <= 8; ++n) {
            times.push_back(n * unit);
            values.push_back((n % 2 == 0 ? 1 : -1) / (unit * unit));
        }
        e.inputs = {sampled_signal(times, values, interpolation::hold)};
        double x = 0, v = 0; // small enough steps of Euler's method, made symplectic
        int const steps = 200000;
        double const h = 8.0 / steps;
        for (int n = 1; n <= steps; ++n) {
            double const u = int((n - 0.5) * h) % 2 == 0 ? 1 : -1;
            v += h * (u - k * x - d * v);
            x += h * v;
            if (n % (steps / 32) == 0)
                e.measurements.push_back({n * h * unit, 0, {x - 0.01, x + 0.01}});
        }
        box const prior{interval(3.2 / (unit * unit), 4.8 / (unit * unit)),
                        interval(0.2 / unit, 0.4 / unit)};
        auto const found = identify(
            {record_model<plain_oscillator>(), {{"k", "d"}, {}}, prior, {e}}, hulls_alone());
        CAPTURE(unit);
        CHECK(found.verdict == verdict::consistent);
        CHECK(contains(found.hull[0], k / (unit * unit)));
        CHECK(contains(found.hull[1], d / unit));
        widths.push_back(width(found.hull[0]) * unit * unit);
        CHECK(widths.back() < 1.1 * widths.front());
        CHECK(widths.back() < 0.1 * 1.6);
    }
}
