// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_SIMULATOR_IMPL_EXPORT_MAPPING_IPP
#define SIVID_IO_SIMULATOR_IMPL_EXPORT_MAPPING_IPP

#include <sivid/io/simulator/export_mapping.hpp>

#include <sivid/compiled.hpp>
#include <sivid/io/dataset/mapping_entries.hpp>
#include <sivid/io/dataset/stated_unit.hpp>
#include <sivid/io/input_error.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace io_detail {

inline constexpr auto mjcf = export_format::mjcf;
inline constexpr auto urdf = export_format::urdf;
inline constexpr auto isaaclab = export_format::isaaclab;
inline constexpr auto turning = "N m s/rad|N s/m", force = "N m|N", inertia = "kg m^2",
                      stiff = "N m/rad|N/m", speed = "rad/s|m/s";
/// Of MJCF as of MuJoCo 2.2, of URDF, and of the actuators of Isaac Lab.
inline constexpr std::array export_attributes{
    export_attribute{mjcf, "joint", "damping", "", "damping", turning},
    export_attribute{mjcf, "joint", "frictionloss", "", "frictionloss", force},
    export_attribute{mjcf, "joint", "armature", "", "armature", "kg m^2|kg"},
    export_attribute{mjcf, "joint", "stiffness", "", "stiffness", stiff},
    export_attribute{mjcf, "body", "mass", "inertial", "mass", "kg"},
    export_attribute{mjcf, "body", "diaginertia", "inertial", "diaginertia", inertia, 3, 3},
    export_attribute{mjcf, "body", "fullinertia", "inertial", "fullinertia", inertia, 6, 6},
    export_attribute{mjcf, "actuator", "gear", "", "gear", "", 1, 6},
    export_attribute{mjcf, "actuator", "ctrlrange", "", "ctrlrange", "", 2, 2},
    export_attribute{mjcf, "actuator", "forcerange", "", "forcerange", force, 2, 2},
    export_attribute{urdf, "joint", "damping", "dynamics", "damping", turning},
    export_attribute{urdf, "joint", "friction", "dynamics", "friction", force},
    export_attribute{urdf, "joint", "effort", "limit", "effort", force},
    export_attribute{urdf, "joint", "velocity", "limit", "velocity", speed},
    export_attribute{urdf, "link", "mass", "inertial/mass", "value", "kg"},
    export_attribute{urdf, "link", "ixx", "inertial/inertia", "ixx", inertia},
    export_attribute{urdf, "link", "ixy", "inertial/inertia", "ixy", inertia},
    export_attribute{urdf, "link", "ixz", "inertial/inertia", "ixz", inertia},
    export_attribute{urdf, "link", "iyy", "inertial/inertia", "iyy", inertia},
    export_attribute{urdf, "link", "iyz", "inertial/inertia", "iyz", inertia},
    export_attribute{urdf, "link", "izz", "inertial/inertia", "izz", inertia},
    export_attribute{isaaclab, "joint", "stiffness", "", "stiffness", stiff},
    export_attribute{isaaclab, "joint", "damping", "", "damping", turning},
    export_attribute{isaaclab, "joint", "armature", "", "armature", "kg m^2|kg"},
    export_attribute{isaaclab, "joint", "friction", "", "friction", "N m|N|1"},
    export_attribute{isaaclab, "joint", "effort_limit", "", "effort_limit", force},
    export_attribute{isaaclab, "joint", "velocity_limit", "", "velocity_limit", speed},
    export_attribute{isaaclab, "joint", "delay", "", "delay", "s"}};

/// Real things that a format cannot say: they go into the note.
inline bool cannot_be_said(export_format f, std::string const& kind, std::string const& name) {
    bool const own = kind == "joint" || (kind == "actuator" && f == mjcf);
    return own && f != isaaclab &&
           (name == "delay" || (f == urdf && (name == "armature" || name == "stiffness")));
}

inline export_attribute const* rule_of(export_format format, export_entry const& e) {
    std::string known;
    for (auto const& a : export_attributes) {
        if (a.format != format) continue;
        if (a.kind == e.kind && a.name == e.attribute) return &a;
        known += text_of(known.empty() ? "" : ", ", a.kind, " ", a.name);
    }
    if (format != export_format::json && !cannot_be_said(format, e.kind, e.attribute))
        e.place.fail(text_of("this format has no ", in_quotes(e.attribute), " of a ", e.kind),
                     "it has: " + known);
    return nullptr;
}

inline export_entry read_export_entry(json_value const& own, export_format format) {
    own.allow_only({"joint", "body", "link", "actuator", "attribute", "value", "part", "unit",
                    "file_unit", "step"});
    export_entry e;
    e.place = own;
    for (auto const* kind : {"joint", "body", "link", "actuator"}) {
        auto const* const named = own.find(kind);
        if (named == nullptr) continue;
        if (!e.kind.empty()) own.fail("it names two elements", "write one entry for each");
        e.kind = kind;
        e.name = named->string();
    }
    if (e.kind.empty())
        own.fail("it names no element", "write \"joint\", \"body\", \"link\" or \"actuator\"");
    e.attribute = own.at("attribute").string();
    auto const& value = own.at("value");
    if (value.type() == json_value::kind::array)
        for (auto const& one : value.elements()) e.values.push_back(one.string());
    else
        e.values.push_back(value.string());
    if (auto const* p = own.find("part")) e.part = mapping_entries::whole(*p, 1, 6);
    if (auto const* u = own.find("unit")) e.unit = (static_cast<void>(read_unit(*u)), u->string());
    if (auto const* u = own.find("file_unit"))
        e.file_unit = (static_cast<void>(read_unit(*u)), u->string());
    if (auto const* s = own.find("step"))
        e.step = mapping_entries::positive(*s, "state the simulator's step");
    e.rule = rule_of(format, e);
    auto const most = e.rule == nullptr ? 6 : e.rule->most;
    auto const least = e.rule == nullptr ? 1 : e.rule->least;
    if (e.part ? e.values.size() != 1 || *e.part > most
               : e.values.size() < least || most < e.values.size())
        own.fail(text_of(e.attribute, " has ", std::to_string(most), " numbers, ",
                         std::to_string(e.values.size()), " values are given"),
                 "write all as a list, or \"part\" for the one that changes, from 1");
    if (e.attribute != "delay" ? e.step.has_value() : format == isaaclab && !e.step)
        own.fail("a delay has a \"step\" there, and nothing else has",
                 "state that of the simulator in s, or leave it out");
    return e;
}

} // namespace io_detail

SIVID_DECL std::vector<export_entry> read_export_mapping(std::filesystem::path const& file,
                                                         export_format format) {
    auto const root = read_json(file);
    mapping_entries::require_format(root, "sivid-export-1");
    root.allow_only({"format", "attributes"});
    std::vector<export_entry> result;
    for (auto const& own : root.at("attributes").elements()) {
        auto e = io_detail::read_export_entry(own, format);
        for (auto const& other : result)
            if (e.kind == other.kind && e.name == other.name && e.attribute == other.attribute &&
                (!e.part || !other.part || *e.part == *other.part))
                own.fail(e.title() + " is given twice", "keep one of them");
        result.push_back(std::move(e));
    }
    if (result.empty())
        root.at("attributes").fail("no attributes", "say which constant is which attribute");
    return result;
}

} // namespace sivid

#endif
