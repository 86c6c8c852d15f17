// SPDX-License-Identifier: MIT
#include <sivid/cluster/identity.hpp>

#include "support/catch.hpp"

using namespace sivid::cluster;

TEST_CASE("a program knows itself again, and tells others by what differs") {
    auto const who = identity_of_program();
    CHECK(who.differing(identity_of_program()) == nullptr);
    REQUIRE(who.parts.size() == 3);
    CHECK(who.parts[1].value.find("-0") == std::string::npos); // the file was read
    for (std::size_t k = 0; k < who.parts.size(); ++k) {
        auto other = who;
        other.parts[k].value += "x";
        REQUIRE(who.differing(other) != nullptr);
        CHECK(who.differing(other)->what == who.parts[k].what);
        other.parts.resize(k);
        CHECK(who.differing(other) == &who.parts[k]);
    }
}

TEST_CASE("one byte of a file changes its print") {
    std::string text(100003, 'a');
    auto const before = identity_detail::print_of(text);
    CHECK(identity_detail::print_of(text) == before);
    for (auto const at : {0, 65535, 65536, 100000, 100002}) {
        auto other = text;
        other[static_cast<std::size_t>(at)] = 'b';
        CHECK(identity_detail::print_of(other) != before);
    }
    CHECK(identity_detail::print_of(text + 'a') != before);
}
