// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_STATED_EQUATION_HPP
#define SIVID_PAVING_RELATION_DETAIL_STATED_EQUATION_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/paving/relation/detail/observed_motion.hpp>
#include <sivid/paving/relation/detail/parted_functions.hpp>
#include <sivid/paving/relation/detail/relation_row.hpp>
#include <sivid/paving/relation/detail/weak_equation.hpp>
#include <sivid/paving/relation/integrand_set.hpp>
#include <sivid/paving/relation/relation_finding.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// Equation i as something that is zero along every motion: \f$ \sum_k M_{ik} x_k' - f_i \f$ of a
/// model that states it so, without forces of constraints, else \f$ x_i' - f_i \f$. The rate of
/// state k stands as the leaf of input number (inputs + k), or as the state that it is.
[[nodiscard]] inline node_id stated_equation(bound_model& model, std::size_t i) {
    auto& g = model.g;
    auto const rate = [&](std::size_t k) {
        bool const named = g[model.rate[k]].op == operation::state;
        return named ? model.rate[k] : g.leaf(operation::input, model.about.inputs.size() + k);
    };
    auto const n = model.state_count();
    auto const row = model.stated ? model.stated->mass[i] : std::vector<node_id>{};
    bool free = !row.empty();
    for (std::size_t k = n; k < row.size(); ++k) free = free && g.is(row[k], 0);
    if (!free) return g.sub(rate(i), model.rate[i]);
    auto sum = g.constant(0.0);
    for (std::size_t k = 0; k < n; ++k) sum = g.add(sum, g.mul(row[k], rate(k)));
    return g.sub(sum, model.stated->force[i]);
}

/// Encloses the rates over each cell of a motion; unbounded where they may be undefined.
[[nodiscard]] inline std::vector<box> rates_along(bound_model const& model,
                                                  observed_motion const& motion) {
    graph_range range(model.g, model.rate);
    std::vector<box> result;
    for (auto const& cell : motion.cells) {
        range.evaluate(cell.at);
        auto& rates = result.emplace_back(model.state_count());
        for (std::size_t k = 0; k < rates.size(); ++k) {
            auto const f = model.rate[k];
            rates[k] = range.undefined(f) ? interval_traits<interval>::entire() : range.value(f);
        }
    }
    return result;
}

/// The stated equations of states that are not measured while their integrals are, and windows of
/// them: \f$ q' = r \f$, equation r.
class stated_relations {
public:
    stated_relations() = default;
    /// @param model  outlives this; nodes are added to its graph
    /// @param pairs  with q sampled
    /// @param seen   whether r is, too
    stated_relations(bound_model& model, box const& prior, std::vector<derivative_pair> pairs,
                     std::function<bool(std::size_t)> const& seen)
        : model_(&model), prior_(prior), all_(std::move(pairs)) {
        std::copy_if(all_.begin(), all_.end(), std::back_inserter(unseen_),
                     [&](derivative_pair const& p) { return !seen(p.r); });
    }

    /// The pair of equation i.
    [[nodiscard]] std::optional<derivative_pair> pair_of(std::size_t i) const {
        return pair_of_rate(all_, i);
    }
    /// Whether the coefficients of equation i are bounded.
    /// @given  `pair_of(i)`
    [[nodiscard]] bool bounded(std::size_t i) { return at(i).plain.bounded; }
    /// @given  something else was asked of equation i
    [[nodiscard]] relation_row const& row(std::size_t i, bool middle) const {
        return middle ? equations_.at(i).middle : equations_.at(i).plain;
    }
    /// Windows of all motions, for the plain row or the one about the middle of its coefficients.
    /// @given  `pair_of(i)`, and always the same motions and lengths
    [[nodiscard]] std::vector<window_row> windows(std::size_t i, bool middle,
                                                  std::vector<observed_motion> const& motions,
                                                  relation_options const& options) {
        auto& e = at(i);
        for (std::size_t m = 0; !e.asked && e.plain.bounded && m < motions.size(); ++m) {
            if (rates_.size() == m) rates_.push_back(rates_along(*model_, motions[m]));
            parted_functions const parted(e.set, e.middle.centre, motions[m], rates_[m],
                                          pair_of(i)->q, unseen_);
            auto more = weak_equation(parted).over(m, options);
            std::move(more.begin(), more.end(), std::back_inserter(e.windows));
        }
        e.asked = true;
        auto result = e.windows;
        for (auto& w : result) w.a.erase(w.a.end() - (middle ? 2 : 1));
        return result;
    }

private:
    struct equation {
        relation_row plain, middle;
        integrand_set set;
        bool asked = false;
        std::vector<window_row> windows{}; ///< a: of functions, of \f$ \psi_0 \f$, of the sum
    };
    [[nodiscard]] equation& at(std::size_t i) {
        if (auto const known = equations_.find(i); known != equations_.end()) return known->second;
        auto& e = equations_[i];
        auto& g = model_->g;
        e.plain = make_relation_row(g, stated_equation(*model_, i), i, prior_);
        e.middle = e.plain;
        combine(g, e.middle, 0);
        auto functions = e.plain.functions;
        functions.push_back(e.middle.functions.back());
        auto const n = model_->state_count();
        e.set = integrand_set::of(g, functions, n, model_->about.inputs.size() + n);
        return e;
    }

    bound_model* model_ = nullptr;
    box prior_;
    std::vector<derivative_pair> all_, unseen_;
    std::map<std::size_t, equation> equations_;
    std::vector<std::vector<box>> rates_; ///< along each motion
};

} // namespace sivid

#endif
