// SPDX-License-Identifier: MIT
// mpirun -n N hovercraft fleet and diagnose: coarse tasks handed out to ranks.
#include "ranks/job.hpp"

#include <sivid/io/text/json_document.hpp>

#include "support/catch.hpp"

#include <string>

using io_support::temporary_folder;
using namespace ranks_test;

TEST_CASE("ranks share a fleet, and the summary is that of one process") {
    temporary_folder const folder;
    auto const data = folder.path() / "campaigns";
    for (std::string const name : {"a", "b", "c", "d"}) {
        REQUIRE(run_alone({"generate", "--scenario", "S3", "--seed",
                           std::to_string(static_cast<int>(name[0])), "--absolute", "0.02", "--out",
                           (data / name).string()})
                    .code == 0);
    }
    auto const call = [&](fs::path const& out) {
        return words{"fleet",
                     "identify",
                     data.string(),
                     "--out",
                     out.string(),
                     "--with-options",
                     "--boxes 50 --budget 600"};
    };
    auto const one = folder.path() / "one", several = folder.path() / "several";
    REQUIRE(run_alone(call(one)).code == 0);
    auto const r = run_job(3, call(several));
    CAPTURE(r.out, r.err);
    CHECK(r.code == 0);
    auto const found = [](fs::path const& out) {
        std::string text;
        auto const summary = sivid::read_json(out / "fleet.json");
        for (auto const& d : summary.at("datasets").elements())
            text += d.at("dataset").string() + " " + d.at("found").string() + "\n";
        return text;
    };
    CHECK(found(one) == found(several));
    for (std::string const name : {"a", "b", "c", "d"})
        CHECK(support::text_of(one / name / "boxes.csv") ==
              support::text_of(several / name / "boxes.csv"));
}

TEST_CASE("ranks share the fits of a diagnosis, and say what one process says") {
    temporary_folder const folder;
    auto const data = std::string{SIVID_SOURCE_DIR} + "/examples/hovercraft/data/straight_run";
    auto const call = [&](fs::path const& out) {
        return words{"diagnose", data, "--out", out.string(), "--budget", "600", "--threads", "1"};
    };
    auto const one = folder.path() / "one", several = folder.path() / "several";
    auto const expected = run_alone(call(one));
    auto const r = run_job(3, call(several));
    CAPTURE(r.out, r.err);
    CHECK(r.code == expected.code);
    auto const text = [](fs::path const& out) {
        auto j = nlohmann::json::parse(support::text_of(out / "diagnosis.json"));
        j.erase("seconds");
        for (auto& tried : j["answer"]["journal"]) tried.erase("seconds");
        return j.dump();
    };
    CHECK(text(one) == text(several));
}
