// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_SIMULATE_APPROXIMATE_MODEL_HPP
#define SIVID_APPROXIMATE_SIMULATE_APPROXIMATE_MODEL_HPP

#include <sivid/approximate/simulate/approximate_program.hpp>
#include <sivid/approximate/simulate/detail/held_signs.hpp>
#include <sivid/approximate/simulate/late_signal.hpp>
#include <sivid/measurement/dead_time.hpp>
#include <sivid/model/bound_model.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// One structurally non-zero partial derivative: d output `row` / d argument `column`.
struct approximate_derivative {
    std::size_t row = 0, column = 0;
    std::size_t slot = 0; ///< of its value in the program's memory
};

/// A delay, play or rate limit of an input, or a delay of a channel: of an unknown size or of a
/// known one.
struct plain_memory {
    std::size_t index = 0;     ///< of the input or channel
    bool unknown = false;      ///< whether `parameter` is its size, else `size`
    std::size_t parameter = 0; ///< among the unknown parameters
    double size = 0;           ///< [time], or in the unit of the input
    memory_kind kind = memory_kind::delay;
    std::optional<std::size_t> when{}; ///< of a channel: while this held input is not 0

    [[nodiscard]] double value(std::vector<double> const& parameters) const {
        return unknown ? parameters[parameter] : size;
    }
    /// Of what moves in time.
    void add_to(dead_time& late, std::vector<double> const& parameters) const {
        constexpr double fastest = 0.99; // a clock that stands is none
        double const more = std::max(0.0, value(parameters));
        if (kind == memory_kind::drift)
            late.drift = std::min(fastest, late.drift + more);
        else
            late.delay += more;
    }
};

/// Rates or outputs with their partial derivatives, as programs in plain doubles.
struct approximate_function {
    approximate_program values;    ///< the outputs alone
    approximate_program expansion; ///< outputs, then the derivatives below
    std::vector<approximate_derivative> by_state, by_parameter, by_input, by_time;
};

/// A model bound to constants and inputs for simulation with sensitivities. Delays and plays are
/// kept.
class approximate_model {
public:
    approximate_model(recorded_model const& model, parameter_choice const& choice,
                      std::vector<signal> const& inputs) {
        if (inputs.size() != model.about.inputs.size()) {
            throw std::invalid_argument("model '" + model.about.name + "' has " +
                                        std::to_string(model.about.inputs.size()) +
                                        " inputs, but " + std::to_string(inputs.size()) +
                                        " signals were given");
        }
        input_memory_ = memory_of(model, choice, model.input_memory, inputs);
        channel_delays_ = memory_of(model, choice, model.channel_delays, inputs);
        auto prompt = with_held_signs(model);
        prompt.input_memory.clear();
        prompt.channel_delays.clear();
        // A formula with a memory is no formula in t: it is kept as an input.
        auto seen = inputs;
        for (auto const& d : input_memory_) {
            seen[d.index] = sampled_signal({0.0}, {0.0}, interpolation::linear);
        }
        *this = approximate_model(sivid::bind(prompt, choice, seen), std::move(input_memory_),
                                  std::move(channel_delays_));
    }
    /// A model that is bound already; it has no memory.
    explicit approximate_model(bound_model const& bound) : approximate_model(bound, {}, {}) {}

    [[nodiscard]] std::size_t states() const { return shape_.states; }
    [[nodiscard]] std::size_t parameters() const { return shape_.constants; }
    [[nodiscard]] std::size_t channels() const { return channels_; }
    [[nodiscard]] program_shape const& shape() const { return shape_; }
    [[nodiscard]] approximate_function const& rate() const { return rate_; }
    [[nodiscard]] approximate_function const& observe() const { return observe_; }
    [[nodiscard]] std::vector<plain_memory> const& input_memory() const { return input_memory_; }
    [[nodiscard]] std::vector<plain_memory> const& channel_delays() const {
        return channel_delays_;
    }
    /// Inputs whose values the programs read: sampled ones and formulas with a memory.
    [[nodiscard]] std::vector<std::size_t> const& used_inputs() const { return used_; }

private:
    approximate_model(bound_model const& bound, std::vector<plain_memory> of_inputs,
                      std::vector<plain_memory> of_channels)
        : shape_{bound.state_count(), bound.about.inputs.size(), bound.parameter_count()},
          channels_(bound.channel_count()),
          used_(bound.sampled),
          input_memory_(std::move(of_inputs)),
          channel_delays_(std::move(of_channels)),
          rate_(function_of(bound, bound.rate, bound.rate_dx, bound.rate_dp)),
          observe_(function_of(bound, bound.observe, bound.observe_dx, bound.observe_dp)) {}

    [[nodiscard]] static std::vector<plain_memory>
    memory_of(recorded_model const& model, parameter_choice const& choice,
              std::vector<signal_memory> const& delays, std::vector<signal> const& inputs) {
        std::vector<plain_memory> result;
        for (auto const& d : delays) {
            if (!acts_in(d, inputs)) continue;
            auto const& c = model.about.constants.at(d.constant);
            plain_memory p;
            p.index = d.index;
            p.kind = d.kind;
            if (d.only_if && std::holds_alternative<sampled_signal>(inputs[*d.only_if]))
                p.when = d.only_if;
            p.size = c.nominal.nearest;
            if (auto const f = choice.fixed.find(c.name); f != choice.fixed.end()) {
                p.size = mid(f->second);
            }
            for (std::size_t j = 0; j < choice.unknown.size(); ++j) {
                if (choice.unknown[j] != c.name) continue;
                p.unknown = true;
                p.parameter = j;
            }
            result.push_back(p);
        }
        return result;
    }

    [[nodiscard]] approximate_function
    function_of(bound_model const& bound, std::vector<node_id> const& values,
                std::vector<std::vector<node_id>> const& dx,
                std::vector<std::vector<node_id>> const& dp) const {
        approximate_function f;
        f.values = approximate_program(bound.g, values, shape_);
        auto g = bound.g;
        std::vector<node_id> u;
        for (auto const i : used_) u.push_back(g.leaf(operation::input, i));
        auto const du = differentiate(g, values, u);
        auto const dt = differentiate(g, values, {g.leaf(operation::time, 0)});
        auto outputs = values;
        auto const collect = [&](std::vector<std::vector<node_id>> const& d,
                                 std::vector<approximate_derivative>& entries, bool inputs) {
            for (std::size_t i = 0; i < d.size(); ++i) {
                for (std::size_t j = 0; j < d[i].size(); ++j) {
                    if (g.is(d[i][j], 0)) continue;
                    entries.push_back({i, inputs ? used_[j] : j, outputs.size()});
                    outputs.push_back(d[i][j]);
                }
            }
        };
        collect(dx, f.by_state, false);
        collect(dp, f.by_parameter, false);
        collect(du, f.by_input, true);
        collect(dt, f.by_time, false);
        f.expansion = approximate_program(g, outputs, shape_);
        for (auto* part : {&f.by_state, &f.by_parameter, &f.by_input, &f.by_time}) {
            for (auto& e : *part) e.slot = f.expansion.output(e.slot);
        }
        return f;
    }

    program_shape shape_;
    std::size_t channels_ = 0;
    std::vector<std::size_t> used_;
    std::vector<plain_memory> input_memory_, channel_delays_;
    approximate_function rate_, observe_;
};

} // namespace sivid

#endif
