// SPDX-License-Identifier: MIT
// A coordinator and its workers in threads: everything is done once, whoever does it; strangers,
// faults and messages that nobody sends end the work with words.
#include <sivid/cluster/worker.hpp>
#include <sivid/cluster/worker_pool.hpp>

#include "cluster/threads.hpp"
#include "support/catch.hpp"

#include <atomic>
#include <chrono>
#include <thread>

using namespace sivid::cluster;
using cluster_test::workers_in_threads;
using namespace std::chrono_literals;

namespace {

service const echo{[](std::string_view) {
                       return identity{{{"task", "echo", "-"}}};
                   },
                   [](std::string_view text) { return std::string{text} + "!"; }};
identity const of_echo{{{"task", "echo", "ask for the same"}}};

std::vector<worker_pool::task> tasks(std::size_t count) {
    std::vector<worker_pool::task> result;
    for (std::size_t k = 0; k < count; ++k)
        result.push_back({[k](std::size_t) { return std::to_string(k); }});
    return result;
}
auto const always = [] { return true; };

} // namespace

TEST_CASE("all tasks are done, by any number of workers, again and again") {
    for (std::size_t const workers : {1u, 2u, 5u}) {
        workers_in_threads all(workers, [](std::size_t, worker& m) { m.serve(echo); });
        all.helpers.begin("about", of_echo);
        for (std::size_t const count : {0u, 1u, 3u, 200u}) {
            auto const done = all.helpers.ask(tasks(count), always);
            REQUIRE(done.size() == count);
            for (std::size_t k = 0; k < count; ++k) {
                REQUIRE(done[k]);
                CHECK(done[k]->body == std::to_string(k) + "!");
                CHECK(done[k]->worker < workers);
                CHECK_FALSE(done[k]->cut_short);
            }
        }
        auto const& t = all.helpers.traffic();
        CHECK(t.requests == 204);
        CHECK(t.messages >= 2 * 204 + workers + 1); // some may not have shown themselves
        CHECK(t.messages <= 2 * 204 + 2 * workers);
        CHECK(t.bytes_sent > 204 * 8);
        CHECK(t.worked >= 0);
    }
}

TEST_CASE("what is meant for a worker is done by that worker") {
    workers_in_threads all(3, [](std::size_t k, worker& m) {
        auto mine = echo;
        mine.answer = [k](std::string_view) { return std::to_string(k); };
        m.serve(mine);
    });
    all.helpers.begin("", of_echo);
    (void)all.helpers.ask(tasks(100), always); // all have shown themselves, or none is needed
    std::vector<worker_pool::task> meant;
    for (std::size_t m = 0; m < 3; ++m) {
        for (int n = 0; n < 7; ++n) meant.push_back({[](std::size_t) { return ""; }, m});
    }
    auto const done = all.helpers.ask(meant, always);
    for (std::size_t k = 0; k < meant.size(); ++k) CHECK(done[k]->body == std::to_string(k / 7));
}

TEST_CASE("strangers are told apart and named") {
    for (bool const program : {true, false}) {
        workers_in_threads all(
            2,
            [program](std::size_t k, worker& m) {
                auto mine = echo;
                if (k == 1 && !program)
                    mine.take_up = [](std::string_view) {
                        return identity{{{"task", "shout", "-"}}};
                    };
                m.serve(mine);
            },
            [program](std::size_t k) {
                auto who = identity_of_program();
                if (k == 1 && program) who.parts[1].value = "0000-1";
                return who;
            });
        all.helpers.begin("", of_echo);
        CHECK_THROWS_WITH(all.ask_for_ever(tasks(1)),
                          ContainsSubstring("thread 1 differs") &&
                              ContainsSubstring(program ? "program" : "shout"));
    }
}

TEST_CASE("a worker's fault is told with its words") {
    for (bool const at_begin : {true, false}) {
        workers_in_threads all(1, [at_begin](std::size_t, worker& m) {
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

TEST_CASE("messages that nobody sends are refused by both sides") {
    memory_transport office(1);
    worker_pool helpers(*office.of_first, identity_of_program());
    helpers.begin("", of_echo);
    office.of_workers[0]->send(0, {message::kind::ask, 1, {}});
    CHECK_THROWS_AS(helpers.ask(tasks(1), always), std::logic_error);
    worker m(*office.of_workers[0], identity_of_program());
    while (office.of_workers[0]->receive()) {
    }
    office.of_first->send(0, {message::kind::welcome, 0, {}});
    CHECK_THROWS_AS(m.serve(echo), std::logic_error);
}

TEST_CASE("told to stop, workers end soon and say so, and nobody waits for the silent for ever") {
    std::atomic<int> finished = 0;
    workers_in_threads all(2, [&finished](std::size_t, worker& m) {
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
    // A new beginning, and all is wanted again.
    all.helpers.begin("", of_echo);
    auto const until = std::chrono::steady_clock::now() + 200ms;
    (void)all.helpers.ask(tasks(1), [&] { return std::chrono::steady_clock::now() < until; });
    CHECK(finished > static_cast<int>(answered));
}

TEST_CASE("alone or with others, a coordinator's own thread works, and all are let go") {
    for (std::size_t const others : {0u, 2u}) {
        memory_transport office(others);
        identity const mine{{{"task", "count", "-"}}};
        std::atomic<bool> at_work = false; // the others do not take all before
        std::vector<std::thread> threads;
        for (std::size_t k = 0; k < others; ++k) {
            threads.emplace_back([&, k] {
                worker m(*office.of_workers[k], identity_of_program());
                m.serve({[&](std::string_view) { return mine; },
                         [&](std::string_view text) {
                             while (!at_work) std::this_thread::sleep_for(1ms);
                             return std::string{text} + "there";
                         }});
            });
        }
        std::size_t here = 0;
        {
            working_coordinator all(*office.of_first, "", mine,
                                    [&](worker& self, std::string_view text) {
                                        at_work = true;
                                        CHECK(self.wanted());
                                        return std::string{text} + "here";
                                    });
            CHECK(all.helpers().size() == others + 1);
            std::vector<worker_pool::task> tasks(40, {[](std::size_t) { return "done "; }});
            for (auto const& a : all.helpers().ask(tasks, [] { return true; })) {
                REQUIRE(a);
                here += a->body == "done here" ? 1 : 0;
                CHECK((a->body == "done here" || a->body == "done there"));
            }
        }
        CHECK(here > 0);
        if (others == 0) CHECK(here == 40);
        for (auto& t : threads) t.join();
    }
}

TEST_CASE("those who wait for work that never came are released") {
    memory_transport office(1);
    std::thread helper([&] {
        worker m(*office.of_workers[0], identity_of_program());
        m.serve({});
    });
    release(*office.of_first);
    helper.join();
    CHECK_FALSE(office.of_first->receive());
}

TEST_CASE("they are released with the end of a life, unless work has come") {
    memory_transport office(1);
    for (bool const work : {true, false}) {
        {
            released_at_end idle(*office.of_first);
            if (work) idle.work_has_come();
        }
        CHECK(office.of_workers[0]->receive().has_value() == !work);
    }
}
