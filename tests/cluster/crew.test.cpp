// SPDX-License-Identifier: MIT
// A coordinator and its crew in threads: everything is done once, whoever does it; strangers,
// faults and damaged messages end the work with words.
#include <sivid/cluster/crew.hpp>
#include <sivid/cluster/member.hpp>

#include "cluster/threads.hpp"
#include "support/catch.hpp"

#include <atomic>
#include <chrono>

using namespace sivid::cluster;
using cluster_test::crew_in_threads;
using namespace std::chrono_literals;

namespace {

service const echo{[](std::string_view) {
                       return identity{{{"task", "echo", "-"}}};
                   },
                   [](std::string_view text) { return std::string{text} + "!"; }};
identity const of_echo{{{"task", "echo", "ask for the same"}}};

std::vector<crew::task> tasks(std::size_t count) {
    std::vector<crew::task> result;
    for (std::size_t k = 0; k < count; ++k)
        result.push_back({[k](std::size_t) { return std::to_string(k); }});
    return result;
}
auto const always = [] { return true; };

} // namespace

TEST_CASE("all tasks are done, by any number of members, again and again") {
    for (std::size_t const members : {1u, 2u, 5u}) {
        crew_in_threads all(members, [](std::size_t, member& m) { m.serve(echo); });
        all.helpers.begin("about", of_echo);
        for (std::size_t const count : {0u, 1u, 3u, 200u}) {
            auto const done = all.helpers.ask(tasks(count), always);
            REQUIRE(done.size() == count);
            for (std::size_t k = 0; k < count; ++k) {
                REQUIRE(done[k]);
                CHECK(done[k]->body == std::to_string(k) + "!");
                CHECK(done[k]->member < members);
                CHECK_FALSE(done[k]->cut_short);
            }
        }
        auto const& t = all.helpers.traffic();
        CHECK(t.requests == 204);
        CHECK(t.messages >= 2 * 204 + members + 1); // some may not have shown themselves
        CHECK(t.messages <= 2 * 204 + 2 * members);
        CHECK(t.bytes_sent > 204 * 8);
        CHECK(t.worked >= 0);
    }
}

TEST_CASE("what is meant for a member is done by that member") {
    crew_in_threads all(3, [](std::size_t k, member& m) {
        auto mine = echo;
        mine.answer = [k](std::string_view) { return std::to_string(k); };
        m.serve(mine);
    });
    all.helpers.begin("", of_echo);
    (void)all.helpers.ask(tasks(100), always); // all have shown themselves, or none is needed
    std::vector<crew::task> meant;
    for (std::size_t m = 0; m < 3; ++m) {
        for (int n = 0; n < 7; ++n) meant.push_back({[](std::size_t) { return ""; }, m});
    }
    auto const done = all.helpers.ask(meant, always);
    for (std::size_t k = 0; k < meant.size(); ++k) CHECK(done[k]->body == std::to_string(k / 7));
}

TEST_CASE("strangers are told apart and named") {
    for (bool const program : {true, false}) {
        crew_in_threads all(
            2,
            [program](std::size_t k, member& m) {
                auto mine = echo;
                if (k == 1 && !program)
                    mine.take_up = [](std::string_view) {
                        return identity{{{"task", "shout", "-"}}};
                    };
                m.serve(mine);
            },
            [program](std::size_t k) {
                auto who = identity_of_program();
                if (k == 1 && program) who.parts[2].value = "0000-1";
                return who;
            });
        all.helpers.begin("", of_echo);
        CHECK_THROWS_WITH(all.ask_for_ever(tasks(1)),
                          ContainsSubstring("thread 1 differs") &&
                              ContainsSubstring(program ? "program" : "shout"));
    }
}

TEST_CASE("a member's fault is told with its words") {
    for (bool const at_begin : {true, false}) {
        crew_in_threads all(1, [at_begin](std::size_t, member& m) {
            auto mine = echo;
            (at_begin ? mine.answer : mine.answer) = [](std::string_view) -> std::string {
                throw std::runtime_error("no such box");
            };
            if (at_begin)
                mine.take_up = [](std::string_view) -> identity {
                    throw std::runtime_error("no such box");
                };
            m.serve(mine);
        });
        all.helpers.begin("", of_echo);
        CHECK_THROWS_WITH(all.helpers.ask(tasks(1), always),
                          ContainsSubstring("thread 0") && ContainsSubstring("no such box"));
    }
}

TEST_CASE("damaged messages, and such as nobody sends, are refused by both sides") {
    memory_post office(1);
    crew helpers(*office.of_first, identity_of_program());
    helpers.begin("", of_echo);
    auto const good = to_bytes({frame::kind::answer, 1, {}});
    for (auto const& bytes :
         {std::string{}, std::string{"hello"}, good.substr(0, 20), good + "x",
          to_bytes({frame::kind::ask, 1, {}}), to_bytes({frame::kind::welcome, 0, "??"}), good}) {
        office.of_members[0]->send(0, bytes);
        CHECK_THROWS_AS(helpers.ask(tasks(1), always), wire_error);
    }
    member m(*office.of_members[0], identity_of_program());
    while (office.of_members[0]->receive()) {
    }
    office.of_first->send(0, "what?");
    CHECK_THROWS_AS(m.serve(echo), wire_error);
    office.of_first->send(0, to_bytes({frame::kind::welcome, 0, {}}));
    CHECK_THROWS_AS(m.serve(echo), wire_error);
}

TEST_CASE("told to stop, members end soon and say so, and nobody waits for the silent for ever") {
    std::atomic<int> finished = 0;
    crew_in_threads all(2, [&finished](std::size_t, member& m) {
        auto mine = echo;
        mine.answer = [&](std::string_view) {
            while (m.wanted()) std::this_thread::sleep_for(1ms);
            ++finished;
            return std::string{"so far"};
        };
        m.serve(mine);
    });
    all.helpers.begin("", of_echo);
    auto const begin = std::chrono::steady_clock::now();
    auto const done =
        all.helpers.ask(tasks(8), [&] { return std::chrono::steady_clock::now() < begin + 300ms; });
    std::size_t answered = 0, cut = 0;
    for (auto const& d : done) {
        answered += d ? 1 : 0;
        cut += d && d->cut_short ? 1 : 0;
    }
    CHECK(answered >= 1);
    CHECK(answered <= 4);
    CHECK(cut == answered);
    CHECK(finished == static_cast<int>(answered));
    CHECK(std::chrono::steady_clock::now() < begin + 5s);
    // A new beginning, and all is wanted again.
    all.helpers.begin("", of_echo);
    auto const until = std::chrono::steady_clock::now() + 200ms;
    (void)all.helpers.ask(tasks(1), [&] { return std::chrono::steady_clock::now() < until; });
    CHECK(finished > static_cast<int>(answered));
}
