// SPDX-License-Identifier: MIT
// Bounds and values of a flow's derivatives on a step, against closed forms: x' = p x.
#include <sivid/enclosure/series/detail/variation_step.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/reference.hpp"
#include "support/systems.hpp"

#include <sivid/model/series/taylor_arithmetic.hpp>

#include <cmath>
#include <vector>

using namespace sivid;
using namespace sivid::enclosure_detail;
using support::extended;
using model = taylor_model<double>;

TEST_CASE("Steps of V: the bounds hold, the values enclose, at every order") {
    auto const f = support::flow_of(
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * x[0]};
        }));
    auto const& narrow = model_shape<double>::of(1, 1);
    auto const& wide = model_shape<double>::of(2, 1);
    double const x = 1.5;
    for (std::size_t const L : {1u, 2u, 3u, 6u}) {
        for (double const p : {-1.0, 0.5, 1.0}) {
            for (double const h : {0.0625, 0.25, 0.375}) {
                CAPTURE(L, p, h);
                extended const growth = std::exp(static_cast<extended>(p * h));
                expansion<model> e(*f, L + 1, variations::by_state_and_parameter, narrow);
                expansion<model> tube(*f, L + 1, variations::by_state_and_parameter, wide);
                e.set_parameters(std::vector{model::constant(p)});
                tube.set_parameters(std::vector{model::constant(p)});
                e.expand_with_variations(0, model::constant(0.0), std::vector{model::constant(x)},
                                         L - 1);
                auto const swept = model::constant(support::between(
                    x * std::fmin(1.0, std::exp(p * h)), x * std::fmax(1.0, std::exp(p * h))));
                tube.expand_with_variations(0, model::constant(support::between(0, h)),
                                            std::vector{widened(swept, 1e-9)}, L);
                auto const base = variation_sizes(*f, e, 2, h, L, 1);
                auto const last = last_variation_sizes(
                    *f, tube, 2, std::pow(h, static_cast<double>(L)) * (1 + 1e-14), L);
                std::vector<double> w;
                REQUIRE(bound_variations(base, last, 1, 12, true, w));
                REQUIRE(w.size() == 2);
                CHECK(static_cast<extended>(w[0]) >= std::fabs(growth - 1));
                CHECK(static_cast<extended>(w[1]) >= x * h * std::fmax(growth, 1.0L));
                for (std::size_t c = 0; c < 2; ++c) {
                    extended const exact = c == 0 ? growth : x * h * growth;
                    auto const left = last_variation(*f, tube, w, 0, c, L, narrow);
                    auto const end = variation_at_end(e, left, 0, c, L, narrow, h);
                    CHECK(support::encloses_reference(range(end), exact));
                    if (L == 6) CHECK(end.r() < 1e-4);
                    // Without a tube: what the series leaves out, given.
                    extended known = 0;
                    for (std::size_t k = L; k-- > 0;) {
                        known = known * h + static_cast<extended>(mid(range(e.variation(0, c, k))));
                    }
                    double const rest = static_cast<double>(std::fabs(exact - known)) + 1e-15;
                    auto const plain = variation_at_end(e, rest, 0, c, L, narrow, h);
                    CHECK(support::encloses_reference(range(plain), exact));
                    CHECK(plain.r() < rest + 1e-12);
                }
                auto const all = variation_sizes(*f, e, 2, h, L, 0);
                CHECK(all[0] >= 1 + base[0] * (1 - 1e-11));
            }
        }
    }
}

TEST_CASE("Steps of V: lanes that are too long are refused, the others keep their bounds") {
    using side_by_side = lane_traits<lanes<8>>;
    std::vector<lanes<8>> base(1, lanes<8>(0.125)), last(1, lanes<8>(0.0)), w;
    for (std::size_t l = 0; l < 8; ++l) side_by_side::put(last[0], l, 0.3 * static_cast<double>(l));
    auto const asked = !side_by_side::only(1);
    auto const found = bound_variations(base, last, 1, 12, asked, w);
    for (std::size_t l = 0; l < 8; ++l) {
        double const a = 0.3 * static_cast<double>(l);
        CAPTURE(l);
        bool const possible = l != 1 && a < 1;
        CHECK(side_by_side::test(found, l) == possible);
        double const least = possible ? (0.125 + a) / (1 - a) : 0; // the fixed point
        CHECK(side_by_side::get(w[0], l) >= least);
        CHECK(side_by_side::get(w[0], l) <= 1.5 * least);
    }
}

TEST_CASE("Steps of V: a chain of states takes a round for each") {
    // Each state is moved by the next: the corner entry is reached after n rounds.
    std::size_t const n = 12;
    std::vector<double> base(n * n, 0.0), last(n * n, 0.0), w;
    for (std::size_t i = 0; i + 1 < n; ++i) last[i * n + i + 1] = 0.5;
    CHECK_FALSE(bound_variations(base, last, n, 2, true, w));
    CHECK(w[1] == 0);
    REQUIRE(bound_variations(base, last, n, 12 + n, true, w));
    CHECK(w[n - 1] >= std::pow(0.5, n - 1));
}
