// SPDX-License-Identifier: MIT
#include <sivid/io/file_set.hpp>

#include "io/support.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <csignal>
#include <string>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using io_support::temporary_folder;
using sivid::file_set;

namespace {

std::size_t count_of(io_support::fs::path const& folder) {
    auto const all = io_support::fs::directory_iterator{folder};
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

} // namespace

TEST_CASE("files take their names together") {
    temporary_folder const folder;
    folder.write("a.csv", "old a");
    folder.write("gone.csv", "old");
    folder.write("result.json", "old result");
    {
        file_set files(folder.path());
        files.add("a.csv", "new a");
        files.drop("gone.csv");
        files.add("b.csv", std::string(100000, 'b'));
        files.add("result.json", "new result");
        CHECK(folder.read("a.csv") == "old a");
        CHECK(folder.read("result.json") == "old result");
        CHECK(folder.read("gone.csv") == "old");
        files.commit();
        CHECK(folder.read("a.csv") == "new a");
        CHECK(folder.read("b.csv").size() == 100000);
        CHECK(folder.read("result.json") == "new result");
    }
    CHECK(count_of(folder.path()) == 3);
    file_set deep(folder.path() / "x" / "y");
    deep.add("only.txt", "");
    deep.commit();
    CHECK(folder.read("x/y/only.txt").empty());
}

TEST_CASE("what is not committed leaves no trace") {
    temporary_folder const folder;
    folder.write("a.csv", "old");
    {
        file_set files(folder.path());
        files.add("a.csv", "new");
        files.add("b.csv", "new");
        files.drop("a.csv");
    }
    CHECK(folder.read("a.csv") == "old");
    CHECK(count_of(folder.path()) == 1);
}

TEST_CASE("what a killed process left behind goes with the next commit, and nothing else") {
    temporary_folder const folder;
    auto const dead = ::fork();
    if (dead == 0) ::_exit(0);
    ::waitpid(dead, nullptr, 0);
    folder.write("a.csv.part" + std::to_string(dead), "half");
    folder.write("a.csv.part" + std::to_string(::getpid() == 1 ? 1 : ::getppid()), "of another");
    folder.write("other.part" + std::to_string(dead), "somebody's");
    folder.write("a.csv.partial", "somebody's");
    file_set files(folder.path());
    files.add("a.csv", "new");
    files.commit();
    CHECK(count_of(folder.path()) == 4);
    CHECK_FALSE(io_support::fs::exists(folder.path() / ("a.csv.part" + std::to_string(dead))));
}

TEST_CASE("where one file cannot be written the others keep their old content") {
    temporary_folder const folder;
    folder.write("a.csv", "old a");
    io_support::fs::create_directory(folder.path() / "result.json");
    {
        file_set files(folder.path());
        files.add("a.csv", "new a");
        CHECK_THROWS_WITH(files.add("result.json", "x"),
                          ContainsSubstring("a folder has this name"));
    }
    CHECK(folder.read("a.csv") == "old a");
    folder.write("file", "");
    CHECK_THROWS_AS(file_set(folder.path() / "file"), sivid::output_error);
    CHECK_THROWS_AS(file_set(folder.path() / "file" / "below"), sivid::output_error);
}

TEST_CASE("a full disk leaves the old result whole") {
    temporary_folder const folder;
    folder.write("a.csv", "old a");
    folder.write("b.csv", "old b");
    folder.write("result.json", "old result");
    auto const child = ::fork();
    if (child == 0) { // of its own: the limit cannot be taken back
        ::rlimit const limit{5000, 5000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        ::signal(SIGXFSZ, SIG_IGN);
        int said = 1;
        try {
            file_set files(folder.path());
            files.add("a.csv", std::string(1000, 'a'));
            files.add("b.csv", std::string(6000, 'b'));
            files.add("result.json", "new");
            files.commit();
        } catch (sivid::output_error const& e) {
            said =
                std::string{e.what()}.find("b.csv: cannot be written") != std::string::npos ? 0 : 2;
        }
        ::_exit(said);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    CHECK(WEXITSTATUS(status) == 0);
    CHECK(folder.read("a.csv") == "old a");
    CHECK(folder.read("b.csv") == "old b");
    CHECK(folder.read("result.json") == "old result");
    CHECK(count_of(folder.path()) == 3);
}
