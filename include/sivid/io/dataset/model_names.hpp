// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DATASET_MODEL_NAMES_HPP
#define SIVID_IO_DATASET_MODEL_NAMES_HPP

#include <sivid/model/model.hpp>
#include <sivid/number/interval.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sivid {

/// A quantity of a model: its name, as files and messages use it, and its unit ("" = none).
struct name_unit {
    std::string name, unit;
};

/// What the reader of a data set must know about the model: the names that may appear, in the
/// model's order, and what is taken for a state about which the data set says nothing.
struct model_names {
    std::string name;
    std::vector<name_unit> constants, states, inputs, channels;
    std::vector<interval> state_ranges; ///< one for each state
    std::string time_unit = "s";
};

/// The names of a recorded model.
[[nodiscard]] inline model_names names_of(model_description const& model) {
    model_names names;
    names.name = model.name;
    names.time_unit = model.time_unit;
    for (auto const& c : model.constants) names.constants.push_back({c.name, c.unit});
    for (auto const& i : model.inputs) names.inputs.push_back({i.name, i.unit});
    for (auto const& c : model.channels) names.channels.push_back({c.name, c.unit});
    for (auto const& s : model.states) {
        names.states.push_back({s.name, s.unit});
        names.state_ranges.push_back(s.limit.range());
    }
    return names;
}

/// The index of the entry with this name, or nothing.
[[nodiscard]] inline std::optional<std::size_t> index_of(std::vector<name_unit> const& list,
                                                         std::string_view name) {
    auto const found = std::find_if(list.begin(), list.end(),
                                    [&](name_unit const& entry) { return entry.name == name; });
    if (found == list.end()) return std::nullopt;
    return static_cast<std::size_t>(found - list.begin());
}

} // namespace sivid

#endif // SIVID_IO_DATASET_MODEL_NAMES_HPP
