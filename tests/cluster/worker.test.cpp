// SPDX-License-Identifier: MIT
// What a worker does by itself; with its coordinator: worker_pool.test.cpp.
#include <sivid/cluster/worker.hpp>

#include "support/catch.hpp"

#include <vector>

using namespace sivid::cluster;

TEST_CASE("a worker answers what it is asked once it has taken the work up, until the end") {
    memory_transport office(1);
    auto& coordinator = *office.of_first;
    std::string told;
    int answers = 0;
    service const work{[&told](std::string_view about) {
                           told = about;
                           return identity{{{"problem", "p", "-"}}};
                       },
                       [&answers](std::string_view request) {
                           ++answers;
                           return std::string{request};
                       }};
    coordinator.send(0, {message::kind::ask, 1, "too early"});
    coordinator.send(0, {message::kind::hello, 0, "this"});
    coordinator.send(0, {message::kind::ask, 2, "question"});
    coordinator.send(0, {message::kind::end, 0, {}});
    coordinator.send(0, {message::kind::ask, 3, "too late"});
    worker m(*office.of_workers[0], identity_of_program());
    CHECK(m.wanted());
    m.serve(work);
    CHECK(told == "this");
    CHECK(answers == 1);

    auto const welcome = coordinator.receive()->says;
    REQUIRE(welcome.what == message::kind::welcome);
    auto mine = identity_of_program();
    mine.parts.push_back({"problem", "p", "-"});
    CHECK(mine.differing(welcome.who) == nullptr);
    auto const answer = coordinator.receive()->says;
    CHECK(answer.what == message::kind::answer);
    CHECK(answer.number == 2);
    CHECK(answer.seconds >= 0);
    CHECK_FALSE(answer.cut_short);
    CHECK(answer.body == "question");
    CHECK_FALSE(coordinator.receive());
}

TEST_CASE("a stop that arrives with what it stops is not lost") {
    memory_transport office(1);
    auto& coordinator = *office.of_first;
    std::vector<bool> wanted;
    worker m(*office.of_workers[0], identity_of_program());
    service const work{[](std::string_view) { return identity{}; },
                       [&](std::string_view) {
                           wanted.push_back(m.wanted());
                           return std::string{};
                       }};
    coordinator.send(0, {message::kind::stop, 0, {}}); // of what was before
    coordinator.send(0, {message::kind::hello, 0, {}});
    coordinator.send(0, {message::kind::ask, 1, {}});
    coordinator.send(0, {message::kind::end, 0, {}});
    m.serve(work);
    coordinator.send(0, {message::kind::hello, 0, {}});
    coordinator.send(0, {message::kind::ask, 2, {}});
    coordinator.send(0, {message::kind::stop, 0, {}});
    coordinator.send(0, {message::kind::end, 0, {}});
    m.serve(work);
    CHECK(wanted == std::vector<bool>{true, false});
}
