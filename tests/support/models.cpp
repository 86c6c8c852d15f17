// SPDX-License-Identifier: MIT
#include "support/models.hpp"

#include <cstddef>
#include <vector>

namespace support {

sivid::recorded_model model_of(shape const& s, recorded_rate const& rate,
                               recorded_rate const& observe) {
    using sivid::expression;
    using sivid::operation;
    sivid::recorded_model m;
    m.about.name = "test";
    auto& g = m.g;
    auto const leaves = [&g](operation op, std::size_t n) {
        std::vector<expression> out;
        for (std::size_t i = 0; i < n; ++i) out.emplace_back(g, g.leaf(op, i));
        return out;
    };
    auto const x = leaves(operation::state, s.states);
    auto const p = leaves(operation::constant, s.constants);
    auto const u = leaves(operation::input, s.inputs);
    expression const t(g, g.leaf(operation::time, 0));
    for (std::size_t i = 0; i < s.states; ++i) {
        m.about.states.push_back({numbered('x', i), "1", s.limit});
    }
    for (std::size_t j = 0; j < s.constants; ++j) {
        m.about.constants.push_back({numbered('p', j), "1", sivid::literal{interval(1.0), 1.0}});
    }
    for (std::size_t k = 0; k < s.inputs; ++k) {
        m.about.inputs.push_back({numbered('u', k), "1"});
    }
    for (expression const& e : rate(t, x, p, u)) m.rate.push_back(e.in(g));
    for (expression const& e : observe ? observe(t, x, p, u) : x) m.observe.push_back(e.in(g));
    for (std::size_t y = 0; y < m.observe.size(); ++y) {
        m.about.channels.push_back({numbered('y', y), "1"});
    }
    return m;
}

} // namespace support
