// SPDX-License-Identifier: MIT
// Steps that are long against the time constants: their image, their error and their derivative
// apart, and whole trajectories of stiff problems with closed forms.
#include <sivid/enclosure/stiff/detail/dissipative_step.hpp>
#include <sivid/enclosure/methods.hpp>

#include "support/catch.hpp"
#include "support/matrix_exponential.hpp"
#include "support/random.hpp"
#include "support/runge_kutta.hpp"
#include "support/sampling.hpp"
#include "support/systems.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::encloses;
using support::implicit_methods;
using support::mp;

namespace {

/// x follows cos t with the rate L, y follows x slowly. From x = 1 + c:
/// x = cos t + c e^{-Lt}.
auto const relaxation = [](auto const& t, auto const& x, auto const& p, auto const&) {
    using namespace support::real;
    return std::vector{-(p[0] * (x[0] - cos(t))) - sin(t), 0.5 * (x[0] - x[1])};
};
std::vector<mp> relaxed(mp const& t, mp const& rate, mp const& x, mp const& y) {
    mp const c = x - 1;
    // y' + y/2 = cos(t)/2 + c/2 e^{-Lt}
    auto const particular = [&](mp const& s) {
        return mp(cos(s) / 5 + 2 * sin(s) / 5 + c / (1 - 2 * rate) * exp(-rate * s));
    };
    return {cos(t) + c * exp(-rate * t), particular(t) + (y - particular(0)) * exp(-t / 2)};
}

std::shared_ptr<flow const> relaxation_flow() {
    return support::flow_of(support::model_of({2, 1}, relaxation));
}

double longest(tube<interval> const& run) {
    double h = 0;
    for (auto const& s : run.steps()) h = std::max(h, s.to - s.from);
    return h;
}

/// x' = A x with time constants from 1e-4 to 0.3 and couplings of size 1.
std::pair<Eigen::MatrixXd, std::shared_ptr<flow const>> stiff_linear_system(draws& d) {
    Eigen::MatrixXd a = d.matrix(3, 3, 1);
    for (Eigen::Index i = 0; i < 3; ++i) a(i, i) = -std::pow(10, d.uniform(0.5, 4));
    return {a, support::flow_of(support::model_of(
                   {3, 0}, [a](auto const&, auto const& x, auto const&, auto const&) {
                       auto const row = [&](Eigen::Index i) {
                           return a(i, 0) * x[0] + a(i, 1) * x[1] + a(i, 2) * x[2];
                       };
                       return std::vector{row(0), row(1), row(2)};
                   }))};
}

} // namespace

TEST_CASE("the closed form of the stiff problem solves it") {
    mp const e = 1e-15;
    auto const at = [](mp const& t) { return relaxed(t, mp(7), mp(1.5), mp(0.25)); };
    auto const x = at(mp(0.375));
    auto const up = at(mp(0.375) + e);
    auto const down = at(mp(0.375) - e);
    mp const dx = (up[0] - down[0]) / (2 * e);
    mp const dy = (up[1] - down[1]) / (2 * e);
    CHECK(abs(dx + 7 * (x[0] - cos(mp(0.375))) + sin(mp(0.375))) < 1e-25);
    CHECK(abs(dy - (x[0] - x[1]) / 2) < 1e-25);
}

TEST_CASE("image and derivative hold every member of the set, for steps short and long") {
    draws d(651);
    int maps = 0;
    support::for_each_system([&](auto const& system) {
        auto const f = system.flow();
        for (auto const& method : implicit_methods()) {
            dissipative_step<interval> stiff(*f, method);
            auto const centre = mid(system.parameters);
            stiff.set_parameters(system.parameters, centre);
            auto const m = mid(system.initial);
            double const most = std::min(system.horizon, f->next_knot(0));
            double const to = most * std::pow(10, -d.uniform(0, 2));
            auto const tube =
                stiff.enclose(0, to, system.initial, m, std::vector<double>(f->states(), 1e-3));
            if (!tube) continue;
            auto const map = stiff.map(0, to, m, *tube);
            if (!map) continue;
            ++maps;
            for (int member = 0; member < 3; ++member) {
                auto const x0 = member == 0 ? m : d.in(system.initial);
                auto const p = member == 0 ? centre : d.in(system.parameters);
                auto const x =
                    support::reference_states(system.rate, support::extend(x0), support::extend(p),
                                              0, {to}, system.inputs)[0];
                for (std::size_t i = 0; i < x.size(); ++i) {
                    auto sum = map->image[i];
                    for (std::size_t c = 0; c < x0.size() + p.size(); ++c) {
                        auto const n = x0.size();
                        auto const off =
                            c < n ? interval(x0[c]) - m[c] : interval(p[c - n]) - centre[c - n];
                        sum = sum + map->derivative(i, c) * off;
                    }
                    CAPTURE(system.name, method.name, to, member, i);
                    CHECK(support::encloses_reference(sum, x[i]));
                    CHECK(support::encloses_reference((*tube)[i], x[i]));
                }
            }
        }
    });
    CHECK(maps > 40);
}

TEST_CASE("the error of the image is the method's, and is needed") {
    auto const f = relaxation_flow();
    double const rate = 1e4;
    for (auto const& method : implicit_methods()) {
        dissipative_step<interval> stiff(*f, method);
        stiff.set_parameters(box{interval(rate)}, {rate});
        std::vector<double> errors;
        for (double const h : {0.2, 0.1, 0.05}) {
            auto const tube =
                stiff.enclose(0, h, box{interval(1.0), interval(0.5)}, {1, 0.5}, {1e-6, 1e-6});
            REQUIRE(tube);
            auto const map = stiff.map(0, h, {1, 0.5}, *tube);
            REQUIRE(map);
            auto const exact = relaxed(mp(h), mp(rate), mp(1), mp(0.5));
            for (std::size_t i = 0; i < 2; ++i) {
                CAPTURE(method.name, h, i);
                CHECK(encloses(map->image[i], exact[i]));
            }
            // Without it: the polynomial alone misses the solution.
            mp const off = abs(exact[1] - mp(mid(map->image[1])));
            if (h == 0.2) CHECK(off > 1e-14);
            CHECK(off <= map->error[1]);
            errors.push_back(map->error.maxCoeff());
        }
        // The defect has the order q of the stages; what it does to y in the time h is smaller.
        auto const q =
            static_cast<double>(method.name[0] == 'l' ? method.stages() - 1 : method.stages());
        CAPTURE(method.name, errors);
        CHECK(std::log2(errors[1] / errors[2]) > q - 0.3);
        CHECK(std::log2(errors[1] / errors[2]) < q + 2.3);
    }
}

TEST_CASE("the derivative of a linear problem is the matrix exponential, whatever the step") {
    draws d(652);
    for (int round = 0; round < 12; ++round) {
        auto const [a, f] = stiff_linear_system(d);
        dissipative_step<interval> stiff(*f, radau_iia5());
        stiff.set_parameters(box{}, {});
        double const h = d.uniform(0.1, 2);
        auto const x = box{between(-1, 1), between(-1, 1), between(-1, 1)};
        auto const tube = stiff.enclose(0, h, x, {0, 0, 0}, {1e-3, 1e-3, 1e-3});
        REQUIRE(tube);
        auto const map = stiff.map(0, h, {0, 0, 0}, *tube);
        REQUIRE(map);
        auto const exact = support::exact_exponential(a, mp(h));
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                CHECK(encloses(map->derivative(i, c), exact[i][c], 1e-30));
                CHECK(width(map->derivative(i, c)) < 1e-8);
            }
        }
    }
}

TEST_CASE("a stiff linear problem: implicit methods take long steps, the others cannot") {
    auto const f = relaxation_flow();
    double const rate = 1e4;
    draws d(653);
    for (auto const& method : {radau_iia5(), gauss6(), lobatto_iiic6(), gauss4()}) {
        enclosure_options o;
        o.method = method;
        o.tolerance = 2e-6;
        o.maximum_steps = 500;
        // From off the slow manifold: a transient of 1e-4 comes first.
        auto const run =
            integrate<interval>(f, box{interval(1.5), interval(0.0)}, box{interval(rate)}, 0, 5, o);
        CAPTURE(method.name, run.steps().size(), longest(run));
        REQUIRE(run.complete());
        CHECK(rate * longest(run) > 300);
        CHECK(run.steps().size() < 450);
        CHECK(width(run.end().hull) < 1e-4);
        for (int k = 0; k < 60; ++k) {
            double const t = d.coin() ? d.uniform(0, 5) : d.uniform(0, 2e-3);
            auto const exact = relaxed(mp(t), mp(rate), mp(1.5), mp(0));
            auto const x = run.at(t);
            CAPTURE(t);
            for (std::size_t i = 0; i < 2; ++i) CHECK(encloses(x[i], exact[i]));
        }
    }
    for (auto const& method : {std::optional<tableau>{}, std::optional<tableau>{rk4()}}) {
        enclosure_options o;
        o.method = method;
        o.tolerance = 1e-6;
        o.maximum_steps = 500;
        auto const run =
            integrate<interval>(f, box{interval(1.5), interval(0.0)}, box{interval(rate)}, 0, 5, o);
        CHECK_FALSE(run.complete());
        CHECK(rate * longest(run) < 1);
        CHECK(run.end_time() < 0.1);
    }
}

TEST_CASE("random stiff linear systems against the matrix exponential") {
    draws d(655);
    std::size_t long_steps = 0;
    for (int round = 0; round < 8; ++round) {
        auto const [a, f] = stiff_linear_system(d);
        box const initial{between(0.5, 1), between(-1, -0.9), interval(0.25)};
        for (auto const& method : {radau_iia5(), gauss6(), lobatto_iiic4()}) {
            enclosure_options o;
            o.method = method;
            o.tolerance = 1e-6;
            o.maximum_steps = 3000;
            auto const run = integrate<interval>(f, initial, box{}, 0, 2, o);
            CAPTURE(round, method.name, run.steps().size());
            REQUIRE(run.complete());
            for (auto const& s : run.steps()) long_steps += s.long_map != nullptr;
            for (int k = 0; k < 10; ++k) {
                double const t = d.coin() ? d.uniform(0, 2) : d.uniform(0, 0.01);
                auto const e = support::exact_exponential(a, mp(t));
                auto const x0 = d.in(initial);
                auto const x = run.at(t);
                for (std::size_t i = 0; i < 3; ++i) {
                    mp exact = 0;
                    for (std::size_t c = 0; c < 3; ++c) exact += e[i][c] * mp(x0[c]);
                    CHECK(encloses(x[i], exact, 1e-30));
                }
            }
        }
    }
    CHECK(long_steps > 100);
}

TEST_CASE("stiff problems over boxes, linear and not") {
    draws d(654);
    struct {
        std::string name;
        box initial, parameters;
        std::vector<sivid::sampled_signal> inputs;
        support::extended_state (*rate)(support::extended, support::extended_state const&,
                                        support::extended_state const&,
                                        support::extended_state const&);
    } system{"relaxation",
             box{between(1.4, 1.5), between(0, 0.1)},
             box{between(300, 300.001)},
             {},
             nullptr};
    system.rate = [](support::extended t, support::extended_state const& x,
                     support::extended_state const& p,
                     support::extended_state const& u) { return relaxation(t, x, p, u); };
    enclosure_options o;
    o.method = radau_iia5();
    o.tolerance = 1e-6;
    auto const run =
        integrate<interval>(relaxation_flow(), system.initial, system.parameters, 0, 3, o);
    REQUIRE(run.complete());
    CHECK(longest(run) > 0.1);
    support::check_tube(system, run, d, 4);

    // Van der Pol's oscillator on its slow branch.
    auto const oscillator = [](auto const&, auto const& x, auto const&, auto const&) {
        using namespace support::real;
        return std::vector{x[1], 100 * ((1 - sqr(x[0])) * x[1]) - x[0]};
    };
    auto const g = support::flow_of(support::model_of({2, 0}, oscillator));
    system.initial = box{between(2, 2.001), between(-0.01, 0.0)};
    system.parameters = box{};
    system.rate = [](support::extended, support::extended_state const& x,
                     support::extended_state const&, support::extended_state const&) {
        return support::extended_state{x[1], 100 * ((1 - x[0] * x[0]) * x[1]) - x[0]};
    };
    auto const slow = integrate<interval>(g, system.initial, system.parameters, 0, 1, o);
    REQUIRE(slow.complete());
    CHECK(longest(slow) * 300 > 10);
    support::check_tube(system, slow, d, 4);
}
