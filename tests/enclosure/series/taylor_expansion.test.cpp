// SPDX-License-Identifier: MIT
// V's series with its columns side by side against the same series entry by entry in intervals.
#include <sivid/enclosure/series/taylor_expansion.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/systems.hpp"

#include <sivid/enclosure/series/expansion.hpp>
#include <sivid/model/series/taylor_arithmetic.hpp>

#include <vector>

using namespace sivid;
using support::draws;

namespace {

constexpr std::size_t K = 12;

/// Over a part of the system's boxes: the states' spread is left to the radii, the first
/// parameter is the variable.
template <std::size_t D>
void check(auto const& system, double share, draws& d) {
    using model = taylor_model<double>;
    auto const& shape = model_shape<double>::of(1, D);
    auto const f = system.flow();
    auto const n = f->states();
    box x(n), p(f->parameters());
    std::vector<model> states(n), parameters(p.size());
    for (std::size_t i = 0; i < n; ++i) {
        double const m = mid(system.initial[i]), r = rad(system.initial[i]) * share;
        x[i] = interval(m - r, m + r);
        states[i] = model::constant(x[i]);
    }
    for (std::size_t j = 0; j < p.size(); ++j) {
        double const m = mid(system.parameters[j]), r = rad(system.parameters[j]) * share;
        p[j] = interval(m - r, m + r);
        parameters[j] = model::constant(p[j]);
        if constexpr (D > 0) {
            if (j == 0 && r > 0)
                parameters[j] = widened(model::variable(shape, 0, m, r), 1e-14 * m);
        }
    }
    for (auto const which : {variations::by_state, variations::by_state_and_parameter}) {
        expansion<model> e(*f, K, which, shape);
        e.set_parameters(parameters);
        // What an earlier expansion, to a higher order, left must not count.
        for (std::size_t const order : {K, std::size_t{0}, K - 3}) {
            e.expand_with_variations(0.125, model::constant(0.125), states, order);
        }
        if (e.undefined() || e.kinked()) return;
        for (int member = 0; member < 3; ++member) {
            box const at = point_box(d.in(x)), with = point_box(d.in(p));
            expansion<interval> sharp(*f, K, which);
            sharp.set_parameters(with);
            sharp.expand_with_variations(0.125, interval(0.125), at, K - 3);
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t c = 0; c < e.columns(); ++c) {
                    for (std::size_t k = 0; k <= K - 3; ++k) {
                        auto const found = range(e.variation(i, c, k));
                        auto const exact = sharp.variation(i, c, k);
                        CAPTURE(system.name, D, share, i, c, k, found.lower(), found.upper(),
                                exact.lower(), exact.upper());
                        CHECK(!disjoint(found, exact));
                        if (!f->sensitive(i, c)) CHECK(e.variation(i, c, k).norm() == 0);
                        if (share == 0) CHECK(width(found) <= 1e-10 * (1 + mag(found)));
                    }
                }
            }
        }
    }
}

} // namespace

TEST_CASE("V by columns contains V entry by entry") {
    draws d(331);
    support::for_each_system([&](auto const& system) {
        for (double const share : {0.0, 1e-6, 0.02}) {
            check<0>(system, share, d);
            check<1>(system, share, d);
            check<3>(system, share, d);
        }
    });
}

TEST_CASE("V by columns: more columns than a group has, and some of the identity") {
    // x' = p x_0 for states 1 .. 9; of state 0 alone the columns are more than 1.
    auto const f = support::flow_of(
        support::model_of({10, 1},
                          [](auto const&, auto const& x, auto const& p, auto const&) {
                              std::vector rate{-(p[0] * x[0])};
                              for (std::size_t i = 1; i < 10; ++i) {
                                  rate.push_back(i < 5 ? p[0] * x[0] : x[i - 1] * x[i] + x[0]);
                              }
                              return rate;
                          }),
        {});
    using model = taylor_model<double>;
    std::vector<model> x;
    box at(10);
    for (std::size_t i = 0; i < 10; ++i) {
        at[i] = interval(1 + 0.25 * static_cast<double>(i));
        x.push_back(model::constant(at[i]));
    }
    expansion<model> e(*f, 6);
    expansion<interval> sharp(*f, 6);
    e.set_parameters(std::vector<model>{model::constant(0.5)});
    sharp.set_parameters(box{interval(0.5)});
    e.expand_with_variations(0.0, model::constant(0.0), x, 6);
    sharp.expand_with_variations(0.0, interval(0.0), at, 6);
    for (std::size_t i = 0; i < 10; ++i) {
        for (std::size_t c = 0; c < 11; ++c) {
            for (std::size_t k = 0; k <= 6; ++k) {
                auto const found = range(e.variation(i, c, k));
                CAPTURE(i, c, k);
                CHECK(!disjoint(found, sharp.variation(i, c, k)));
                CHECK(width(found) <= 1e-12 * (1 + mag(found)));
            }
        }
    }
}
