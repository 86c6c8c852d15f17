// SPDX-License-Identifier: MIT
// The units of time, of states and of inputs are the user's: enclosures of the same motion take the
// same steps and are as wide.
#include <sivid/enclosure/enclose.hpp>

#include "support/catch.hpp"
#include "support/oscillator_in_units.hpp"

#include <sivid/enclosure/methods.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

using namespace sivid;
using support::in_units::scalings;
using support::in_units::units;
using support::in_units::units_of_time;

namespace {

struct way {
    char const* name;
    carried_set set;
    std::optional<tableau> method;
};
std::vector<way> ways() {
    return {{"Taylor models", carried_set::taylor_model, {}},
            {"doubletons", carried_set::doubleton, {}},
            {"doubletons by rk4", carried_set::doubleton, rk4()},
            {"doubletons by gauss4", carried_set::doubleton, gauss4()}};
}

struct outcome {
    std::size_t steps = 0;
    double until = 0;    ///< [s]
    double x = 0, v = 0; ///< widths at the end, in base units
    double rounding = 0; ///< what roundings alone may make them, in base units
};

/// @param spread  of the constants, as a share
outcome enclosed(units const& in, way const& how, double spread, double seconds) {
    auto const p = support::in_units::problem_in(in);
    auto const& e = p.experiments.front();
    std::vector<interval> constants;
    for (double const c : support::in_units::true_constants(in))
        constants.emplace_back(c * (1 - spread), c * (1 + spread));
    enclosure_options options;
    options.method = how.method;
    if (how.method) options.tolerance = 1e-9;
    auto const found = enclose(p.model, p.choice, e.initial, box(constants), 0, seconds * in.time,
                               how.set, options, e.inputs);
    auto const x = found.at(found.end_time());
    // States of at most about 4 are rounded some ten times a step.
    double const rounding = 40 * std::numeric_limits<double>::epsilon();
    auto const steps = found.spans().size();
    return {steps, found.end_time() / in.time, width(x[0]) / in.state, width(x[1]) / in.speed(),
            rounding * static_cast<double>(steps)};
}

void compare(std::vector<units> const& all, double seconds) {
    for (auto const& how : ways()) {
        for (double const spread : {0.0, 1e-3, 0.03}) {
            auto const base = enclosed({}, how, spread, seconds);
            for (auto const& in : all) {
                auto const power = [](double x) { return std::ldexp(1.0, std::ilogb(x)) == x; };
                bool const exact = power(in.time) && power(in.state) && power(in.input);
                auto const found = enclosed(in, how, spread, seconds);
                CAPTURE(how.name, spread, in.name, in.state, in.input);
                auto const apart = [](std::size_t a, std::size_t b) {
                    return a < b ? b - a : a - b;
                };
                CHECK(apart(found.steps, base.steps) <= (exact ? 0u : 2u));
                CHECK(std::abs(found.until - base.until) <= 1e-9 * base.until);
                double const share = exact ? 1e-6 : 0.01, fall = exact ? 0 : base.rounding;
                CHECK(std::abs(found.x - base.x) <= share * base.x + fall);
                CHECK(std::abs(found.v - base.v) <= share * base.v + fall);
            }
        }
    }
}

} // namespace

TEST_CASE("units that are powers of two change no step of an enclosure") {
    compare({{0x1p-10, 1, 1, "2^10 s"},
             {0x1p20, 1, 1, "2^-20 s"},
             {1, 0x1p20, 1, "s"},
             {1, 0x1p-20, 1, "s"},
             {1, 1, 0x1p20, "s"},
             {0x1p-12, 0x1p20, 0x1p-10, "2^12 s"}},
            4);
}

TEST_CASE("a motion of milliseconds, or of days, is enclosed as one of seconds") {
    compare({{1e3, 1, 1, "ms"}, {1.0 / 86400, 1e6, 1, "d"}}, 2);
}

TEST_CASE("a motion is enclosed alike in all units", "[.long]") {
    std::vector<units> all(units_of_time.begin(), units_of_time.end());
    for (double const size : scalings) {
        all.push_back({1, size, 1, "s"});
        all.push_back({1, 1, size, "s"});
        all.push_back({1e3, size, 1 / size, "ms"});
        all.push_back({1.0 / 3600, size, size, "h"});
    }
    compare(all, 20);
}
