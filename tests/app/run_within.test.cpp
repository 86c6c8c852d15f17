// SPDX-License-Identifier: MIT
// A command within another program: no terminal, no signals, exceptions in place of exit codes.
#include "app/cup.hpp"

#include "support/catch.hpp"
#include "support/child_program.hpp"

#include <sivid/app/names.hpp>

#include <atomic>
#include <csignal>

using namespace app_test;
using sivid::app::run_within;
using support::text_of;

namespace {

sivid::app::host silent() {
    return {nullptr, [] { return false; }};
}

} // namespace

TEST_CASE("a command within another program is that of the program") {
    served const s;
    auto const other = s.at("other");
    auto const within = run_within(silent(), cup(), {"identify", s.data(), "--out", other});
    auto const alone = run({"identify", s.data(), "--out", s.at("out"), "--quiet"});
    CHECK(within.code == alone.code);
    CHECK(text_of(s.at("other") + "/boxes.csv") == text_of(s.at("out") + "/boxes.csv"));
    CHECK_THAT(within.words, ContainsSubstring("consistent"));
    CHECK(within.notices.empty());
}

TEST_CASE("what is wrong is thrown, with the words of the program") {
    served const s;
    auto const same = [&](std::vector<std::string> const& words) {
        auto const alone = run(words);
        CAPTURE(alone.err);
        CHECK(alone.code == 2);
        try {
            static_cast<void>(run_within(silent(), cup(), words));
            FAIL("nothing was thrown");
        } catch (std::exception const& e) {
            auto const failed = sivid::app::failure_of(e);
            CHECK(failed.code == 2);
            CHECK("cup: " + failed.words + "\n" == alone.err);
        }
    };
    auto const out = s.at("out");
    same({"identify", s.at("nowhere"), "--out", out});
    same({"identify", s.data(), "--out", out, "--with", "draugth"});
    same({"identify", s.data(), "--out", out, "--outliers", "99"});
    CHECK_THROWS_WITH(run_within(silent(), cup(), {"identify", s.data(), "--otu", out}),
                      ContainsSubstring("; Did you mean --out?"));
    CHECK_THROWS_AS(run_within(silent(), cup(), {}), sivid::app::bad_request);
    CHECK_THAT(run_within(silent(), cup(), {"rank", "--help"}).words, ContainsSubstring("Example"));
}

TEST_CASE("the other program hears of progress and may ask for the result so far") {
    served const s;
    auto const before = std::signal(SIGINT, SIG_DFL);
    std::atomic<bool> stop{false};
    std::string heard;
    sivid::app::host const h{[&](std::string const& line) {
                                 heard += line + "\n";
                                 stop = heard.find(" boxes ") != std::string::npos;
                             },
                             [&] { return stop.load(); }};
    auto const ended = run_within(
        h, cup(),
        {"identify", s.data(), "--out", s.at("out"), "--accuracy", "1e-12", "--budget", "600"});
    CHECK_THAT(heard, ContainsSubstring("identifying generated") && ContainsSubstring(" s  "));
    CHECK_THAT(ended.words, ContainsSubstring("cancelled"));
    CHECK(fs::exists(s.at("out") + "/result.json"));
    CHECK(std::signal(SIGINT, before) == SIG_DFL); // the handler of Ctrl-C is that of the other
    CHECK_FALSE(sivid::app::interrupted());        // and nothing of it is left
    auto const quiet = run_within(h, cup(), {"rank", s.data(), "--out", s.at("r"), "--quiet"});
    CHECK(quiet.notices.empty());
}
