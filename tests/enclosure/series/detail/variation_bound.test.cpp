// SPDX-License-Identifier: MIT
// |V(s) - 1| <= E on a step, against reference derivatives of the flow.
#include <sivid/enclosure/series/detail/variation_bound.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"
#include "support/systems.hpp"

#include <cmath>

using namespace sivid;
using support::draws;
using support::extended;

TEST_CASE("the bound holds for the derivatives of sampled trajectories within the tube") {
    draws d(231);
    int bounded = 0;
    support::for_each_system([&](auto const& system) {
        auto const f = system.flow();
        auto const n = f->states();
        auto const columns = n + f->parameters();
        for (double const h : {0.2, 0.05, 0.01}) {
            // A crude tube: the initial box, widened until trajectories stay inside for sure.
            auto tube = system.initial;
            for (auto i = 0U; i < n; ++i) {
                tube[i] = interval_traits<interval>::add(tube[i], support::between(-0.4, 0.4));
            }
            expansion<interval> e(*f, 2);
            e.set_parameters(system.parameters);
            e.expand_with_variations(0, support::between(0, h), tube, 1);
            if (e.undefined()) continue;
            auto const bound = bound_variation(*f, e, h);
            if (!bound) continue;
            ++bounded;
            for (int member = 0; member < 3; ++member) {
                auto const x0 = support::extend(d.in(system.initial));
                auto const p = support::extend(d.in(system.parameters));
                std::vector<double> const times{0.3 * h, h};
                for (std::size_t c = 0; c < columns; ++c) {
                    extended const step = 1e-6L;
                    auto const moved = [&](extended by) {
                        auto x = x0;
                        auto q = p;
                        (c < n ? x[c] : q[c - n]) += by;
                        return support::reference_states(system.rate, x, q, 0, times,
                                                         system.inputs);
                    };
                    auto const up = moved(step);
                    auto const down = moved(-step);
                    for (std::size_t k = 0; k < times.size(); ++k) {
                        for (std::size_t i = 0; i < n; ++i) {
                            extended const v = (up[k][i] - down[k][i]) / (2 * step);
                            extended const change = std::fabs(v - (i == c ? 1 : 0));
                            double const limit = (*bound)(static_cast<Eigen::Index>(i),
                                                          static_cast<Eigen::Index>(c));
                            CAPTURE(system.name, h, i, c, static_cast<double>(change), limit);
                            CHECK(change <= static_cast<extended>(limit) * 1.00001L + 1e-9L);
                        }
                    }
                }
            }
        }
    });
    CHECK(bounded > 15);
}

TEST_CASE("the bound is sharp for a linear system, and refused when the step is too long") {
    auto const f = support::flow_of(
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{2 * x[0] + p[0]};
        }));
    expansion<interval> e(*f, 2);
    e.set_parameters(box{support::between(-1, 1)});
    e.expand_with_variations(0, support::between(0, 1), box{support::between(-9, 9)}, 1);
    for (double const h : {0.1, 0.2, 0.4}) {
        auto const bound = bound_variation(*f, e, h);
        REQUIRE(bound);
        CHECK((*bound)(0, 0) >= std::exp(2 * h) - 1);
        CHECK((*bound)(0, 1) >= (std::exp(2 * h) - 1) / 2);
        CHECK((*bound)(0, 0) <= 1.3 * 2 * h / (1 - 2 * h)); // the fixed point of Picard's bound
    }
    CHECK_FALSE(bound_variation(*f, e, 0.5));
    CHECK_FALSE(bound_variation(*f, e, 5));
    CHECK_FALSE(bound_variation(*f, e, HUGE_VAL));
}
