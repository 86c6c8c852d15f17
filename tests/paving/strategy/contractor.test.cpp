// SPDX-License-Identifier: MIT
#include <sivid/paving/strategy/contractor.hpp>

#include "support/catch.hpp"

using namespace sivid;
using outcome = contraction_record::outcome;

TEST_CASE("journals of several searches become one, with a line for each contractor") {
    contraction_journal journal;
    add(journal, {{"windows", "no time", outcome::not_applicable}, {"equations", "early"}});
    CHECK(journal.size() == 2);
    add(journal, {{"equations", "later", outcome::gained, 0.4, 3, 1.5, {{"longest", 2}}},
                  {"windows", "early", outcome::cut_short, 1, 5, 0.5}});
    add(journal, {{"windows", "late", outcome::not_applicable},
                  {"equations", "last", outcome::idle, 1, 1, 0.5}});
    REQUIRE(journal.size() == 2);
    CHECK(journal[0].why == "early");
    CHECK(journal[0].how == outcome::cut_short);
    CHECK(journal[0].integrations == 5);
    CHECK(journal[1].how == outcome::gained);
    CHECK(journal[1].left == 0.4);
    CHECK(journal[1].integrations == 4);
    CHECK(journal[1].seconds == 2);
}

TEST_CASE("a record has its figures by name, and outcomes have words") {
    contraction_record const r{"a", "b", outcome::gained, 0.5, 1, 1, {{"longest", 2}}};
    CHECK(r.figure("longest") == 2);
    CHECK(r.figure("shortest") == 0);
    CHECK(r.asked());
    CHECK(to_string(outcome::not_applicable) == "not applicable");
    CHECK(to_string(outcome::cut_short) == "cut short");
}
