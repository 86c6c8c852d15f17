// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_CHANGE_DETAIL_SUBSTITUTION_HPP
#define SIVID_MODEL_CHANGE_DETAIL_SUBSTITUTION_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/change/copy_equations.hpp>
#include <sivid/model/graph/recorded_map.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace sivid {

namespace model_detail {

/// The memories of a model whose constants have moved.
/// @param position  of each of the old constants; beyond `kept`: it is replaced
inline std::vector<signal_memory> moved(std::vector<signal_memory> memories,
                                        std::vector<std::size_t> const& position, std::size_t kept,
                                        std::vector<model_description::constant> const& old) {
    for (auto& m : memories) {
        if (position[m.constant] >= kept) {
            throw std::invalid_argument("substituted: the delay or play '" + old[m.constant].name +
                                        "' must stay a constant");
        }
        m.constant = position[m.constant];
    }
    return memories;
}

} // namespace model_detail

/// The model with some of its constants replaced by functions of new ones, which stand behind the
/// others. A derived constant follows those that are replaced.
/// @param replaced  names of constants
/// @param fresh     the new constants; a name may be that of a replaced one
/// @param values    of the replaced constants, as functions of the new ones
/// @param show      whether the replaced constants become channels, behind the model's own
/// @throws std::invalid_argument when sizes or names do not fit, or a delay would be replaced
[[nodiscard]] inline recorded_model
substituted(recorded_model const& model, std::vector<std::string> const& replaced,
            std::vector<model_description::constant> const& fresh, recorded_map const& values,
            bool show = false) {
    if (values.arguments() != fresh.size() || values.values() != replaced.size()) {
        throw std::invalid_argument("substituted: the map must lead from the new constants to the "
                                    "replaced ones");
    }
    auto const& old = model.about.constants;
    std::vector<std::size_t> gone;
    for (auto const& name : replaced) gone.push_back(index_of(old, name, "constant"));
    recorded_model result;
    result.about = model.about;
    auto& constants = result.about.constants;
    constants.clear();
    std::vector<std::size_t> position(old.size(), old.size() + fresh.size());
    for (std::size_t k = 0; k < old.size(); ++k) {
        if (std::find(gone.begin(), gone.end(), k) != gone.end()) continue;
        position[k] = constants.size();
        constants.push_back(old[k]);
    }
    auto& g = result.g;
    std::vector<node_id> arguments;
    for (auto const& c : fresh) {
        for (auto const& other : constants) {
            if (other.name == c.name)
                throw std::invalid_argument("substituted: the model has a constant '" + c.name +
                                            "'");
        }
        arguments.push_back(g.leaf(operation::constant, constants.size()));
        constants.push_back(c);
    }
    auto const images = values.in(g, arguments);
    auto const leaf = [&](node const& n, graph& to) {
        auto const k = static_cast<std::size_t>(n.index);
        if (n.op != operation::constant) return to.leaf(n.op, k);
        auto const at = std::find(gone.begin(), gone.end(), k);
        if (at == gone.end()) return to.leaf(n.op, position[k]);
        return images[static_cast<std::size_t>(at - gone.begin())];
    };
    copy_equations(result, model, leaf);
    for (auto const& d : model.derived) {
        if (position[d.constant] >= constants.size()) continue; // replaced itself
        auto const value = copy_into(g, model.g, {d.value}, leaf).front();
        auto const of = leaves_of(model.g, {d.value}, operation::constant);
        bool const follows_replaced =
            std::find_first_of(of.begin(), of.end(), gone.begin(), gone.end()) != of.end();
        result.derived.push_back({position[d.constant], value, d.always || follows_replaced});
    }
    auto const moved = [&](std::vector<signal_memory> const& memories) {
        return model_detail::moved(memories, position, constants.size(), old);
    };
    result.input_memory = moved(model.input_memory);
    result.channel_delays = moved(model.channel_delays);
    result.input_copies = model.input_copies;
    for (std::size_t j = 0; show && j < replaced.size(); ++j) {
        result.about.channels.push_back({replaced[j], old[gone[j]].unit});
        result.observe.push_back(images[j]);
    }
    return result;
}

} // namespace sivid

#endif
