// SPDX-License-Identifier: MIT
#include <sivid/io/text/text_file.hpp>

#include "io/support.hpp"
#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("reading a text drops the byte-order mark and needs a regular file") {
    io_support::temporary_folder const folder;
    folder.write("bom", "\xEF\xBB\xBFtext");
    folder.write("empty", "");
    CHECK(read_text(folder.path() / "bom") == "text");
    CHECK(read_text(folder.path() / "empty").empty());
    CHECK_THROWS_WITH(read_text(folder.path() / "gone"), ContainsSubstring("no such file"));
    CHECK_THROWS_WITH(read_text(folder.path()), ContainsSubstring("not a regular file"));
}

TEST_CASE("a path named by a data set stays inside its folder") {
    io_support::temporary_folder const outer;
    outer.write("secret.csv", "x");
    outer.write("set/a.csv", "x");
    outer.write("set/sub/b.csv", "x");
    auto const set = outer.path() / "set";
    std::filesystem::create_symlink("../secret.csv", set / "link.csv");
    std::filesystem::create_directory_symlink("..", set / "up");
    std::filesystem::create_symlink("a.csv", set / "inner_link.csv");
    std::filesystem::create_directory_symlink("set", outer.path() / "alias");

    input_place const place{.file = "dataset.json", .pointer = "/x", .is_json = true};
    CHECK(path_inside(set, "a.csv", place) == set / "a.csv");
    CHECK(path_inside(set, "sub/b.csv", place) == set / "sub/b.csv");
    CHECK(path_inside(set, "./a.csv", place) == set / "./a.csv");
    CHECK(path_inside(set, "inner_link.csv", place) == set / "inner_link.csv");
    CHECK_NOTHROW(
        path_inside(outer.path() / "alias", "a.csv", place)); // the folder itself may be a link
    CHECK_NOTHROW(path_inside(set, "absent.csv", place));
    for (auto name : {"../secret.csv", "sub/../../secret.csv", "sub/../a.csv", "..", "/etc/passwd",
                      "link.csv", "up/secret.csv", "", "a\\b.csv"}) {
        CAPTURE(name);
        CHECK_THROWS_AS(path_inside(set, name, place), input_error);
    }
    CHECK_THROWS_AS(path_inside(set, std::string{"a.csv\0b", 7}, place), input_error);
}

TEST_CASE("a file that is too large is refused before it is read") {
    io_support::temporary_folder const folder;
    folder.write("large.csv", "t,y\n");
    // A hole, which takes no space on the disk.
    std::filesystem::resize_file(folder.path() / "large.csv", largest_text + 1);
    CHECK_THROWS_WITH(read_text(folder.path() / "large.csv"),
                      ContainsSubstring("larger than 1 GB"));
}
