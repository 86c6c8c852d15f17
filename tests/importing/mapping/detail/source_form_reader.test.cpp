// SPDX-License-Identifier: MIT
#include <sivid/importing/mapping/detail/source_form_reader.hpp>

#include "io/import_support.hpp"

using namespace sivid;
using io_support::dec;

namespace {
json_value entry(std::string const& text) { return parse_json("m.json", text); }
} // namespace

TEST_CASE("the form of a table") {
    auto const plain = read_source_form(entry(R"({"kind": "csv"})"));
    CHECK(plain.from == source_form::kind::csv);
    CHECK(plain.separator == ',');
    CHECK(plain.decimal == '.');
    auto const f = read_source_form(entry(
        R"({"kind": "csv", "separator": ";", "decimal": ",", "missing": ["-"], "skip_lines": 2, "skip_after_heading": 1})"));
    CHECK(f.separator == ';');
    CHECK(f.decimal == ',');
    CHECK(f.missing == std::vector<std::string>{"-"});
    CHECK(f.skip_lines == 2);
    CHECK(f.skip_after_heading == 1);
    CHECK_FALSE(f.heading);
    CHECK(read_source_form(entry(R"({"heading": false, "skip_lines": 2})")).heading == false);
    for (auto const* bad :
         {R"({"kind": "xls"})", R"({"kind": "csv", "separator": "x"})",
          R"({"kind": "csv", "decimal": ","})", R"({"kind": "csv", "decimal": "'"})",
          R"({"kind": "csv", "fields": ["t"]})", R"({"kind": "csv", "skip_lines": -1})",
          R"({"heading": "no"})", R"({"heading": false, "skip_after_heading": 1})"})
        CHECK_THROWS_AS(read_source_form(entry(bad)), input_error);
}

TEST_CASE("the form of a log") {
    auto const f = read_source_form(entry(
        R"({"kind": "serial", "fields": ["t", "_", "_", "x"], "longest_gap": 0.1, "gap": "keep", "restart": "drop"})"));
    CHECK(f.from == source_form::kind::serial);
    CHECK(f.fields.size() == 4);
    CHECK(f.longest_gap == dec("0.1"));
    CHECK(f.gap == break_policy::keep);
    CHECK(f.restart == break_policy::drop);
    auto const refusing = read_source_form(
        entry(R"({"kind": "serial", "fields": ["t"], "longest_gap": 1, "gap": "split"})"));
    CHECK(refusing.gap == break_policy::split);
    CHECK(refusing.restart == break_policy::refuse);
    for (auto const* bad :
         {R"({"kind": "serial", "fields": ["t"]})", R"({"kind": "serial", "longest_gap": 1})",
          R"({"kind": "serial", "fields": [], "longest_gap": 1})",
          R"({"kind": "serial", "fields": ["t", "t"], "longest_gap": 1})",
          R"({"kind": "serial", "fields": ["t"], "longest_gap": 0})",
          R"({"kind": "serial", "fields": ["t"], "longest_gap": 1, "gap": "drop"})",
          R"({"kind": "serial", "fields": ["t"], "longest_gap": 1, "restart": "keep"})",
          R"({"kind": "serial", "fields": ["t"], "longest_gap": 1, "skip_lines": 1})"})
        CHECK_THROWS_AS(read_source_form(entry(bad)), input_error);
}

TEST_CASE("the time") {
    auto const t = read_time_mapping(
        entry(R"({"column": "t_ms", "unit": "ms", "offset": "first", "counter_bits": 32})"), true);
    CHECK(t.from_first);
    CHECK(t.counter_bits == 32u);
    CHECK(t.to_seconds(dec("1500"))->value == dec("1.5"));
    auto const us =
        read_time_mapping(entry(R"({"column": 2, "unit": "us", "offset": -0.5})"), false);
    CHECK(us.to_seconds(dec("7"))->value == dec("7e-6"));
    CHECK(us.offset == dec("-0.5"));
    CHECK(read_time_mapping(entry(R"({"column": 2, "unit": "s", "offset": 0})"), false)
              .to_seconds(dec("7"))
              ->value == dec("7"));
    for (auto const* bad :
         {R"({"unit": "s", "offset": 0})", R"({"column": 1, "unit": "fortnight", "offset": 0})",
          R"({"column": 1, "unit": "s"})", R"({"column": 1, "unit": "s", "offset": "last"})",
          R"({"column": 1, "unit": "ms", "offset": 0, "counter_bits": 32})"})
        CHECK_THROWS_AS(read_time_mapping(entry(bad), false), input_error);
}

TEST_CASE("a quantity") {
    auto const q = read_quantity_mapping(
        entry(
            R"({"column": "adc", "unit": "V", "factor": 5, "divisor": 1023, "offset": -2.5, "range": [0, 1023], "error": "propose"})"),
        "y", false);
    CHECK(q.name == "y");
    CHECK(q.conversion.text() == "reading * 5 / 1023 - 2.5");
    CHECK(q.range->second == dec("1023"));
    CHECK(q.error.from == bound_source::kind::proposed);
    auto const exact = read_quantity_mapping(entry(R"({"column": 1})"), "u", true);
    CHECK(exact.error.from == bound_source::kind::none);
    auto const column = read_quantity_mapping(
        entry(R"({"column": 1, "counter_bits": 16, "factor": [-2, -1], "error": {"column": "e"}})"),
        "u", true);
    CHECK(column.error.from == bound_source::kind::column);
    CHECK(column.error.column.heading == "e");
    CHECK(column.counter_bits == 16u);
    CHECK_FALSE(column.conversion.factor_is_exact());
    auto const angle = read_quantity_mapping(entry(R"({"column": 1, "period": 360})"), "psi", true);
    CHECK(angle.period->second == dec("360"));
    for (auto const* bad : {R"({"column": 1, "error": 1, "period": 0})",
                            R"({"column": 1, "error": 1, "period": [-1, 1]})",
                            R"({"column": 1, "error": 1, "period": 1e400})",
                            R"({"column": 1, "error": 1, "period": 360, "counter_bits": 16})"})
        CHECK_THROWS_AS(read_quantity_mapping(entry(bad), "y", false), input_error);
    CHECK_THROWS_AS(read_quantity_mapping(entry(R"({"column": 1, "period": [6, 7]})"), "u", true),
                    input_error);
    auto const sum = read_quantity_mapping(
        entry(R"({"column": {"formula": "left - right", "columns": {"right": 3}},
                  "signed_bits": 16, "error": 1})"),
        "y", false);
    REQUIRE(sum.columns.size() == 2);
    CHECK(sum.columns[0].heading == "left");
    CHECK(sum.columns[1].number == 3);
    CHECK(sum.formula->text() == "left - right");
    CHECK(sum.signed_bits == 16u);
    for (auto const* bad :
         {R"({"column": {"formula": ""}, "error": 1})",
          R"({"column": {"formula": "3"}, "error": 1})",
          R"({"column": {"formula": "a b"}, "error": 1})",
          R"({"column": {"formula": "a*"}, "error": 1})",
          R"_({"column": {"formula": "f(a)"}, "error": 1})_",
          R"({"column": {"formula": "a^0.5"}, "error": 1})",
          R"_({"column": {"formula": "max(a)"}, "error": 1})_",
          R"({"column": {"formula": "a*1e999"}, "error": 1})",
          R"({"column": {"formula": "a", "columns": {"b": 1}}, "error": 1})",
          R"({"column": {"columns": {"b": 1}}, "error": 1})", R"({"column": {"a": 1}, "error": 1})",
          R"({"column": 1, "signed_bits": 16, "counter_bits": 16, "error": 1})"})
        CHECK_THROWS_AS(read_quantity_mapping(entry(bad), "y", false), input_error);
    for (auto const* bad : {R"({"error": 1})", R"({"column": 1})", R"({"column": 1, "error": 0})",
                            R"({"column": 1, "error": "guess"})", R"({"column": 1, "error": {}})",
                            R"({"column": 1, "error": 1, "factor": 0})",
                            R"({"column": 1, "error": 1, "factor": [-1, 1]})",
                            R"({"column": 1, "error": 1, "divisor": 0})",
                            R"({"column": 1, "error": 1, "divisor": 1.5})",
                            R"({"column": 1, "error": 1, "counter_bits": 4})",
                            R"({"column": 1, "error": 1, "range": [2, 1]})",
                            R"({"column": 1, "error": 1, "scale": 2})"})
        CHECK_THROWS_AS(read_quantity_mapping(entry(bad), "y", false), input_error);
    // An exact input cannot have an uncertain factor.
    CHECK_THROWS_AS(read_quantity_mapping(entry(R"({"column": 1, "factor": [1, 2]})"), "u", true),
                    input_error);
}
