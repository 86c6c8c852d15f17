// SPDX-License-Identifier: MIT
// What a recorded model gives at a point, and its graph in an order of its own.
#ifndef SIVID_TESTS_TEXT_VALUES_HPP
#define SIVID_TESTS_TEXT_VALUES_HPP

#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace texts {

inline bool is_near(double a, double b) { return std::abs(a - b) <= 1e-12 * std::abs(b); }

/// A model's rates and channels, nearly, with inputs that are numbers.
inline std::vector<double> values(sivid::recorded_model const& m, std::vector<double> const& x,
                                  std::vector<double> const& u) {
    sivid::graph g;
    auto wanted = m.rate;
    wanted.insert(wanted.end(), m.observe.begin(), m.observe.end());
    auto const all = sivid::copy_into(g, m.g, wanted, [&](sivid::node const& n, sivid::graph& to) {
        auto const k = static_cast<std::size_t>(n.index);
        return n.op == sivid::operation::state      ? to.constant(x[k])
               : n.op == sivid::operation::input    ? to.constant(u[k])
               : n.op == sivid::operation::constant ? to.constant(m.about.constants[k].nominal)
                                                    : to.constant(0.0);
    });
    std::vector<double> result;
    for (auto const k : all) result.push_back(g.value(g[k]).nearest);
    return result;
}

/// Whether two models have the same rates and channels, whatever the order of their nodes and what
/// else stands in their graphs.
inline bool same_equations(sivid::recorded_model const& a, sivid::recorded_model const& b) {
    std::map<std::pair<sivid::node_id, sivid::node_id>, bool> known;
    std::function<bool(sivid::node_id, sivid::node_id)> const same = [&](auto i, auto j) {
        auto const [at, fresh] = known.try_emplace({i, j}, false);
        if (!fresh) return at->second;
        auto const &x = a.g[i], &y = b.g[j];
        bool equal = x.op == y.op;
        if (equal && x.op == sivid::operation::literal) {
            auto const &u = a.g.value(x), &v = b.g.value(y);
            equal = u.nearest == v.nearest && u.enclosure.lower() == v.enclosure.lower() &&
                    u.enclosure.upper() == v.enclosure.upper();
        } else if (equal && sivid::is_leaf(x.op)) {
            equal = x.index == y.index;
        } else if (equal && sivid::is_binary(x.op)) { // sums and products in either order
            bool const commutes = x.op == sivid::operation::add || x.op == sivid::operation::mul;
            equal = (same(x.a, y.a) && same(x.b, y.b)) ||
                    (commutes && same(x.a, y.b) && same(x.b, y.a));
        } else if (equal) {
            equal = x.index == y.index && same(x.a, y.a);
        }
        return known[{i, j}] = equal;
    };
    return std::equal(a.rate.begin(), a.rate.end(), b.rate.begin(), b.rate.end(), same) &&
           std::equal(a.observe.begin(), a.observe.end(), b.observe.begin(), b.observe.end(), same);
}

} // namespace texts

#endif
