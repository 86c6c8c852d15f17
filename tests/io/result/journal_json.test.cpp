// SPDX-License-Identifier: MIT
#include <sivid/io/result/journal_json.hpp>

#include "support/catch.hpp"

#include <nlohmann/json.hpp>

using namespace sivid;

TEST_CASE("a journal says who was tried and why, and its effort where it was asked") {
    json_writer writer;
    writer.begin_object();
    write_journal(writer, {}); // nothing
    using outcome = contraction_record::outcome;
    write_journal(writer, {{"windows", "delays", outcome::not_applicable},
                           {"equations", "early", outcome::gained, 0.5, 3, 1, {{"longest", 2}}}});
    writer.end_object();
    auto const json = nlohmann::json::parse(writer.text())["journal"];
    REQUIRE(json.size() == 2);
    CHECK(json[0]["by"] == "windows");
    CHECK(json[0]["outcome"] == "not applicable");
    CHECK(json[0]["why"] == "delays");
    CHECK_FALSE(json[0].contains("seconds"));
    CHECK(json[1]["left"] == 0.5);
    CHECK(json[1]["integrations"] == 3);
    CHECK(json[1]["longest"] == 2);
}
