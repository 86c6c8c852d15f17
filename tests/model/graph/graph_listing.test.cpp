// SPDX-License-Identifier: MIT
#include <sivid/model/graph/graph_listing.hpp>

#include "support/catch.hpp"
#include "support/formulas.hpp"
#include "support/models.hpp"

using namespace sivid;

TEST_CASE("parts by what a value varies with") {
    CHECK(part_of(on_nothing) == graph_part::fixed);
    CHECK(part_of(on_constant) == graph_part::parameters);
    CHECK(part_of(on_input) == graph_part::inputs);
    CHECK(part_of(on_time) == graph_part::inputs);
    CHECK(part_of(on_time | on_constant) == graph_part::both);
    CHECK(part_of(on_state | on_constant | on_input) == graph_part::states);
}

TEST_CASE("literals read as decimals, uncertain ones as bounds") {
    using namespace sivid::literals;
    auto const text = [](expression const& e) {
        graph g;
        return graph_listing::literal_text(g.value(g[e.in(g)]));
    };
    CHECK(text(expression(0.1_dec)) == "0.1");
    CHECK(text(expression(0.1)) == "0.1");
    CHECK(text(expression(0.1 + 0.2)) == "0.30000000000000004");
    CHECK(text(expression(-3)) == "-3");
    CHECK(text(expression(interval(0.25, 0.5))) == "[0.25, 0.5]");
    CHECK(text(expression(0)) == "0");
}

TEST_CASE("operations are numbered in the order of evaluation, each use counted") {
    support::draws d(77);
    int seen = 0;
    for (int round = 0; round < 100; ++round) {
        recorded_model m;
        m.about.states.assign(6, {"s", "1", 1, {}});
        m.about.constants.assign(6, {"c", "1", {}});
        m.about.inputs.assign(6, {"u", "1"});
        m.about.channels.push_back({"y", "1"});
        auto const f = support::random_formula(d, 12, false);
        try {
            m.observe.push_back(support::recorded(f, m.g));
        } catch (std::domain_error const&) {
            continue;
        }
        graph_listing const listing(m);
        std::size_t last = 0, uses = 0, operands = 1;
        for (auto const& l : listing.lines()) {
            uses += l.uses;
            if (l.number == 0) continue;
            CHECK(l.number == last + 1);
            last = l.number;
            auto const& n = m.g[l.id];
            operands += is_binary(n.op) ? 2 : 1;
            // No operand has a later number.
            for (auto const i : {n.a, n.b}) {
                auto const text = listing.operand(i);
                if (text[0] == '%') CHECK(std::stoul(text.substr(1)) < l.number);
            }
        }
        CHECK(last == listing.operations());
        CHECK(uses == operands);
        seen += last > 3 ? 1 : 0;
    }
    CHECK(seen > 20);
}
