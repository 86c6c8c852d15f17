// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_SYMMETRY_HPP
#define SIVID_MODEL_SYMMETRY_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/rewrite.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// How quantities move together along one unknown s.
enum class motion_kind {
    scaling,    ///< each is multiplied by \f$ e^{w s} \f$
    translation ///< w s is added to each
};

/// A motion of parameters and states, with one small integer w for each.
struct model_motion {
    motion_kind kind = motion_kind::scaling;
    std::vector<int> parameters; ///< one per unknown parameter
    std::vector<int> states;     ///< one per state
};

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
        std::int64_t a = 0, b = 0;
        if (__builtin_mul_overflow(x.above, y.above, &a) ||
            __builtin_mul_overflow(x.below, y.below, &b) || !limited(a) || !limited(b)) {
            return std::nullopt;
        }
        return of(a, b);
    }
    static std::optional<small_fraction> sum(small_fraction x, small_fraction y) {
        std::int64_t a = 0, b = 0, both = 0, below = 0;
        if (__builtin_mul_overflow(x.above, y.below, &a) ||
            __builtin_mul_overflow(y.above, x.below, &b) || __builtin_add_overflow(a, b, &both) ||
            __builtin_mul_overflow(x.below, y.below, &below) || !limited(both) || !limited(below)) {
            return std::nullopt;
        }
        return of(both, below);
    }

private:
    static bool limited(std::int64_t x) { return x > -(std::int64_t{1} << 62); }
};

/// A polynomial with fractions as coefficients in nodes of a graph and their reciprocals, the
/// nodes taken for independent variables. What is 0 here is 0 for all values of the leaves.
class node_polynomial {
public:
    using monomial = std::vector<std::pair<node_id, int>>; ///< nodes with powers, increasing

    static node_polynomial constant(small_fraction c) {
        node_polynomial r;
        if (c.above != 0) r.terms_[{}] = c;
        return r;
    }
    static node_polynomial node(node_id i) {
        node_polynomial r;
        r.terms_[{{i, 1}}] = {1, 1};
        return r;
    }
    [[nodiscard]] bool is_zero() const { return terms_.empty(); }
    [[nodiscard]] std::size_t size() const { return terms_.size(); }

    /// this + factor * other. @returns false where integers would overflow
    [[nodiscard]] bool add(node_polynomial const& other, small_fraction factor = {1, 1}) {
        for (auto const& [m, c] : other.terms_) {
            auto const scaled = small_fraction::product(c, factor);
            if (!scaled || !add_term(m, *scaled)) return false;
        }
        return true;
    }
    [[nodiscard]] static std::optional<node_polynomial> product(node_polynomial const& a,
                                                                node_polynomial const& b) {
        node_polynomial r;
        for (auto const& [m, c] : a.terms_) {
            for (auto const& [n, d] : b.terms_) {
                auto const both = small_fraction::product(c, d);
                if (!both || !r.add_term(joined(m, n), *both)) return std::nullopt;
            }
        }
        return r;
    }
    /// 1 / this. @given  a single term
    [[nodiscard]] std::optional<node_polynomial> reciprocal() const {
        if (terms_.size() != 1) return std::nullopt;
        auto const& [factors, c] = *terms_.begin();
        auto inverted = factors;
        for (auto& factor : inverted) factor.second = -factor.second;
        node_polynomial r;
        auto const inverse = small_fraction::of(c.below, c.above);
        if (!inverse || !r.add_term(inverted, *inverse)) return std::nullopt;
        return r;
    }

private:
    static monomial joined(monomial const& a, monomial const& b) {
        std::map<node_id, int> powers(a.begin(), a.end());
        for (auto const& [node, power] : b) powers[node] += power;
        monomial r;
        for (auto const& f : powers) {
            if (f.second != 0) r.push_back(f);
        }
        return r;
    }
    bool add_term(monomial const& m, small_fraction c) {
        auto const [at, fresh] = terms_.try_emplace(m, c);
        if (!fresh) {
            auto const sum = small_fraction::sum(at->second, c);
            if (!sum) return false;
            at->second = *sum;
        }
        if (at->second.above == 0) terms_.erase(at);
        return true;
    }

    std::map<monomial, small_fraction> terms_;
};

/// The nodes of a graph multiplied out, as far as that stays small; what does not is a variable.
class multiplied_out {
public:
    explicit multiplied_out(graph const& g) : g_(&g) {}

    node_polynomial const& operator()(node_id i) {
        if (auto const known = done_.find(i); known != done_.end()) return known->second;
        auto found = expand(i);
        if (!found || found->size() > most_terms) found = node_polynomial::node(i);
        return done_[i] = std::move(*found);
    }

private:
    static constexpr std::size_t most_terms = 200;

    std::optional<node_polynomial> expand(node_id i) {
        auto const& n = (*g_)[i];
        switch (n.op) {
        case operation::literal: {
            auto const& value = g_->value(n).enclosure;
            double const scaled = value.lower() * 1024;
            if (is_point(value) && std::abs(scaled) < 1e9 && scaled == std::round(scaled)) {
                auto const c = small_fraction::of(static_cast<std::int64_t>(scaled), 1024);
                return c ? std::optional(node_polynomial::constant(*c)) : std::nullopt;
            }
            return std::nullopt;
        }
        case operation::neg:
            return sum(node_polynomial{}, n.a, -1);
        case operation::add:
            return sum((*this)(n.a), n.b, 1);
        case operation::sub:
            return sum((*this)(n.a), n.b, -1);
        case operation::mul:
            return product((*this)(n.a), (*this)(n.b));
        case operation::sqr:
            return product((*this)(n.a), (*this)(n.a));
        case operation::pown: {
            auto result = std::optional((*this)(n.a));
            for (int k = 1; k < n.index && result; ++k) result = product(*result, (*this)(n.a));
            return n.index > 0 ? result : std::nullopt;
        }
        case operation::div: {
            auto below = (*this)(n.b).reciprocal();
            if (!below && !(*this)(n.b).is_zero()) below = node_polynomial::node(n.b).reciprocal();
            if (!below) return std::nullopt;
            return product((*this)(n.a), *below);
        }
        default:
            return std::nullopt;
        }
    }
    std::optional<node_polynomial> sum(node_polynomial a, node_id b, std::int64_t sign) {
        if (!a.add((*this)(b), {sign, 1})) return std::nullopt;
        return a;
    }
    static std::optional<node_polynomial> product(node_polynomial const& a,
                                                  node_polynomial const& b) {
        if (a.size() * b.size() > 20 * most_terms) return std::nullopt;
        return node_polynomial::product(a, b);
    }

    graph const* g_;
    std::map<node_id, node_polynomial> done_;
};

/// Whether a function that jumps depends on something that moves.
inline bool jumps_along(bound_model const& model, model_motion const& motion) {
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

/// Whether a motion of parameters and initial states moves the trajectories by the same motion of
/// the states and leaves all outputs as they are. With v the velocity of the motion (w_j p_j or w_j
/// for parameters, likewise for states) that is
///   \f$ \sum_j v_j \partial f_i/\partial p_j + \sum_k v_k \partial f_i/\partial x_k = w_i f_i \f$
/// (0 on the right for a translation) and the same with 0 for every output; these identities are
/// multiplied out and compared term by term, with functions other than + - * / and powers as
/// variables of their own.
/// @guarantee  true is a theorem about the equations: the sensitivities along v vanish, whatever
/// the
///             inputs of the sampled kind; false says nothing
/// @cost  sums of up to 200 terms a node
/// @ref   Yates, Evans and Chappell, Structural identifiability analysis via symmetries of
///        differential equations, Automatica 45 (2009)
[[nodiscard]] inline bool is_symmetry(bound_model const& model, model_motion const& motion) {
    using namespace model_detail;
    if (jumps_along(model, motion)) return false;
    auto g = model.g;
    bool const scales = motion.kind == motion_kind::scaling;
    std::vector<node_id> x, p;
    for (std::size_t i = 0; i < model.state_count(); ++i) x.push_back(g.leaf(operation::state, i));
    for (std::size_t j = 0; j < model.parameter_count(); ++j) {
        p.push_back(g.leaf(operation::constant, j));
    }
    multiplied_out multiplied(g);
    // Adds w v(leaf) times the derivative.
    auto const along = [&](node_polynomial& sum, int w, node_id leaf, node_id derivative) {
        if (w == 0) return true;
        auto term = std::optional(multiplied(derivative));
        if (scales) term = node_polynomial::product(*term, multiplied(leaf));
        return term && sum.add(*term, {w, 1});
    };
    auto const holds = [&](node_id f, std::vector<node_id> const& dx,
                           std::vector<node_id> const& dp, int weight) {
        node_polynomial sum;
        for (std::size_t j = 0; j < p.size(); ++j) {
            if (!along(sum, motion.parameters[j], p[j], dp[j])) return false;
        }
        for (std::size_t i = 0; i < x.size(); ++i) {
            if (!along(sum, motion.states[i], x[i], dx[i])) return false;
        }
        if (scales && weight != 0 && !sum.add(multiplied(f), {-weight, 1})) return false;
        return sum.is_zero();
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
