// SPDX-License-Identifier: MIT
#include <sivid/io/dataset/dataset_digest.hpp>

#include "io/support.hpp"
#include "support/catch.hpp"

using io_support::temporary_folder;

namespace {

void write_set(temporary_folder const& folder, std::string const& inputs = "t,W\n0,1\n1,1\n",
               std::string const& measured = "t,x,x_err\n0.5,1,0.1\n") {
    folder.write("dataset.json",
                 R"({"scenarios": [{"inputs": "a.csv", "measurements": "b.csv"}]})");
    folder.write("a.csv", inputs);
    folder.write("b.csv", measured);
}

} // namespace

TEST_CASE("the digest follows the content, not the place") {
    temporary_folder const one, other;
    write_set(one);
    write_set(other);
    other.write("unrelated.txt", "anything");
    auto const digest = sivid::dataset_digest(one.path());
    CHECK(digest.size() == 64);
    CHECK(sivid::dataset_digest(other.path()) == digest);
    write_set(other, "t,W\n0,1\n1,1\n", "t,x,x_err\n0.5,1,0.2\n");
    CHECK(sivid::dataset_digest(other.path()) != digest);
    write_set(other, "t,W\n0,1\n1,2\n");
    CHECK(sivid::dataset_digest(other.path()) != digest);
}

TEST_CASE("a table that is missing or outside the folder is an error") {
    temporary_folder const folder;
    write_set(folder);
    folder.write("dataset.json",
                 R"({"scenarios": [{"inputs": "a.csv", "measurements": "c.csv"}]})");
    CHECK_THROWS_AS(sivid::dataset_digest(folder.path()), sivid::input_error);
    folder.write("dataset.json",
                 R"({"scenarios": [{"inputs": "../a.csv", "measurements": "b.csv"}]})");
    CHECK_THROWS_AS(sivid::dataset_digest(folder.path()), sivid::input_error);
}
