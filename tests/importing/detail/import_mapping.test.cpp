// SPDX-License-Identifier: MIT
#include <sivid/importing/detail/import_mapping.hpp>
#include <sivid/number/text/joined.hpp>

#include "io/import_support.hpp"

using namespace sivid;

TEST_CASE("the names of a mapping are those that occur, each once, in order") {
    import_mapping m;
    m.model = "tank";
    m.parameters.push_back({"k", "1/s", {}});
    m.fixed.push_back({"g", io_support::dec("9.81"), interval{9.8, 9.9}});
    scenario_mapping a, b;
    a.inputs.resize(1);
    a.inputs[0].name = "u";
    a.channels.resize(2);
    a.channels[0].name = "h";
    a.channels[0].unit = "m";
    a.channels[1].name = "q";
    a.initial.resize(1);
    a.initial[0].name = "x1";
    b = a;
    b.channels[1].name = "p";
    b.initial_after_break.resize(1);
    b.initial_after_break[0].name = "x2";
    b.windows.emplace();
    b.windows->initial = b.initial_after_break;
    b.windows->initial[0].name = "x3";
    m.scenarios = {a, b};
    auto const names = m.names();
    CHECK(names.name == "tank");
    CHECK(joined_names(names.constants) == "k, g");
    CHECK(joined_names(names.inputs) == "u");
    CHECK(joined_names(names.channels) == "h, q, p");
    CHECK(names.channels[0].unit == "m");
    CHECK(joined_names(names.states) == "x1, x2, x3");
    CHECK(names.state_ranges.size() == 3);
}

TEST_CASE("which windows are held out") {
    window_mapping w;
    CHECK_FALSE(w.is_holdout(3));
    w.holdout_every = 3;
    CHECK(w.is_holdout(3));
    CHECK(w.is_holdout(6));
    CHECK_FALSE(w.is_holdout(4));
    w.holdout = {4};
    CHECK(w.is_holdout(4));
}
