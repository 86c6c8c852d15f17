// SPDX-License-Identifier: MIT
// Containment: draws of (model, parameters, initial state, time) from thirteen models against a
// reference of order 8 (5 across kinks) in extended precision, over every stepper, set and number
// type. A draw is one state vector compared at one time, at a step's end or inside a step.
#include "support/catch.hpp"
#include "support/parametric_sets.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"
#include "support/systems.hpp"
#include "support/variational_reference.hpp"

#include <sivid/enclosure/methods.hpp>
#include <sivid/enclosure/runge_kutta/tableau.hpp>
#include <sivid/enclosure/sensitivity/sensitive_flow.hpp>
#include <sivid/enclosure/taylor/parametric_flow.hpp>
#include <sivid/enclosure/tube.hpp>
#if defined(SIVID_HAS_MPFI)
#include <sivid/number/mp_interval.hpp>
#endif

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

using namespace sivid;
using support::draws;
using support::extended;
using support::extended_state;
using support::part_of;

namespace {

struct any_system : support::dynamic_system {
    std::shared_ptr<sivid::flow const> equations;
    bool rough = false;
};

std::vector<any_system> all_systems() {
    std::vector<any_system> all;
    support::for_each_smooth_system([&](auto const& s) { all.push_back({s, s.flow(), false}); });
    support::for_each_rough_system([&](auto const& s) { all.push_back({s, s.flow(), true}); });
    return all;
}

/// Relative to 1 + |x|: the reference's error at the looser tolerances of a `plan`, which 1e5 draws
/// can afford, and across kinks.
constexpr double smooth_error = 1e-13, rough_error = 1e-8;

struct tally {
    std::map<std::string, std::size_t> compared;
    [[nodiscard]] std::size_t all() const {
        std::size_t n = 0;
        for (auto const& [way, count] : compared) n += count;
        return n;
    }
};

struct plan {
    enclosure_options options;
    double share = 1; ///< of the system's box
    bool rough = false;

    [[nodiscard]] double error() const { return rough ? rough_error : smooth_error; }
    [[nodiscard]] extended tolerance() const { return rough ? 1e-12L : 1e-16L; }
};

plan random_plan(draws& d, bool rough) {
    plan p;
    p.rough = rough;
    p.options.order = 2 + d.below(17);
    if (d.coin()) p.options.variational_order = 1 + d.below(p.options.order);
    p.options.tolerance = std::pow(10, -d.uniform(3, 13));
    p.options.relative_tolerance = d.coin() ? 0 : 1e-3;
    p.options.minimum_step = 1e-4;
    p.options.maximum_steps = 60;
    p.share = d.below(4) == 0 ? 0 : std::pow(10, -d.uniform(0, 3));
    return p;
}

tableau random_method(draws& d) {
    auto const all = {
        explicit_midpoint(), heun(),          kutta3(),        rk4(),          dormand_prince5(),
        butcher6(),          gauss2(),        gauss4(),        gauss6(),       radau_iia3(),
        radau_iia5(),        lobatto_iiic2(), lobatto_iiic4(), lobatto_iiic6()};
    return *(all.begin() + static_cast<std::ptrdiff_t>(d.below(all.size())));
}

/// The reference from `from` to the times.
std::vector<extended_state> exact_states(any_system const& s, plan const& p,
                                         extended_state const& x, extended_state const& c,
                                         double from, std::vector<double> const& times) {
    if (!p.rough) {
        return support::reference_states(s.rate, x, c, from, times, s.inputs, p.tolerance());
    }
    return support::reference_states<support::dormand_prince>(s.rate, x, c, from, times, s.inputs,
                                                              p.tolerance());
}

template <class I>
bool encloses(I const& e, extended x, double error) {
    using traits = interval_traits<I>;
    extended const room = static_cast<extended>(error) * (1 + std::fabs(x));
    return static_cast<extended>(traits::lower(e)) <= x + room &&
           x - room <= static_cast<extended>(traits::upper(e));
}

/// Doubletons in the number type I.
template <class I>
void by_tube(any_system const& system, plan const& p, draws& d, tally& done,
             std::string const& way) {
    basic_box<I> x0(system.initial.size()), c(system.parameters.size());
    using traits = interval_traits<I>;
    for (std::size_t i = 0; i < x0.size(); ++i) {
        x0[i] = traits::bounds(system.initial[i].lower(), system.initial[i].upper());
    }
    for (std::size_t j = 0; j < c.size(); ++j) {
        c[j] = traits::bounds(system.parameters[j].lower(), system.parameters[j].upper());
    }
    auto const tube = integrate<I>(system.equations, x0, c, 0, system.horizon, p.options);
    if (tube.steps().empty()) return;
    for (int member = 0; member < 2; ++member) {
        auto const start = support::extend(d.in(system.initial));
        auto const q = support::extend(d.in(system.parameters));
        std::vector<double> times{tube.end_time(), tube.steps()[d.below(tube.steps().size())].to};
        for (int k = 0; k < 4; ++k) times.push_back(d.uniform(0, tube.end_time()));
        std::sort(times.begin(), times.end());
        auto const exact = exact_states(system, p, start, q, 0, times);
        for (std::size_t k = 0; k < times.size(); ++k) {
            auto const at = tube.at(times[k]);
            for (std::size_t i = 0; i < at.size(); ++i) {
                CAPTURE(system.name, way, times[k], i, static_cast<double>(exact[k][i]));
                REQUIRE(encloses(at[i], exact[k][i], p.error()));
            }
            ++done.compared[way];
        }
    }
}

/// Taylor-model sets of one lane: every step's end at the member's own q, and inside every step.
template <class Run>
void by_set(any_system const& system, plan const& p, draws& d, tally& done,
            std::string const& way) {
    auto const& f = system.equations;
    Run run(*f, p.options);
    run.begin(0, system.initial, system.parameters);
    struct member {
        std::vector<double> q;
        extended_state x, c;
    };
    std::vector<member> members(2);
    for (auto& m : members) {
        m.q = support::short_point(d, 4);
        m.x = support::at(run.unknowns().initial, m.q);
        m.c = support::at(run.unknowns().parameters, m.q);
    }
    while (run.time() < system.horizon) {
        double const from = run.time();
        if (!run.step(system.horizon)) break;
        double const within = d.uniform(from, run.time());
        auto const swept = run.swept();
        for (auto& m : members) {
            auto const exact = exact_states(system, p, m.x, m.c, from, {within, run.time()});
            m.x = exact[1];
            CAPTURE(system.name, way, from, within, run.time());
            REQUIRE(support::encloses_at(run.set(), m.q, exact[1], p.error()));
            for (std::size_t i = 0; i < swept.size(); ++i) {
                REQUIRE(encloses(swept[i], exact[0][i], p.error()));
            }
            done.compared[way] += 2;
        }
    }
}

/// Derivatives of Taylor-model flows by initial states and parameters, over the box.
void by_derivatives(any_system const& system, plan const& p, draws& d, tally& done) {
    std::vector<double> times{system.horizon};
    for (int k = 0; k < 3; ++k) times.push_back(d.uniform(0, system.horizon));
    std::sort(times.begin(), times.end());
    auto const found =
        sensitivities_at(*system.equations, p.options, system.initial, system.parameters, 0, times);
    if (found.empty()) return;
    times.resize(found.size());
    for (int member = 0; member < 2; ++member) {
        auto const exact = support::reference_sensitivities(
            system.rate, support::extend(d.in(system.initial)),
            support::extend(d.in(system.parameters)), 0, times, system.inputs, p.tolerance());
        for (std::size_t k = 0; k < times.size(); ++k) {
            for (std::size_t i = 0; i < exact[k].s.size(); ++i) { // every state is a channel
                for (std::size_t j = 0; j < exact[k].s[i].size(); ++j) {
                    CAPTURE(system.name, times[k], i, j);
                    REQUIRE(encloses(found[k].over_box(i, j), exact[k].s[i][j], p.error()));
                }
            }
            ++done.compared["derivatives of Taylor models"];
        }
    }
}

/// Taylor-model sets side by side, each lane on a part of its own.
template <std::size_t D, std::size_t W>
void by_lanes(any_system const& system, plan const& p, draws& d, tally& done) {
    auto const& f = system.equations;
    support::sized_flow<4, D, lanes<W>> run(*f, p.options);
    struct member {
        std::vector<double> q;
        extended_state x, c;
    };
    std::vector<member> members(W);
    std::vector<double> times(W, 0.0);
    for (std::size_t l = 0; l < W; ++l) {
        run.begin(l, 0, part_of(d, system.initial, d.uniform(0, 1)),
                  part_of(d, system.parameters, d.uniform(0, 1)));
        auto& m = members[l];
        m.q = support::short_point(d, 4);
        m.x = support::at(run.unknowns(l).initial, m.q);
        m.c = support::at(run.unknowns(l).parameters, m.q);
    }
    lanes<W> const limit(system.horizon);
    for (int round = 0; round < 400; ++round) {
        auto const moved = run.advance(limit);
        bool waiting = false;
        for (std::size_t l = 0; l < W; ++l) {
            waiting = waiting || (!run.failure(l) && run.time(l) < system.horizon);
            if (!lane_traits<lanes<W>>::test(moved, l)) continue;
            double const within = d.uniform(times[l], run.time(l));
            auto const exact = exact_states(system, p, members[l].x, members[l].c, times[l],
                                            {within, run.time(l)});
            auto const swept = run.swept(l);
            CAPTURE(system.name, l, times[l], within, run.time(l));
            REQUIRE(support::encloses_at(lane_of(run.set(), l), members[l].q, exact[1], p.error()));
            for (std::size_t i = 0; i < swept.size(); ++i) {
                REQUIRE(encloses(swept[i], exact[0][i], p.error()));
            }
            done.compared["Taylor models in lanes"] += 2;
            members[l].x = exact[1];
            times[l] = run.time(l);
        }
        if (!waiting) break;
    }
}

void all_ways(any_system system, draws& d, tally& done) {
    bool const rough = system.rough;
    auto p = random_plan(d, rough);
    auto const whole_initial = system.initial;
    auto const whole_parameters = system.parameters;
    auto const redraw = [&] {
        p = random_plan(d, rough);
        system.initial = part_of(d, whole_initial, p.share);
        system.parameters = part_of(d, whole_parameters, p.share);
    };
    redraw();
    by_tube<interval>(system, p, d, done, "doubletons");
    redraw();
    p.options.method = random_method(d);
    p.options.tolerance = std::max(p.options.tolerance, 1e-8);
    by_tube<interval>(system, p, d, done, "doubletons, Runge-Kutta");
#if defined(SIVID_HAS_MPFI)
    redraw();
    by_tube<proven_interval>(system, p, d, done, "doubletons, proven type");
    if (d.below(6) == 0) {
        redraw();
        by_tube<mp_interval>(system, p, d, done, "doubletons, 40 digits");
    }
#endif
    redraw();
    p.options.order = std::min<std::size_t>(p.options.order, 12);
    if (d.coin()) {
        by_set<support::sized_flow<4, 1>>(system, p, d, done, "Taylor models, degree 1");
    } else {
        by_set<support::sized_flow<4, 3>>(system, p, d, done, "Taylor models, degree 3");
    }
    redraw();
    p.options.order = std::min<std::size_t>(p.options.order, 10);
    by_lanes<2, 8>(system, p, d, done);
    if (!rough && d.below(3) == 0) { // their references cost most
        redraw();
        p.options.order = std::min<std::size_t>(p.options.order, 12);
        by_derivatives(system, p, d, done);
    }
}

tally draw(std::uint64_t seed, std::size_t enough) {
    draws d(seed);
    tally done;
    auto const systems = all_systems();
    // Derivatives cost most and come least often.
    while (done.all() < enough || done.compared["derivatives of Taylor models"] < 12) {
        for (auto const& s : systems) all_ways(s, d, done);
    }
    for (auto const& [way, count] : done.compared) {
        CAPTURE(way, count);
        CHECK(count >= 12);
        UNSCOPED_INFO(way << ": " << count);
    }
    return done;
}

} // namespace

TEST_CASE("every stepper, set and number type contains the truth") {
    auto const done = draw(401, 3000);
    CHECK(done.compared.size() >= 8);
}

TEST_CASE("every stepper, set and number type contains the truth, 1e5 draws", "[.long]") {
    auto const done = draw(402, 100'000);
    CHECK(done.all() >= 100'000);
}
