// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_SIMULATOR_ROBOT_FILE_HPP
#define SIVID_IO_SIMULATOR_ROBOT_FILE_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/simulator/export_mapping.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

/// The start tag of an element of an XML file.
struct xml_element {
    struct attribute {
        std::string name, value;
        std::size_t begin = 0, end = 0; ///< of what stands between the quotes
    };
    std::string name;
    std::size_t parent = 0;         ///< in the document's list; the root is its own
    std::size_t begin = 0, end = 0; ///< from < to behind >
    std::size_t line = 0;           ///< from 1
    std::vector<attribute> attributes;

    [[nodiscard]] attribute const* find(std::string_view wanted) const {
        for (auto const& a : attributes)
            if (a.name == wanted) return &a;
        return nullptr;
    }
    /// "" where there is none.
    [[nodiscard]] std::string_view value(std::string_view wanted) const {
        auto const* const a = find(wanted);
        return a == nullptr ? std::string_view{} : a->value;
    }
};

/// An XML file that knows where its parts stand, so that some can be replaced and all else kept.
struct xml_document {
    std::string file, text;            ///< all bytes, a mark of UTF-8 included
    std::vector<xml_element> elements; ///< in the order of the file; the root is the first

    [[noreturn]] void fail(std::size_t line, std::string problem, std::string remedy) const {
        throw input_error{{.file = file, .line = line}, std::move(problem), std::move(remedy)};
    }
};

/// Reads an XML file: `read_xml` of xml_reader.hpp.
using xml_parser = std::function<xml_document(std::filesystem::path const&)>;

/// What an attribute of a robot's description becomes.
struct robot_change {
    export_entry const* what = nullptr;
    std::string numbers; ///< decimals, with blanks between
    std::string comment; ///< beside it
};

struct changed_robot {
    std::string text;
    std::vector<std::string> notes; ///< for people, on what the file makes of it
};

/// An MJCF or URDF file with other values of some attributes.
///   Attributes are replaced, or joined to their element where they came from a class of defaults;
/// in URDF an element `dynamics` is made where there is none. Comments begin by "sivid:"; one that
/// stands there is replaced. All other bytes stay as they are.
/// @throws input_error  where an element is not there, or more than once; for another root, xacro,
///                      and what would have the simulator pass the change over
[[nodiscard]] SIVID_DECL changed_robot changed_robot_file(xml_document const& of,
                                                          std::vector<robot_change> const& changes);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/simulator/impl/robot_file.ipp>
#endif

#endif
