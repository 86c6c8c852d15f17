// SPDX-License-Identifier: MIT
#include <sivid/cluster/box_server.hpp>

#include "cluster/rings.hpp"
#include "support/catch.hpp"

using namespace sivid;
using namespace sivid::cluster;
using cluster_test::ring_prior;
using cluster_test::ring_test;

namespace {

std::string to_learn(std::uint64_t lesson, std::vector<box> const& boxes,
                     std::vector<std::pair<std::uint64_t, std::uint64_t>> const& forget = {}) {
    return packed(box_request{forget, {{lesson, boxes}}, true, {}});
}
std::string to_judge(std::uint64_t lesson, std::uint64_t place, box const& x,
                     std::vector<box> const& companions = {}) {
    box_request r{{}, {}, false, {{lesson, place, x}}};
    if (!companions.empty()) r.lessons.push_back({lesson, companions});
    return packed(r);
}
std::string judgement(std::string const& reply) { return reply.substr(8); } // behind its time

} // namespace

TEST_CASE("a box is judged the same where it was learnt and where the companions are sent along") {
    ring_test test, other;
    box_server<ring_test> here(test, ring_prior()), there(other, ring_prior());
    auto [low, high] = bisect(ring_prior(), 0, 0.1);
    std::vector<box> const both{low, high};
    auto const said = here(to_learn(7, both));
    unpacker in(said);
    for (auto const& x : both) {
        CHECK(in.take<assessment<ring_test::knowledge>>().cost == 2);
        CHECK(in.take<bool>());
        CHECK(in.take<std::uint64_t>() > test.bytes({x, 0}));
    }
    CHECK(here.lessons() == 1);
    auto const part = bisect(high, 1, 0.3).second;
    auto const first = judgement(here(to_judge(7, 1, part)));
    CHECK(judgement(there(to_judge(7, 1, part, both))) == first);
    CHECK(judgement(there(to_judge(7, 1, part))) == first); // it has it now
    // Learnt alone it would have been another lesson.
    CHECK_THROWS_AS(there(to_judge(8, 1, part, {high})), std::invalid_argument);

    // What nobody refers to any longer is forgotten.
    (void)here(to_learn(9, {low}, {{7, 0}}));
    CHECK(here.lessons() == 2);
    CHECK(judgement(here(to_judge(7, 1, part))) == first);
    (void)here(to_learn(10, {low}, {{7, 1}, {7, 1}, {99, 0}, {9, 0}}));
    CHECK(here.lessons() == 1);
    CHECK_THROWS_WITH(here(to_judge(7, 1, part)), ContainsSubstring("nobody has learnt"));
}

TEST_CASE("requests that no coordinator writes are refused") {
    ring_test test;
    box_server<ring_test> server(test, ring_prior());
    (void)server(to_learn(1, {ring_prior()}));
    box const outside{hull(0_dec, 9_dec), hull(0_dec, 1_dec)};
    box const flat{hull(0_dec, 1_dec)};
    for (auto const& bad : {to_learn(2, {outside}), to_learn(2, {flat}),
                            to_judge(1, 1, ring_prior()), to_judge(3, 0, ring_prior()),
                            to_judge(1, 0, flat), to_learn(2, {ring_prior()}, {{1, 5}})}) {
        CHECK_THROWS_AS(server(bad), std::invalid_argument);
    }
    CHECK(server.lessons() == 1);
}
