// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_RUNGE_KUTTA_ORDER_CONDITIONS_HPP
#define SIVID_ENCLOSURE_RUNGE_KUTTA_ORDER_CONDITIONS_HPP

#include <sivid/enclosure/runge_kutta/tableau.hpp>
#include <sivid/number/interval.hpp>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// A rooted tree: the subtrees at its root, as indices into a list of trees in which children come
/// before their parents, in ascending order.
struct rooted_tree {
    std::size_t nodes = 1;
    double density = 1; ///< \f$ \gamma \f$, a product of small integers: exact
    std::vector<std::size_t> children;
};

/// All rooted trees with up to `order` nodes: 1, 1, 2, 4, 9, 20, ... of each size.
[[nodiscard]] inline std::vector<rooted_tree> rooted_trees(std::size_t order) {
    std::vector<rooted_tree> trees;
    // Adds all trees of `left` more nodes whose further children have an index of at most `last`.
    auto const grow = [&trees](auto const& self, rooted_tree root, std::size_t left,
                               std::size_t last) -> void {
        if (left == 0) {
            root.density *= static_cast<double>(root.nodes);
            trees.push_back(std::move(root));
            return;
        }
        for (std::size_t k = last + 1; k-- > 0;) {
            auto const size = trees[k].nodes;
            if (size > left) continue;
            auto more = root;
            more.nodes += size;
            more.density *= trees[k].density;
            more.children.push_back(k);
            self(self, std::move(more), left - size, k);
        }
    };
    for (std::size_t n = 1; n <= order; ++n) {
        auto const smaller = trees.size();
        grow(grow, rooted_tree{}, n - 1, smaller == 0 ? 0 : smaller - 1);
    }
    return trees;
}

/// Enclosures of \f$ \sum_i b_i \Phi_i(t) - 1/\gamma(t) \f$ for all trees with up to `order` nodes,
/// after those of \f$ \sum_j a_{ij} - c_i \f$: a method has the order if and only if all these
/// numbers are zero.
/// @ref  Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I (1993), theorem
///       II.2.13
template <class I = interval>
[[nodiscard]] std::vector<I> order_residuals(tableau const& method, std::size_t order) {
    using traits = interval_traits<I>;
    auto const s = method.stages();
    std::vector<I> residuals;
    std::vector<std::vector<I>> a(s);
    for (std::size_t i = 0; i < s; ++i) {
        I sum = traits::neg(method.c[i].template enclose<I>());
        for (auto const& x : method.a[i]) {
            a[i].push_back(x.template enclose<I>());
            sum = traits::add(sum, a[i].back());
        }
        residuals.push_back(sum);
    }
    auto const trees = rooted_trees(order);
    // \Phi_i of the tree: the product over its children of \sum_j a_{ij} \Phi_j(child).
    std::vector<std::vector<I>> branch; // \sum_j a_{ij} \Phi_j(tree)
    for (auto const& tree : trees) {
        std::vector<I> weight(s, traits::point(1.0));
        for (auto const child : tree.children) {
            for (std::size_t i = 0; i < s; ++i) {
                weight[i] = traits::mul(weight[i], branch[child][i]);
            }
        }
        typename traits::mask never{};
        I sum = traits::neg(traits::div(traits::point(1.0), traits::point(tree.density), never));
        for (std::size_t i = 0; i < s; ++i) {
            sum = traits::add(sum, traits::mul(method.b[i].template enclose<I>(), weight[i]));
        }
        residuals.push_back(sum);
        std::vector<I> next(s, traits::point(0.0));
        for (std::size_t i = 0; i < s; ++i) {
            for (std::size_t j = 0; j < a[i].size(); ++j) {
                next[i] = traits::add(next[i], traits::mul(a[i][j], weight[j]));
            }
        }
        branch.push_back(std::move(next));
    }
    return residuals;
}

/// Refuses a method whose stated order is disproved: its enclosures would not hold.
/// @throws std::invalid_argument
inline void require_order(tableau const& method) {
    for (auto const& r : order_residuals<interval>(method, method.order)) {
        if (contains(r, 0.0)) continue;
        throw std::invalid_argument("tableau '" + method.name + "' does not have the order " +
                                    std::to_string(method.order) + " that it states");
    }
}

} // namespace sivid

#endif
