// SPDX-License-Identifier: MIT
// States that act on one another through many others: what the first one does arrives at the last
// one only after as many rounds of each fixed point. Both problems have closed forms.
#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"

#include <sivid/enclosure/enclose.hpp>
#include <sivid/enclosure/methods.hpp>

#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::extended;

namespace {

constexpr std::size_t length = 32;

/// Vessels, each filled by the one before it, the first one from a full tank:
/// \f$ x_i(t) = e^{-pt} \sum_{j > i} (pt)^j/j! \f$.
std::shared_ptr<flow const> cascade() {
    return support::flow_of(support::model_of(
        {length, 1, 0, 10}, [](auto const&, auto const& x, auto const& p, auto const&) {
            auto rate = x;
            for (std::size_t i = 0; i < length; ++i) {
                rate[i] = i == 0 ? p[0] * (1 - x[0]) : p[0] * (x[i - 1] - x[i]);
            }
            return rate;
        }));
}
extended filled(std::size_t i, extended p, extended t) {
    extended const z = p * t;
    extended term = std::exp(-z), sum = 0;
    for (std::size_t j = 1; j <= i + 40; ++j) {
        term *= z / static_cast<extended>(j);
        if (j > i) sum += term;
    }
    return sum;
}

/// Heat along a rod whose ends are cold, from one warm cell at its beginning.
std::shared_ptr<flow const> rod() {
    return support::flow_of(support::model_of(
        {length, 1, 0, 10}, [](auto const&, auto const& x, auto const& p, auto const&) {
            auto rate = x;
            for (std::size_t i = 0; i < length; ++i) {
                auto sum = -2 * x[i];
                if (i > 0) sum = sum + x[i - 1];
                if (i + 1 < length) sum = sum + x[i + 1];
                rate[i] = p[0] * sum;
            }
            return rate;
        }));
}
extended warm(std::size_t i, extended p, extended t) {
    extended sum = 0;
    extended const N = length + 1;
    for (std::size_t m = 1; m <= length; ++m) {
        extended const a = static_cast<extended>(m) * std::numbers::pi_v<extended> / N;
        extended const s = std::sin(a / 2);
        sum +=
            std::sin(a) * std::sin(a * static_cast<extended>(i + 1)) * std::exp(-4 * p * t * s * s);
    }
    return 2 / N * sum;
}

using maybe_method = std::optional<tableau>;

void check(std::shared_ptr<flow const> const& f, box const& start,
           std::vector<maybe_method> const& methods,
           std::function<extended(std::size_t, extended, extended)> const& exact) {
    draws d(11);
    for (auto const set : {carried_set::doubleton, carried_set::taylor_model}) {
        for (auto const& method : methods) {
            if (method && set == carried_set::taylor_model) continue; // refused
            CAPTURE(static_cast<int>(set), method ? method->name : "taylor");
            enclosure_options options{.tolerance = 1e-6, .relative_tolerance = 1e-3};
            options.method = method;
            auto const motion = enclose(f, start, {between(0.95, 1.05)}, 0, 1, set, options);
            INFO((motion.failure() ? motion.failure()->message("x") : ""));
            CAPTURE(motion.end_time());
            REQUIRE(motion.complete());
            for (auto const& span : motion.spans()) {
                double const p = d.uniform(0.95, 1.05), t = d.uniform(span.from, span.to);
                for (std::size_t i = 0; i < length; ++i) {
                    CAPTURE(i, p, t);
                    REQUIRE(support::encloses_reference(span.states[i], exact(i, p, t), 1e-15));
                }
            }
            double const p = d.uniform(0.95, 1.05);
            auto const end = motion.at(1);
            for (std::size_t i = 0; i < length; ++i) {
                CAPTURE(i, p);
                REQUIRE(support::encloses_reference(end[i], exact(i, p, 1), 1e-15));
            }
        }
    }
}

} // namespace

TEST_CASE("a cascade of many states is carried by every set and method") {
    check(cascade(), box(length), {std::nullopt, rk4(), gauss4()}, filled);
}

TEST_CASE("states that act both ways along a rod are carried by every set") {
    box start(length);
    start[0] = interval(1);
    check(rod(), start, {std::nullopt, rk4()}, warm);
}
