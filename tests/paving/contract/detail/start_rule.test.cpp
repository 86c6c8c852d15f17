// SPDX-License-Identifier: MIT
#include <sivid/paving/contract/detail/start_rule.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

/// How many functions exceed their margins at some corner of the box.
std::size_t failing(misfit_forms const& f, start_rule const& rule) {
    auto const n = f.functions();
    std::size_t count = 0;
    for (std::size_t y = 0; y < n; ++y) {
        double worst = 0;
        for (std::size_t corner = 0; corner < (std::size_t{1} << f.parameters); ++corner) {
            double value = f.offset[y];
            for (std::size_t i = 0; i < f.starts; ++i) {
                value += f.by_start[i * n + y] * rule.middle[i];
            }
            for (std::size_t j = 0; j < f.parameters; ++j) {
                double const d = ((corner >> j) & 1) != 0 ? 1 : -1;
                value += f.by_parameter[j * n + y] * d;
                for (std::size_t i = 0; i < f.starts; ++i) {
                    value += f.by_start[i * n + y] * rule.slope[i * f.parameters + j] * d;
                }
            }
            worst = std::max(worst, std::abs(value));
        }
        count += worst > f.margin[y] + 1e-9 ? 1 : 0;
    }
    return count;
}

/// The largest |s_i| of a rule.
double furthest(misfit_forms const& f, start_rule const& rule) {
    double most = 0;
    for (std::size_t i = 0; i < f.starts; ++i) {
        double reach = std::abs(rule.middle[i]);
        for (std::size_t j = 0; j < f.parameters; ++j) {
            reach += std::abs(rule.slope[i * f.parameters + j]);
        }
        most = std::max(most, reach);
    }
    return most;
}

misfit_forms one_start(std::vector<double> by_parameter, double by_start, double margin) {
    misfit_forms f;
    f.parameters = by_parameter.size();
    f.starts = 1;
    f.offset = {0};
    f.by_parameter = std::move(by_parameter);
    f.by_start = {by_start};
    f.margin = {margin};
    return f;
}

} // namespace

TEST_CASE("a start follows the parameter where one start for all does not do") {
    auto const f = one_start({0.5}, 1, 0.1); // |d/2 + s| <= 0.1
    auto const rule = start_rule_search()(f, 0);
    REQUIRE(rule);
    CHECK(failing(f, *rule) == 0);
    CHECK(rule->slope[0] < -0.39);
    CHECK(furthest(f, *rule) < 1);
}

TEST_CASE("no rule where starts would have to leave their boxes, or do not act") {
    CHECK_FALSE(start_rule_search()(one_start({1.5}, 1, 0.1), 0));
    CHECK_FALSE(start_rule_search()(one_start({0.5}, 0, 0.1), 0));
    CHECK_FALSE(start_rule_search()(one_start({0.7, 0.7}, 1, 0.1), 0));
    CHECK_FALSE(start_rule_search()(one_start({0.1}, 1, -0.1), 0)); // a rest wider than the bound
}

TEST_CASE("measurements that stand in the way are left out while there are spare ones") {
    // s = 0 by many, s = 0.9 by one.
    misfit_forms f;
    f.parameters = f.starts = 1;
    f.offset = {0, 0.01, -0.01, -0.9, 0.02};
    f.by_parameter = {0.02, -0.01, 0, 0.01, 0.01};
    f.by_start = {1, 1, 1, 1, 1};
    f.margin = {0.1, 0.1, 0.1, 0.1, 0.1};
    CHECK_FALSE(start_rule_search()(f, 0));
    auto const rule = start_rule_search()(f, 1);
    REQUIRE(rule);
    CHECK(failing(f, *rule) == 1);
    f.margin[0] = -1e9; // nothing is known of it: it takes the spare one
    CHECK_FALSE(start_rule_search()(f, 1));
    CHECK(start_rule_search()(f, 2));
}

TEST_CASE("rules that exist are found, and do what they should") {
    draws d(11);
    std::size_t found = 0, wanted = 0;
    for (int trial = 0; trial < 300; ++trial) {
        misfit_forms f;
        f.parameters = d.below(5);
        f.starts = 1 + d.below(4);
        std::size_t const n = 3 + d.below(30);
        auto const spare = d.below(3);
        // Forms for which a planted rule leaves a little room.
        start_rule planted;
        double const share = d.uniform(0.2, 0.9) / static_cast<double>(f.parameters + 1);
        for (std::size_t i = 0; i < f.starts; ++i) {
            planted.middle.push_back(d.uniform(-share, share));
            for (std::size_t j = 0; j < f.parameters; ++j) {
                planted.slope.push_back(d.uniform(-share, share));
            }
        }
        f.offset.assign(n, 0);
        f.by_start.resize(f.starts * n);
        for (auto& b : f.by_start) b = d.uniform(-2, 2);
        f.by_parameter.resize(f.parameters * n);
        for (std::size_t y = 0; y < n; ++y) {
            double left = 0;
            double at = 0;
            for (std::size_t i = 0; i < f.starts; ++i)
                at += f.by_start[i * n + y] * planted.middle[i];
            f.offset[y] = d.uniform(-0.5, 0.5) - at;
            left += std::abs(f.offset[y] + at);
            for (std::size_t j = 0; j < f.parameters; ++j) {
                double change = 0;
                for (std::size_t i = 0; i < f.starts; ++i) {
                    change += f.by_start[i * n + y] * planted.slope[i * f.parameters + j];
                }
                double const more = d.uniform(-0.1, 0.1);
                f.by_parameter[j * n + y] = more - change;
                left += std::abs(more);
            }
            f.margin.push_back(left * d.uniform(1.01, 1.5));
        }
        bool const possible = d.below(4) > 0;
        if (!possible) f.margin[d.below(n)] = d.uniform(-1, 0);
        auto const rule = start_rule_search()(f, possible ? spare : 0);
        if (possible) {
            ++wanted;
            found += rule ? 1 : 0;
        } else {
            CHECK_FALSE(rule);
        }
        if (!rule) continue;
        CHECK(failing(f, *rule) <= spare);
        CHECK(furthest(f, *rule) < 1);
    }
    INFO(found << " of " << wanted);
    CHECK(found == wanted);
}
