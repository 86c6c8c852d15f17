// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_PREDICTION_PROBLEM_HPP
#define SIVID_DECISION_PREDICTION_PROBLEM_HPP

#include <sivid/measurement/signal.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/change/added_start.hpp>
#include <sivid/model/model.hpp>
#include <sivid/model/parameter_choice.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/number/text/needed_given.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/paving/run_options.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// What data say of a box of parameters: responses of experiments over it, each with the box of
/// starts that it is of.
struct measured_responses {
    response_list known;
    std::vector<box> starts;
};

/// What is to be predicted: a scenario, for all parameters in a union of boxes and all starts in a
/// box.
struct prediction_problem {
    recorded_model model;
    parameter_choice choice; ///< `choice.unknown` names the sides of the boxes
    std::vector<box> sets;   ///< their union holds every parameter that counts
    std::vector<signal> inputs;
    box initial;    ///< the states at time 0
    double end = 0; ///< in the model's unit of time
    /// What measurements say of a box around some of the sets: every parameter that counts meets
    /// all of them for some starts. Its second argument ends runs when it says false; what was
    /// reached holds. May be left out: tubes are narrower with it, and more is decided.
    std::function<measured_responses(box const&, std::function<bool()> const&)> measured = nullptr;

    /// Boxes within the sets of which parameters reach every point; nothing: all of the sets.
    /// Products of parameters that share a factor cannot be chosen independently. What is said of
    /// all motions holds for all of the sets, what is said to be reached only there.
    std::optional<std::vector<box>> reached{};

    /// The smallest box around all sets.
    [[nodiscard]] box around() const {
        auto result = sets.front();
        for (auto const& s : sets) result = hull(result, s);
        return result;
    }

    /// The same under other inputs: states that effects added begin at what these say.
    /// @throws std::invalid_argument  where they begin at what constants say, too
    [[nodiscard]] prediction_problem under(std::vector<signal> others) const {
        auto result = *this;
        result.inputs = std::move(others);
        std::vector<interval> const unknown(model.about.constants.size(),
                                            interval_traits<interval>::entire());
        for (auto const& a : model.added_states) {
            if ((model.g.depends(a.at_begin) & on_constant) != 0)
                throw std::invalid_argument("the state '" + model.about.states[a.state].name +
                                            "' begins at what parameters say: inputs cannot be "
                                            "exchanged with this effect");
            result.initial[a.state] = start_of(model, a, unknown, result.inputs, 0);
        }
        return result;
    }

    /// @throws std::invalid_argument that names what does not fit
    void require_valid() const {
        auto const fail = [](std::string const& what) {
            throw std::invalid_argument("prediction: " + what);
        };
        auto const bounded = [](box const& x) {
            return !is_empty(x) && std::all_of(x.begin(), x.end(), [](interval const& side) {
                return std::isfinite(mag(side));
            });
        };
        if (model.has_memory())
            fail("the model has a delay, a play or a rate limit of unknown size, which cannot be "
                 "enclosed; leave "
                 "the effect out");
        if (!(end > 0) || !std::isfinite(end))
            fail("the duration must be above 0 and finite, not " + nearest_text(end));
        if (sets.empty()) fail("no parameters are left to predict for");
        for (auto const& s : sets) {
            if (s.size() != choice.unknown.size())
                fail("a set needs one side per parameter" +
                     needed_given(choice.unknown.size(), s.size()));
            if (!bounded(s)) fail("the sets must be bounded and not empty");
        }
        if (initial.size() != model.about.states.size())
            fail("the start needs one side per state" +
                 needed_given(model.about.states.size(), initial.size()));
        if (!bounded(initial)) fail("the starts must be bounded and not empty");
        if (inputs.size() != model.about.inputs.size())
            fail("one signal per input is needed" +
                 needed_given(model.about.inputs.size(), inputs.size()));
    }
};

/// A model whose outputs are chosen expressions, each once; the states come first.
struct followed_outputs {
    recorded_model model;
    std::vector<std::size_t> channels; ///< where the model's own channels stand among the outputs
    std::vector<std::size_t> margins;  ///< where `margins` stand

    /// @param margins_wanted  nodes of the model's graph
    followed_outputs(recorded_model original, std::vector<node_id> const& margins_wanted)
        : model(std::move(original)) {
        auto const own = model.observe;
        auto const about = model.about.channels;
        model.observe.clear();
        model.about.channels.clear();
        for (std::size_t i = 0; i < model.rate.size(); ++i) {
            model.observe.push_back(model.g.leaf(operation::state, i));
            model.about.channels.push_back(
                {model.about.states[i].name, model.about.states[i].unit});
        }
        for (std::size_t c = 0; c < own.size(); ++c) channels.push_back(place(own[c], about[c]));
        for (auto const m : margins_wanted) margins.push_back(place(m, {"margin", ""}));
    }

private:
    std::size_t place(node_id node, model_description::item const& about) {
        auto const found = std::find(model.observe.begin(), model.observe.end(), node);
        auto const index = static_cast<std::size_t>(found - model.observe.begin());
        if (found == model.observe.end()) {
            model.observe.push_back(node);
            model.about.channels.push_back(about);
        }
        return index;
    }
};

/// Instants that part a motion into cells: `wanted` ones, those at which a sampled input changes
/// its course, and others, so that no cell is longer than `longest`.
[[nodiscard]] inline std::vector<double> time_cells(prediction_problem const& p,
                                                    std::vector<double> wanted, double longest) {
    wanted.push_back(0);
    wanted.push_back(p.end);
    for (auto const& s : p.inputs) {
        auto const* u = std::get_if<sampled_signal>(&s);
        if (u == nullptr) continue;
        wanted.insert(wanted.end(), u->times().begin(), u->times().end());
    }
    std::erase_if(wanted, [&](double t) { return !(t >= 0 && t <= p.end); });
    std::sort(wanted.begin(), wanted.end());
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    std::vector<double> result;
    for (std::size_t k = 0; k + 1 < wanted.size(); ++k) {
        double const from = wanted[k], length = wanted[k + 1] - wanted[k];
        double const parts = std::clamp(std::ceil(length / longest * (1 - 1e-9)), 1.0, 1e5);
        for (double n = 0; n < parts; ++n) {
            double const t = n == 0 ? from : from + length * (n / parts);
            if (result.empty() || t > result.back()) result.push_back(t);
        }
    }
    result.push_back(wanted.back());
    return result;
}

/// How hard motions are predicted and requirements tried.
struct prediction_options {
    double seconds = 10;
    std::size_t parts = 20'000; ///< at most so many
    std::size_t cells = 120;    ///< of the grid in time, at least; `verify` refines it
    /// Tubes may be wider than what is reached by this share.
    double excess = 0.02;
    run_options run{};
    std::function<bool()> keep_going{}; ///< false ends the work; what is proved stays proved
};

} // namespace sivid

#endif
