// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_PLACE_PLACE_HPP
#define SIVID_APPROXIMATE_PLACE_PLACE_HPP

#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

enum class place_kind {
    equation,  ///< a rate that depends on constants or inputs
    kinematic, ///< a rate of states alone
    sensor,
    input
};

/// Something that can be wrong: an equation, a sensor (of one channel, or of several that are
/// measured together), an input.
struct place {
    place_kind kind = place_kind::equation;
    std::vector<std::size_t> members; ///< a state, channels, or an input
    std::string name;
    double cost = 1; ///< how many ordinary places it counts for
    /// Of a kinematic equation: the measured channels in its row, its own state's first.
    std::vector<std::string> sensors{};
    bool askew =
        false; ///< of a sensor: of two channels of one instrument each shows some of the other

    [[nodiscard]] bool is_sensor() const { return kind == place_kind::sensor; }
};

namespace approximate_detail {

/// Lists the places of a model.
class place_finder {
public:
    place_finder(recorded_model const& model, std::vector<bool> const& measured,
                 std::vector<bool> const& sampled)
        : model_(&model), measured_(&measured), sampled_(&sampled) {}

    [[nodiscard]] std::vector<place> operator()() {
        add_equations();
        add_inputs();
        add_sensors();
        add_askew_instruments();
        return std::move(result_);
    }

private:
    [[nodiscard]] bool dynamic(std::size_t state) const {
        return (model_->g.depends(model_->rate[state]) & (on_constant | on_input)) != 0;
    }
    /// Its rate is another state.
    [[nodiscard]] bool identity(std::size_t state) const {
        return model_->g[model_->rate[state]].op == operation::state;
    }
    [[nodiscard]] bool shows_state(std::size_t channel) const {
        return model_->g[model_->observe[channel]].op == operation::state;
    }
    [[nodiscard]] std::size_t shown_by(std::size_t channel) const {
        return static_cast<std::size_t>(model_->g[model_->observe[channel]].index);
    }
    /// Whether a channel shows a state of the geometry.
    [[nodiscard]] bool geometric(std::size_t channel) const {
        return shows_state(channel) && !dynamic(shown_by(channel)) && !identity(shown_by(channel));
    }
    [[nodiscard]] std::string const& unit(std::size_t channel) const {
        return model_->about.channels[channel].unit;
    }

    /// Names of the channels in the row of a state, its own first.
    [[nodiscard]] std::vector<std::string> sensors_of(std::size_t state) const {
        std::vector<std::string> names;
        auto const add = [&](std::size_t i) {
            for (std::size_t y = 0; y < model_->observe.size(); ++y) {
                if (!(*measured_)[y] || !shows_state(y) || shown_by(y) != i) continue;
                auto const& name = model_->about.channels[y].name;
                if (std::find(names.begin(), names.end(), name) == names.end())
                    names.push_back(name);
            }
        };
        add(state);
        for (auto const k : leaves_of(model_->g, {model_->rate[state]}, operation::state)) add(k);
        return names;
    }
    void add_equations() {
        for (std::size_t i = 0; i < model_->rate.size(); ++i) {
            place p;
            p.members = {i};
            p.name = model_->about.states[i].equation_name();
            if (!dynamic(i)) {
                p.kind = place_kind::kinematic;
                p.cost = identity(i) ? 1.5 : 2.5;
                p.sensors = sensors_of(i);
            }
            result_.push_back(std::move(p));
        }
    }
    void add_inputs() {
        auto const needed = reachable(model_->g, model_->rate);
        for (std::size_t k = 0; k < model_->g.size(); ++k) {
            auto const& n = model_->g.nodes()[k];
            auto const i = static_cast<std::size_t>(n.index);
            if (!needed[k] || n.op != operation::input || !(*sampled_)[i]) continue;
            result_.push_back(
                {place_kind::input, {i}, model_->about.inputs[i].name, 1.5, {}, false});
        }
    }
    /// Channels that show states of one geometry in one unit come from one instrument.
    void add_sensors() {
        auto const count = model_->observe.size();
        std::vector<bool> taken(count, false);
        for (std::size_t k = 0; k < count; ++k) {
            if (taken[k] || !(*measured_)[k]) continue;
            place p;
            p.kind = place_kind::sensor;
            p.name = model_->about.channels[k].name;
            for (std::size_t j = k; j < count; ++j) {
                bool const joins = j == k || (geometric(j) && geometric(k) && (*measured_)[j] &&
                                              unit(j) == unit(k));
                if (!joins) continue;
                taken[j] = true;
                p.members.push_back(j);
            }
            result_.push_back(std::move(p));
        }
    }
    /// Two channels of states in one unit, both of the geometry or neither, may come from one
    /// instrument that is mounted askew.
    void add_askew_instruments() {
        auto const& channels = model_->about.channels;
        auto const in_a_frame = [&](std::size_t k) {
            return (*measured_)[k] && !unit(k).empty() && unit(k) != "1" && shows_state(k);
        };
        for (std::size_t k = 0; k < model_->observe.size(); ++k) {
            for (std::size_t j = k + 1; j < model_->observe.size(); ++j) {
                if (!in_a_frame(k) || !in_a_frame(j) || geometric(k) != geometric(j)) continue;
                if (unit(j) != unit(k)) continue;
                auto const name = std::string(channels[k].name) + ", " + channels[j].name;
                result_.push_back({place_kind::sensor, {k, j}, name, 1, {}, true});
            }
        }
    }

    recorded_model const* model_;
    std::vector<bool> const* measured_;
    std::vector<bool> const* sampled_;
    std::vector<place> result_;
};

} // namespace approximate_detail

/// All places of a model. Equations are called after their states.
///   Geometry is seldom wrong: a kinematic equation counts for more, and so does an input, which
///   moves several equations at once.
/// @param measured  per channel
/// @param sampled   per input: whether it was recorded, and not a formula
[[nodiscard]] inline std::vector<place> places_of(recorded_model const& model,
                                                  std::vector<bool> const& measured,
                                                  std::vector<bool> const& sampled) {
    return approximate_detail::place_finder(model, measured, sampled)();
}

} // namespace sivid

#endif
