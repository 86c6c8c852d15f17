// SPDX-License-Identifier: MIT
// Inputs within error bounds: every engine contains the states that true inputs cause.
#include <sivid/enclosure/uncertain_input.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/parametric_sets.hpp"
#include "support/systems.hpp"
#include "support/taylor_models.hpp"
#include "support/uncertain_inputs.hpp"

#include <sivid/enclosure/methods.hpp>
#include <sivid/enclosure/taylor/parametric_flow.hpp>
#include <sivid/enclosure/tube.hpp>

#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

using namespace sivid;
using support::admissible_inputs;
using support::at;
using support::between;
using support::draws;
using support::dynamic_system;
using support::extended;
using support::extended_state;
using support::with_errors;

namespace {

sampled_signal const held({0, 0.35, 0.8, 1.1, 1.7}, {1, -0.5, 0.7, 0, 0.4}, interpolation::hold);
sampled_signal const line({0, 0.6, 1.3, 2.2}, {0.3, 1, -0.4, 0.5}, interpolation::linear);

void for_each_uncertain_system(support::system_visit const& visit) {
    auto const decay = [](auto const&, auto const& x, auto const& p, auto const& u) {
        return std::vector{u[0] - p[0] * x[0]};
    };
    visit({"decay, held",
           {1, 1, 1},
           decay,
           box{between(0.4, 0.6)},
           box{between(0.9, 1.1)},
           2,
           {with_errors(held, {0.1, 0.05, 0.2, 0, 0.1})}});
    visit({"decay, linear",
           {1, 1, 1},
           decay,
           box{between(0.4, 0.6)},
           box{between(0.9, 1.1)},
           2,
           {with_errors(line, {0.1, 0, 0.3, 0.1})}});
    visit({"oscillator",
           {2, 1, 1},
           [](auto const&, auto const& x, auto const& p, auto const& u) {
               return std::vector{x[1], u[0] - p[0] * x[0] - 0.2 * x[1]};
           },
           box{between(0.9, 1.1), interval(0.0)},
           box{between(8.8, 9.2)},
           2,
           {with_errors(line, {0.1, 0.1, 0.1, 0.1})}});
    visit({"pendulum driven at its pivot",
           {2, 1, 1},
           [](auto const&, auto const& x, auto const& p, auto const& u) {
               using namespace support::real;
               return std::vector{x[1], u[0] * cos(x[0]) - p[0] * sin(x[0]) - 0.25 * x[1]};
           },
           box{between(0.95, 1.05), between(-0.05, 0.05)},
           box{between(1.9, 2.1)},
           2,
           {with_errors(held, {0.05, 0.05, 0.05, 0.05, 0.05})}});
    visit({"two inputs",
           {1, 1, 2},
           [](auto const&, auto const& x, auto const& p, auto const& u) {
               using namespace support::real;
               return std::vector{p[0] * sin(u[0] * x[0]) + u[1]};
           },
           box{between(0.4, 0.5)},
           box{between(0.9, 1.1)},
           2,
           {with_errors(line, {0.05, 0.1, 0.02, 0.05}),
            with_errors(held, {0.02, 0.03, 0.02, 0.01, 0.02})}});
    visit({"kinks in state and input",
           {2, 1, 1},
           [](auto const&, auto const& x, auto const& p, auto const& u) {
               using namespace support::real;
               auto const drive = max(min(u[0], x[0] - x[0] + 0.6), x[0] - x[0] - 0.4);
               return std::vector{x[1], drive - x[0] - p[0] * abs(x[1]) * x[1]};
           },
           box{between(0.2, 0.21), between(0.19, 0.21)},
           box{between(0.49, 0.51)},
           1.5,
           {with_errors(line, {0.05, 0.05, 0.05, 0.05})}});
}

/// One trajectory that the engines have to contain, at any time.
struct planted {
    std::vector<double> q; ///< in the normalised unknowns
    std::function<std::vector<extended_state>(std::vector<double> const&)> states;
};

std::vector<planted> plant(dynamic_system const& s, std::uint64_t seed) {
    draws d(seed);
    normalised_unknowns const unknowns(s.initial, s.parameters);
    std::vector<planted> result;
    for (int k = 0; k < 8; ++k) {
        auto const q = support::short_point(d, unknowns.variables);
        auto const x0 = at(unknowns.initial, q);
        auto const p = at(unknowns.parameters, q);
        auto const n = s.initial.size();
        auto const chosen = k < 4 ? support::worst_inputs(s.rate, x0, p, s.horizon, s.inputs,
                                                          static_cast<std::size_t>(k) % n, k < 2)
                                  : support::draw_inputs(d, s.inputs.size(), s.horizon);
        result.push_back({q, [&s, x0, p, chosen](std::vector<double> const& times) {
                              return support::states_under(s.rate, x0, p, times, s.inputs, chosen,
                                                           1e-15L);
                          }});
    }
    return result;
}

/// Rounding of the reference.
constexpr double room = 1e-12;

void require_within(box const& all, extended_state const& x) {
    for (std::size_t i = 0; i < x.size(); ++i) {
        CAPTURE(i, static_cast<double>(x[i]), lower(all[i]), upper(all[i]));
        REQUIRE(support::encloses_reference(all[i], x[i], room));
    }
}

void check_tube(dynamic_system const& s, enclosure_options const& options,
                std::vector<planted> const& all) {
    auto const f = s.flow();
    auto const t = integrate<interval>(f, s.initial, s.parameters, 0, s.horizon, options);
    REQUIRE(t.complete());
    std::vector<double> times;
    for (auto const& step : t.steps()) {
        times.push_back(step.from + 0.3 * (step.to - step.from));
        times.push_back(step.to);
    }
    for (auto const& one : all) {
        auto const x = one.states(times);
        for (std::size_t k = 0; k < t.steps().size(); ++k) {
            CAPTURE(times[2 * k]);
            require_within(t.steps()[k].swept, x[2 * k]);
            require_within(t.at(times[2 * k]), x[2 * k]); // in the middle of a step
            require_within(t.steps()[k].swept, x[2 * k + 1]);
            require_within(t.at(times[2 * k + 1]), x[2 * k + 1]);
        }
    }
}

/// Polynomial sets, which know where in the boxes a trajectory began.
template <class Run>
void check_sets(Run& run, dynamic_system const& s, std::vector<planted> const& all) {
    std::vector<double> times;
    std::vector<box> swept;
    std::vector<parametric_set<>> sets;
    while (run.time() < s.horizon) {
        double const from = run.time();
        REQUIRE(run.step(s.horizon));
        times.push_back(from + 0.3 * (run.time() - from));
        times.push_back(run.time());
        swept.push_back(run.swept());
        sets.push_back(lane_of(run.set(), 0));
    }
    for (auto const& one : all) {
        auto const x = one.states(times);
        for (std::size_t k = 0; k < sets.size(); ++k) {
            CAPTURE(times[2 * k + 1]);
            require_within(swept[k], x[2 * k]);
            require_within(swept[k], x[2 * k + 1]);
            REQUIRE(support::encloses_at(sets[k], one.q, x[2 * k + 1], room));
        }
    }
}

enclosure_options patient() {
    enclosure_options o;
    o.order = 10;
    o.tolerance = 1e-9;
    o.minimum_step = 1e-4;
    return o;
}

} // namespace

TEST_CASE("every engine contains what inputs within their bounds cause") {
    for_each_uncertain_system([](auto const& s) {
        CAPTURE(s.name);
        auto const all = plant(s, 5);
        bool const rough = s.name.find("kink") == 0;
        SECTION(s.name + ": doubletons by Taylor series") { check_tube(s, patient(), all); }
        SECTION(s.name + ": Taylor models") {
            auto const f = s.flow();
            support::sized_flow<3, 3> own(*f, patient());
            own.begin(0, s.initial, s.parameters);
            check_sets(own, s, all);
        }
        if (!rough) {
            for (auto const& m : {rk4(), gauss4(), radau_iia5()}) {
                SECTION(s.name + ": " + m.name) {
                    auto o = patient();
                    o.tolerance = 1e-7;
                    o.method = m;
                    check_tube(s, o, all);
                }
            }
        }
    });
}

namespace {

/// Boxes for the states at `end` by every engine, with their names.
std::vector<std::pair<std::string, box>> ends(dynamic_system const& s) {
    std::vector<std::pair<std::string, box>> result;
    auto const f = s.flow();
    auto o = patient();
    auto const add = [&](std::string const& name) {
        auto const t = integrate<interval>(f, s.initial, s.parameters, 0, s.horizon, o);
        REQUIRE(t.complete());
        result.emplace_back(name, t.end().hull);
    };
    auto const run_to_end = [&](auto& run, std::string const& name) {
        run.begin(0, s.initial, s.parameters);
        while (run.time() < s.horizon) REQUIRE(run.step(s.horizon));
        result.emplace_back(name, run.set().hull(0));
    };
    add("Taylor series");
    support::sized_flow<3, 3> models(*f, o);
    run_to_end(models, "Taylor models");
    support::sized_flow<3, 3, lanes<8>> abreast(*f, o);
    for (std::size_t l = 0; l < 8; ++l) abreast.begin(l, 0, s.initial, s.parameters);
    for (std::size_t l = 0; l < 8; ++l) {
        while (abreast.time(l) < s.horizon) {
            REQUIRE_FALSE(abreast.failure(l));
            (void)abreast.advance(lanes<8>(s.horizon));
        }
    }
    for (std::size_t l = 0; l < 8; l += 5) {
        result.emplace_back("Taylor models, lane", abreast.set().hull(l));
    }
    for (auto const& m : {dormand_prince5(), gauss4(), radau_iia5()}) {
        o.tolerance = 1e-7;
        o.method = m;
        add(m.name);
    }
    return result;
}

sampled_signal constant_error(sampled_signal const& s, double e) {
    return with_errors(s, std::vector<double>(s.times().size(), e));
}

/// x' = -x + u: \f$ \int_0^T e^{s-T} e(s) ds \f$ for e along lines, in the order of the knots.
double reach_of_decay(sampled_signal const& u, double end) {
    double sum = 0;
    for (int k = 0; k < 200000; ++k) {
        double const t = end * (k + 0.5) / 200000;
        sum += std::exp(t - end) * u.error_bound(u.piece(t), t) * end / 200000;
    }
    return sum;
}

} // namespace

TEST_CASE("the reachable set of x' = u - x is met within a hundredth") {
    auto const decay = [](auto const&, auto const& x, auto const&, auto const& u) {
        return std::vector{u[0] - x[0]};
    };
    std::vector<sampled_signal> const inputs{
        constant_error(sampled_signal({0}, {1}, interpolation::hold), 0.1),
        with_errors(held, {0.1, 0.05, 0.2, 0, 0.1}), constant_error(line, 0.1),
        with_errors(line, {0.1, 0, 0.3, 0.1})};
    for (std::size_t k = 0; k < inputs.size(); ++k) {
        dynamic_system const s{"decay", {1, 0, 1}, decay,      box{interval(0.5)},
                               box{},   2,         {inputs[k]}};
        double const exact = 2 * reach_of_decay(inputs[k], 2);
        for (auto const& [name, x] : ends(s)) {
            CAPTURE(k, name, exact, width(x[0]));
            CHECK(width(x[0]) >= exact * (1 - 1e-6));
            CHECK(width(x[0]) <= exact * 1.01);
        }
    }
}

TEST_CASE("sets are not much wider than what bang-bang inputs reach") {
    for_each_uncertain_system([](auto s) {
        s.initial = point_box(mid(s.initial));
        s.parameters = point_box(mid(s.parameters));
        normalised_unknowns const unknowns(s.initial, s.parameters);
        auto const x0 = at(unknowns.initial, {});
        auto const p = at(unknowns.parameters, {});
        std::vector<double> reached;
        for (std::size_t i = 0; i < x0.size(); ++i) {
            extended ends[2];
            for (int up = 0; up < 2; ++up) {
                ends[up] = support::states_under(
                    s.rate, x0, p, {s.horizon}, s.inputs,
                    support::worst_inputs(s.rate, x0, p, s.horizon, s.inputs, i, up == 1, 24),
                    1e-12L)[0][i];
            }
            reached.push_back(static_cast<double>(ends[1] - ends[0]));
        }
        if (s.name.find("kink") != std::string::npos) return;
        for (auto const& [name, x] : ends(s)) {
            for (std::size_t i = 0; i < x.size(); ++i) {
                CAPTURE(s.name, name, i, reached[i], width(x[i]));
                bool const first_order = name.find("models") == std::string::npos;
                CHECK(width(x[i]) >= reached[i] * (1 - 1e-6));
                CHECK(width(x[i]) <= reached[i] * (first_order ? 10 : 1.55));
            }
        }
    });
}
