// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_STRUCTURE_IMPL_STATE_SUM_IPP
#define SIVID_MODEL_STRUCTURE_IMPL_STATE_SUM_IPP

#include <sivid/model/structure/state_sum.hpp>

#include <sivid/model/graph/detail/fraction_coefficients.hpp>
#include <sivid/model/graph/normal_form.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace sivid {

namespace model_detail {

/// The echelon form of `find_state_sums`.
class sum_elimination {
    using expansion = multiplied_out<fraction_coefficients>;
    using entry = expansion::terms; ///< a Laurent polynomial of constants: product -> fraction

public:
    /// A sum of states, and the functions in its rate.
    struct row {
        std::map<std::size_t, entry> weights;
        std::map<node_product, entry> rate;
        bool cancelled = false; ///< something that is not affine was in it
    };

    sum_elimination(graph const& g, std::vector<node_id> const& rates)
        : g_(&g), multiplied_(fraction_coefficients(g), {200, 4000}) {
        for (std::size_t i = 0; i < rates.size(); ++i) {
            row own{{{i, {{{}, {1, 1}}}}}, {}};
            for (auto const& [product, v] : multiplied_(rates[i])) {
                node_product constants, function;
                for (auto const& factor : product) {
                    bool const known = (g.depends(factor.first) & ~on_constant) == 0;
                    (known ? constants : function).push_back(factor);
                }
                own.rate[function][constants] = v;
            }
            rows_.push_back(std::move(own));
        }
    }

    /// Sums that are left when rows are taken in turn from one on, each with its first state.
    /// @param take  called with (state, row)
    template <class Take>
    void collect(std::size_t from, Take const& take) {
        auto rows = rows_;
        std::rotate(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(from), rows.end());
        std::set<node_product> tried;
        while (auto const column = next_column(rows, tried)) {
            tried.insert(*column);
            if (!eliminate(rows, *column)) return;
            for (auto r : rows) {
                int most = 0;
                for (auto const& f : r.rate) most = std::max(most, degree(f.first));
                if (r.weights.size() < 2 || most > (r.cancelled ? 1 : 0)) continue;
                auto const unit = std::find_if(r.weights.begin(), r.weights.end(),
                                               [](auto const& w) { return w.second.size() == 1; });
                if (unit == r.weights.end()) continue;
                auto const share = inverse(unit->second);
                if (scale(r.weights, share) && scale(r.rate, share)) take(unit->first, r);
            }
        }
    }

private:
    /// How far a product is from an affine function: 0 without states, 1 linear in one of them.
    [[nodiscard]] int degree(node_product const& function) const {
        int result = 0;
        for (auto const& [node, e] : function) {
            if ((g_->depends(node) & on_state) == 0) continue;
            result += (*g_)[node].op == operation::state && e > 0 ? e : 2;
        }
        return result;
    }
    /// The function of the greatest degree that is left; of those the one in most rows. What does
    /// not depend on states stays.
    [[nodiscard]] std::optional<node_product> next_column(std::vector<row> const& rows,
                                                          std::set<node_product> const& but) const {
        std::map<node_product, int> count;
        for (auto const& r : rows)
            for (auto const& f : r.rate) ++count[f.first];
        std::optional<node_product> best;
        std::pair<int, int> most{0, 0};
        for (auto const& [function, n] : count) {
            int const own = degree(function);
            if (own == 0 || but.count(function) > 0 || std::pair(own, n) <= most) continue;
            most = {own, n};
            best = function;
        }
        return best;
    }
    [[nodiscard]] static entry inverse(entry const& unit) {
        auto const& [product, v] = *unit.begin();
        auto const sign = v.above < 0 ? -1 : 1;
        return {{quotient({}, product), {sign * v.below, sign * v.above}}};
    }
    /// Takes a function out of all rows by one in which its coefficient is a single product; that
    /// row goes, and where there is none, all rows with the function go.
    /// @returns false where numbers grow too large
    [[nodiscard]] bool eliminate(std::vector<row>& rows, node_product const& function) {
        auto const has = [&](row const& r) { return r.rate.count(function) > 0; };
        auto const pivot = std::find_if(rows.begin(), rows.end(), [&](row const& r) {
            return has(r) && r.rate.at(function).size() == 1;
        });
        if (pivot == rows.end()) {
            std::erase_if(rows, has);
            return true;
        }
        auto const by = *pivot;
        rows.erase(pivot);
        auto const own = inverse(by.rate.at(function));
        for (auto& r : rows) {
            if (!has(r)) continue;
            auto const share = multiplied_.product(r.rate.at(function), own);
            if (!share || !subtract(r.weights, by.weights, *share) ||
                !subtract(r.rate, by.rate, *share))
                return false;
            r.cancelled = r.cancelled || by.cancelled || degree(function) > 1;
        }
        return true;
    }
    template <class Key>
    [[nodiscard]] bool subtract(std::map<Key, entry>& to, std::map<Key, entry> const& more,
                                entry const& share) {
        for (auto const& [key, value] : more) {
            auto const part = multiplied_.product(value, share);
            if (!part || !multiplied_.add(to[key], *part, {-1, 1})) return false;
            if (to[key].empty()) to.erase(key);
        }
        return true;
    }
    /// @returns false where numbers grow too large for doubles
    template <class Key>
    [[nodiscard]] bool scale(std::map<Key, entry>& to, entry const& share) {
        constexpr std::int64_t most = std::int64_t{1} << 53;
        for (auto& [key, value] : to) {
            auto part = multiplied_.product(value, share);
            if (!part) return false;
            value = *std::move(part);
            for (auto const& [product, v] : value)
                if (std::abs(v.above) > most || v.below > most) return false;
        }
        return true;
    }

    graph const* g_;
    expansion multiplied_;
    std::vector<row> rows_;
};

inline node_id node_of(graph& g, node_product const& product) {
    auto above = g.constant(1.0), below = above;
    for (auto const& [node, e] : product) {
        auto& side = e > 0 ? above : below;
        auto const power = std::abs(e) == 1 ? node : g.pown(node, std::abs(e));
        side = g.is(side, 1) ? power : g.mul(side, power);
    }
    return g.is(below, 1) ? above : g.div(above, below);
}

} // namespace model_detail

SIVID_DECL std::vector<state_sum> find_state_sums(graph& g, std::vector<node_id> const& rates) {
    using namespace model_detail;
    constexpr std::size_t most = 24;
    if (rates.size() < 2 || rates.size() > most) return {};
    auto const number = [&g](small_fraction const& v) {
        return g.div(g.constant(static_cast<double>(v.above)),
                     g.constant(static_cast<double>(v.below)));
    };
    std::vector<state_sum> result;
    auto const take = [&](std::size_t first, sum_elimination::row const& r) {
        state_sum sum{first, {}, g.constant(0.0)};
        for (auto const& [i, a] : r.weights) {
            for (auto const& [product, v] : a) {
                auto const factor = number(v);
                auto const value = g.mul(factor, node_of(g, product));
                if (i != first) sum.weights.push_back({i, product, factor, value});
            }
        }
        if (std::any_of(result.begin(), result.end(), [&](state_sum const& known) {
                return known.first == first && known.weights == sum.weights;
            }))
            return;
        for (auto const& [function, coefficient] : r.rate) {
            for (auto const& [product, v] : coefficient) {
                auto const own = g.mul(number(v), node_of(g, product));
                sum.rate = g.add(sum.rate, g.mul(own, node_of(g, function)));
            }
        }
        result.push_back(std::move(sum));
    };
    auto const same = graph(g);
    sum_elimination elimination(same, rates);
    for (std::size_t k = 0; k < rates.size(); ++k) elimination.collect(k, take);
    std::stable_sort(result.begin(), result.end(), [](auto const& a, auto const& b) {
        return a.weights.size() < b.weights.size();
    });
    if (result.size() > 2 * rates.size()) result.resize(2 * rates.size());
    return result;
}

} // namespace sivid

#endif
