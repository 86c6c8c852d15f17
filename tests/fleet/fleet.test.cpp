// SPDX-License-Identifier: MIT
// Many data sets at once: each as if it were alone, one summary, parts of the list by several
// processes, interrupted, killed, and gone on with.
#include "support/catch.hpp"
#include "support/child_program.hpp"

#include <sivid/io/text/json_document.hpp>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace fs = std::filesystem;
using io_support::temporary_folder;
using support::text_of;
using namespace std::chrono_literals;

namespace {

using words = std::vector<std::string>;

words operator+(words a, words const& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}
support::finished_program run(words const& arguments) {
    return support::run_program(HOVERCRAFT_PROGRAM, arguments);
}

/// Three data sets; the truth of one is outside of its prior.
fs::path campaigns(temporary_folder const& folder) {
    auto const all = folder.path() / "campaigns";
    for (std::string const name : {"one", "two", "three"}) {
        words call{"generate", "--scenario",         "S3", "--seed", name, "--absolute", "0.02",
                   "--out",    (all / name).string()};
        call[4] = std::to_string(name.size());
        if (name == "three")
            call = call + words{"--set", "Sv=0.30", "--unknown", "Sv=0.29:0.31,Sg,L"};
        REQUIRE(run(call).code == 0);
        if (name != "three") continue;
        auto const file = all / name / "dataset.json";
        auto json = text_of(file);
        for (auto const& [from, to] :
             {std::pair<std::string, std::string>{"0.29", "0.20"}, {"0.31", "0.25"}})
            json.replace(json.find(from), from.size(), to);
        std::ofstream(file) << json;
    }
    return all;
}
words fleet(fs::path const& data, fs::path const& out, words const& more = {}) {
    return words{"fleet",    "identify", data.string(),    "--out",     out.string(),
                 "--budget", "60",       "--with-options", "--boxes 60"} +
           more;
}
sivid::json_value summary(fs::path const& out) { return sivid::read_json(out / "fleet.json"); }
std::string state_of(fs::path const& out, std::string const& name) {
    auto const all = summary(out);
    for (auto const& d : all.at("datasets").elements()) {
        if (d.at("dataset").string() == name) return d.at("state").string();
    }
    return "not listed";
}

} // namespace

TEST_CASE("a fleet finds for each data set what it finds alone, with any number of jobs") {
    temporary_folder const folder;
    auto const data = campaigns(folder);
    auto const alone = folder.path() / "alone";
    REQUIRE(
        run({"identify", (data / "one").string(), "--out", alone.string(), "--boxes", "60"}).code ==
        0);
    for (std::string const jobs : {"1", "3"}) {
        auto const out = folder.path() / ("out" + jobs);
        auto const r = run(fleet(data, out, {"--jobs", jobs}));
        CAPTURE(r.err, r.out);
        CHECK(r.code == 0);
        CHECK(text_of(out / "one" / "boxes.csv") == text_of(alone / "boxes.csv"));
        CHECK_THAT(r.out, ContainsSubstring("3 data sets") && ContainsSubstring("inconsistent") &&
                              ContainsSubstring("not excluded ["));
        CHECK(summary(out).at("datasets").elements().size() == 3);
        auto const csv = text_of(out / "fleet.csv");
        CHECK_THAT(csv, ContainsSubstring("one,result,consistent") &&
                            ContainsSubstring("three,result,inconsistent"));
        // Bounds are those of the result, digit for digit.
        auto const outer = sivid::read_json(out / "one" / "result.json")
                               .at("volume")
                               .at("outer")
                               .elements()[1]
                               .number()
                               .text();
        CHECK_THAT(csv, ContainsSubstring("," + outer + ","));
    }
}

TEST_CASE("what is finished is kept, for the same data and the same command alone") {
    temporary_folder const folder;
    auto const data = campaigns(folder);
    auto const out = folder.path() / "out";
    REQUIRE(run(fleet(data, out)).code == 0);
    auto const when = [&](std::string const& name) {
        return fs::last_write_time(out / name / "fleet.json");
    };
    auto const first = when("one"), second = when("two");
    auto r = run(fleet(data, out));
    CHECK_THAT(r.err, ContainsSubstring("0 data sets to work on, 3 finished before"));
    CHECK(when("one") == first);
    // Other data: anew.
    std::ofstream(data / "two" / "dataset.json", std::ios::app) << "\n";
    r = run(fleet(data, out));
    CHECK_THAT(r.err, ContainsSubstring("1 data set to work on"));
    CHECK(when("one") == first);
    CHECK(when("two") != second);
    // Another command: all.
    r = run({"fleet", "identify", data.string(), "--out", out.string(), "--with-options",
             "--boxes 70", "--jobs", "2"});
    CHECK_THAT(r.err, ContainsSubstring("3 data sets to work on"));
    r = run({"fleet", "identify", data.string(), "--out", out.string(), "--with-options",
             "--boxes 70", "--again"});
    CHECK_THAT(r.err, ContainsSubstring("3 data sets to work on"));
}

TEST_CASE("tasks of a job array share a list, and the last one has all") {
    temporary_folder const folder;
    auto const data = campaigns(folder);
    auto const out = folder.path() / "out";
    auto r = run(fleet(data, out, {"--task", "1/2"}));
    CHECK(r.code == 3);
    CHECK(state_of(out, "one") == "result");
    CHECK(state_of(out, "three") == "missing");
    CHECK(state_of(out, "two") == "result");
    r = run(fleet(data, out, {"--task", "2/2"}));
    CHECK(r.code == 0);
    CHECK(state_of(out, "three") == "result");
    for (std::string const bad : {"0/2", "3/2", "1", "a/b", "1/2/3"}) {
        r = run(fleet(data, out, {"--task", bad}));
        CHECK(r.code == 2);
        CHECK_THAT(r.err, ContainsSubstring("K/N"));
    }
}

TEST_CASE("a data set that fails does not stop the others, and is tried again") {
    temporary_folder const folder;
    auto const data = campaigns(folder);
    auto const table = data / "two" / "S3.measurements.csv";
    auto const good = text_of(table);
    std::ofstream(table) << good.substr(0, good.find('\n')) << "\nthis, is, no, number\n";
    auto const out = folder.path() / "out";
    auto r = run(fleet(data, out));
    CAPTURE(r.out, r.err);
    CHECK(r.code == 2);
    CHECK(state_of(out, "one") == "result");
    CHECK(state_of(out, "two") == "failed");
    CHECK_THAT(text_of(out / "two" / "log.txt"), ContainsSubstring("S3.measurements.csv"));
    std::ofstream(table) << good;
    r = run(fleet(data, out));
    CHECK(r.code == 0);
    CHECK_THAT(r.err, ContainsSubstring("1 data set to work on, 2 finished before"));

    r = run(fleet(folder.path() / "nowhere", out));
    CHECK(r.code == 2);
    fs::create_directories(folder.path() / "empty");
    r = run(fleet(folder.path() / "empty", out));
    CHECK(r.code == 2);
    CHECK_THAT(r.err, ContainsSubstring("no data set"));
    fs::create_directories(folder.path() / "again");
    fs::copy(data / "one", folder.path() / "again" / "one");
    r = run(words{"fleet", "identify", data.string(), (folder.path() / "again").string(), "--out",
                  out.string()});
    CHECK(r.code == 2);
    CHECK_THAT(r.err, ContainsSubstring("two data sets are called one"));
}

TEST_CASE("interrupted or killed, a fleet goes on where it was and leaves nobody behind") {
    temporary_folder const folder;
    auto const data = campaigns(folder);
    auto const out = folder.path() / "out";
    words const slow{"fleet",
                     "identify",
                     data.string(),
                     "--out",
                     out.string(),
                     "--jobs",
                     "3",
                     "--budget",
                     "3600",
                     "--with-options",
                     "--accuracy 1e-9 --checkpoint 0.05 --boxes 4000"};
    for (int const signal : {SIGINT, SIGKILL}) {
        temporary_folder const own;
        support::child_program const c(HOVERCRAFT_PROGRAM, slow, own.path());
        for (int k = 0; k < 20000 && !fs::exists(out / "one" / "checkpoint.txt"); ++k)
            std::this_thread::sleep_for(1ms);
        c.signal(signal);
        CHECK(c.wait_at_most(60) != 0);
        if (signal == SIGINT) CHECK(state_of(out, "one") == "missing");
        std::this_thread::sleep_for(200ms);
        std::size_t left = 0;
        for (auto const& entry : fs::directory_iterator{"/proc"}) {
            auto const command = text_of(entry.path() / "cmdline");
            left += command.find(out.string()) != std::string::npos &&
                            command.find("identify") != std::string::npos &&
                            command.find("--checkpoint") != std::string::npos
                        ? 1
                        : 0;
        }
        CHECK(left == 0);
        CHECK(fs::exists(out / "one" / "checkpoint.txt"));
    }
    auto const r = run(slow);
    CAPTURE(r.out, r.err);
    CHECK(r.code == 0);
    CHECK_FALSE(fs::exists(out / "fleet.json.part"));
    auto const alone = folder.path() / "alone";
    (void)run({"identify", (data / "one").string(), "--out", alone.string(), "--budget", "3600",
               "--accuracy", "1e-9", "--boxes", "4000"});
    CHECK(text_of(out / "one" / "boxes.csv") == text_of(alone / "boxes.csv"));
}

TEST_CASE("time for all ends what runs") {
    temporary_folder const folder;
    auto const data = campaigns(folder);
    auto const out = folder.path() / "out";
    auto const r = run({"fleet", "identify", data.string(), "--out", out.string(), "--jobs", "2",
                        "--within", "1.5", "--with-options", "--accuracy 1e-12 --budget 3600"});
    CHECK(r.code == 3);
    CHECK(state_of(out, "two") == "missing");
}
