// SPDX-License-Identifier: MIT
#include <sivid/io/text/durable_file.hpp>

#include "io/support.hpp"
#include "support/catch.hpp"

#include <string>

using io_support::temporary_folder;

TEST_CASE("a file is replaced whole, and nothing else is left") {
    temporary_folder const folder;
    auto const file = folder.path() / "state.txt";
    folder.write("state.txt.part", "what a killed run left behind, and longer than the new text");
    for (auto const& text : {std::string{"first"}, std::string(300000, 'x'), std::string{}}) {
        sivid::write_durably(file, text);
        CHECK(folder.read("state.txt") == text);
        CHECK_FALSE(io_support::fs::exists(folder.path() / "state.txt.part"));
    }
}

TEST_CASE("what cannot be written says so and leaves the old content") {
    temporary_folder const folder;
    CHECK_THROWS_WITH(sivid::write_durably(folder.path() / "none" / "state.txt", "x"),
                      ContainsSubstring("state.txt") && ContainsSubstring("cannot be written"));
    // A folder stands where the file should be.
    io_support::fs::create_directory(folder.path() / "state.txt");
    CHECK_THROWS_AS(sivid::write_durably(folder.path() / "state.txt", "x"), sivid::output_error);
    CHECK_FALSE(io_support::fs::exists(folder.path() / "state.txt.part"));
    folder.write("file", "x");
    CHECK_THROWS_AS(sivid::write_durably(folder.path() / "file" / "below", "y"),
                    sivid::output_error);
    folder.write("old.txt", "old");
    io_support::fs::create_directory(folder.path() / "old.txt.part");
    CHECK_THROWS_AS(sivid::write_durably(folder.path() / "old.txt", "new"), sivid::output_error);
    CHECK(folder.read("old.txt") == "old");
}
