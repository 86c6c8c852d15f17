// SPDX-License-Identifier: MIT
// Runge-Kutta formulas in 100 digits.
#ifndef SIVID_TESTS_SUPPORT_RUNGE_KUTTA_HPP
#define SIVID_TESTS_SUPPORT_RUNGE_KUTTA_HPP

#include "support/power_series.hpp"
#include "support/rates.hpp"

#include <sivid/enclosure/methods.hpp>
#include <sivid/measurement/signal.hpp>

#include <cstddef>
#include <vector>

namespace support {

inline mp exact(sivid::surd const& x) {
    return (x.numerator + x.factor * sqrt(mp(x.radicand))) / x.denominator;
}

inline std::vector<sivid::tableau> implicit_methods() {
    using namespace sivid;
    return {gauss2(),     gauss4(),        gauss6(),        radau_iia3(),
            radau_iia5(), lobatto_iiic2(), lobatto_iiic4(), lobatto_iiic6()};
}

/// The stages for a step h from x at t, by fixed-point iteration: exact after as many rounds as
/// there are stages where the method is explicit, else for h |A| |f'| well below 1.
/// @param start  a time of the piece of the sampled inputs
inline std::vector<std::vector<mp>> exact_stages(rate_on<mp> const& rate,
                                                 std::vector<sivid::sampled_signal> const& inputs,
                                                 sivid::tableau const& m, mp const& t,
                                                 std::vector<mp> const& x, std::vector<mp> const& p,
                                                 mp const& h, double start) {
    std::vector<std::vector<mp>> k(m.stages(), std::vector<mp>(x.size(), mp(0)));
    for (std::size_t round = 0; round < 2000; ++round) {
        mp change = 0;
        for (std::size_t i = 0; i < m.stages(); ++i) {
            auto at = x;
            for (std::size_t l = 0; l < m.a[i].size(); ++l) {
                for (std::size_t s = 0; s < x.size(); ++s) {
                    at[s] += h * exact(m.a[i][l]) * k[l][s];
                }
            }
            mp const time = t + exact(m.c[i]) * h;
            std::vector<mp> u;
            for (auto const& s : inputs) {
                auto const piece = s.piece(start);
                mp value = s.values()[piece];
                if (s.kind() == sivid::interpolation::linear) {
                    value += (mp(s.values()[piece + 1]) - value) * (time - mp(s.times()[piece])) /
                             (mp(s.times()[piece + 1]) - mp(s.times()[piece]));
                }
                u.push_back(value);
            }
            std::vector<mp> const next = rate(time, at, p, u);
            for (std::size_t s = 0; s < x.size(); ++s) {
                change = std::max<mp>(change, abs(next[s] - k[i][s]));
            }
            k[i] = next;
        }
        if (change < 1e-44) break;
    }
    return k;
}

/// The formula itself.
inline std::vector<mp> exact_step(rate_on<mp> const& rate,
                                  std::vector<sivid::sampled_signal> const& inputs,
                                  sivid::tableau const& m, mp const& t, std::vector<mp> const& x,
                                  std::vector<mp> const& p, mp const& h, double start) {
    auto const k = exact_stages(rate, inputs, m, t, x, p, h, start);
    auto result = x;
    for (std::size_t i = 0; i < m.stages(); ++i) {
        for (std::size_t s = 0; s < x.size(); ++s) result[s] += h * exact(m.b[i]) * k[i][s];
    }
    return result;
}

} // namespace support

#endif
