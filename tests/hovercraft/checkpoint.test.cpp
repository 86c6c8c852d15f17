// SPDX-License-Identifier: MIT
// The program killed at any moment, its checkpoint spoilt, its threads: the result stays the same.
#include "child.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace fs = std::filesystem;
using io_support::temporary_folder;
using namespace hovercraft_test;
using namespace std::chrono_literals;

namespace {

std::string const h3 = std::string{SIVID_SOURCE_DIR} + "/examples/hovercraft/data/h3";

std::vector<std::string> operator+(std::vector<std::string> a, std::vector<std::string> const& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

std::string text_of(fs::path const& file) {
    std::ifstream in{file, std::ios::binary};
    return {std::istreambuf_iterator<char>{in}, {}};
}

/// h3 with a start that is not known exactly: its paving takes many boxes and few integrations.
fs::path uncertain_starts(temporary_folder const& folder) {
    auto const data = folder.path() / "uncertain";
    fs::copy(h3, data);
    auto json = text_of(data / "dataset.json");
    for (auto const& [from, to] : {std::pair<std::string, std::string>{"[2, 2]", "[1.99, 2.01]"},
                                   {"\"psi\": [0, 0]", "\"psi\": [-0.01, 0.01]"}}) {
        json.replace(json.find(from), from.size(), to);
    }
    folder.write("uncertain/dataset.json", json);
    return data;
}

/// All that a result says but for how long it took and what it was called.
struct outcome {
    nlohmann::json result;
    std::string boxes, outputs;

    explicit outcome(fs::path const& out)
        : result(json_of(out / "result.json")),
          boxes(text_of(out / "boxes.csv")),
          outputs(text_of(out / "outputs.csv")) {
        result.erase("seconds");
        for (auto const* time : {"seconds", "most_seconds"}) result["search"].erase(time);
        for (auto& tried : result["journal"]) tried.erase("seconds");
        result.erase("source");
    }
};
void check_same(outcome const& a, outcome const& b) {
    CHECK(a.result == b.result);
    CHECK(a.boxes == b.boxes);
    CHECK(a.outputs == b.outputs);
}

/// How many boxes the run that says so went on from; -1 when it began anew.
long resumed_at(std::string const& said) {
    std::string const words = "resuming after ";
    auto const at = said.find(words);
    return at == std::string::npos ? -1 : std::atol(said.c_str() + at + words.size());
}

} // namespace

TEST_CASE("killed at random moments with kill -9, identify resumes and finds the same") {
    temporary_folder const folder;
    support::draws d(5301);
    for (auto const& arguments :
         {std::vector<std::string>{uncertain_starts(folder).string(), "--boxes", "1500"},
          std::vector<std::string>{h3, "--algorithm", "report-1", "--boxes", "200"}}) {
        auto const call = std::vector<std::string>{"identify"} + arguments +
                          std::vector<std::string>{"--accuracy", "1e-5", "--budget", "3600"};
        auto const undisturbed = folder.path() / "undisturbed", out = folder.path() / "killed";
        fs::remove_all(out);
        auto const begin = std::chrono::steady_clock::now();
        auto const whole = run(call + std::vector<std::string>{"--out", undisturbed.string()});
        auto const took = std::chrono::steady_clock::now() - begin;
        REQUIRE((whole.code == 0 || whole.code == 3));

        auto const resuming = call + std::vector<std::string>{"--out", out.string(), "--checkpoint",
                                                              "0.01", "--resume"};
        int resumptions = 0;
        long reached = -1;
        for (int kill = 0; kill < 14; ++kill) {
            temporary_folder const own;
            child const c(resuming, own.path());
            if (kill % 2 == 0) { // a while after the first checkpoint of all, or of this run
                for (int k = 0; k < 20000 && !fs::exists(out / "checkpoint.txt"); ++k) {
                    std::this_thread::sleep_for(1ms);
                }
                std::this_thread::sleep_for(took * d.uniform(0, 0.2));
            } else {
                // Two of these and one of the others are less than the whole run.
                std::this_thread::sleep_for(took * d.uniform(0, 0.4));
            }
            c.signal(SIGKILL);
            int const code = c.wait();
            CHECK((code == 1000 + SIGKILL || code == whole.code)); // never a refusal
            auto const at = resumed_at(c.err());
            resumptions += at >= 0 ? 1 : 0;
            // Killed before it said where it goes on from, it has said nothing at all.
            bool const silent = at < 0 && c.err().find("identifying") == std::string::npos;
            CHECK((at >= reached || silent || code == whole.code || reached < 0));
            reached = std::max(reached, at);
            if (code == whole.code) break;
        }
        auto const last = run(resuming);
        CHECK(last.code == whole.code);
        resumptions += resumed_at(last.err) >= 0 ? 1 : 0;
        CHECK(resumptions >= 2);
        check_same(outcome(out), outcome(undisturbed));
        for (auto const& entry : fs::directory_iterator{out})
            CHECK_THAT(entry.path().filename().string(), !ContainsSubstring(".part"));
    }
}

TEST_CASE("a search goes on with larger budgets, and ends without a checkpoint") {
    temporary_folder const folder;
    auto const out = folder.path() / "out";
    auto const call = [&](std::vector<std::string> const& more) {
        return run(std::vector<std::string>{"identify", h3, "--accuracy", "0.002", "--budget",
                                            "3600", "--out", out.string()} +
                   more);
    };
    auto r = call({"--boxes", "10", "--resume", "--quiet"});
    CHECK_THAT(r.err, ContainsSubstring("no checkpoint in " + out.string()));
    fs::remove_all(out);
    r = call({"--boxes", "40", "--checkpoint", "100"});
    CHECK(r.code == 0);
    CHECK_THAT(r.out, ContainsSubstring("--resume"));
    REQUIRE(fs::exists(out / "checkpoint.txt"));
    CHECK(json_of(out / "result.json")["stop_reason"] == "box budget spent");
    auto const checkpoint = text_of(out / "checkpoint.txt");

    // It is not overwritten by accident, nor taken for another search's.
    r = call({"--boxes", "40", "--checkpoint", "100"});
    CHECK(r.code == 2);
    CHECK_THAT(r.err, ContainsSubstring("checkpoint.txt") && ContainsSubstring("--resume"));
    r = call({"--resume", "--outliers", "1"});
    CHECK(r.code == 2);
    CHECK_THAT(r.err, ContainsSubstring("checkpoint.txt") && ContainsSubstring("another problem"));
    r = call({"--resume", "--lift", "rudder"});
    CHECK(r.code == 2);
    // Neither is a spoilt one.
    for (auto const& bad : {checkpoint.substr(0, checkpoint.size() / 2), std::string{},
                            checkpoint.substr(0, 300) + "7" + checkpoint.substr(301)}) {
        folder.write("out/checkpoint.txt", bad);
        r = call({"--resume"});
        CHECK(r.code == 2);
        CHECK_THAT(r.err, ContainsSubstring("checkpoint.txt") && ContainsSubstring("begin anew"));
        CHECK(text_of(out / "checkpoint.txt") == bad);
    }
    folder.write("out/checkpoint.txt", checkpoint);

    r = call({"--resume", "--memory", "0.001"});
    CHECK(json_of(out / "result.json")["stop_reason"] == "memory budget spent");
    r = call({"--resume"});
    CHECK(r.code == 0);
    CHECK(resumed_at(r.err) >= 40);
    CHECK_FALSE(fs::exists(out / "checkpoint.txt"));
    auto const resumed = outcome(out);
    fs::remove_all(out);
    CHECK(call({}).code == 0);
    check_same(resumed, outcome(out));
    CHECK(resumed.result["stop_reason"] == "accuracy reached");
}

TEST_CASE("the number of threads does not show in the result") {
    temporary_folder const folder;
    auto const call = [&](std::string const& data, std::string const& threads) {
        auto const out = folder.path() / ("threads" + threads);
        auto const r = run({"identify", data, "--accuracy", "0.002", "--boxes", "500", "--budget",
                            "3600", "--out", out.string(), "--threads", threads});
        if (r.code == 2) CHECK_THAT(r.err, ContainsSubstring("libtbb-dev"));
        return r.code;
    };
    for (auto const& data : {h3, uncertain_starts(folder).string()}) {
        auto const alone = call(data, "1");
        CHECK((alone == 0 || alone == 3));
        for (std::string const threads : {"2", "3", "0"}) {
            if (call(data, threads) == 2) continue; // not built with oneTBB
            check_same(outcome(folder.path() / "threads1"),
                       outcome(folder.path() / ("threads" + threads)));
        }
    }
}
