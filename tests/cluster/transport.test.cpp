// SPDX-License-Identifier: MIT
#include <sivid/cluster/transport.hpp>

#include "support/catch.hpp"

#include <thread>

using namespace sivid::cluster;

namespace {
message text(std::string body) { return {message::kind::ask, 0, std::move(body)}; }
} // namespace

TEST_CASE("letters between threads arrive in their order, at whom they are for") {
    memory_transport office(3);
    auto& first = *office.of_first;
    CHECK(first.others() == 3);
    CHECK(office.of_workers[1]->others() == 1);
    CHECK_FALSE(first.receive());
    std::thread worker([&] {
        patience rest;
        for (int seen = 0; seen < 100;) {
            if (auto l = office.of_workers[1]->receive()) {
                office.of_workers[1]->send(0, text(l->says.body + "!"));
                ++seen;
            } else {
                rest.wait();
            }
        }
    });
    for (int k = 0; k < 100; ++k) first.send(1, text(std::to_string(k)));
    patience rest;
    for (int seen = 0; seen < 100;) {
        if (auto const l = first.receive()) {
            CHECK(l->from == 1);
            CHECK(l->says.body == std::to_string(seen) + "!");
            ++seen;
            rest.renew();
        } else {
            rest.wait();
        }
    }
    worker.join();
    CHECK_FALSE(office.of_workers[0]->receive());
    CHECK_FALSE(office.of_workers[2]->receive());
}

TEST_CASE("two transports joined are one, the others of the second behind those of the first") {
    memory_transport a(1), b(2);
    joined_transport both(*a.of_first, *b.of_first);
    CHECK(both.others() == 3);
    both.send(0, text("a0"));
    both.send(2, text("b1"));
    CHECK(a.of_workers[0]->receive()->says.body == "a0");
    CHECK(b.of_workers[1]->receive()->says.body == "b1");
    b.of_workers[0]->send(0, text("from b0"));
    auto const l = both.receive();
    REQUIRE(l);
    CHECK(l->from == 1);
    CHECK(both.name_of(0) == a.of_first->name_of(0));
    CHECK(both.name_of(2) == b.of_first->name_of(1));
}
