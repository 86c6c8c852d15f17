// SPDX-License-Identifier: MIT
#include <sivid/number/text/joined.hpp>

#include "support/catch.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace {

struct entry {
    std::string name;
    std::size_t size = 0;
};

} // namespace

TEST_CASE("a separator stands between any two entries and nowhere else") {
    using strings = std::vector<std::string>;
    CHECK(sivid::joined(strings{}) == "");
    CHECK(sivid::joined(strings{"a"}) == "a");
    CHECK(sivid::joined(strings{"a", "b", "c"}) == "a, b, c");
    CHECK(sivid::joined(strings{"a", "b"}, " + ") == "a + b");
    CHECK(sivid::joined(strings{"", "", "x"}, ",") == ",,x");
    CHECK(sivid::joined(std::array<std::string_view, 2>{"a", "b"}, "") == "ab");
}

TEST_CASE("an enumeration has another word before the last") {
    using strings = std::vector<std::string>;
    CHECK(sivid::enumeration(strings{}) == "");
    CHECK(sivid::enumeration(strings{"a"}) == "a");
    CHECK(sivid::enumeration(strings{"a", "b"}) == "a and b");
    CHECK(sivid::enumeration(strings{"a", "b", "c"}, " or ") == "a, b or c");
}

TEST_CASE("entries are told by a function, a member or their name") {
    std::vector<entry> const list{{"a", 1}, {"b", 22}};
    CHECK(sivid::joined(list, "; ", [](entry const& e) {
              return e.name + " = " + std::to_string(e.size);
          }) == "a = 1; b = 22");
    CHECK(sivid::joined(list, "/", &entry::name) == "a/b");
    CHECK(sivid::joined_names(list) == "a, b");
    CHECK(sivid::joined_names(list, "+") == "a+b");
    CHECK(sivid::joined_names(std::vector<entry>{}) == "");
}
