// SPDX-License-Identifier: MIT
#include <sivid/io/dataset/mapping_entries.hpp>

#include "io/import_support.hpp"

using namespace sivid;
namespace entries = sivid::mapping_entries;

namespace {
json_value entry(std::string const& text) { return parse_json("m.json", text); }
} // namespace

TEST_CASE("names can head a column") {
    auto const e = entry("1");
    for (auto const* good : {"u", "psi", "T_in", "rudder_lag.tau", "x-1", "\xCF\x89"})
        CHECK(entries::name(e, good) == good);
    for (auto const* bad : {"", "t", "a,b", "a b", "a;b", ".x", "a/b", "\"", "#x", "a\nb"})
        CHECK_THROWS_AS(entries::name(e, bad), input_error);
    CHECK_THROWS_AS(entries::name(e, std::string(101, 'a')), input_error);
}

TEST_CASE("words, ranges and whole numbers") {
    CHECK_FALSE(entry("\"fit\"").is_second_of("fit", "holdout"));
    CHECK(entry("\"holdout\"").is_second_of("fit", "holdout"));
    CHECK_THROWS_AS(entry("\"test\"").is_second_of("fit", "holdout"), input_error);
    auto const r = entries::range(entry("[0.1, 0.3]"));
    CHECK(r.lower == io_support::dec("0.1"));
    CHECK(contains(r.enclosure, 0.3));
    CHECK_THROWS_AS(entries::range(entry("[0.3, 0.1]")), input_error);
    CHECK_THROWS_AS(entries::range(entry("[0.3]")), input_error);
    CHECK(entries::whole(entry("16"), 8, 48) == 16);
    CHECK(entries::whole(entry("1.6e1"), 8, 48) == 16);
    for (auto const* bad : {"7", "49", "16.5", "-16", "1e300", "\"16\""})
        CHECK_THROWS_AS(entries::whole(entry(bad), 8, 48), input_error);
    CHECK(entries::positive(entry("1e-9"), "") == io_support::dec("1e-9"));
    for (auto const* bad : {"0", "-1", "1e-400"})
        CHECK_THROWS_AS(entries::positive(entry(bad), "state it"), input_error);
}
