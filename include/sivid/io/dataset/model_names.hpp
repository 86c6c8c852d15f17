// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DATASET_MODEL_NAMES_HPP
#define SIVID_IO_DATASET_MODEL_NAMES_HPP

#include <sivid/compiled.hpp>
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
[[nodiscard]] SIVID_DECL model_names names_of(model_description const& model);

/// The index of the entry with this name, or nothing.
[[nodiscard]] inline std::optional<std::size_t> index_of(std::vector<name_unit> const& list,
                                                         std::string_view name) {
    auto const found = std::find_if(list.begin(), list.end(),
                                    [&](name_unit const& entry) { return entry.name == name; });
    if (found == list.end()) return std::nullopt;
    return static_cast<std::size_t>(found - list.begin());
}

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/dataset/impl/model_names.ipp>
#endif

#endif // SIVID_IO_DATASET_MODEL_NAMES_HPP
