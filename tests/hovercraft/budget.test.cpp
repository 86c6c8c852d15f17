// SPDX-License-Identifier: MIT
// What a user asks for is what happens: budgets and Ctrl-C end every phase with the files written,
// a full disk leaves the old result, an accuracy is one, and texts of data sets stay texts.
#include "child.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace fs = std::filesystem;
using io_support::temporary_folder;
using namespace hovercraft_test;

namespace {

fs::path const h3 = fs::path{SIVID_SOURCE_DIR} / "examples/hovercraft/data/h3";

std::string replaced(std::string text, std::string const& from, std::string const& to) {
    auto const at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

/// h3 with another dataset.json, and all error bounds set to `bound` when it is not empty.
void write_variant(temporary_folder const& folder, std::string const& dataset,
                   std::string const& bound = {}) {
    folder.write("data/dataset.json", dataset);
    folder.write("data/S3.inputs.csv", support::text_of(h3 / "S3.inputs.csv"));
    std::ifstream in{h3 / "S3.measurements.csv"};
    std::string all;
    for (std::string line; std::getline(in, line); all += line + "\n") {
        if (bound.empty() || line.front() == 't') continue;
        std::string row;
        std::size_t cell = 0;
        for (std::size_t from = 0; from <= line.size(); ++cell) {
            auto const to = std::min(line.find(',', from), line.size());
            row += (cell > 0 ? "," : "") +
                   (cell > 0 && cell % 2 == 0 ? bound : line.substr(from, to - from));
            from = to + 1;
        }
        line = row;
    }
    folder.write("data/S3.measurements.csv", all);
}
std::string const h3_json = support::text_of(h3 / "dataset.json");

std::map<std::string, std::string> files_of(fs::path const& folder) {
    std::map<std::string, std::string> result;
    for (auto const& f : fs::directory_iterator{folder}) {
        result[f.path().filename().string()] = support::text_of(f.path());
    }
    return result;
}
void check_complete(fs::path const& out) {
    for (auto const* name : {"result.json", "boxes.csv", "outputs.csv", "report.html"}) {
        CAPTURE(name);
        CHECK(fs::exists(out / name));
    }
    for (auto const& [name, text] : files_of(out)) {
        CAPTURE(name);
        CHECK(name.find(".part") == std::string::npos);
    }
}

} // namespace

TEST_CASE("a budget ends identify in time however wide the boxes inside are") {
    struct one {
        std::string json, bound;
        std::vector<std::string> more;
        std::string command = "identify";
    };
    auto const tolerant =
        replaced(h3_json, "\"max_outlier_fraction\": 0", "\"max_outlier_fraction\": 0.9");
    for (auto const& c :
         {one{h3_json, "9", {}}, one{tolerant, "", {}},
          one{tolerant, "", {"--identifiability", "--compare"}}, one{h3_json, "9", {}, "online"},
          one{h3_json, "0.001", {"--outliers", "auto"}}}) {
        temporary_folder const folder;
        write_variant(folder, c.json, c.bound);
        auto const out = folder.path() / "out";
        std::vector<std::string> arguments{
            c.command, (folder.path() / "data").string(), "--out", out.string(), "--budget", "1",
            "--quiet"};
        arguments.insert(arguments.end(), c.more.begin(), c.more.end());
        child const run(arguments, folder.path());
        auto const code = run.wait_at_most(120);
        CAPTURE(c.bound, c.more.size(), run.err());
        CHECK((code == 0 || code == 3 || code == 4));
        check_complete(out);
    }
}

TEST_CASE("a budget and Ctrl-C end check in time however many boxes there are") {
    using namespace std::chrono_literals;
    temporary_folder const folder;
    auto const out = folder.path() / "out";
    // Tens of thousands of boxes of products, and as many steps of proof.
    REQUIRE(run({"identify", h3.string(), "--out", out.string(), "--accuracy", "1e-8", "--budget",
                 "4", "--quiet"})
                .code != 2);
    for (bool const all : {false, true}) {
        std::vector<std::string> arguments{"check", out.string(), "--budget", "1"};
        if (all) arguments.push_back("--all");
        child const timed(arguments, folder.path());
        auto const code = timed.wait_at_most(60);
        CAPTURE(all, timed.out());
        CHECK(code == 3);
        CHECK_THAT(timed.out(), ContainsSubstring("not within the budget"));
    }
    child const stopped({"check", out.string(), "--all"}, folder.path());
    std::this_thread::sleep_for(500ms);
    stopped.signal(SIGINT);
    CHECK(stopped.wait_at_most(60) == 3);
}

TEST_CASE("Ctrl-C ends every phase with the files written") {
    using namespace std::chrono_literals;
    auto const tolerant =
        replaced(h3_json, "\"max_outlier_fraction\": 0", "\"max_outlier_fraction\": 0.9");
    struct phase {
        std::string bound, seen;
        std::vector<std::string> more;
        std::chrono::milliseconds after;
    };
    for (auto const& p :
         {phase{"", "identifying", {"--accuracy", "1e-9"}, 0ms},
          phase{"", "identifying", {"--accuracy", "1e-9"}, 300ms},
          phase{"9", "identifying", {}, 150ms}, phase{"9", "identifying", {}, 400ms},
          phase{"", "for comparison", {"--compare", "--accuracy", "0.02"}, 200ms},
          phase{"0.001", "how many outliers", {"--outliers", "auto"}, 50ms},
          phase{"0.001", "how many outliers", {"--outliers", "auto"}, 600ms},
          phase{"", "measurement by measurement", {}, 20ms}}) {
        temporary_folder const folder;
        write_variant(folder, h3_json, p.bound);
        auto const out = folder.path() / "out";
        auto const* const command = p.seen.starts_with("measurement") ? "online" : "identify";
        std::vector<std::string> arguments{
            command, (folder.path() / "data").string(), "--out", out.string(), "--budget", "600"};
        arguments.insert(arguments.end(), p.more.begin(), p.more.end());
        child const run(arguments, folder.path());
        for (int k = 0; k < 12000 && run.err().find(p.seen) == std::string::npos; ++k)
            std::this_thread::sleep_for(5ms);
        std::this_thread::sleep_for(p.after);
        run.signal(SIGINT);
        auto const code = run.wait_at_most(60);
        CAPTURE(p.seen, p.bound, p.after.count(), run.err(), run.out());
        CHECK((code == 0 || code == 3 || code == 4));
        check_complete(out);
    }
}

TEST_CASE("online with a budget the result is of all measurements") {
    temporary_folder const folder;
    auto const out = folder.path() / "out";
    auto const r = run({"online", h3.string(), "--out", out.string(), "--budget", "0.01"});
    CHECK((r.code == 0 || r.code == 3));
    CHECK_THAT(r.out,
               ContainsSubstring("measurements at once") && ContainsSubstring("180 samples"));
    auto const result = json_of(out / "result.json");
    CHECK(result["stop_reason"] == "time budget spent");
}

TEST_CASE("a full disk leaves the former result whole") {
    temporary_folder const folder;
    auto const out = folder.path() / "out";
    std::vector<std::string> const arguments{"identify", h3.string(), "--out", out.string(),
                                             "--quiet"};
    REQUIRE(run(arguments).code == 0);
    auto const before = files_of(out);
    REQUIRE(before.size() == 7); // products.csv, certificates.csv, report.page.json among them
    for (::rlim_t const room : {1000u, 12000u, 30000u}) {
        child const full(arguments, folder.path(), room);
        auto const code = full.wait_at_most(60);
        CAPTURE(room, full.err());
        CHECK(code == 2);
        CHECK_THAT(full.err(),
                   ContainsSubstring("cannot be written") && ContainsSubstring("space"));
        CHECK(files_of(out) == before);
    }
    auto const data = folder.path() / "made";
    std::vector<std::string> const making{"generate",    "--scenario", "S3",  "--out",
                                          data.string(), "--absolute", "0.02"};
    REQUIRE(run(making).code == 0);
    auto const made = files_of(data);
    auto other = making;
    other.insert(other.end(), {"--seed", "5"});
    child const full(other, folder.path(), 2000);
    CHECK(full.wait_at_most(60) == 2);
    CHECK(files_of(data) == made);
}

TEST_CASE("an accuracy that is asked for is one") {
    temporary_folder const folder;
    auto const outer = [&](std::string const& name, std::vector<std::string> const& more,
                           std::string const& reason) {
        auto const out = folder.path() / name;
        std::vector<std::string> arguments{"identify", h3.string(), "--out", out.string(),
                                           "--quiet"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        CHECK(run(arguments).code == 0);
        auto const result = json_of(out / "result.json");
        CAPTURE(name);
        CHECK(result["stop_reason"] == reason);
        return result["volume"]["outer"][1].get<double>();
    };
    auto const enough = "enough of what is left is proved inside";
    double const usual = outer("usual", {}, enough);
    CHECK(outer("same", {"--accuracy", "0.003", "--budget", "600"}, "accuracy reached") <= usual);
    CHECK(outer("fine", {"--accuracy", "1e-8", "--boxes", "3000", "--budget", "600"},
                "box budget spent") <= usual);
    CHECK(outer("coarse", {"--accuracy", "0.05", "--budget", "600"}, "accuracy reached") > 0);
}

TEST_CASE("as many outliers as measurements explain nothing") {
    temporary_folder const folder;
    auto const out = folder.path() / "out";
    for (std::string const count : {"180", "200", "99999"}) {
        auto const r = run({"identify", h3.string(), "--out", out.string(), "--outliers", count});
        CHECK(r.code == 2);
        CHECK_THAT(r.err, ContainsSubstring("--outliers " + count) &&
                              ContainsSubstring("'S3' has 180 measurements"));
    }
    CHECK_FALSE(fs::exists(out));
}

TEST_CASE("texts of a data set neither steer a terminal nor fill it") {
    struct one {
        std::string from, to, says;
    };
    std::string const red = "\\u001b[31mEVIL\\u0007\\r\\n";
    for (auto const& c :
         {one{"\"Sv\":", "\"" + red + "\":", "unknown constant"},
          one{"\"format\"", "\"" + red + "\": 1, \"format\"", "unknown key"},
          one{"\"id\": \"h3\"", "\"id\": \"h3\\u202etxt\"", "control character: U+202E"},
          one{"\"id\": \"h3\"", "\"id\": \"h3\\u009b31m\"", "control character: U+009B"},
          one{"\"name\": \"S3\"", "\"name\": \"S3\\u2066\"", "control character: U+2066"},
          one{"\"unit\": \"m\"", "\"unit\": \"" + red + "\"", "control character"},
          one{"\"Sv\":", "\"" + std::string(5000, 'k') + "\":", "unknown constant 'kkk"},
          one{"\"id\": \"h3\"", "\"id\": \"" + std::string(100000, 'k') + "\"", "has 100000 bytes"},
          one{"[0.2, 0.25]", "[-1e308, 1e308]", "/parameters/Sv/prior"},
          one{"[0.2, 0.25]", "[0.2, 1e101]", "beyond 1e100"},
          one{"\"u\": [2, 2]", "\"u\": [-1e300, 1e300]", "/scenarios/0/initial/u"}}) {
        temporary_folder const folder;
        write_variant(folder, replaced(h3_json, c.from, c.to));
        auto const r = run({"identify", (folder.path() / "data").string(), "--out",
                            (folder.path() / "out").string()});
        CAPTURE(c.to.substr(0, 60), r.err);
        CHECK(r.code == 2);
        CHECK_THAT(r.err, ContainsSubstring(c.says) && ContainsSubstring("dataset.json: /"));
        CHECK(r.err.size() < 1500);
        for (auto const* raw : {"\x1b", "\x07", "\r", "\xc2\x9b", "\xe2\x80\xae"})
            CHECK(r.err.find(raw) == std::string::npos);
    }
    temporary_folder const folder;
    write_variant(folder, h3_json);
    auto const table = support::text_of(folder.path() / "data/S3.measurements.csv");
    folder.write("data/S3.measurements.csv", replaced(table, "psi_err", "\x1b[2Jpsi_err"));
    auto const r = run(
        {"identify", (folder.path() / "data").string(), "--out", (folder.path() / "out").string()});
    CHECK(r.code == 2);
    CHECK(r.err.find('\x1b') == std::string::npos);
}

TEST_CASE("an empty name is no folder for results") {
    temporary_folder const folder;
    for (auto const& start : std::vector<std::vector<std::string>>{
             {"identify", h3.string()},
             {"generate", "--scenario", "S3", "--relative", "0.1"},
             {"rank"},
             {"verify", h3.string(), "--scenario", "S2", "--require", "x <= 7"},
             {"simulate", "--scenario", "S1"}}) {
        auto arguments = start;
        arguments.insert(arguments.end(), {"--out", ""});
        auto const r = run(arguments);
        CAPTURE(start[0], r.err);
        CHECK(r.code == 2);
        CHECK_THAT(r.err, ContainsSubstring("--out is empty"));
    }
    CHECK(run({"identify", h3.string(), "--out", (folder.path() / std::string(400, 'x')).string()})
              .err.size() < 600);
    auto const far = run({"generate", "--scenario", "S3", "--out", (folder.path() / "o").string(),
                          "--unknown", "Sv=-1e308:1e308"});
    CHECK(far.code == 2);
    CHECK_THAT(far.err, ContainsSubstring("--unknown Sv") && ContainsSubstring("beyond 1e100"));
}
