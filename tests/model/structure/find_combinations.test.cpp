// SPDX-License-Identifier: MIT
#include <sivid/model/structure/find_combinations.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/real_functions.hpp"

#include "../../../examples/hovercraft/model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

using namespace sivid;
using support::between;
using support::draws;

namespace {

template <class Rate>
dependence_structure structure(std::size_t constants, Rate const& rate,
                               std::vector<signal> const& inputs = {}) {
    auto const m = support::model_of({1, constants, inputs.size()}, rate);
    auto const bound = bind(m, {support::all_constants(constants), {}}, inputs);
    return find_combinations({&bound});
}
template <class Rate>
std::vector<combination> sums(std::size_t constants, Rate const& rate) {
    auto const m = support::model_of({1, constants, 0}, rate);
    auto const bound = bind(m, {support::all_constants(constants), {}}, {});
    return find_sums({&bound});
}
std::vector<std::string> formulas(std::vector<combination> const& list) {
    std::vector<std::string> names;
    for (auto const& c : list) names.push_back(c.formula);
    std::sort(names.begin(), names.end());
    return names;
}
using names = std::vector<std::string>;
using indices = std::vector<std::size_t>;

} // namespace

TEST_CASE("products, ratios and powers are found") {
    auto const product = structure(2, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{p[0] * p[1] * x[0]};
    });
    CHECK(product.entangled == indices{0, 1});
    CHECK(formulas(product.combinations) == names{"p0*p1"});
    auto const ratio = structure(3, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{sin(p[0] / p[1] * x[0]) + p[2]};
    });
    CHECK(ratio.entangled == indices{0, 1});
    CHECK(formulas(ratio.combinations) == names{"p0/p1"});
    auto const power = structure(2, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{exp(-(pown(p[0], 4) / sqr(p[1])) * x[0])};
    });
    CHECK(power.entangled == indices{0, 1});
    CHECK(formulas(power.combinations) == names{"p0^4/p1^2"});
    auto const three = structure(3, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{p[0] * p[1] * x[0] + p[1] * p[2]};
    });
    CHECK(three.entangled == indices{0, 1, 2});
    CHECK(formulas(three.combinations) == names{"p0*p1", "p1*p2"});
}

TEST_CASE("sums are multiplied out") {
    auto const over = structure(4, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{(p[0] * p[1] - p[2] * x[0]) / p[3]};
    });
    CHECK(over.entangled == indices{0, 1, 2, 3});
    CHECK(formulas(over.combinations) == names{"p0*p1/p3", "p2/p3"});
    auto const factor = structure(3, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{p[0] * (p[1] * x[0] + p[2] - p[1])};
    });
    CHECK(factor.entangled == indices{0, 1, 2});
    CHECK(formulas(factor.combinations) == names{"p0*p1", "p0*p2"});
    auto const square = structure(2, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{sqr(p[0] + p[1] * x[0])};
    });
    CHECK(square.entangled.empty());
    auto const divisor = structure(2, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{p[0] / (p[0] + p[1] * x[0])};
    });
    CHECK(divisor.entangled.empty()); // p0/p1 alone is known, but it is not looked for
}

TEST_CASE("parameters that stand alone somewhere are not entangled") {
    auto const sum = structure(2, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{p[0] * p[1] * x[0] + p[1]};
    });
    CHECK(sum.entangled.empty());
    CHECK(sum.combinations.empty());
    auto const inside = structure(2, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{p[0] * (p[1] + 1) * x[0]};
    });
    CHECK(inside.entangled.empty());
    auto const two = structure(2, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{p[0] * p[1] * x[0] + p[0] / p[1]};
    });
    CHECK(two.entangled.empty());
    auto const under = structure(2, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{sqrt(p[0]) * p[1] * x[0]};
    });
    CHECK(under.entangled.empty());
    auto const shifted = structure(2, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{p[0] * (x[0] - p[1])};
    });
    CHECK(shifted.entangled.empty());
    auto const clipped = structure(2, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{p[1] * saturate(x[0], -p[0], p[0])};
    });
    CHECK(clipped.entangled.empty());
}

TEST_CASE("factors that are known alone are divided out of products") {
    auto const known = structure(3, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{p[0] * p[1] * p[2] * x[0] + p[2]};
    });
    CHECK(known.entangled == indices{0, 1});
    CHECK(formulas(known.combinations) == names{"p0*p1"});
    auto const twice = structure(3, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{p[0] * p[1] * x[0] / p[2] + p[0] * p[1] * sqr(p[2]) + sin(p[2] * x[0])};
    });
    CHECK(twice.entangled == indices{0, 1});
    CHECK(formulas(twice.combinations) == names{"p0*p1"});
    auto const unused = structure(4, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{p[1] * p[2] * p[3] * x[0] + p[3]};
    });
    CHECK(unused.entangled == indices{0, 1, 2});
    CHECK(formulas(unused.combinations) == names{"p1*p2"});
}

TEST_CASE("a claim of entanglement holds: rescaled parameters give the same rates") {
    // Random monomials in sums under random functions; the claimed structure is tested by scaling.
    draws d(171);
    int claims = 0;
    for (int round = 0; round < 200; ++round) {
        std::vector<std::vector<int>> exponents(1 + d.below(3), std::vector<int>(3));
        for (auto& e : exponents) {
            for (auto& v : e) v = static_cast<int>(d.below(5)) - 2;
        }
        auto const rate = [&exponents](auto const&, auto const& x, auto const& p, auto const&) {
            auto sum = 0.5 * x[0];
            for (auto const& e : exponents) {
                using namespace support::real;
                auto term = pown(p[0], e[0]) * pown(p[1], e[1]) * pown(p[2], e[2]);
                sum = sum + sin(term * x[0]) - term;
            }
            return std::vector{sum};
        };
        auto const found = structure(3, rate);
        if (found.entangled.empty()) continue;
        ++claims;
        // A direction orthogonal to all products moves each entangled parameter.
        std::vector<bool> moved(3, false);
        for (int a = -8; a <= 8; ++a) {
            for (int b = -8; b <= 8; ++b) {
                for (int c = -8; c <= 8; ++c) {
                    bool orthogonal = true;
                    for (auto const& e : exponents) {
                        orthogonal = orthogonal && a * e[0] + b * e[1] + c * e[2] == 0;
                    }
                    if (!orthogonal || (a == 0 && b == 0 && c == 0)) continue;
                    int const move[] = {a, b, c};
                    for (std::size_t j = 0; j < 3; ++j) {
                        bool const listed =
                            std::count(found.entangled.begin(), found.entangled.end(), j) > 0;
                        if (move[j] != 0) CHECK(listed);
                        moved[j] = moved[j] || move[j] != 0;
                    }
                    for (auto const& combined : found.combinations) {
                        int dot = 0;
                        for (std::size_t j = 0; j < 3; ++j) dot += move[j] * combined.exponents[j];
                        CHECK(dot == 0);
                    }
                }
            }
        }
        for (auto const j : found.entangled) CHECK(moved[j]);
    }
    CHECK(claims > 30);
}

TEST_CASE("what vanishes in one experiment may show in another") {
    auto const m =
        support::model_of({1, 2, 1}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{-(p[0] * p[1]) * x[0] + p[0] * u[0]};
        });
    auto const constant = [](double v) {
        return analytic_signal::from([v](auto const&) { return expression(v); });
    };
    parameter_choice const choice{{"p0", "p1"}, {}};
    auto const quiet = bind(m, choice, {constant(0)});
    auto const driven = bind(m, choice, {constant(1)});
    CHECK(find_combinations({&quiet}).entangled == indices{0, 1});
    CHECK(find_combinations({&quiet, &driven}).entangled.empty());
    CHECK(find_combinations({&driven, &quiet}).entangled.empty());
}

TEST_CASE("the hovercraft knows L and S_g through their product only") {
    sampled_signal const rotor({0, 3}, {80, 85}, interpolation::linear);
    sampled_signal const rudder({0, 3}, {0.1, 0.4}, interpolation::linear);
    auto const bound = bind(record_model(hovercraft{}), {{"Sv", "Sg", "L"}, {}}, {rotor, rudder});
    auto const found = find_combinations({&bound});
    CHECK(found.entangled == indices{1, 2});
    REQUIRE(found.combinations.size() == 1);
    CHECK(found.combinations[0].exponents == std::vector<int>{0, 1, 1});
    CHECK((found.combinations[0].formula == "L*Sg" || found.combinations[0].formula == "Sg*L"));
    CHECK(found.combinations[0].unit == "m^3");
    hovercraft physical;
    physical.lift = hovercraft::lift_area::rudder; // S_g alone in the side force
    auto const other = bind(record_model(physical), {{"Sv", "Sg", "L"}, {}}, {rotor, rudder});
    CHECK(find_combinations({&other}).entangled.empty());
}

TEST_CASE("the inertia of the hovercraft divides what turns it") {
    sampled_signal const rotor({0, 3}, {80, 85}, interpolation::linear);
    sampled_signal const rudder({0, 3}, {0.1, 0.4}, interpolation::linear);
    auto const bound =
        bind(record_model(hovercraft{}),
             {{"Sv", "Sg", "m", "Iz", "D22", "D33", "Ff", "Su", "L"}, {}}, {rotor, rudder});
    auto const found = find_combinations({&bound});
    CHECK(found.entangled == indices{1, 3, 5, 8});
    REQUIRE(found.combinations.size() == 2);
    CHECK(found.combinations[0].formula == "D33/Iz");
    CHECK(found.combinations[1].formula == "Sg*L/Iz");
}

TEST_CASE("sums through which alone the equations see their terms") {
    auto const mass = sums(3, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{(p[2] - p[2] * x[0] + sin(p[0] + p[1])) / (p[0] + p[1])};
    });
    REQUIRE(formulas(mass) == names{"p0 + p1"});
    CHECK(mass[0].signs == std::vector<int>{1, 1, 0});
    CHECK(mass[0].exponents == std::vector<int>{0, 0, 0});
    auto const range = mass[0].over(box{between(1, 2), between(0, 0.5), between(7, 9)});
    CHECK(range.lower() == 1);
    CHECK(range.upper() == 2.5);
    auto const three = sums(3, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{exp(-((p[0] - p[1]) + x[0]) + p[2]) * x[0]};
    });
    REQUIRE(three.size() == 1);
    CHECK((three[0].signs == std::vector<int>{1, -1, -1} ||
           three[0].signs == std::vector<int>{-1, 1, 1}));
    // A term that stands anywhere else is no term.
    CHECK(sums(2, [](auto const&, auto const& x, auto const& p, auto const&) {
              return std::vector{(p[0] + p[1]) * x[0] - p[1] * sqr(x[0])};
          }).empty());
    CHECK(sums(2, [](auto const&, auto const& x, auto const& p, auto const&) {
              return std::vector{(p[0] + p[1]) * x[0] + (p[0] - p[1])};
          }).empty());
    CHECK(sums(2, [](auto const&, auto const& x, auto const& p, auto const&) {
              return std::vector{(2.0 * p[0] + p[1]) * x[0]};
          }).empty());
    CHECK(find_sums({}).empty());
    // One that is a sum in one experiment only is none.
    auto const m =
        support::model_of({1, 2, 1}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{(p[0] + u[0] * p[1]) * x[0]};
        });
    auto const held_at = [&m](double v) {
        return bind(m, {support::all_constants(2), {}},
                    {analytic_signal::from([v](auto const&) { return expression(v); })});
    };
    auto const on = held_at(1), off = held_at(0);
    CHECK(find_sums({&on}).size() == 1);
    CHECK(find_sums({&on, &off}).empty());
}

TEST_CASE("no output changes with the terms of a sum as long as it stays") {
    draws d(641);
    std::size_t found = 0;
    for (int round = 0; round < 600; ++round) {
        // A random expression of three constants and the state.
        std::vector<int> plan;
        for (int k = 0; k < 12; ++k) plan.push_back(static_cast<int>(d.below(1000)));
        auto const rate = [&plan](auto const&, auto const& x, auto const& p, auto const&) {
            auto parts = std::vector{p[0] + 0.0, p[1] + 0.0, p[2] + 0.0, x[0] + 0.0};
            for (std::size_t k = 0; k + 1 < plan.size(); k += 2) {
                auto const a = static_cast<std::size_t>(plan[k]) % parts.size();
                auto const b = static_cast<std::size_t>(plan[k + 1]) % parts.size();
                int const kind = plan[k] / 4 % 5;
                auto const value = kind < 2    ? parts[a] + parts[b]
                                   : kind == 2 ? parts[a] - parts[b]
                                   : kind == 3 ? parts[a] * parts[b]
                                               : sin(parts[a]);
                parts[a] = value; // what it was is gone: terms are used once, often
            }
            return std::vector{parts[0] + parts[3]};
        };
        auto const m = support::model_of({1, 3, 0}, rate);
        auto const bound = bind(m, {support::all_constants(3), {}}, {});
        for (auto const& c : find_sums({&bound})) {
            ++found;
            std::vector<double> p{d.uniform(-1, 1), d.uniform(-1, 1), d.uniform(-1, 1)}, q = p;
            std::size_t first = 3;
            for (std::size_t j = 0; j < 3; ++j) {
                if (c.signs[j] == 0) continue;
                if (first == 3) {
                    first = j;
                } else {
                    double const step = d.uniform(-1, 1);
                    q[j] += c.signs[j] * step;
                    q[first] -= c.signs[first] * step;
                }
            }
            std::vector<double> const x{d.uniform(-1, 1)}, none;
            double const before = rate(0.0, x, p, none)[0], after = rate(0.0, x, q, none)[0];
            CAPTURE(round, c.formula);
            CHECK(std::abs(before - after) <= 1e-12 * (1 + std::abs(before)));
        }
    }
    CHECK(found > 50);
}
