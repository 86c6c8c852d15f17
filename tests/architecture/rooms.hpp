// SPDX-License-Identifier: MIT
// The rooms of the floors, and which headers are their doors.
#ifndef SIVID_TESTS_ARCHITECTURE_ROOMS_HPP
#define SIVID_TESTS_ARCHITECTURE_ROOMS_HPP

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace architecture {

/// Folders within a floor, lowest first: a header in one includes none that stands in a higher one.
/// Headers at the top of the floor are its doors, what programs name; every room may use them.
inline std::map<std::string_view, std::vector<std::string_view>> const rooms{
    {"number", {"rounding", "text", "pack", "elementary", "polynomial"}},
    {"space", {"exact", "linear_program", "frame"}},
    {"model", {"graph", "structure", "series", "change"}},
    {"approximate", {"simulate", "fit", "candidate", "place"}},
    {"enclosure", {"series", "set", "step", "runge_kutta", "stiff", "taylor", "sensitivity"}},
    {"paving",
     {"relation", "response", "observer", "run", "search", "products", "contract", "curve", "judge",
      "confidence", "strategy", "inflation", "outliers", "online", "identifiability", "static",
      "disturbance"}},
    {"decision", {"requirement", "motion", "ranking", "design"}},
    {"diagnosis", {"sensor", "candidate", "gap", "hold_out", "claim"}},
    {"io", {"text", "dataset", "result", "simulator"}},
    {"verifier", {"proof", "claim"}},
    {"importing", {"mapping", "table", "scenario", "robot"}},
    {"report", {"draw"}}};

/// The room of sivid/floor/room/...; "" for a door.
inline std::string room_of(std::filesystem::path const& name) {
    std::vector<std::string> parts;
    for (auto const& p : name) parts.push_back(p.string());
    bool const door = parts.size() < 4 || parts[2] == "detail" || parts[2] == "impl";
    return door ? std::string{} : parts[2];
}

/// Position of a room on its floor; past the end where it is not known.
inline std::size_t height_of(std::string_view floor, std::string_view room) {
    auto const of = rooms.find(floor);
    if (of == rooms.end()) return 1;
    auto const found = std::find(of->second.begin(), of->second.end(), room);
    return static_cast<std::size_t>(found - of->second.begin());
}
inline bool is_room(std::string_view floor, std::string_view room) {
    auto const of = rooms.find(floor);
    return of != rooms.end() && height_of(floor, room) < of->second.size();
}

/// The names behind sivid::, or a namespace within it, in the examples of the tree.
inline std::set<std::string> names_in_programs(std::filesystem::path const& tree) {
    std::set<std::string> names;
    if (!std::filesystem::exists(tree / "examples")) return names;
    for (auto const& entry : std::filesystem::recursive_directory_iterator{tree / "examples"}) {
        auto const kind = entry.path().extension();
        if (!entry.is_regular_file() || (kind != ".cpp" && kind != ".hpp")) continue;
        std::ifstream in{entry.path()};
        std::string const text{std::istreambuf_iterator<char>{in}, {}};
        bool ours = false; // behind sivid::, or a namespace within it
        for (std::size_t from = 0, to = 0; from < text.size(); from = to + 1) {
            to = from;
            while (to < text.size() &&
                   (std::isalnum(static_cast<unsigned char>(text[to])) != 0 || text[to] == '_'))
                ++to;
            if (to == from) {
                ours = ours && text[from] == ':';
                continue;
            }
            auto const word = text.substr(from, to - from);
            if (ours) names.insert(word);
            ours = (ours || word == "sivid") && text.compare(to, 2, "::") == 0;
        }
    }
    return names;
}

} // namespace architecture

#endif
