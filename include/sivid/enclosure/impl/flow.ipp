// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_IMPL_FLOW_IPP
#define SIVID_ENCLOSURE_IMPL_FLOW_IPP

#include <sivid/enclosure/flow.hpp>

#include <sivid/model/change/detail/resting_models.hpp>

namespace sivid {

SIVID_DECL flow::flow(recorded_model const& model, parameter_choice const& choice,
                      std::vector<signal> const& inputs, std::optional<region_of_runs> const& runs)
    : flow(model, choice, inputs, runs, 0) {}

SIVID_DECL flow::flow(recorded_model const& model, parameter_choice const& choice,
                      std::vector<signal> const& inputs, std::optional<region_of_runs> const& runs,
                      std::size_t sticking)
    : model_(bind(model, choice, inputs, runs)), signals_(inputs.size()) {
    for (auto const i : model_.sampled) signals_[i] = std::get<sampled_signal>(inputs[i]);
    rate_ = tape(model_.g, model_.rate);
    rate_state_jacobian_ = with_jacobian(model_.rate, model_.rate_dx, {}, entries_);
    state_entries_ = std::exchange(entries_, {}).size();
    rate_jacobian_ = with_jacobian(model_.rate, model_.rate_dx, model_.rate_dp, entries_);
    observe_ = tape(model_.g, model_.observe);
    observe_jacobian_ =
        with_jacobian(model_.observe, model_.observe_dx, model_.observe_dp, observe_entries_);
    find_structure();
    constexpr std::size_t most = 2; // that stick at once: each pair is a flow of its own
    if (uncertain() || sticking == most) return;
    auto models = resting_models(model, sticking);
    if (models.empty()) return;
    auto const shared = std::make_shared<std::vector<signal> const>(inputs); // long, in all of them
    for (auto& r : models) {
        at_rest_.emplace_back(r.state, [=, own = std::move(r.model)] {
            return std::unique_ptr<flow const>(
                new flow(own, choice, *shared, std::nullopt, sticking + 1));
        });
    }
}

} // namespace sivid

#endif
