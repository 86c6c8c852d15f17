// SPDX-License-Identifier: MIT
// mpirun -n N hovercraft identify: the bits of one process, whatever N, whoever dies, whenever it
// is interrupted; ranks with other data are refused.
#include "ranks/job.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/sweep.hpp"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

using io_support::temporary_folder;
using namespace ranks_test;
using namespace std::chrono_literals;

namespace {

std::string const h3 = std::string{SIVID_SOURCE_DIR} + "/examples/hovercraft/data/h3";

/// h3 with a start that is not known exactly: its paving takes many boxes and few integrations.
fs::path uncertain_starts(temporary_folder const& folder) {
    auto const data = folder.path() / "uncertain";
    if (fs::exists(data)) return data;
    fs::copy(h3, data);
    auto json = support::text_of(data / "dataset.json");
    for (auto const& [from, to] : {std::pair<std::string, std::string>{"[2, 2]", "[1.99, 2.01]"},
                                   {"\"psi\": [0, 0]", "\"psi\": [-0.01, 0.01]"}}) {
        json.replace(json.find(from), from.size(), to);
    }
    folder.write("uncertain/dataset.json", json);
    return data;
}
words identify(fs::path const& data, fs::path const& out, words const& more) {
    return words{"identify",   data.string(), "--out",    out.string(),
                 "--accuracy", "1e-5",        "--budget", "3600"} +
           more;
}
/// Boxes without end: whoever is to be disturbed is still at work, however late the disturbance.
words const endless{"--boxes", "100000000", "--resume", "--checkpoint"};

/// Some boxes more than the checkpoint has tested.
words a_little_further(fs::path const& out) {
    std::ifstream in{out / "checkpoint.txt"};
    for (std::string line; std::getline(in, line);) {
        std::istringstream list{line};
        std::string word;
        std::size_t pushed = 0, tested = 0;
        if (list >> word >> pushed >> tested && word == "counters")
            return {"--boxes", std::to_string(tested + 1000)};
    }
    FAIL("no counters in the checkpoint");
    return {};
}

} // namespace

TEST_CASE("one to four ranks find the same as one process, bit for bit") {
    temporary_folder const folder;
    for (auto const& [data, more] :
         {std::pair<fs::path, words>{h3, {"--boxes", "300"}},
          {uncertain_starts(folder), {"--boxes", "600"}},
          {h3, {"--boxes", "60", "--algorithm", "report-1", "--batches", "7"}}}) {
        auto const alone = folder.path() / "alone", out = folder.path() / "ranks";
        auto const expected = run_alone(identify(data, alone, more));
        REQUIRE((expected.code == 0 || expected.code == 3));
        for (std::size_t const ranks : {2u, 4u, 1u, 3u}) {
            if (!support::swept(ranks % 2 == 0, true)) break;
            fs::remove_all(out);
            auto const r = run_job(ranks, identify(data, out, more));
            CAPTURE(ranks, r.err);
            CHECK(r.code == expected.code);
            CHECK(outcome(out) == outcome(alone));
            if (ranks > 1) CHECK_THAT(r.out, ContainsSubstring(std::to_string(ranks) + " ranks: "));
        }
    }
}

TEST_CASE(
    "with a rank killed by kill -9 the job ends, and fewer ranks finish it with the same bits") {
    temporary_folder const folder;
    auto const data = uncertain_starts(folder);
    auto const alone = folder.path() / "alone";
    for (std::size_t const victim : {0u, 1u, 3u}) {
        CAPTURE(victim);
        auto const out = folder.path() / ("killed" + std::to_string(victim));
        {
            temporary_folder const own;
            job const j(4, identify(data, out, endless + words{"0.01"}), own.path());
            auto all = processes_of(out, 4);
            for (int k = 0; k < 3000 && all[victim] == 0; ++k, all = processes_of(out, 4))
                std::this_thread::sleep_for(10ms);
            REQUIRE(all[victim] != 0);
            for (int k = 0; k < 30000 && !fs::exists(out / "checkpoint.txt"); ++k)
                std::this_thread::sleep_for(1ms);
            CHECK(::kill(all[victim], SIGKILL) == 0);
            int const code = j.wait_at_most(60);
            CHECK(code != 0);
            CHECK(code != 1000 + SIGKILL); // it ended by itself
            // mpirun tells the others to stop a second before it ends them: time enough for rank 0
            // to write what is proved, which is then no more than that.
            if (fs::exists(out / "result.json")) {
                CHECK(outcome(out).result["stop_reason"] == "cancelled");
                auto const checked = run_alone({"check", out.string(), "--budget", "5"});
                CHECK((checked.code == 0 || checked.code == 3)); // nothing is refuted
            }
        }
        std::this_thread::sleep_for(50ms);
        for (auto const pid : processes_of(out, 4)) CHECK(pid == 0); // nobody is left behind
        REQUIRE(fs::exists(out / "checkpoint.txt"));
        auto const further = a_little_further(out);
        auto const saving = further + words{"--checkpoint", "0.01", "--resume"};
        auto const r = victim == 3 ? run_alone(identify(data, out, saving))
                                   : run_job(3 - victim, identify(data, out, saving));
        CAPTURE(r.err);
        CHECK(r.code == run_alone(identify(data, alone, further)).code);
        CHECK_THAT(r.err, ContainsSubstring("resuming after "));
        CHECK(outcome(out) == outcome(alone));
    }
}

TEST_CASE("budgets of time, boxes and memory hold for all ranks") {
    temporary_folder const folder;
    auto const data = uncertain_starts(folder);
    auto const out = folder.path() / "out";
    auto const r = run_job(3, {"identify", data.string(), "--out", out.string(), "--accuracy",
                               "1e-9", "--budget", "1"});
    CAPTURE(r.err);
    CHECK((r.code == 0 || r.code == 3));
    CHECK(outcome(out).result["stop_reason"] == "time budget spent");
    auto const alone = folder.path() / "alone", shared = folder.path() / "shared";
    words const little{"--memory", "0.05"};
    (void)run_alone(identify(data, alone, little));
    (void)run_job(2, identify(data, shared, little));
    CHECK(outcome(shared).result["stop_reason"] == "memory budget spent");
    CHECK(outcome(shared) == outcome(alone));
}

TEST_CASE("an interrupted job writes what is proved, and goes on later") {
    temporary_folder const folder;
    auto const data = uncertain_starts(folder);
    for (int const signal : {SIGINT, SIGTERM, SIGUSR1}) {
        CAPTURE(signal);
        auto const out = folder.path() / ("out" + std::to_string(signal));
        temporary_folder const own;
        job const j(3, identify(data, out, endless + words{"0.05"}), own.path(), 2);
        for (int k = 0; k < 30000 && !fs::exists(out / "checkpoint.txt"); ++k)
            std::this_thread::sleep_for(1ms);
        j.signal(signal); // of SIGINT and SIGTERM the ranks hear two seconds later
        (void)j.wait_at_most(60);
        CAPTURE(j.err());
        REQUIRE(fs::exists(out / "result.json"));
        CHECK(outcome(out).result["stop_reason"] == "cancelled");
        for (auto const pid : processes_of(out, 3)) CHECK(pid == 0);
        auto const further = a_little_further(out);
        auto const r =
            run_job(2, identify(data, out, further + words{"--checkpoint", "0.05", "--resume"}));
        CHECK_THAT(r.err, ContainsSubstring("resuming after "));
        auto const alone = folder.path() / "alone";
        (void)run_alone(identify(data, alone, further));
        CHECK(outcome(out) == outcome(alone));
    }
}

TEST_CASE("ranks with other data or other commands are refused, with words, and nobody hangs") {
    temporary_folder const folder;
    auto const other = uncertain_starts(folder);
    auto const two = [&](words const& first, words const& second) {
        io_support::temporary_folder const own;
        support::child_program const j(MPIRUN_PROGRAM,
                                       mpirun(1) + words{HOVERCRAFT_PROGRAM} + first +
                                           words{":", "-n", "1", HOVERCRAFT_PROGRAM} + second,
                                       own.path());
        int const code = j.wait_at_most(60);
        return support::finished_program{code, j.out(), j.err()};
    };
    auto const out = folder.path() / "out";
    auto r = two(identify(h3, out, {}), identify(other, out, {}));
    CHECK(r.code == 2);
    CHECK_THAT(r.err, ContainsSubstring("rank 1 differs") && ContainsSubstring("problem") &&
                          ContainsSubstring("same data"));
    CHECK_FALSE(fs::exists(out / "result.json"));
    r = two(identify(h3, out, {}), identify(h3, out, {"--lift", "rudder"}));
    CHECK(r.code == 2);
    // An error of one rank alone is told by that rank, and ends all.
    r = two(identify(h3, out, {}), identify(folder.path() / "nowhere", out, {}));
    CHECK(r.code == 2);
    CHECK_THAT(r.err, ContainsSubstring("rank 1: ") && ContainsSubstring("nowhere"));
    // One of all ranks is told once.
    r = run_job(3, identify(folder.path() / "nowhere", out, {}));
    CHECK(r.code == 2);
    auto const first = r.err.find("nowhere");
    REQUIRE(first != std::string::npos);
    CHECK(r.err.find("rank 1: ") == std::string::npos);
    // What runs in one process says so.
    r = run_job(2, {"describe"});
    CHECK(r.code == 2);
    CHECK_THAT(r.err, ContainsSubstring("without mpirun"));
}
