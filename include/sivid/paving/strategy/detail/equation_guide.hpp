// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STRATEGY_DETAIL_EQUATION_GUIDE_HPP
#define SIVID_PAVING_STRATEGY_DETAIL_EQUATION_GUIDE_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/paving/contract/window_contraction.hpp>
#include <sivid/paving/relation/detail/observed_motion.hpp>
#include <sivid/paving/relation/input_range.hpp>
#include <sivid/paving/relation/relation_contraction.hpp>
#include <sivid/paving/relation/state_samples.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

/// What the equations between samples tell while windows grow: of the prior, and of the states in
/// which windows begin.
/// @guarantee  every parameter that explains the data is in what is left of the prior, and the
///             motion that explains an experiment is in the states
class equation_guide {
    using traits = interval_traits<interval>;

public:
    /// @param recorded  outlives this; without outliers and delays
    /// @param carried   whose windows are carried: `recorded`, or the same with slower inputs, in
    ///                  which channels behind those of `recorded` show all of its states; outlives
    ///                  this
    equation_guide(identification_problem const& recorded, identification_problem const& carried,
                   std::function<bool()> keep_going)
        : recorded_(&recorded), carried_(&carried), keep_going_(std::move(keep_going)) {}

    [[nodiscard]] known_motions operator()(box const& prior) const {
        auto narrowed = *recorded_;
        narrowed.prior = prior;
        narrowed.prior = contract_by_relations(narrowed, {.keep_going = keep_going_, .rounds = 1});
        known_motions result{narrowed.prior, {}};
        if (is_empty(result.rest)) return result;
        auto motions = std::make_shared<std::vector<observed_motion>>();
        auto model = opened(narrowed);
        auto const sums = find_state_sums(model.g, model.rate);
        for (auto const& e : narrowed.experiments) {
            motions->push_back(
                proved_motion(model, narrowed.prior, e, measured_states(model, {&e}), 4, sums));
        }
        auto const shown = carried_ == recorded_
                               ? nullptr
                               : std::make_shared<bound_model const>(opened(*carried_));
        result.states = [guide = *this, motions, shown, rest = result.rest](std::size_t e,
                                                                            double t) {
            auto const x = states_in((*motions)[e], t);
            return shown ? guide.carried_states(*shown, rest, e, t, x) : x;
        };
        return result;
    }

private:
    /// A model whose inputs stay leaves.
    [[nodiscard]] static bound_model opened(identification_problem const& p) {
        std::vector<signal> const open(p.model.about.inputs.size(),
                                       sampled_signal({0.0}, {0.0}, interpolation::linear));
        return bind(p.model, p.choice, open);
    }
    /// What the cells that meet at a time have in common.
    [[nodiscard]] static box states_in(observed_motion const& motion, double t) {
        box result(std::vector<interval>(motion.tubes.size(), traits::entire()));
        auto const end = std::min(motion.boundary_at(t) + 1, motion.cells.size());
        for (auto k = end < 2 ? 0 : end - 2; k < end; ++k) {
            auto const& cell = motion.cells[k];
            if (!(cell.from <= t && t <= cell.to)) continue;
            for (std::size_t i = 0; i < result.size(); ++i) {
                result[i] = agreed(result[i], cell.at.states[i]);
            }
        }
        return result;
    }
    /// The states z of the model with slower inputs, which shows x = z + B U in channels of its
    /// own; B depends on no state that is moved.
    [[nodiscard]] box carried_states(bound_model const& shown, box const& rest, std::size_t e,
                                     double t, box const& x) const {
        auto const first = recorded_->model.about.channels.size();
        auto const& inputs = carried_->experiments[e].inputs;
        leaf_ranges at{interval(t), x, rest, box(inputs.size())};
        for (std::size_t u = 0; u < inputs.size(); ++u) at.inputs[u] = input_over(inputs[u], t, t);
        auto z = x;
        for (std::size_t i = 0; i < x.size(); ++i) {
            auto const channel = shown.observe[first + i];
            graph_range range(shown.g, {channel});
            auto without = at;
            without.states[i] = interval(0.0);
            range.evaluate(without);
            z[i] = range.undefined(channel) ? traits::entire()
                                            : traits::sub(x[i], range.value(channel));
        }
        return z;
    }

    identification_problem const* recorded_;
    identification_problem const* carried_;
    std::function<bool()> keep_going_;
};

} // namespace sivid::paving_detail

#endif
