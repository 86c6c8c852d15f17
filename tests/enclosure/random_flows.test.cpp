// SPDX-License-Identifier: MIT
// Random right-hand sides, boxes, orders and tolerances: every proved step of a Taylor-model flow
// against a reference, from boxes of starts and from generators alone.
#include "support/catch.hpp"
#include "support/formulas.hpp"
#include "support/models.hpp"
#include "support/reference.hpp"
#include "support/taylor_models.hpp"

#include <sivid/enclosure/taylor/parametric_flow.hpp>

#include <cmath>
#include <cstddef>
#include <exception>
#include <memory>
#include <stdexcept>
#include <vector>

using namespace sivid;
using support::draws;
using support::extended;
using support::extended_state;
using support::formula;

namespace {

/// x' = u c + (1 - u) f(t, x, p), u = 1 before time 1 and 0 after; c in [-w, w] has no variable, so
/// that at time 1 it stands in generators. With w = 0 there is none of this, and f acts from time 0
/// on.
struct random_flow {
    formula f[2];
    double w = 0;
    box x0 = box(2), p = box(2);
    enclosure_options options;
    std::shared_ptr<flow const> equations;

    random_flow(draws& d, bool smooth, bool generators) {
        for (auto& one : f) one = support::random_formula(d, 1 + d.below(6), smooth);
        double const width = std::pow(10, -d.uniform(0, 3)) * (generators && d.coin() ? 1e-4 : 1);
        w = generators ? std::pow(10, -d.uniform(0, 2)) : 0;
        for (std::size_t i = 0; i < 2; ++i) {
            x0[i] = support::around(d.uniform(-2, 2), width / 2);
            p[i] = support::around(d.uniform(-2, 2), width / 2);
        }
        options.order = 1 + d.below(8);
        options.tolerance = std::pow(10, -d.uniform(0, 6));
        options.relative_tolerance = d.coin() ? 0 : 1e-2;
        options.minimum_step = 1e-3;
        options.widest = options.remainder_share = 1e3;
        options.maximum_steps = 80;
    }
    template <class X, class T>
    X rate(T const& t, X const& x, X const& parameters) const {
        using value = typename X::value_type;
        auto const leaf = [&](operation op, std::size_t i) -> value {
            if (op == operation::time) return value(t);
            return op == operation::state ? x[i] : parameters[i];
        };
        return X{support::value<value>(f[0], leaf), support::value<value>(f[1], leaf)};
    }
    /// @returns false where the formulas cannot be recorded
    bool record() {
        if (f[0].uses(operation::sign) || f[1].uses(operation::sign)) return false;
        try {
            auto const model = support::model_of(
                {2, 4, 1, 1e3}, [this](auto const& t, auto const& x, auto const& c, auto const& u) {
                    auto r = rate(t, x, c);
                    if (w == 0) return r;
                    for (std::size_t i = 0; i < 2; ++i) r[i] = u[0] * c[2 + i] + (1 - u[0]) * r[i];
                    return r;
                });
            parameter_choice const choice{
                {"p0", "p1"}, {{"p2", support::between(-w, w)}, {"p3", support::between(-w, w)}}};
            equations = std::make_shared<flow const>(
                model, choice,
                std::vector<sivid::signal>{sampled_signal({0, 1}, {1, 0}, interpolation::hold)});
        } catch (std::domain_error const&) {
            return false;
        }
        return true;
    }
};

struct member {
    std::vector<double> q;
    extended_state x, p;
};

/// @returns the number of comparisons
template <std::size_t D>
std::size_t check_flow(std::uint64_t seed, bool smooth, bool generators) {
    draws d(seed);
    random_flow r(d, smooth, generators);
    if (!r.record()) return 0;
    parametric_flow<taylor_model<double>> run(*r.equations, r.options, 4, D);
    run.begin(0, r.x0, r.p);
    std::vector<member> members(3);
    for (auto& m : members) {
        m.q = support::short_point(d, 4);
        for (auto const& s : run.unknowns().initial) {
            m.x.push_back(s.centre + static_cast<extended>(s.radius) * m.q[s.variable] +
                          r.w * (d.coin() ? 1 : d.uniform(-1, 1)));
        }
        for (auto const& s : run.unknowns().parameters) {
            m.p.push_back(s.centre + static_cast<extended>(s.radius) * m.q[s.variable]);
        }
    }
    auto const rate = [&r](extended t, extended_state const& x, extended_state const& p,
                           extended_state const&) { return r.rate(t, x, p); };
    double const start = generators ? 1 : 0;
    while (run.time() < start) {
        if (!run.step(start)) return 0;
    }
    // The reference crosses kinks with steps of its own.
    double const error = smooth ? 1e-13 : 1e-8;
    std::size_t compared = 0;
    while (run.time() < start + 1) {
        double const from = run.time();
        if (!run.step(start + 1)) break;
        auto const swept = run.swept();
        for (auto& m : members) {
            double const within = from + d.uniform(0, 1) * (run.time() - from);
            std::vector<extended_state> exact;
            try {
                exact = support::reference_states(rate, m.x, m.p, from, {within, run.time()}, {},
                                                  smooth ? 1e-16L : 1e-13L);
            } catch (std::exception const&) { // the reference got stuck
                return compared;
            }
            for (std::size_t i = 0; i < 2; ++i) {
                extended reach = 0;
                for (auto const& g : run.set().columns) {
                    reach += std::fabs(support::value<extended>(g[i], m.q));
                }
                extended const off =
                    std::fabs(exact[1][i] - support::value<extended>(run.set().centre[i], m.q));
                CAPTURE(seed, D, smooth, generators, from, run.time(), i);
                REQUIRE(off <= reach + error * (1 + std::fabs(exact[1][i])));
                REQUIRE(support::encloses_reference(swept[i], exact[0][i], error));
                ++compared;
            }
            m.x = exact[1];
        }
    }
    return compared;
}

std::size_t check_seeds(std::uint64_t first, std::uint64_t last) {
    std::size_t compared = 0;
    for (auto seed = first; seed < last; ++seed) {
        for (bool const smooth : {true, false}) {
            for (bool const generators : {true, false}) {
                compared += seed % 2 == 0 ? check_flow<1>(seed, smooth, generators)
                                          : check_flow<2>(seed, smooth, generators);
            }
        }
    }
    return compared;
}

} // namespace

TEST_CASE("random flows are contained, step by step") { REQUIRE(check_seeds(1, 151) > 3000); }

TEST_CASE("random flows are contained, many seeds", "[.long]") {
    REQUIRE(check_seeds(1000, 6000) > 100000);
}
