// SPDX-License-Identifier: MIT
// 21 test cases with a semicolon in their name had never run: ctest took the name apart, both
// halves matched nothing, and Catch2 2 ended with 0. A filter that matches nothing is a failure
// now, and scripts/check compares what ran.
#include "support/catch.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;

int exit_code(std::string const& command) {
    int const status = std::system((command + " >/dev/null 2>&1").c_str()); // NOLINT
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// This program, told to run other cases than this one.
int run_with(std::string const& filter) {
    return exit_code("'" + fs::read_symlink("/proc/self/exe").string() + "' " + filter);
}

/// A build with one test program, which lists what it is told to.
class planted_build {
public:
    planted_build()
        : root_{fs::temp_directory_path() /
                std::string{"sivid_cases_"}.append(std::to_string(::getpid()))} {
        fs::remove_all(root_);
        fs::create_directories(root_ / "tests/programs");
        write("program", "#!/bin/sh\nprintf 'one\\nunder [0, 1] <x> & y\\n'\nexit 2\n");
        fs::permissions(root_ / "program", fs::perms::owner_all);
        write("tests/programs/floor", "floor " + (root_ / "program").string() + "\n");
    }
    ~planted_build() { fs::remove_all(root_); }
    planted_build(planted_build const&) = delete;
    planted_build& operator=(planted_build const&) = delete;

    void write(std::string const& file, std::string const& text) const {
        std::ofstream{root_ / file} << text;
    }
    int judged(std::string const& results) const {
        write("results.xml", "<testsuite>\n" + results + "</testsuite>\n");
        return exit_code("'" SIVID_SOURCE_DIR "/tests/all-cases-ran' '" + root_.string() + "' '" +
                         (root_ / "results.xml").string() + "'");
    }

private:
    fs::path root_;
};

std::string result(std::string const& name, std::string const& status) {
    return "\t<testcase name=\"floor/" + name + "\" classname=\"x\" time=\"0.01\" status=\"" +
           status + "\">\n";
}

} // namespace

TEST_CASE("a filter that matches nothing fails") {
    CHECK(run_with("'cases that are listed and did not run are an error'") == 0);
    CHECK(run_with("'cases that are listed'") != 0);
    CHECK(run_with("'[no such tag]'") != 0);
    CHECK(run_with("'cases that are listed,and a second one'") != 0);
    CHECK(run_with("--help") == 0);
}

TEST_CASE("cases that are listed and did not run are an error") {
    planted_build const build;
    std::string const second = "under [0, 1] &lt;x&gt; &amp; y";
    CHECK(build.judged(result("one", "run") + result(second, "run")) == 0);
    CHECK(build.judged(result("one", "run")) == 1);
    CHECK(build.judged(result("one", "run") + result("under [0", "run")) == 1);
    CHECK(build.judged(result("one", "run") + result(second, "notrun")) == 1);
    auto const skipped = result(second, "notrun") + "\t\t<skipped message=\"SKIP_";
    CHECK(build.judged(result("one", "run") + skipped + "REGULAR_EXPRESSION_MATCHED\"/>\n") == 0);
    build.write("tests/programs/floor", "floor /nowhere/program\n");
    CHECK(build.judged(result("one", "run")) == 1);
}
