// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_CHANGE_DETAIL_DRIVING_PRODUCTS_HPP
#define SIVID_MODEL_CHANGE_DETAIL_DRIVING_PRODUCTS_HPP

/// @file
/// How recorded inputs drive a model, and the model in states without what lines leave of them: the
/// algebra of `with_slower_inputs`.

#include <sivid/model/graph/differentiate.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid::model_detail {

/// The functions of recorded inputs alone that drive a model, and the model with an input in place
/// of each.
struct driven_model {
    std::vector<node_id> functions; ///< in the original graph
    std::vector<bool> replaced;     ///< of the original's inputs
    graph g;                        ///< function j is input (number of inputs) + j
    std::vector<node_id> rate, observe, at_begin;
    std::vector<bool> of_held; ///< per function
};

/// What the nodes of a model are functions of.
struct kinds_of_nodes {
    enum kind : char { other, number, slow_one, fast_one };
    std::vector<kind> of;
    std::vector<bool> of_held; ///< of inputs that are all held
};
inline kinds_of_nodes kinds_of(graph const& g, std::vector<bool> const& fast,
                               std::vector<bool> const& recorded, std::vector<bool> const& held) {
    using enum kinds_of_nodes::kind;
    kinds_of_nodes result{std::vector(g.size(), other), std::vector<bool>(g.size(), true)};
    auto& [kind, of_held] = result;
    for (std::size_t k = 0; k < g.size(); ++k) {
        auto const& n = g.nodes()[k];
        auto const i = static_cast<std::size_t>(n.index);
        if (n.op == operation::literal) {
            kind[k] = number;
        } else if (n.op == operation::input) {
            kind[k] = fast[i] ? fast_one : recorded[i] ? slow_one : other;
            of_held[k] = held[i];
        } else if (!is_leaf(n.op)) {
            auto const b = is_binary(n.op) ? n.b : n.a;
            if (kind[n.a] == other || kind[b] == other) continue;
            kind[k] = std::max(kind[n.a], kind[b]);
            of_held[k] = of_held[n.a] && of_held[b];
        }
    }
    return result;
}

/// @param fast      of the inputs; a function of one of them is replaced if all its inputs are ...
/// @param recorded  ... recorded
/// @param held      of the inputs
/// @returns nothing where a function is neither held nor an input itself
inline std::optional<driven_model> driven_by(recorded_model const& model,
                                             std::vector<bool> const& fast,
                                             std::vector<bool> const& recorded,
                                             std::vector<bool> const& held) {
    auto const& from = model.g;
    driven_model result;
    auto outputs = model.rate;
    outputs.insert(outputs.end(), model.observe.begin(), model.observe.end());
    for (auto const& a : model.added_states) outputs.push_back(a.at_begin);
    auto const needed = operands_of(from, outputs);
    auto const kinds = kinds_of(from, fast, recorded, held);
    auto const is_fast = [&](std::size_t k) { return kinds.of[k] == kinds_of_nodes::fast_one; };
    std::vector<node_id> image(from.size(), 0);
    bool fits = true;
    auto const driver = [&](std::size_t k) {
        auto const function = static_cast<node_id>(k);
        auto at = std::find(result.functions.begin(), result.functions.end(), function);
        auto const j = static_cast<std::size_t>(at - result.functions.begin());
        if (at == result.functions.end()) {
            result.functions.push_back(function);
            result.of_held.push_back(kinds.of_held[k]);
            fits = fits && (kinds.of_held[k] || from.nodes()[k].op == operation::input);
        }
        return result.g.leaf(operation::input, fast.size() + j);
    };
    auto const of = [&](node_id i) { return is_fast(i) ? driver(i) : image[i]; };
    for (std::size_t k = 0; k < from.size(); ++k) {
        if (!needed[k] || is_fast(k)) continue;
        auto const& n = from.nodes()[k];
        if (n.op == operation::literal) {
            image[k] = result.g.constant(from.value(n));
        } else if (is_leaf(n.op)) {
            image[k] = same_leaf{}(n, result.g);
        } else {
            auto const a = of(n.a);
            image[k] = same_operation()(n, a, is_binary(n.op) ? of(n.b) : a, result.g);
        }
    }
    for (auto const i : model.rate) result.rate.push_back(of(i));
    for (auto const i : model.observe) result.observe.push_back(of(i));
    for (auto const& a : model.added_states) result.at_begin.push_back(of(a.at_begin));
    if (!fits) return std::nullopt;
    result.replaced = fast;
    return result;
}

/// The model in z, with p and U of each driving product as inputs behind those that stay.
struct integrated_model {
    recorded_model model;
    std::vector<std::vector<std::size_t>> products; ///< of one or two functions
};

inline bool is_function(driven_model const& d, node const& n) {
    return n.op == operation::input && static_cast<std::size_t>(n.index) >= d.replaced.size();
}

/// Whether no function is seen but by the rates, and none goes there into what has a kink: a
/// derivative does not tell affine from affine on either side of a kink, nor from constant on
/// either side of a jump.
inline bool drives_smoothly(driven_model const& d) {
    auto const& g = d.g;
    auto seen_later = d.observe; // what sees inputs without an integral
    seen_later.insert(seen_later.end(), d.at_begin.begin(), d.at_begin.end());
    for (auto const i : leaves_of(g, seen_later, operation::input)) {
        if (i >= d.replaced.size()) return false;
    }
    auto const used = operands_of(g, d.rate);
    std::vector<bool> of_function(g.size(), false);
    for (std::size_t k = 0; k < g.size(); ++k) {
        auto const& n = g.nodes()[k];
        if (is_leaf(n.op)) {
            of_function[k] = is_function(d, n);
            continue;
        }
        of_function[k] = of_function[n.a] || (is_binary(n.op) && of_function[n.b]);
        if (used[k] && has_kink(n.op) && of_function[k]) return false;
    }
    return true;
}

/// Rates as a sum of what is driven by nothing and, for each product of functions, a gain times the
/// product.
struct gains_of_products {
    std::vector<std::vector<std::size_t>> products; ///< of one or two functions
    graph h;
    std::vector<node_id> rest;  ///< in h, as the gains
    std::vector<node_id> gains; ///< B, one after the other for each product: by state
};

/// The first and second derivatives of the rates by the functions w, at w = 0.
/// @returns nothing where a function drives by its square, or by a product with an input
inline std::optional<gains_of_products> gains_of(driven_model& d) {
    auto const states = d.rate.size(), functions = d.functions.size();
    auto& g = d.g;
    std::vector<node_id> w;
    for (std::size_t j = 0; j < functions; ++j)
        w.push_back(g.leaf(operation::input, d.replaced.size() + j));
    auto const first = differentiate(g, d.rate, w);
    gains_of_products result;
    std::vector<node_id> gains;
    for (std::size_t j = 0; j < functions; ++j) {
        result.products.push_back({j});
        for (std::size_t i = 0; i < states; ++i) gains.push_back(first[i][j]);
    }
    for (std::size_t j = 0; j < functions; ++j) {
        std::vector<node_id> column;
        for (std::size_t i = 0; i < states; ++i) column.push_back(first[i][j]);
        auto const second = differentiate(g, column, w);
        for (std::size_t l = 0; l < functions; ++l) {
            bool some = false;
            for (std::size_t i = 0; i < states; ++i) {
                if (g.is(second[i][l], 0)) continue;
                if (l == j || (g.depends(second[i][l]) & on_input) != 0) return std::nullopt;
                some = true;
            }
            if (!some || l < j) continue;
            result.products.push_back({j, l});
            for (std::size_t i = 0; i < states; ++i) gains.push_back(second[i][l]);
        }
    }
    auto const none = [&](node const& n, graph& to) {
        return is_function(d, n) ? to.constant(0.0) : same_leaf{}(n, to);
    };
    auto& h = result.h;
    result.rest = copy_into(h, g, d.rate, none);
    result.gains = copy_into(h, g, gains, none);
    for (std::size_t m = result.products.size(); m-- > 0;) { // what drives nothing
        auto const begin = result.gains.begin() + static_cast<std::ptrdiff_t>(m * states);
        auto const end = begin + static_cast<std::ptrdiff_t>(states);
        if (!std::all_of(begin, end, [&h](node_id b) { return h.is(b, 0); })) continue;
        result.gains.erase(begin, end);
        result.products.erase(result.products.begin() + static_cast<std::ptrdiff_t>(m));
    }
    return result;
}

/// Whether the gains depend on constants and on states that are not driven, and do not jump.
inline bool stay_smooth(gains_of_products const& b) {
    auto const& h = b.h;
    auto const states = b.rest.size();
    std::vector<bool> driven(states, false);
    for (std::size_t k = 0; k < b.gains.size(); ++k) {
        if ((h.depends(b.gains[k]) & (on_input | on_time)) != 0) return false;
        if (!h.is(b.gains[k], 0)) driven[k % states] = true;
    }
    auto const seen = operands_of(h, b.gains);
    for (std::size_t k = 0; k < seen.size(); ++k) {
        auto const& n = h.nodes()[k];
        bool const moved = n.op == operation::state && driven[static_cast<std::size_t>(n.index)];
        if (seen[k] && (moved || n.op == operation::sign)) return false;
    }
    return true;
}

/// The inputs that stay, then a line and an integral for each product.
/// @returns the place of each that stays
inline std::vector<std::size_t>
replace_inputs(model_description& about, std::vector<bool> const& replaced, std::size_t products) {
    auto const before = std::exchange(about.inputs, {});
    std::vector<std::size_t> position(before.size(), 0);
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (replaced[i]) continue;
        position[i] = about.inputs.size();
        about.inputs.push_back(before[i]);
    }
    for (char const* const what : {"line ", "integral "}) {
        for (std::size_t m = 1; m <= products; ++m)
            about.inputs.push_back({what + std::to_string(m), ""});
    }
    return position;
}

/// \f$ \dot z = f_0(z + B U) + B p - (\partial_x B \, f_0) U \f$, and all else at x = z + B U.
/// @param same  a leaf of the closed model where it is, or where its input is now
template <class Same>
void write_equations(recorded_model& made, driven_model const& d, gains_of_products& b,
                     std::size_t lines, Same const& same) {
    auto const states = d.rate.size(), products = b.products.size();
    std::vector<node_id> x;
    for (std::size_t i = 0; i < states; ++i) x.push_back(b.h.leaf(operation::state, i));
    auto const slopes = differentiate(b.h, b.gains, x);
    auto& to = made.g;
    auto const B = copy_into(to, b.h, b.gains, same);
    auto const line = [&](std::size_t m) { return to.leaf(operation::input, lines + m); };
    auto const U = [&](std::size_t m) { return to.leaf(operation::input, lines + products + m); };
    std::vector<node_id> moved; // x as a function of z and U
    for (std::size_t i = 0; i < states; ++i) {
        moved.push_back(to.leaf(operation::state, i));
        for (std::size_t m = 0; m < products; ++m) {
            moved[i] = to.add(moved[i], to.mul(B[m * states + i], U(m)));
        }
    }
    auto const shifted = [&](node const& n, graph& there) {
        return n.op == operation::state ? moved[static_cast<std::size_t>(n.index)] : same(n, there);
    };
    auto const at = copy_into(to, b.h, b.rest, shifted); // the rate itself of what is not driven
    made.rate = at;
    made.observe = copy_into(to, d.g, d.observe, shifted);
    for (std::size_t i = 0; i < states; ++i) {
        for (std::size_t m = 0; m < products; ++m) {
            auto const k = m * states + i;
            auto change = to.constant(0.0);
            auto const slope = copy_into(to, b.h, slopes[k], same);
            for (std::size_t s = 0; s < states; ++s) {
                if (!to.is(slope[s], 0)) change = to.add(change, to.mul(slope[s], at[s]));
            }
            auto const driving = to.sub(to.mul(B[k], line(m)), to.mul(change, U(m)));
            made.rate[i] = to.add(made.rate[i], driving);
        }
    }
}

/// @returns nothing where the rates are not sums of products of at most two different functions
///          with gains as `with_slower_inputs` needs them
inline std::optional<integrated_model> in_integrals(recorded_model const& model, driven_model d) {
    if (!drives_smoothly(d)) return std::nullopt;
    auto gains = gains_of(d);
    if (!gains || !stay_smooth(*gains)) return std::nullopt;
    integrated_model result{{}, gains->products};
    auto& made = result.model;
    made.about = model.about;
    auto const position = replace_inputs(made.about, d.replaced, result.products.size());
    auto const same = [&](node const& n, graph& there) {
        auto const k = static_cast<std::size_t>(n.index);
        return there.leaf(n.op, n.op == operation::input ? position[k] : k);
    };
    auto const lines = made.about.inputs.size() - 2 * result.products.size();
    write_equations(made, d, *gains, lines, same);
    auto& to = made.g;
    auto const begins = copy_into(to, d.g, d.at_begin, same);
    for (std::size_t a = 0; a < begins.size(); ++a) {
        made.added_states.push_back({model.added_states[a].state, begins[a]});
    }
    made.derived = model.derived;
    std::vector<node_id> values;
    for (auto const& c : model.derived) values.push_back(c.value);
    values = copy_into(to, model.g, values, same);
    for (std::size_t c = 0; c < values.size(); ++c) made.derived[c].value = values[c];
    return result;
}

} // namespace sivid::model_detail

#endif
