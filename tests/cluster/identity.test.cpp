// SPDX-License-Identifier: MIT
#include <sivid/cluster/identity.hpp>

#include "io/support.hpp"
#include "support/catch.hpp"

using namespace sivid::cluster;

TEST_CASE("a program knows itself again, and tells others by what differs") {
    auto const who = identity_of_program();
    CHECK(who.differing(identity_of_program()) == nullptr);
    REQUIRE(who.parts.size() == 4);
    CHECK(who.parts[2].value.find("-0") == std::string::npos); // the file was read
    for (std::size_t k = 0; k < who.parts.size(); ++k) {
        auto other = who;
        other.parts[k].value += "x";
        REQUIRE(who.differing(other) != nullptr);
        CHECK(who.differing(other)->what == who.parts[k].what);
        other.parts.resize(k);
        CHECK(who.differing(other) == &who.parts[k]);
    }
    sivid::cluster::wire_writer out;
    put(out, who);
    auto const bytes = out.take();
    wire_reader in(bytes);
    CHECK(who.differing(take_identity(in)) == nullptr);
}

TEST_CASE("one byte of a file changes its print") {
    io_support::temporary_folder const folder;
    std::string text(100003, 'a');
    auto const print = [&] {
        folder.write("file", text);
        return identity_detail::print_of((folder.path() / "file").c_str());
    };
    auto const before = print();
    CHECK(print() == before);
    for (auto const at : {0, 65535, 65536, 100000, 100002}) {
        auto const was = text[static_cast<std::size_t>(at)];
        text[static_cast<std::size_t>(at)] = 'b';
        CHECK(print() != before);
        text[static_cast<std::size_t>(at)] = was;
    }
    text += 'a';
    CHECK(print() != before);
}
