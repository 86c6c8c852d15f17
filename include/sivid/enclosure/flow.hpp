// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_FLOW_HPP
#define SIVID_ENCLOSURE_FLOW_HPP

#include <sivid/compiled.hpp>
#include <sivid/measurement/signal.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/tape.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// One structurally non-zero entry of a Jacobian and the output of its tape that holds it.
struct jacobian_entry {
    std::size_t row = 0;
    std::size_t column = 0; ///< a state, or state_count + a parameter
    std::size_t output = 0;
};

/// An initial value problem as programs: x' = f(t, x, p, u(t)), with the inputs of one scenario.
/// Immutable after construction; shared by all boxes and threads.
class flow {
public:
    /// @param runs  where given, the flow is for these runs alone: states that rest in all of them
    ///              are numbers (`bind`)
    flow(recorded_model const& model, parameter_choice const& choice,
         std::vector<signal> const& inputs, std::optional<region_of_runs> const& runs = {});

    [[nodiscard]] bound_model const& model() const { return model_; }
    [[nodiscard]] std::size_t states() const { return model_.state_count(); }
    [[nodiscard]] std::size_t parameters() const { return model_.parameter_count(); }
    [[nodiscard]] std::size_t channels() const { return model_.channel_count(); }

    [[nodiscard]] tape const& rate() const { return rate_; }
    /// Rates first (outputs 0 .. n-1), then the entries of `entries()`.
    [[nodiscard]] tape const& rate_jacobian() const { return rate_jacobian_; }
    [[nodiscard]] std::vector<jacobian_entry> const& entries() const { return entries_; }
    /// The same without derivatives by parameters: of `entries()` the first ones.
    [[nodiscard]] tape const& rate_state_jacobian() const { return rate_state_jacobian_; }
    [[nodiscard]] std::size_t state_entries() const { return state_entries_; }
    [[nodiscard]] tape const& observe() const { return observe_; }
    [[nodiscard]] tape const& observe_jacobian() const { return observe_jacobian_; }
    [[nodiscard]] std::vector<jacobian_entry> const& observe_entries() const {
        return observe_entries_;
    }
    /// The state's own range, in which it is measured where norms are taken over states.
    [[nodiscard]] double own_range(std::size_t i) const {
        double const limit = model_.about.states[i].limit;
        return limit > 0 && limit < 1e100 ? limit : 1e6; // else it is no range
    }
    /// A millionth of it: what is smaller counts as so large, for tolerances. Ranges are generous.
    [[nodiscard]] double small(std::size_t i) const { return 1e-6 * own_range(i); }
    /// Whether \f$ \partial x_i(t) / \partial (x_0, p)_c \f$ can be non-zero.
    [[nodiscard]] bool sensitive(std::size_t i, std::size_t c) const {
        return sensitive_[i * (states() + parameters()) + c];
    }

    [[nodiscard]] sampled_signal const& input(std::size_t i) const { return signals_[i]; }
    /// All of them; those that stand in the model already, as formulas or numbers, are empty.
    [[nodiscard]] std::vector<signal> inputs() const { return {signals_.begin(), signals_.end()}; }
    [[nodiscard]] std::vector<std::size_t> const& sampled_inputs() const { return model_.sampled; }
    /// Whether an input has an error bound: each trajectory of the flow then stands for all those
    /// that the inputs within their bounds cause.
    [[nodiscard]] bool uncertain() const { return !model_.uncertain.empty(); }
    /// The inputs with error bounds, by index in the model.
    [[nodiscard]] std::vector<std::size_t> const& uncertain_inputs() const {
        return model_.uncertain;
    }
    /// A state that may stick at 0 by its sign.
    class resting {
    public:
        resting(std::size_t state, std::function<std::unique_ptr<flow const>()> make)
            : state_(state), equations_(std::make_shared<lazy>()) {
            equations_->make = std::move(make);
        }
        [[nodiscard]] std::size_t state() const { return state_; }
        /// The flow while it does, made when it is asked for first, by any thread: its outputs are
        /// conditions (`resting_models`).
        [[nodiscard]] flow const& equations() const {
            std::call_once(equations_->once, [this] {
                equations_->made = equations_->make();
                equations_->make = nullptr; // with the inputs it holds
            });
            return *equations_->made;
        }

    private:
        struct lazy {
            std::function<std::unique_ptr<flow const>()> make;
            std::once_flag once;
            std::unique_ptr<flow const> made;
        };
        std::size_t state_;
        std::shared_ptr<lazy> equations_;
    };
    /// None where inputs have error bounds.
    [[nodiscard]] std::vector<resting> const& at_rest() const { return at_rest_; }
    /// First knot of a sampled input strictly after t, or +infinity.
    [[nodiscard]] double next_knot(double t) const {
        double next = HUGE_VAL;
        for (auto const i : model_.sampled) next = std::min(next, signals_[i].next_knot(t));
        return next;
    }

private:
    /// While so many states stick.
    flow(recorded_model const& model, parameter_choice const& choice,
         std::vector<signal> const& inputs, std::optional<region_of_runs> const& runs,
         std::size_t sticking);
    [[nodiscard]] tape with_jacobian(std::vector<node_id> const& values,
                                     std::vector<std::vector<node_id>> const& dx,
                                     std::vector<std::vector<node_id>> const& dp,
                                     std::vector<jacobian_entry>& entries) const {
        auto outputs = values;
        auto const collect = [&](std::vector<std::vector<node_id>> const& d, std::size_t offset) {
            for (std::size_t i = 0; i < d.size(); ++i) {
                for (std::size_t j = 0; j < d[i].size(); ++j) {
                    if (model_.g.is(d[i][j], 0)) continue;
                    entries.push_back({i, offset + j, outputs.size()});
                    outputs.push_back(d[i][j]);
                }
            }
        };
        collect(dx, 0);
        collect(dp, states());
        return tape(model_.g, outputs, values.size());
    }

    /// Transitive closure of the Jacobian's pattern.
    void find_structure() {
        auto const n = states();
        auto const columns = n + parameters();
        sensitive_.assign(n * columns, false);
        for (std::size_t i = 0; i < n; ++i) sensitive_[i * columns + i] = true;
        for (auto const& e : entries_) {
            if (e.column >= n) sensitive_[e.row * columns + e.column] = true;
        }
        for (bool changed = true; changed;) {
            changed = false;
            for (auto const& e : entries_) {
                if (e.column >= n) continue;
                for (std::size_t c = 0; c < columns; ++c) {
                    if (sensitive_[e.column * columns + c] && !sensitive_[e.row * columns + c]) {
                        sensitive_[e.row * columns + c] = true;
                        changed = true;
                    }
                }
            }
        }
    }

    bound_model model_;
    std::vector<sampled_signal> signals_;
    std::size_t state_entries_ = 0;
    tape rate_, rate_jacobian_, rate_state_jacobian_, observe_, observe_jacobian_;
    std::vector<jacobian_entry> entries_, observe_entries_;
    std::vector<bool> sensitive_;
    std::vector<resting> at_rest_;
};

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/enclosure/impl/flow.ipp>
#endif

#endif
