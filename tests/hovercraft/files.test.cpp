// SPDX-License-Identifier: MIT
// Files that cannot be read or written, and requests that no motion can meet: one message, exit
// code 2, nothing left behind.
#include "child.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using io_support::temporary_folder;
using namespace hovercraft_test;

namespace {

std::string const h3 = std::string{SIVID_SOURCE_DIR} + "/examples/hovercraft/data/h3";

/// A command as a shell runs it, with what follows the program's name.
support::finished_program shell(std::string const& before, std::string const& command) {
    return support::run_program(
        "/bin/sh", {"-c", before + " exec '" + std::string{HOVERCRAFT_PROGRAM} + "' " + command});
}

bool holds_part_files(fs::path const& folder) {
    return std::any_of(fs::recursive_directory_iterator{folder}, fs::recursive_directory_iterator{},
                       [](auto const& entry) {
                           auto const name = entry.path().filename().string();
                           return name.find(".part") != std::string::npos;
                       });
}

} // namespace

TEST_CASE("a standard output that is full is an error") {
    REQUIRE(fs::exists("/dev/full"));
    temporary_folder const folder;
    auto const out = (folder.path() / "out").string();
    for (auto const& command : {std::string{"describe"}, std::string{"--help"},
                                "identify '" + h3 + "' --out '" + out + "' --quiet --budget 2",
                                "check '" + out + "' --sample 1 --budget 2",
                                "simulate --scenario S3 --out '" + out + "'"}) {
        auto const r = shell("", command + " > /dev/full");
        CAPTURE(command, r.err);
        CHECK(r.code == 2);
        CHECK_THAT(r.err, ContainsSubstring("standard output"));
    }
    CHECK(shell("", "identify '" + h3 + "' --out /dev/full").code == 2);
}

TEST_CASE("a limit of the size of files ends with a message and leaves nothing") {
    temporary_folder const folder;
    for (auto const* const command :
         {"identify H3 --quiet --budget 2", "simulate --scenario S3",
          "generate --scenario S3 --absolute 0.02", "diagnose H3 --budget 1 --quiet"}) {
        std::string text = command;
        if (auto const at = text.find("H3"); at != std::string::npos)
            text.replace(at, 2, "'" + h3 + "'");
        auto const out = folder.path() / "limited";
        auto const r = shell("ulimit -f 4;", text + " --out '" + out.string() + "'");
        CAPTURE(command, r.err);
        CHECK(r.code == 2);
        CHECK_THAT(r.err, ContainsSubstring("cannot be written"));
        CHECK_FALSE(holds_part_files(folder.path()));
        fs::remove_all(out);
    }
}

TEST_CASE("a motion that cannot be followed is bad input") {
    temporary_folder const folder;
    auto const out = (folder.path() / "out").string();
    auto const scenario = [&](std::string const& amplitude, std::string const& speed) {
        folder.write("s.json",
                     R"({"format": "hovercraft-scenario-1", "name": "X", "about": "x",
                         "duration": 3, "initial": {"u": )" +
                         speed +
                         R"(, "v": 0, "r": 0, "x": 0, "y": 0, "psi": 0}, "inputs": {
                         "W": {"shape": "constant", "value": 83},
                         "delta": {"shape": "sine", "offset": 0, "amplitude": )" +
                         amplitude + R"(, "frequency": 0.25, "phase": 0}}})");
        return (folder.path() / "s.json").string();
    };
    for (auto const& [amplitude, speed] : {std::pair{"4e9", "2"}, std::pair{"1e300", "2"},
                                           std::pair{"0.2", "4e9"}, std::pair{"0.2", "1e300"}}) {
        auto const file = scenario(amplitude, speed);
        for (bool const validated : {false, true}) {
            std::vector<std::string> command{"simulate", "--scenario", file, "--out", out};
            if (validated) command.emplace_back("--validated");
            auto const r = run(command);
            CAPTURE(amplitude, speed, validated, r.err);
            CHECK((r.code == 0 || r.code == 2 || r.code == 3));
            CHECK_THAT(r.err, !ContainsSubstring("internal error"));
        }
    }
    auto const r = run({"simulate", "--scenario", "S3", "--out", out, "--set", "Sg=1e300"});
    CHECK(r.code == 2);
    CHECK_THAT(r.err, ContainsSubstring("cannot be followed"));
}

TEST_CASE("names that no file can have and links in a circle are bad input") {
    temporary_folder const folder;
    auto const out = (folder.path() / "out").string();
    fs::create_symlink("b", folder.path() / "a");
    fs::create_symlink("a", folder.path() / "b");
    for (auto const& name : {std::string(5000, 'a'), (folder.path() / "a").string(),
                             (folder.path() / "a/x").string(), std::string{"/dev/null"}}) {
        for (auto const& command : std::vector<std::vector<std::string>>{
                 {"identify", name, "--out", out},
                 {"identify", h3, "--out", name, "--budget", "1"},
                 {"check", name},
                 {"diagnose", name, "--out", out},
                 {"simulate", "--scenario", name, "--out", out},
                 {"rank", "--scenario", name, "--out", out},
                 {"predict", name, "--scenario", "S3", "--out", out}}) {
            auto const r = run(command);
            CAPTURE(command[0], name.substr(0, 40), r.err.substr(0, 200));
            CHECK(r.code == 2);
            CHECK_THAT(r.err, !ContainsSubstring("internal error"));
            CHECK(r.err.size() < 1000);
        }
    }
}
