// SPDX-License-Identifier: MIT
// The DOT text is read back as a graph: every edge joins declared nodes, and the edges are those of
// the recording.
#include <sivid/model/to_dot.hpp>

#include "../../examples/hovercraft/model.hpp"
#include "support/catch.hpp"
#include "support/models.hpp"

#include <map>
#include <sstream>
#include <string>
#include <vector>

using namespace sivid;

namespace {

struct dot_graph {
    std::map<std::string, std::string> labels;
    std::map<std::string, std::string> attributes;
    std::vector<std::pair<std::string, std::string>> edges, dashed;
};

/// Enough of a reader for one statement a line; throws on anything else.
dot_graph read(std::string const& text) {
    dot_graph result;
    std::istringstream lines(text);
    std::string line;
    REQUIRE(std::getline(lines, line));
    REQUIRE(line.rfind("digraph \"", 0) == 0);
    bool closed = false;
    while (std::getline(lines, line)) {
        if (line == "}") {
            closed = true;
            continue;
        }
        REQUIRE_FALSE(closed);
        REQUIRE(line.back() == ';');
        if (line.find("  rankdir") == 0 || line.find("  node ") == 0) continue;
        std::istringstream words(line);
        std::string from, arrow, to;
        words >> from >> arrow;
        if (arrow == "->") {
            words >> to;
            bool const series = to.back() != ';';
            if (!series) to.pop_back();
            (series ? result.dashed : result.edges).emplace_back(from, to);
            continue;
        }
        auto at = line.find("label=\"");
        REQUIRE(at != std::string::npos);
        std::string label;
        for (at += 7; line[at] != '"'; ++at) {
            if (line[at] == '\\') ++at;
            label += line[at];
        }
        CHECK(result.labels.emplace(from, label).second);
        result.attributes[from] = line.substr(at + 1);
    }
    REQUIRE(closed);
    for (auto const* list : {&result.edges, &result.dashed}) {
        for (auto const& [from, to] : *list) {
            CHECK(result.labels.count(from) == 1);
            CHECK(result.labels.count(to) == 1);
        }
    }
    return result;
}

std::string node_labelled(dot_graph const& g, std::string const& end) {
    std::string found;
    for (auto const& [id, label] : g.labels) {
        if (label.size() < end.size() ||
            label.compare(label.size() - end.size(), end.size(), end) != 0)
            continue;
        CHECK(found.empty());
        found = id;
    }
    REQUIRE_FALSE(found.empty());
    return found;
}

} // namespace

TEST_CASE("nodes, edges and frames of a small model") {
    auto const m = support::model_of(
        {1, 1, 1},
        [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector<expression>{p[0] / x[0] - sin(u[0])};
        },
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector<expression>{exp(p[0]) * x[0]};
        });
    auto const g = read(to_dot(m));
    auto const quotient = node_labelled(g, " div");
    std::vector<std::string> into;
    for (auto const& [from, to] : g.edges) {
        if (to == quotient) into.push_back(g.labels.at(from));
    }
    CHECK(into == std::vector<std::string>{"p0", "x0"}); // the dividend first
    CHECK(g.attributes.at(node_labelled(g, " exp")).find("#cfe8cf") != std::string::npos);
    CHECK(g.attributes.at(node_labelled(g, " sin")).find("#cfe0f5") != std::string::npos);
    CHECK(g.attributes.at(quotient).find("#ffffff") != std::string::npos);
    CHECK(g.attributes.at(node_labelled(g, "x0")).find("penwidth") != std::string::npos);
    CHECK(g.dashed.size() == 2); // sin and cos for each other
    CHECK(g.attributes.at(node_labelled(g, "x0'")).find("peripheries=2") != std::string::npos);
    CHECK(node_labelled(g, "y.y0") != "");
}

TEST_CASE("the hovercraft's graph is whole") {
    auto const m = record_model(hovercraft{});
    graph_listing const listing(m);
    auto const g = read(to_dot(m));
    CHECK(g.labels.size() == listing.lines().size() + listing.outputs().size());
    std::size_t uses = 0;
    for (auto const& l : listing.lines()) uses += l.uses;
    CHECK(g.edges.size() == uses);
    auto const bound = bind(m, {{"Sv"}, {}},
                            {analytic_signal::from([](auto const&) { return expression(80); }),
                             analytic_signal::from([](auto const& t) { return t; })});
    CHECK(read(to_dot(bound)).labels.size() < g.labels.size());
}

TEST_CASE("names cannot leave their quotes") {
    auto m = support::model_of({1, 0, 0}, [](auto const&, auto const& x, auto const&, auto const&) {
        return std::vector<expression>{x[0]};
    });
    m.about.name = "two\nlines";
    m.about.states[0].name = "a\"];evil\\";
    auto const g = read(to_dot(m));
    CHECK(g.labels.size() == 3);
    CHECK(node_labelled(g, "a\"];evil\\") != "");
}
