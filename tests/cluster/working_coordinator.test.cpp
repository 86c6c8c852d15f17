// SPDX-License-Identifier: MIT
#include <sivid/cluster/working_coordinator.hpp>

#include "support/catch.hpp"

#include <atomic>
#include <chrono>
#include <thread>

using namespace sivid::cluster;
using namespace std::chrono_literals;

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
