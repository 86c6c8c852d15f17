// SPDX-License-Identifier: MIT
#include <sivid/io/input_error.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("an input error names file, place, problem and remedy") {
    input_error const table{
        {.file = "a.csv", .line = 12, .column = 3, .heading = "u_err", .pointer = ""},
        "the cell is empty",
        "give a number"};
    CHECK(std::string{table.what()} ==
          "a.csv: line 12, column 3 (u_err): the cell is empty; give a number");
    input_error const json{
        {.file = "d.json", .pointer = "/fixed/m", .is_json = true}, "found null", "correct it"};
    CHECK(std::string{json.what()} == "d.json: /fixed/m: found null; correct it");
    CHECK(json.place().pointer == "/fixed/m");
    CHECK(json.problem() == "found null");
    CHECK(json.remedy() == "correct it");
    CHECK(std::string{input_error{{.file = "d.json", .is_json = true}, "x", ""}.what()} ==
          "d.json: (document): x");
}

TEST_CASE("quoted text is short and shows no control characters") {
    CHECK(in_quotes("abc") == "'abc'");
    CHECK(in_quotes(std::string{"a\x01\n\0b", 5}) == "'a???b'");
    CHECK(in_quotes(std::string(100, 'x')).size() == 45);
}
