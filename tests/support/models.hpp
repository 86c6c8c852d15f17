// SPDX-License-Identifier: MIT
// Models made at run time from one generic lambda, so that a test runs the same equations on the
// recording scalar, on doubles, and on the high-precision numbers of its oracle.
#ifndef SIVID_TESTS_SUPPORT_MODELS_HPP
#define SIVID_TESTS_SUPPORT_MODELS_HPP

#include <sivid/enclosure/flow.hpp>
#include <sivid/model/model.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace support {

using sivid::box;
using sivid::interval;

/// [lo, hi] from two exact doubles.
inline interval between(double lo, double hi) {
    return sivid::interval_traits<interval>::bounds(lo, hi);
}
/// [x - r, x + r], rounded outward.
inline interval around(double x, double r) {
    using traits = sivid::interval_traits<interval>;
    return traits::add(traits::point(x), traits::bounds(-r, r));
}

struct shape {
    std::size_t states = 1;
    std::size_t constants = 0;
    std::size_t inputs = 0;
    double limit = 100; ///< own range of each state
};

/// Names "x0", "p0", "u0", "y0", ...
inline std::string numbered(char letter, std::size_t i) {
    std::string name(1, letter);
    name += std::to_string(i);
    return name;
}

inline std::vector<std::string> all_constants(std::size_t n) {
    std::vector<std::string> names;
    for (std::size_t j = 0; j < n; ++j) names.push_back(numbered('p', j));
    return names;
}

/// Records rate(t, x, p, u) and observe(t, x, p, u), both from vectors to a vector.
template <class Rate, class Observe>
sivid::recorded_model model_of(shape const& s, Rate const& rate, Observe const& observe) {
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
    for (expression const& e : observe(t, x, p, u)) m.observe.push_back(e.in(g));
    for (std::size_t y = 0; y < m.observe.size(); ++y) {
        m.about.channels.push_back({numbered('y', y), "1"});
    }
    return m;
}

/// Every state is a channel.
template <class Rate>
sivid::recorded_model model_of(shape const& s, Rate const& rate) {
    return model_of(s, rate,
                    [](auto const&, auto const& x, auto const&, auto const&) { return x; });
}

/// The flow with every constant unknown.
inline std::shared_ptr<sivid::flow const> flow_of(sivid::recorded_model const& m,
                                                  std::vector<sivid::signal> const& inputs = {}) {
    return std::make_shared<sivid::flow const>(
        m, sivid::parameter_choice{all_constants(m.about.constants.size()), {}}, inputs);
}

} // namespace support

#endif
