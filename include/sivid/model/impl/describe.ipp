// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPL_DESCRIBE_IPP
#define SIVID_MODEL_IMPL_DESCRIBE_IPP

#include <sivid/model/describe.hpp>

namespace sivid {

namespace model_detail {

/// Rows of cells, each column as wide as its widest cell.
[[nodiscard]] SIVID_DECL std::string aligned(std::vector<std::vector<std::string>> const& rows) {
    std::vector<std::size_t> widths;
    for (auto const& row : rows) {
        widths.resize(std::max(widths.size(), row.size()), 0);
        for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
    }
    std::string text;
    for (auto const& row : rows) {
        std::string line = "  ";
        for (std::size_t c = 0; c < row.size(); ++c) {
            line += row[c] + std::string(widths[c] - row[c].size() + 2, ' ');
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

[[nodiscard]] SIVID_DECL std::string section(std::string const& title,
                                             std::vector<std::vector<std::string>> const& rows) {
    return title + "\n" + (rows.empty() ? "  none\n" : aligned(rows));
}

[[nodiscard]] SIVID_DECL std::string bracketed(std::string const& unit) { return "[" + unit + "]"; }

[[nodiscard]] inline std::string own_range(std::string const& name, state_range const& x) {
    return x.lower == -x.upper
               ? "|" + name + "| <= " + nearest_text(x.upper)
               : nearest_text(x.lower) + " <= " + name + " <= " + nearest_text(x.upper);
}

[[nodiscard]] SIVID_DECL std::string describe_names(model_description const& about) {
    std::vector<std::vector<std::string>> states, inputs, channels;
    for (auto const& s : about.states) {
        states.push_back({s.name, bracketed(s.unit), own_range(s.name, s.limit),
                          s.equation.empty() ? "" : "equation '" + s.equation + "'"});
    }
    for (auto const& i : about.inputs) inputs.push_back({i.name, bracketed(i.unit)});
    for (auto const& y : about.channels) channels.push_back({y.name, bracketed(y.unit)});
    return section("states", states) + section("inputs", inputs) + section("channels", channels);
}

/// The graph as numbered lines, and what each rate and channel is.
[[nodiscard]] SIVID_DECL std::string describe_graph(graph_listing const& listing) {
    std::vector<std::vector<std::string>> rows, outputs;
    for (auto const& l : listing.lines()) {
        if (l.number == 0) continue;
        std::string remarks;
        auto const remark = [&remarks](std::string const& what) {
            remarks += (remarks.empty() ? "" : "; ") + what;
        };
        if (l.part != graph_part::states) remark(std::string(to_string(l.part)));
        if (l.uses > 1) remark("used " + std::to_string(l.uses) + " times");
        if (l.companion) remark("for series only");
        rows.push_back({"%" + std::to_string(l.number), "= " + listing.formula(l.id), remarks});
    }
    for (auto const& o : listing.outputs()) {
        outputs.push_back({o.name, "= " + listing.operand(o.value)});
    }
    std::string title = "graph: " + std::to_string(listing.operations()) + " operations";
    for (auto const part : {graph_part::parameters, graph_part::inputs, graph_part::both}) {
        auto const n = listing.operations(part);
        if (n > 0) title += ", " + std::to_string(n) + " " + std::string(to_string(part));
    }
    if (listing.shared() > 0) title += ", " + std::to_string(listing.shared()) + " shared";
    return section(title, rows) + section("results", outputs);
}

} // namespace model_detail

SIVID_DECL std::string describe(recorded_model const& model) {
    using namespace model_detail;
    auto const& about = model.about;
    std::vector<std::vector<std::string>> constants, delays, plays, limits;
    for (auto const& c : about.constants) {
        constants.push_back({c.name, "= " + graph_listing::literal_text(c.nominal),
                             bracketed(c.unit),
                             c.formula.empty() ? "" : "= " + c.formula + ", rounded"});
    }
    auto const size_of = [&about](signal_memory const& d) {
        auto const& name = about.constants[d.constant].name;
        auto const size = d.kind == memory_kind::drift ? name + " (t - begin)" : name;
        return d.only_if ? size + " if " + about.inputs[*d.only_if].name : size;
    };
    for (auto const& d : model.input_memory) {
        (d.kind == memory_kind::play         ? plays
         : d.kind == memory_kind::rate_limit ? limits
                                             : delays)
            .push_back({"input " + about.inputs[d.index].name, size_of(d)});
    }
    for (auto const& d : model.channel_delays) {
        delays.push_back({"channel " + about.channels[d.index].name, size_of(d)});
    }
    return "model " + about.name + (about.time_unit == "s" ? "" : ", time in " + about.time_unit) +
           "\n" + describe_names(about) + section("constants", constants) +
           (delays.empty() ? "" : section("delays", delays)) +
           (plays.empty() ? "" : section("plays", plays)) +
           (limits.empty() ? "" : section("rate limits", limits)) +
           describe_graph(graph_listing(model));
}

SIVID_DECL std::string describe(bound_model const& model) {
    using namespace model_detail;
    auto const& about = model.about;
    std::vector<std::vector<std::string>> unknown;
    for (auto const k : model.parameters) {
        unknown.push_back({about.constants[k].name, bracketed(about.constants[k].unit)});
    }
    std::vector<std::vector<std::string>> derivatives;
    auto const count = [&](std::string const& what, auto const& d) {
        std::size_t all = 0, present = 0;
        std::vector<node_id> roots;
        for (auto const& row : d) {
            for (auto const i : row) {
                ++all;
                present += model.g.is(i, 0) ? 0 : 1;
                roots.push_back(i);
            }
        }
        std::size_t operations = 0;
        auto const needed = operands_of(model.g, roots);
        for (std::size_t k = 0; k < needed.size(); ++k) {
            operations += needed[k] && !is_leaf(model.g.nodes()[k].op) ? 1 : 0;
        }
        derivatives.push_back(
            {what, std::to_string(present) + " of " + std::to_string(all) + " entries are not 0,",
             std::to_string(operations) + " operations"});
    };
    count("rates by states", model.rate_dx);
    count("rates by parameters", model.rate_dp);
    count("channels by states", model.observe_dx);
    count("channels by parameters", model.observe_dp);
    return "model " + about.name + ", bound\n" + describe_names(about) +
           section("unknown parameters", unknown) + describe_graph(graph_listing(model)) +
           section("derivatives", derivatives);
}

} // namespace sivid

#endif
