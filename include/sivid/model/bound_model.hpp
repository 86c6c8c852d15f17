// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_BOUND_MODEL_HPP
#define SIVID_MODEL_BOUND_MODEL_HPP

#include <sivid/compiled.hpp>
#include <sivid/measurement/signal.hpp>
#include <sivid/model/graph/differentiate.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>
#include <sivid/model/parameter_choice.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// An input given by a formula in time, recorded once.
struct analytic_signal {
    graph g;
    node_id value = 0;

    /// From a functor on a scalar: `analytic_signal::from([](auto const& t) { return sin(t); })`.
    template <class F>
    [[nodiscard]] static analytic_signal from(F const& f) {
        analytic_signal s;
        expression const t(s.g, s.g.leaf(operation::time, 0));
        s.value = expression(f(t)).in(s.g);
        return s;
    }
};

/// An input of a scenario: recorded samples or a formula.
using signal = std::variant<sampled_signal, analytic_signal>;

/// Whether a signal is known up to an error bound only; formulas are exact.
[[nodiscard]] inline bool is_uncertain(signal const& s) {
    auto const* sampled = std::get_if<sampled_signal>(&s);
    return sampled != nullptr && !sampled->exact();
}
[[nodiscard]] inline bool any_uncertain(std::vector<signal> const& inputs) {
    return std::any_of(inputs.begin(), inputs.end(), is_uncertain);
}
/// The inputs as recorded, which are among those that their error bounds allow.
[[nodiscard]] inline std::vector<signal> nominal(std::vector<signal> inputs) {
    for (auto& s : inputs) {
        if (is_uncertain(s)) s = std::get<sampled_signal>(s).nominal();
    }
    return inputs;
}

/// A model with its constants bound and its analytic inputs inserted: the graph that is simulated
/// and enclosed. `operation::constant` leaves are now the unknown parameters p.
struct bound_model {
    model_description about;
    std::vector<std::size_t> parameters; ///< index of each unknown among the model's constants
    std::vector<std::size_t> sampled;    ///< inputs that are sampled, by index in the model
    std::vector<std::size_t> uncertain;  ///< those of them that have error bounds
    graph g;
    std::vector<node_id> rate;
    std::vector<node_id> observe;
    std::optional<stated_equations> stated;                   ///< see `recorded_model`
    std::vector<std::vector<node_id>> rate_dx, rate_dp;       ///< \f$ \partial f/\partial x, p \f$
    std::vector<std::vector<node_id>> observe_dx, observe_dp; ///< \f$ \partial g/\partial x, p \f$
    std::vector<std::vector<node_id>> rate_du; ///< \f$ \partial f/\partial u \f$, uncertain inputs

    [[nodiscard]] std::size_t state_count() const { return rate.size(); }
    [[nodiscard]] std::size_t parameter_count() const { return parameters.size(); }
    [[nodiscard]] std::size_t channel_count() const { return observe.size(); }
};

/// Whether a memory acts in an experiment with these inputs.
[[nodiscard]] inline bool acts_in(signal_memory const& m, std::vector<signal> const& inputs) {
    if (!m.only_if) return true;
    auto const* const on = std::get_if<analytic_signal>(&inputs.at(*m.only_if));
    return on == nullptr || !on->g.is(on->value, 0);
}
/// Whether a memory of a channel acts on what that shows at t.
[[nodiscard]] inline bool acts_at(signal_memory const& m, std::vector<signal> const& inputs,
                                  double t) {
    if (!acts_in(m, inputs)) return false;
    auto const* const on =
        m.only_if ? std::get_if<sampled_signal>(&inputs.at(*m.only_if)) : nullptr;
    return on == nullptr || on->approximate(t) != 0; // held
}

/// Where all runs of a bound model begin, and the parameters that they have.
struct region_of_runs {
    box starts, parameters;
};

/// Binds constants and inputs, folds what became constant, and differentiates. Derived constants
/// that follow their formulas (`followed`) become functions of the others.
/// @param inputs  one signal per input of the model
/// @param runs    where given, the result holds for these runs alone: inputs that do not change and
///                states that rest (`resting_states`) become numbers, and derivatives by such
///                states 0
/// @given  the model has no delays (checked): they have to be resolved first
/// @throws std::invalid_argument on unknown names, a wrong number of inputs, or an empty value
[[nodiscard]] SIVID_DECL bound_model bind(recorded_model const& model,
                                          parameter_choice const& choice,
                                          std::vector<signal> const& inputs,
                                          std::optional<region_of_runs> const& runs = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/impl/bound_model.ipp>
#endif

#endif
