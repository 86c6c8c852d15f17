// SPDX-License-Identifier: MIT
// More unknowns than any size that is compiled apart.
#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/parametric_sets.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"

#include <sivid/enclosure/taylor/parametric_flow.hpp>

#include <cmath>
#include <cstddef>
#include <stdexcept>

using namespace sivid;
using support::between;
using support::draws;
using support::extended;
using support::extended_state;
using support::flow_of;
using support::model_of;

namespace {

/// Nothing gives up: only the proofs are tested.
enclosure_options patient() {
    enclosure_options o;
    o.order = 4;
    o.tolerance = 1e-5;
    o.relative_tolerance = 0;
    o.minimum_step = 1e-4;
    o.widest = 1e6;
    o.remainder_share = 1e9;
    return o;
}

} // namespace

TEST_CASE("parametric flow: as many unknowns as there are") {
    // Twelve states of uncertain start, each decaying at a rate of its own into the next pair:
    // x' = -p x - x^2, with x = p x0 / ((p + x0) e^{p t} - x0).
    constexpr std::size_t states = 12;
    auto const f = flow_of(model_of({states, states, 0, 10},
                                    [](auto const&, auto const& x, auto const& p, auto const&) {
                                        auto rate = x;
                                        for (std::size_t i = 0; i < states; ++i)
                                            rate[i] = -(p[i] * x[i]) - sqr(x[i]);
                                        return rate;
                                    }));
    box x0(states), p(states);
    for (std::size_t i = 0; i < states; ++i) {
        x0[i] = between(0.9, 1.1 + 0.01 * static_cast<double>(i));
        p[i] = between(0.4, 0.6);
    }
    auto const exact = [](extended t, extended_state const& start, extended_state const& rate) {
        extended_state x(states);
        for (std::size_t i = 0; i < states; ++i) {
            x[i] = rate[i] * start[i] / ((rate[i] + start[i]) * std::exp(rate[i] * t) - start[i]);
        }
        return x;
    };
    for (std::size_t const degree : {1U, 2U}) {
        parametric_flow<taylor_model<double>> run(*f, patient(), 24, degree);
        run.begin(0, x0, p);
        REQUIRE(run.unknowns().variables == 24);
        draws d(degree);
        while (run.time() < 0.4) {
            double const from = run.time();
            bool const done = run.step(0.4);
            REQUIRE(done);
            auto const swept = run.swept();
            for (int sample = 0; sample < 12; ++sample) {
                auto const q = support::short_point(d, 24);
                auto const start = support::at(run.unknowns().initial, q);
                auto const rate = support::at(run.unknowns().parameters, q);
                REQUIRE(support::encloses_at(run.set(), q, exact(run.time(), start, rate)));
                auto const share = static_cast<extended>(d.uniform(0, 1));
                auto const middle = exact(from + share * (run.time() - from), start, rate);
                for (std::size_t i = 0; i < states; ++i) {
                    REQUIRE(support::encloses_reference(swept[i], middle[i], 1e-16));
                }
            }
        }
        // Each state depends on its own two unknowns.
        for (std::size_t i = 0; i < states; ++i) {
            auto const& own = run.set().centre[i];
            for (std::size_t v = 0; v < 24; ++v) {
                bool const mine = v == i || v == states + i;
                REQUIRE((own.c(own.space().variable(v)) != 0) == mine);
            }
            REQUIRE(run.set().reach[i] < 0.1 * own.spread());
        }
    }
    // One more than there is room for.
    parametric_flow<taylor_model<double>> narrow(*f, patient(), 23, 1);
    REQUIRE_THROWS_AS(narrow.begin(0, x0, p), std::invalid_argument);
}
