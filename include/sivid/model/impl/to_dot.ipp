// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPL_TO_DOT_IPP
#define SIVID_MODEL_IMPL_TO_DOT_IPP

#include <sivid/model/to_dot.hpp>

#include <array>

namespace sivid {

namespace model_detail {

/// A double-quoted string of the DOT language that shows `text` literally.
[[nodiscard]] SIVID_DECL std::string dot_quoted(std::string_view text) {
    std::string result(1, '"');
    for (char const c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += c == '\n' || c == '\r' ? ' ' : c;
    }
    return result + '"';
}

[[nodiscard]] constexpr std::string_view dot_colour(graph_part part) {
    constexpr std::array<std::string_view, 5> colours{"#eeeeee", "#cfe8cf", "#cfe0f5", "#c9e6e6",
                                                      "#ffffff"};
    return colours[static_cast<std::size_t>(part)];
}

} // namespace model_detail

SIVID_DECL std::string to_dot(graph_listing const& listing) {
    using model_detail::dot_quoted;
    auto const& g = listing.nodes();
    auto const id = [](node_id i) { return "n" + std::to_string(i); };
    std::string text = "digraph " + dot_quoted(listing.about().name) +
                       " {\n  rankdir=LR;\n  node [style=filled];\n";
    for (auto const& l : listing.lines()) {
        auto const& n = g[l.id];
        bool const leaf = is_leaf(n.op);
        std::string label = leaf                      ? listing.operand(l.id)
                            : n.op == operation::pown ? "^" + std::to_string(n.index)
                                                      : std::string(name(n.op));
        if (!leaf) label = "%" + std::to_string(l.number) + " " + label;
        text += "  " + id(l.id) + " [label=" + dot_quoted(label) +
                ", shape=" + (leaf ? "box" : "ellipse") +
                ", fillcolor=" + dot_quoted(model_detail::dot_colour(l.part)) +
                (l.uses > 1 ? ", penwidth=2" : "") + "];\n";
        if (leaf) continue;
        text += "  " + id(n.a) + " -> " + id(l.id) + ";\n";
        if (is_binary(n.op)) text += "  " + id(n.b) + " -> " + id(l.id) + ";\n";
        if (n.companion != 0)
            text +=
                "  " + id(n.companion) + " -> " + id(l.id) + " [style=dashed, constraint=false];\n";
    }
    for (std::size_t k = 0; k < listing.outputs().size(); ++k) {
        auto const& o = listing.outputs()[k];
        auto const name = "out" + std::to_string(k);
        text += "  " + name + " [label=" + dot_quoted(o.name) +
                ", shape=box, peripheries=2, fillcolor=\"#f5dfcf\"];\n  " + id(o.value) + " -> " +
                name + ";\n";
    }
    return text + "}\n";
}

SIVID_DECL std::string to_dot(recorded_model const& model) { return to_dot(graph_listing(model)); }

SIVID_DECL std::string to_dot(bound_model const& model) { return to_dot(graph_listing(model)); }

} // namespace sivid

#endif
