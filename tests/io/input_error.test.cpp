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

TEST_CASE("a message is printable and of a length that can be read whatever the input holds") {
    std::string const evil = "\x1b[31m\r\n\x07\xc2\x9b\xe2\x80\xae";
    input_error const e{{.file = evil + std::string(100000, 'd') + "/" + evil,
                         .line = 3,
                         .column = 2,
                         .heading = evil + std::string(9000, 'h'),
                         .pointer = "/" + std::string(5000, 'p') + evil,
                         .is_json = true},
                        "found " + evil + std::string(99999, 'x'),
                        evil + std::string(99999, 'y')};
    CHECK(unprintable_in(e.what()).empty());
    CHECK(std::string{e.what()}.size() < 2600);
    CHECK(e.place().pointer.size() > 5000); // what was given
    CHECK(unprintable_in(in_quotes(evil)).empty());
    CHECK(in_quotes("Größe 5 °C") == "'Größe 5 °C'");
}
