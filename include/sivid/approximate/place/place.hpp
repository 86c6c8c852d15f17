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

/// All places of a model. Equations are called after their states.
///   Geometry is seldom wrong: a kinematic equation counts for more, and so does an input, which
///   moves several equations at once.
/// @param measured  per channel
/// @param sampled   per input: whether it was recorded, and not a formula
[[nodiscard]] inline std::vector<place> places_of(recorded_model const& model,
                                                  std::vector<bool> const& measured,
                                                  std::vector<bool> const& sampled) {
    std::vector<place> result;
    auto const& about = model.about;
    auto const dynamic = [&](std::size_t i) {
        return (model.g.depends(model.rate[i]) & (on_constant | on_input)) != 0;
    };
    auto const identity = [&](std::size_t i) {
        return model.g[model.rate[i]].op == operation::state;
    };
    auto const sensors_of = [&](std::size_t i) {
        std::vector<std::string> names;
        auto const add = [&](std::size_t state) {
            for (std::size_t y = 0; y < model.observe.size(); ++y) {
                auto const& n = model.g[model.observe[y]];
                bool const shows = n.op == operation::state &&
                                   static_cast<std::size_t>(n.index) == state && measured[y];
                auto const& name = about.channels[y].name;
                if (shows && std::find(names.begin(), names.end(), name) == names.end()) {
                    names.push_back(name);
                }
            }
        };
        add(i);
        for (auto const k : leaves_of(model.g, {model.rate[i]}, operation::state)) add(k);
        return names;
    };
    for (std::size_t i = 0; i < model.rate.size(); ++i) {
        place p;
        p.members = {i};
        p.name = about.states[i].equation_name();
        if (!dynamic(i)) {
            p.kind = place_kind::kinematic;
            p.cost = identity(i) ? 1.5 : 2.5;
            p.sensors = sensors_of(i);
        }
        result.push_back(std::move(p));
    }
    auto const needed = reachable(model.g, model.rate);
    for (std::size_t k = 0; k < model.g.size(); ++k) {
        auto const& n = model.g.nodes()[k];
        auto const i = static_cast<std::size_t>(n.index);
        if (!needed[k] || n.op != operation::input || !sampled[i]) continue;
        result.push_back({place_kind::input, {i}, about.inputs[i].name, 1.5, {}, false});
    }
    // Channels that show states of one geometry in one unit come from one instrument.
    auto const geometric = [&](std::size_t channel) {
        auto const& n = model.g[model.observe[channel]];
        if (n.op != operation::state) return false;
        auto const i = static_cast<std::size_t>(n.index);
        return !dynamic(i) && !identity(i);
    };
    std::vector<bool> taken(model.observe.size(), false);
    for (std::size_t k = 0; k < model.observe.size(); ++k) {
        if (taken[k] || !measured[k]) continue;
        place p;
        p.kind = place_kind::sensor;
        p.name = about.channels[k].name;
        for (std::size_t j = k; j < model.observe.size(); ++j) {
            bool const joins = j == k || (geometric(j) && geometric(k) && measured[j] &&
                                          about.channels[j].unit == about.channels[k].unit);
            if (!joins) continue;
            taken[j] = true;
            p.members.push_back(j);
        }
        result.push_back(std::move(p));
    }
    // Two channels of states in one unit, both of the geometry or neither, may come from one
    // instrument that is mounted askew.
    auto const in_a_frame = [&](std::size_t k) {
        auto const& u = about.channels[k].unit;
        return measured[k] && !u.empty() && u != "1" &&
               model.g[model.observe[k]].op == operation::state;
    };
    for (std::size_t k = 0; k < model.observe.size(); ++k) {
        for (std::size_t j = k + 1; j < model.observe.size(); ++j) {
            if (!in_a_frame(k) || !in_a_frame(j) || geometric(k) != geometric(j)) continue;
            if (about.channels[j].unit != about.channels[k].unit) continue;
            auto const name = std::string(about.channels[k].name) + ", " + about.channels[j].name;
            result.push_back({place_kind::sensor, {k, j}, name, 1, {}, true});
        }
    }
    return result;
}

} // namespace sivid

#endif
