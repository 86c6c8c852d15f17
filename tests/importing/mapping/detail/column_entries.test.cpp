// SPDX-License-Identifier: MIT
#include <sivid/importing/mapping/detail/source_form_reader.hpp>

#include "io/import_support.hpp"

using namespace sivid;
namespace entries = sivid::mapping_entries;

namespace {
json_value entry(std::string const& text) { return parse_json("m.json", text); }
} // namespace

TEST_CASE("columns by heading or number") {
    CHECK(entries::column(entry("\"Zeit [s]\"")).heading == "Zeit [s]");
    CHECK(entries::column(entry("3")).number == 3);
    CHECK_THROWS_AS(entries::column(entry("0")), input_error);
    CHECK_THROWS_AS(entries::column(entry("null")), input_error);
    CHECK(entries::character(entry("\"\\t\""), ",\t", "") == '\t');
    CHECK_THROWS_AS(entries::character(entry("\"x\""), ",\t", "write a comma"), input_error);
    CHECK_THROWS_AS(entries::character(entry("\"\""), ",\t", "write a comma"), input_error);
    CHECK(entries::counter_bits(entry("32")) == 32);
}
