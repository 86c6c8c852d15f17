// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_SIMULATOR_EXPORT_MAPPING_HPP
#define SIVID_IO_SIMULATOR_EXPORT_MAPPING_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/io/text/json_document.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sivid {

/// What an answer can be written into, or as.
enum class export_format { mjcf, urdf, isaaclab, json };

/// An attribute that a format has.
struct export_attribute {
    export_format format;
    std::string_view kind, name; ///< as a mapping names it: joint, damping
    std::string_view path;       ///< of the element within that has it, "inertial/mass"; "": itself
    std::string_view own;        ///< its name there
    std::string_view units;      ///< of one of these, parted by |; "": of any, nothing is converted
    std::size_t least = 1, most = 1; ///< so many numbers
};

/// An entry of a mapping: which attribute gets the value of which expression of constants.
struct export_entry {
    std::vector<std::string> values; ///< one for each number of the attribute
    std::string kind, name, attribute;
    std::optional<std::size_t> part;        ///< the only number that changes, from 1
    std::string unit;                       ///< of the expressions; "": a constant's own
    std::string file_unit;                  ///< of the file; "": one of the attribute's
    std::optional<exact_decimal> step;      ///< of the simulator, in the unit of a delay
    export_attribute const* rule = nullptr; ///< nothing: the format cannot say it
    json_value place;                       ///< for messages

    /// "joint elbow: damping"
    [[nodiscard]] std::string title() const {
        auto const which = part ? " (number " + std::to_string(*part) + ")" : std::string{};
        return kind + " " + name + ": " + attribute + which;
    }
};

/// Reads a mapping, sivid-export-1:
///   {"format": "sivid-export-1", "attributes": [
///     {"joint": "elbow", "attribute": "damping", "value": "Fv"},
///     {"joint": "elbow", "attribute": "armature", "value": "Jm * N^2", "unit": "kg m^2"}]}
/// @throws input_error  also for an attribute that the format does not have, and one that is given
///                      twice
[[nodiscard]] SIVID_DECL std::vector<export_entry>
read_export_mapping(std::filesystem::path const& file, export_format format);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/simulator/impl/export_mapping.ipp>
#endif

#endif
