// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_STRUCTURE_IMPL_SYMMETRY_IPP
#define SIVID_MODEL_STRUCTURE_IMPL_SYMMETRY_IPP

#include <sivid/model/structure/symmetry.hpp>

#include <sivid/model/graph/normal_form.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/number/elementary/detail/wide_integer.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

namespace model_detail {

/// A quotient of 64-bit integers in lowest terms.
struct small_fraction {
    std::int64_t above = 0, below = 1;

    static std::optional<small_fraction> of(std::int64_t a, std::int64_t b) {
        auto const common = std::gcd(a, b);
        if (common == 0) return std::nullopt;
        small_fraction r{a / common, b / common};
        if (r.below < 0) r = {-r.above, -r.below};
        return r;
    }
    /// @returns nothing where integers would overflow
    static std::optional<small_fraction> product(small_fraction x, small_fraction y) {
        auto const a = limited(detail::checked_product(x.above, y.above)),
                   b = limited(detail::checked_product(x.below, y.below));
        if (!a || !b) return std::nullopt;
        return of(*a, *b);
    }
    static std::optional<small_fraction> sum(small_fraction x, small_fraction y) {
        auto const a = detail::checked_product(x.above, y.below),
                   b = detail::checked_product(y.above, x.below),
                   below = limited(detail::checked_product(x.below, y.below));
        if (!a || !b || !below) return std::nullopt;
        auto const above = limited(detail::checked_sum(*a, *b));
        if (!above) return std::nullopt;
        return of(*above, *below);
    }

private:
    static std::optional<std::int64_t> limited(std::optional<std::int64_t> x) {
        return x && *x > -(std::int64_t{1} << 62) ? x : std::nullopt;
    }
};

/// Fractions as coefficients and all other nodes as factors, which are taken for independent: what
/// is 0 then is 0 for all values of the leaves.
class fraction_coefficients {
public:
    using value = small_fraction;
    using result = std::optional<small_fraction>;

    explicit fraction_coefficients(graph const& g) : g_(&g) {}

    [[nodiscard]] graph const& g() const { return *g_; }
    /// Multiples of 1/1024, and not too large.
    [[nodiscard]] result known(node_id i) const {
        if (!g_->is_literal(i)) return std::nullopt;
        auto const& literal = g_->value((*g_)[i]).enclosure;
        double const scaled = literal.lower() * 1024;
        if (!is_point(literal) || !(std::abs(scaled) < 1e9) || scaled != std::round(scaled)) {
            return std::nullopt;
        }
        return small_fraction::of(static_cast<std::int64_t>(scaled), 1024);
    }
    [[nodiscard]] bool is_variable(node_id) const { return true; }
    [[nodiscard]] small_fraction whole(node_id) const { return one(); } // never asked for
    [[nodiscard]] small_fraction one() const { return {1, 1}; }
    [[nodiscard]] bool is_zero(small_fraction v) const { return v.above == 0; }
    [[nodiscard]] result neg(small_fraction v) const { return product(v, {-1, 1}); }
    [[nodiscard]] result sum(small_fraction v, small_fraction w) const {
        return small_fraction::sum(v, w);
    }
    [[nodiscard]] result product(small_fraction v, small_fraction w) const {
        return small_fraction::product(v, w);
    }
    [[nodiscard]] result quotient(small_fraction v, small_fraction w) const {
        auto const inverse = small_fraction::of(w.below, w.above);
        return inverse && w.above != 0 ? product(v, *inverse) : std::nullopt;
    }
    [[nodiscard]] result power(small_fraction v, int n) const {
        result r = one();
        for (int k = 0; k < n && r; ++k) r = product(*r, v);
        return r;
    }

private:
    graph const* g_;
};

/// Whether a function that jumps depends on something that moves.
SIVID_DECL bool jumps_along(bound_model const& model, model_motion const& motion) {
    auto const& g = model.g;
    auto outputs = model.rate;
    outputs.insert(outputs.end(), model.observe.begin(), model.observe.end());
    auto const needed = operands_of(g, outputs);
    std::vector<bool> moves(g.size(), false);
    for (std::size_t k = 0; k < g.size(); ++k) {
        if (!needed[k]) continue;
        auto const& n = g.nodes()[k];
        auto const index = static_cast<std::size_t>(n.index);
        if (n.op == operation::constant) moves[k] = motion.parameters[index] != 0;
        if (n.op == operation::state) moves[k] = motion.states[index] != 0;
        if (is_leaf(n.op)) continue;
        moves[k] = moves[n.a] || (is_binary(n.op) && moves[n.b]);
        if (n.op == operation::sign && moves[k]) return true;
    }
    return false;
}

} // namespace model_detail

SIVID_DECL bool is_symmetry(bound_model const& model, model_motion const& motion) {
    using namespace model_detail;
    if (jumps_along(model, motion)) return false;
    auto g = model.g;
    bool const scales = motion.kind == motion_kind::scaling;
    std::vector<node_id> x, p;
    for (std::size_t i = 0; i < model.state_count(); ++i) x.push_back(g.leaf(operation::state, i));
    for (std::size_t j = 0; j < model.parameter_count(); ++j) {
        p.push_back(g.leaf(operation::constant, j));
    }
    multiplied_out<fraction_coefficients> multiplied(fraction_coefficients(g), {200, 4000});
    using terms = multiplied_out<fraction_coefficients>::terms;
    // Adds w v(leaf) times the derivative.
    auto const along = [&](terms& sum, int w, node_id leaf, node_id derivative) {
        if (w == 0) return true;
        auto term = std::optional(multiplied(derivative));
        if (scales) term = multiplied.product(*term, multiplied(leaf));
        return term && multiplied.add(sum, *term, {w, 1});
    };
    auto const holds = [&](node_id f, std::vector<node_id> const& dx,
                           std::vector<node_id> const& dp, int weight) {
        terms sum;
        for (std::size_t j = 0; j < p.size(); ++j) {
            if (!along(sum, motion.parameters[j], p[j], dp[j])) return false;
        }
        for (std::size_t i = 0; i < x.size(); ++i) {
            if (!along(sum, motion.states[i], x[i], dx[i])) return false;
        }
        if (scales && weight != 0 && !multiplied.add(sum, multiplied(f), {-weight, 1})) {
            return false;
        }
        return sum.empty();
    };
    for (std::size_t i = 0; i < model.rate.size(); ++i) {
        if (!holds(model.rate[i], model.rate_dx[i], model.rate_dp[i], motion.states[i])) {
            return false;
        }
    }
    for (std::size_t y = 0; y < model.observe.size(); ++y) {
        if (!holds(model.observe[y], model.observe_dx[y], model.observe_dp[y], 0)) return false;
    }
    return true;
}

} // namespace sivid

#endif
