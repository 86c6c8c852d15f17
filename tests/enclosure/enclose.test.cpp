// SPDX-License-Identifier: MIT
// A turning vector x' = p y, y' = -p x, known in closed form, by every set and kind of method.
#include <sivid/enclosure/enclose.hpp>

#include <sivid/enclosure/methods.hpp>
#include <sivid/enclosure/tube.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

namespace {

auto turning() {
    return support::flow_of(support::model_of(
        {2, 1, 0, 1e3}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * x[1], -(p[0] * x[0])};
        }));
}
box const starts{between(0.9, 1.1), between(-0.1, 0.1)};
box const speeds{between(0.9, 1.1)};

bool holds(box const& x, std::vector<double> const& x0, double p, double t) {
    long double const c = std::cos(static_cast<long double>(p) * t),
                      s = std::sin(static_cast<long double>(p) * t);
    return support::encloses_reference(x[0], c * x0[0] + s * x0[1]) &&
           support::encloses_reference(x[1], c * x0[1] - s * x0[0]);
}

/// x' = p u - x with an input.
struct driven {
    static constexpr auto name = "driven";
    static constexpr auto states = sivid::states({{"x", "m", 10}});
    static constexpr auto inputs = sivid::inputs({{"u", "m"}});
    static constexpr auto channels = sivid::channels({{"square", "m^2"}});
    static constexpr auto constants = sivid::constants({{"p", "1/s", 1_dec}});
    auto rate(auto const&, auto const& x, auto const& c, auto const& u) const {
        return std::array{c[0] * u[0] - x[0]};
    }
    auto observe(auto const&, auto const& x, auto const&, auto const&) const {
        return std::array{sqr(x[0])};
    }
};

} // namespace

TEST_CASE("by any set and method, at and over contain every trajectory") {
    auto const f = turning();
    draws d(3);
    double widest_models = 0, narrowest_first = 1e9;
    for (auto const set : {carried_set::doubleton, carried_set::taylor_model}) {
        for (auto const& method :
             {std::optional<tableau>{}, std::optional{rk4()}, std::optional{gauss4()}}) {
            if (method && set == carried_set::taylor_model) continue; // refused
            CAPTURE(static_cast<int>(set), method ? method->name : "taylor");
            enclosure_options options{.tolerance = 1e-6, .relative_tolerance = 1e-3};
            options.method = method;
            auto const motion = enclose(f, starts, speeds, 0, 2, set, options);
            REQUIRE(motion.complete());
            CHECK(motion.end_time() == 2);
            REQUIRE(!motion.spans().empty());
            CHECK(motion.spans().front().from == 0);
            CHECK(motion.spans().back().to == 2);
            for (int round = 0; round < 12; ++round) {
                double const from = d.uniform(0, 2), to = d.uniform(from, 2);
                auto const there = motion.at(from), all = motion.over(from, to);
                auto const seen = motion.observe_at(from);
                for (int sample = 0; sample < 20; ++sample) {
                    auto const x0 = d.in(starts);
                    double const p = d.in(speeds)[0];
                    CHECK(holds(there, x0, p, from));
                    CHECK(holds(seen, x0, p, from)); // the channels are the states
                    CHECK(holds(all, x0, p, from));
                    CHECK(holds(all, x0, p, to));
                    CHECK(holds(all, x0, p, d.uniform(from, to)));
                }
            }
            double const end = width(motion.at(2));
            if (set == carried_set::doubleton) narrowest_first = std::min(narrowest_first, end);
            if (set == carried_set::taylor_model) widest_models = std::max(widest_models, end);
            CHECK_THROWS_AS(motion.at(2.1), std::out_of_range);
            CHECK_THROWS_AS(motion.at(-0.1), std::out_of_range);
            CHECK_THROWS_AS(motion.over(1, 0.5), std::invalid_argument);
        }
    }
    CHECK(widest_models < narrowest_first);
}

TEST_CASE("Taylor models refuse a Runge-Kutta method") {
    enclosure_options options;
    options.method = rk4();
    CHECK_THROWS_WITH(enclose(turning(), starts, speeds, 0, 2, carried_set::taylor_model, options),
                      ContainsSubstring("'rk4'") && ContainsSubstring("carried_set::doubleton"));
}

TEST_CASE("over a short time a motion says little more than what it does there") {
    // x = t^3 - 3 t in steps of about one unit, and the same with a parameter.
    auto const cubic = [](auto const& t, auto const&, auto const& p, auto const&) {
        return std::vector{p[0] * (sqr(t) - 1)};
    };
    auto const f = support::flow_of(support::model_of({1, 1, 0, 1e3}, cubic));
    auto const value = [](double start, double p, double t) {
        long double const s = t, c = static_cast<long double>(p) / 3;
        return static_cast<long double>(start) + c * (s * s * s - 3 * s) + 18 * c;
    };
    draws d(5);
    for (auto const set : {carried_set::doubleton, carried_set::taylor_model}) {
        for (auto const& method :
             {std::optional<tableau>{}, std::optional{rk4()}, std::optional{gauss4()}}) {
            for (double const r : {0.0, 0.01}) {
                if (method && set == carried_set::taylor_model) continue; // refused
                CAPTURE(static_cast<int>(set), method ? method->name : "taylor", r);
                enclosure_options options{.tolerance = 1e-6, .relative_tolerance = 1e-3};
                options.maximum_step = 1;
                options.method = method;
                box const start{between(-18 - r, -18 + r)}, p{between(3 - r, 3 + r)};
                auto const motion = enclose(f, start, p, -3, 3, set, options);
                REQUIRE(motion.complete());
                auto const check = [&](double from, double to) {
                    auto const over = motion.over(from, to)[0];
                    double least = HUGE_VAL, most = -HUGE_VAL;
                    for (int k = 0; k <= 40; ++k) {
                        double const t = k == 40 ? to : from + (to - from) * k / 40;
                        for (double const x : {start[0].lower(), start[0].upper()}) {
                            for (double const c : {p[0].lower(), p[0].upper()}) {
                                auto const y = value(x, c, t);
                                CAPTURE(from, to, t, over.lower(), over.upper());
                                REQUIRE(support::encloses_reference(over, y));
                                least = std::min(least, static_cast<double>(y));
                                most = std::max(most, static_cast<double>(y));
                            }
                        }
                    }
                    return width(over) - (most - least);
                };
                for (double const from : {-1.9, 0.0, 1.7, -3.0, 2.9})
                    CHECK(check(from, from + 0.1) < 0.1 + 20 * r);
                for (int round = 0; round < 10; ++round) { // across the ends of steps
                    auto const& span = motion.spans()[d.below(motion.spans().size())];
                    double const from = std::max(-3.0, span.to - d.uniform(0, 0.05)),
                                 to = std::min(3.0, span.to + d.uniform(0, 0.05));
                    CHECK(check(from, to) < 0.1 + 20 * r);
                    CHECK(check(from, span.to) < 0.1 + 20 * r);
                    auto const at = motion.at(from), degenerate = motion.over(from, from);
                    CHECK(at[0].lower() == degenerate[0].lower());
                    CHECK(at[0].upper() == degenerate[0].upper());
                }
                CHECK(check(-3, 3) < 60);
            }
        }
    }
}

TEST_CASE("sets of first order are those of integrate, in any interval type") {
    auto const f = turning();
    auto const motion = enclose(f, starts, speeds, 0, 1, carried_set::doubleton);
    auto const tube = integrate<interval>(f, starts, speeds, 0, 1);
    CHECK(equal(motion.at(0.3)[0], tube.at(0.3)[0]));
    CHECK(equal(motion.over(0.3, 0.7)[1], tube.over(0.3, 0.7)[1]));
    CHECK(motion.steps().steps().size() == tube.steps().size());
    CHECK_THROWS_AS(enclose(f, starts, speeds, 0, 1).steps(), std::logic_error);
}

TEST_CASE("what cannot be enclosed is refused, or ends early with a reason") {
    auto const f = turning();
    CHECK_THROWS_AS(enclose(f, box{interval(1)}, speeds, 0, 1), std::invalid_argument);
    CHECK_THROWS_AS(enclose(f, starts, speeds, 1, 0), std::invalid_argument);
    CHECK_THROWS_AS(enclose(f, starts, box{interval_traits<interval>::entire()}, 0, 1),
                    std::invalid_argument);
    auto const many = support::flow_of(support::model_of(
        {2, 2, 0, 1e3}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * x[1], -(p[1] * x[0])};
        }));
    CHECK(enclose(many, starts, box{speeds[0], speeds[0]}, 0, 1).end_time() == 1);
    auto const blow_up = support::flow_of(
        support::model_of({1, 0, 0, 1e3}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{x[0] * x[0]};
        }));
    auto const motion = enclose(blow_up, box{between(0.9, 1.1)}, box{}, 0, 2);
    REQUIRE_FALSE(motion.complete());
    CHECK(motion.end_time() < 1);
    REQUIRE(motion.end_time() > 0.2);
    double const t = 0.9 * motion.end_time();
    CHECK(contains(motion.at(t)[0], 1 / (1 - t)));
    CHECK_THROWS_AS(motion.at(1.5), std::out_of_range);
}

TEST_CASE("a recorded model needs its names and boxes, and no sizes") {
    auto const model = record_model<driven>();
    std::vector<signal> const held{sampled_signal({0}, {2}, interpolation::hold)};
    box const p{between(0.875, 1.125)}, x0{between(0.375, 0.5)};
    for (auto const set : {carried_set::doubleton, carried_set::taylor_model}) {
        for (auto const& method :
             {std::optional<tableau>{}, std::optional{rk4()}, std::optional{gauss4()}}) {
            if (method && set == carried_set::taylor_model) continue; // refused
            CAPTURE(static_cast<int>(set), method ? method->name : "taylor");
            auto const motion =
                enclose(model, {{"p"}, {}}, x0, p, 0, 3, set, {.method = method}, held);
            REQUIRE(motion.complete());
            for (double const t : {0.0, 0.7, 2.1, 3.0}) { // at the corners, and their hull
                long double const rest = std::exp(-static_cast<long double>(t));
                auto const now = motion.at(t)[0];
                auto const low = 1.75L - 1.375L * rest, high = 2.25L - 1.75L * rest;
                CHECK(now.lower() <= low);
                CHECK(now.upper() >= high);
                CHECK(width(now) < 1.1 * static_cast<double>(high - low) + 1e-9);
                auto const seen = motion.observe_at(t)[0];
                CHECK(seen.lower() <= low * low);
                CHECK(seen.upper() >= high * high);
                CHECK(width(seen) < 1.15 * static_cast<double>(high * high - low * low) + 1e-9);
            }
        }
    }
    CHECK_THROWS_AS(enclose(model, {{"q"}, {}}, x0, p, 0, 1, carried_set::doubleton, {}, held),
                    std::invalid_argument);
    CHECK_THROWS_AS(enclose(model, {{"p"}, {}}, x0, p, 0, 1), std::invalid_argument); // no input
    auto const fixed = enclose(model, {{}, {{"p", interval(1)}}}, x0, box{}, 0, 3,
                               carried_set::taylor_model, {}, held);
    CHECK(contains(fixed.at(3)[0], 2 - 1.55 * std::exp(-3.0)));
}

TEST_CASE("between its steps a motion is told in any order, as tight as at their ends") {
    auto const motion = enclose(turning(), starts, speeds, 0, 4);
    REQUIRE(motion.spans().size() > 5);
    std::vector<double> times;
    for (int k = 0; k <= 64; ++k) times.push_back(k / 16.0);
    for (auto const& s : motion.spans()) times.push_back(s.to);
    auto const once = motion.at(1.3);
    for (auto t = times.rbegin(); t != times.rend(); ++t) {
        CAPTURE(*t);
        auto const now = motion.at(*t);
        for (double const p : {0.9, 1.0, 1.1}) CHECK(holds(now, {1, 0.05}, p, *t));
    }
    CHECK(equal(once[0], motion.at(1.3)[0]));
    for (double const t : {0.1, 1.3, 2.9, 3.7}) {
        auto const own = enclose(turning(), starts, speeds, 0, t);
        CHECK(width(motion.at(t)) < 1.02 * width(own.at(t)));
    }
    auto const still = enclose(turning(), starts, speeds, 1, 1);
    CHECK(subset(starts, still.at(1)));
    CHECK(subset(starts, still.observe_at(1)));
}

TEST_CASE("a motion of many steps keeps some of its sets, and is told as well by them") {
    {
        enclosure_options const options{.tolerance = 1e-9, .maximum_step = 4e-3};
        // 3 sets 4 steps apart, 64 of them, and 47 that are 64 apart after four times of thinning
        for (double const end : {0.04, 1.02, 12.0}) {
            auto const motion =
                enclose(turning(), starts, speeds, 0, end, carried_set::taylor_model, options);
            REQUIRE(motion.complete());
            CHECK(static_cast<double>(motion.spans().size()) >= end / 4e-3);
            draws d(17);
            for (int k = 0; k < 40; ++k) {
                double const t = k < 2 ? end * k : d.uniform(0, end);
                CAPTURE(end, t);
                auto const now = motion.at(t);
                for (double const p : {0.9, 1.0, 1.1}) CHECK(holds(now, {1, 0.05}, p, t));
                CHECK(subset(now, motion.over(t, t)));
            }
            auto const own = enclose(turning(), starts, speeds, 0, 0.7 * end,
                                     carried_set::taylor_model, options);
            CHECK(width(motion.at(0.7 * end)) < 1.02 * width(own.at(0.7 * end)));
        }
    }
}

TEST_CASE("steps are relative to the span, be it a microsecond or days") {
    auto const f = turning();
    auto const width_after = [&](double span, auto const& enclosed) {
        box const own{between(1.8 / span, 2.2 / span)}; // two turns of a radian, whatever the unit
        auto const motion = enclosed(own, span);
        CAPTURE(span);
        REQUIRE(motion.complete());
        CHECK(motion.end_time() == span);
        CHECK(motion.steps_made <= 100);
        return width(motion.end);
    };
    struct result {
        bool done;
        double last;
        box end;
        std::size_t steps_made;
        bool complete() const { return done; }
        double end_time() const { return last; }
    };
    for (auto const set : {carried_set::doubleton, carried_set::taylor_model}) {
        for (auto const& method : {std::optional<tableau>{}, std::optional{rk4()}}) {
            if (method && set == carried_set::taylor_model) continue; // refused
            CAPTURE(static_cast<int>(set), method ? method->name : "taylor");
            enclosure_options options{.tolerance = 1e-6, .relative_tolerance = 1e-3};
            options.method = method;
            auto const by_enclose = [&](box const& own, double span) {
                auto const m = enclose(f, starts, own, 0, span, set, options);
                return result{m.complete(), m.end_time(), m.at(m.end_time()), m.spans().size()};
            };
            double const usual = width_after(2, by_enclose);
            for (double const span : {1e-6, 1e6})
                CHECK(width_after(span, by_enclose) < 1.01 * usual);
            auto const by_integrate = [&](box const& own, double span) {
                auto const t = integrate<interval>(f, starts, own, 0, span, options);
                return result{t.complete(), t.end_time(), t.end().hull, t.steps().size()};
            };
            double const own = width_after(2, by_integrate);
            for (double const span : {1e-6, 1e6})
                CHECK(width_after(span, by_integrate) < 1.01 * own);
        }
    }
}
