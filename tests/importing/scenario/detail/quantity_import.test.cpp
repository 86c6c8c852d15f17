// SPDX-License-Identifier: MIT
#include <sivid/importing/scenario/detail/quantity_import.hpp>

#include "io/import_support.hpp"

#include <cmath>
#include <stdexcept>

using namespace sivid;
using namespace io_support;

namespace {

recorded_table table_of(std::vector<std::vector<std::string>> const& rows) {
    recorded_table table;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        recorded_table::row row;
        row.line = i + 2;
        row.time = dec(std::to_string(i));
        for (auto const& cell : rows[i])
            row.cells.push_back(cell.empty() ? std::nullopt : exact_decimal::parse(cell));
        table.rows.push_back(row);
    }
    return table;
}
struct result {
    import_protocol protocol;
    imported_quantity quantity;
    std::size_t cell = 0;
};
result read(quantity_mapping const& q, std::vector<std::vector<std::string>> const& rows) {
    static scenario_mapping const s;
    result r;
    r.quantity = quantity_import{s, q, "A", r.protocol}.read(table_of(rows), r.cell);
    return r;
}

column_formula formula(std::string const& text) {
    return {text, [](std::size_t at, std::string const& problem, std::string const&) {
                throw std::runtime_error(std::to_string(at) + problem);
            }};
}

} // namespace

TEST_CASE("missing and impossible readings are dropped, the others converted") {
    quantity_mapping q;
    q.name = "y";
    q.unit = "V";
    q.range.emplace(dec("0"), dec("1023"));
    q.conversion.factor_lower = q.conversion.factor_upper = dec("5");
    q.conversion.divisor = 1023;
    q.error.from = bound_source::kind::number;
    auto const r = read(q, {{"0"}, {""}, {"1024"}, {"-1"}, {"1023"}, {"341"}});
    REQUIRE(r.quantity.samples.size() == 3);
    CHECK(r.cell == 1);
    CHECK(r.quantity.samples[1].line == 6);
    CHECK(r.quantity.samples[1].reading.value == dec("5"));
    CHECK(r.quantity.samples[2].reading.rounding.is_positive());
    CHECK(noted(r.protocol, "no reading") == std::vector<std::size_t>{3});
    CHECK(noted(r.protocol, "possible range [0, 1023]") == std::vector<std::size_t>{4, 5});
    CHECK(has_note(r.protocol, "reading * 5 / 1023 [V]"));
    CHECK(has_note(r.protocol, "half width is added"));
}

TEST_CASE("counts are followed, and what is no count is dropped") {
    quantity_mapping q;
    q.name = "x";
    q.counter_bits = 16;
    q.error.from = bound_source::kind::number;
    auto const r = read(q, {{"65530"}, {"4"}, {"3.5"}, {"70000"}, {"65534"}, {"32766"}, {"50000"}});
    REQUIRE(r.quantity.samples.size() == 4);
    CHECK(r.quantity.samples[1].reading.value == dec("65540"));
    CHECK(r.quantity.samples[2].reading.value == dec("65534"));
    CHECK(r.quantity.samples[3].reading.value == dec("50000"));
    CHECK(noted(r.protocol, "no count") == std::vector<std::size_t>{4, 5, 7});
    CHECK(noted(r.protocol, "through the end of its range") == std::vector<std::size_t>{3, 6});
    CHECK(has_note(r.protocol, "less than half its range"));
}

TEST_CASE("registers have signs, and may be of two columns") {
    quantity_mapping q;
    q.name = "i";
    q.error.from = bound_source::kind::number;
    q.signed_bits = 16;
    auto const r =
        read(q, {{"0"}, {"32767"}, {"32768"}, {"65535"}, {"65536"}, {"-3"}, {"1.5"}, {"-32769"}});
    std::vector<std::string> values;
    for (auto const& s : r.quantity.samples) values.push_back(s.reading.value.text());
    CHECK(values == std::vector<std::string>{"0", "32767", "-32768", "-1", "-3"});
    CHECK(noted(r.protocol, "no register of 16 bits") == std::vector<std::size_t>{6, 8, 9});
    // Two words of one register, then the bound of its error.
    q.formula = formula("65536*hi + lo");
    q.columns = {{"hi", 0, {}}, {"lo", 0, {}}};
    q.signed_bits = 32;
    q.error.from = bound_source::kind::column;
    auto const words = read(q, {{"0", "7", "1"}, {"65535", "65534", "1"}, {"1", "", "1"}});
    REQUIRE(words.quantity.samples.size() == 2);
    CHECK(words.cell == 3);
    CHECK(words.quantity.samples[0].reading.value == dec("7"));
    CHECK(words.quantity.samples[1].reading.value == dec("-2"));
    CHECK(noted(words.protocol, "no reading") == std::vector<std::size_t>{4});
    CHECK(has_note(words.protocol, "the reading is 65536*hi + lo"));
}

TEST_CASE("a reading is a formula of columns: exact where it can be, else its enclosure") {
    quantity_mapping q;
    q.name = "P";
    q.formula = formula("V*I/1000 - 0.5");
    q.columns = {{"V", 0, {}}, {"I", 0, {}}};
    q.error.from = bound_source::kind::number;
    auto const power = read(q, {{"12.1", "200"}, {"", "1"}, {"3", "1"}});
    REQUIRE(power.quantity.samples.size() == 2);
    auto const held = [](imported_sample const& s, double exact) {
        auto const& x = s.reading;
        return enclose(x.value - x.rounding)->lower() <= exact &&
               exact <= enclose(x.value + x.rounding)->upper() && *nearest(x.rounding) < 1e-14;
    };
    CHECK(held(power.quantity.samples[0], 1.92));
    CHECK(held(power.quantity.samples[1], -0.497));
    CHECK(noted(power.protocol, "no reading") == std::vector<std::size_t>{3});

    q.formula = formula("sqrt(V^2 - sqr(I))");
    auto const length = read(q, {{"5", "3"}, {"3", "5"}, {"2", "1"}, {"0", "0"}});
    REQUIRE(length.quantity.samples.size() == 3);
    CHECK(held(length.quantity.samples[0], 4));
    CHECK(held(length.quantity.samples[1], std::sqrt(3)));
    CHECK(held(length.quantity.samples[2], 0));
    CHECK(noted(length.protocol, "its formula has no value") == std::vector<std::size_t>{3});
    CHECK(has_note(length.protocol, "half width is added"));
    for (auto const* never : {"1/0*V*I", "log(0)*V*I", "sqrt(-1)*V*I"}) {
        q.formula = formula(never);
        CHECK(read(q, {{"1", "2"}}).quantity.samples.empty());
    }
    q.formula = formula("1/(V - I)");
    CHECK(read(q, {{"1", "1"}, {"1e300", "1e-300"}}).quantity.samples.size() == 1);

    q.formula = formula("max(V, -I, 2)*sign(V) + abs(-V)^3");
    auto const exact = read(q, {{"3", "7"}, {"-1", "0.5"}, {"0", "9"}});
    REQUIRE(exact.quantity.samples.size() == 3);
    CHECK(exact.quantity.samples[0].reading.value == dec("30"));
    CHECK(exact.quantity.samples[1].reading.value == dec("-1"));
    CHECK(exact.quantity.samples[1].reading.rounding.is_zero());
    CHECK(exact.quantity.samples[2].reading.rounding == dec("2")); // sign(0) is a set

    // An angle of a formula is followed.
    q.formula = formula("2*atan(V/I)");
    q.period.emplace(dec("6.283185307179586"), dec("6.283185307179587"));
    auto const angle = read(q, {{"10", "1"}, {"-10", "1"}});
    REQUIRE(angle.quantity.samples.size() == 2);
    CHECK(std::abs(*nearest(angle.quantity.samples[1].reading.value) - 3.3409) < 1e-3);
}

TEST_CASE("angles are followed, with what the period leaves open in the error bound") {
    quantity_mapping q;
    q.name = "psi";
    q.period.emplace(dec("360"), dec("360"));
    q.conversion.factor_lower = q.conversion.factor_upper = dec("0.01");
    q.error.from = bound_source::kind::number;
    auto const r = read(q, {{"170"}, {""}, {"-170"}, {"-60"}, {"120"}, {"100"}, {"-150"}});
    REQUIRE(r.quantity.samples.size() == 5);
    CHECK(r.quantity.samples[1].reading.value == dec("1.9"));
    CHECK(r.quantity.samples[4].reading.value == dec("5.7"));
    CHECK(r.quantity.samples[4].reading.rounding.is_zero());
    CHECK(noted(r.protocol, "half a period") == std::vector<std::size_t>{6});
    CHECK(noted(r.protocol, "followed beyond it") == std::vector<std::size_t>{4, 8});
    CHECK(noted(r.protocol, "the shorter way is taken") == std::vector<std::size_t>{5, 7, 8});
    CHECK(has_note(r.protocol, "less than half a period"));

    auto plain = q;
    plain.period.reset();
    auto const unsaid = read(plain, {{"150"}, {"170"}, {"-170"}, {"-150"}});
    CHECK(noted(unsaid.protocol, "state \"period\": 360") == std::vector<std::size_t>{4});
    CHECK_FALSE(has_note(read(plain, {{"0"}, {"300"}, {"10"}, {"200"}}).protocol, "wraps"));
    CHECK_FALSE(has_note(read(plain, {{"0"}, {"90"}, {"170"}, {"250"}}).protocol, "wraps"));
    CHECK_FALSE(has_note(read(plain, {{"0"}, {"5"}, {"5"}, {"0"}}).protocol, "wraps")); // volts
    auto const radians = read(plain, {{"3.0"}, {"-3.1"}, {"-2.9"}});
    CHECK(noted(radians.protocol, "6.283185307179587") == std::vector<std::size_t>{3});

    q.period.emplace(dec("359"), dec("361"));
    auto const rough = read(q, {{"170"}, {"-170"}});
    CHECK(rough.quantity.samples[1].reading.value == dec("1.9"));
    CHECK(rough.quantity.samples[1].reading.rounding == dec("0.01"));
    CHECK(has_note(rough.protocol, "half width is added"));
}

TEST_CASE("a column of error bounds") {
    quantity_mapping q;
    q.name = "y";
    q.conversion.factor_lower = q.conversion.factor_upper = dec("-0.01");
    q.error.from = bound_source::kind::column;
    auto const r = read(q, {{"100", "2"}, {"100", ""}, {"100", "0"}, {"100", "-1"}, {"", ""}});
    REQUIRE(r.quantity.samples.size() == 1);
    CHECK(r.cell == 2);
    CHECK(r.quantity.samples[0].reading.value == dec("-1"));
    CHECK(r.quantity.samples[0].error == dec("0.02"));
    CHECK(noted(r.protocol, "bound is missing") == std::vector<std::size_t>{3});
    CHECK(noted(r.protocol, "not above 0") == std::vector<std::size_t>{4, 5});
}

TEST_CASE("exact inputs are said to be exact, and overflow is refused") {
    quantity_mapping q;
    q.name = "u";
    CHECK(has_note(read(q, {{"1"}}).protocol, "the input is exact"));
    q.conversion.factor_lower = q.conversion.factor_upper = dec("1e200");
    CHECK_THROWS_AS(read(q, {{"1e200"}}), input_error);
}
