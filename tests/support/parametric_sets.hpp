// SPDX-License-Identifier: MIT
// Members of Taylor-model sets, against exact solutions.
#ifndef SIVID_TESTS_SUPPORT_PARAMETRIC_SETS_HPP
#define SIVID_TESTS_SUPPORT_PARAMETRIC_SETS_HPP

#include "support/reference.hpp"
#include "support/taylor_models.hpp"

#include <sivid/enclosure/taylor/parametric_flow.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace support {

/// A flow of one size, for tests that are written for it.
template <std::size_t N, std::size_t D, class C = double>
struct sized_flow : sivid::parametric_flow<sivid::taylor_model<C>> {
    sized_flow(sivid::flow const& f, sivid::enclosure_options const& options)
        : sivid::parametric_flow<sivid::taylor_model<C>>(f, options, N, D) {}
};

/// x within P(q), its tail and the generators at this q, componentwise; `slack` covers the
/// reference.
template <class Set>
bool encloses_at(Set const& set, std::vector<double> const& q, extended_state const& x,
                 extended slack = 1e-16L) {
    for (std::size_t i = 0; i < x.size(); ++i) {
        extended reach = 0;
        for (auto const& g : set.columns) reach += std::fabs(value<extended>(g[i], q));
        extended const tail = set.tail.empty() ? 0.0 : set.tail[i];
        extended const off = std::fabs(x[i] - value<extended>(set.centre[i], q) - tail);
        if (!(off <= reach + slack * (1 + std::fabs(x[i])))) return false;
    }
    return true;
}

/// The sides' values at the unknowns q.
inline std::vector<extended> at(std::vector<sivid::normalised_unknowns::side> const& sides,
                                std::vector<double> const& q) {
    std::vector<extended> x;
    for (auto const& s : sides) {
        x.push_back(s.centre +
                    (s.radius > 0 ? static_cast<extended>(s.radius) * q[s.variable] : 0));
    }
    return x;
}

} // namespace support

#endif
