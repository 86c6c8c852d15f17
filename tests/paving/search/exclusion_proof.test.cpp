// SPDX-License-Identifier: MIT
#include <sivid/paving/search/exclusion_proof.hpp>

#include "support/catch.hpp"

using namespace sivid;
using kind = proof_step::kind;

namespace {

bool same(box const& a, box const& b) { return subset(a, b) && subset(b, a); }

} // namespace

TEST_CASE("a cut parts a box into what is before it and what is beyond") {
    box const x{interval(0, 4), interval(1, 2)};
    proof_step const high{kind::cut, 0, true, 3}, low{kind::cut, 1, false, 1.5};
    CHECK(same(before(x, high), box{interval(0, 3), interval(1, 2)}));
    CHECK(same(beyond(x, high), box{interval(3, 4), interval(1, 2)}));
    CHECK(same(before(x, low), box{interval(0, 4), interval(1.5, 2)}));
    CHECK(same(beyond(x, low), box{interval(0, 4), interval(1, 1.5)}));
    // Places outside of the box: all of it or nothing.
    CHECK(is_empty(beyond(x, {kind::cut, 0, true, 5})));
    CHECK(same(before(x, {kind::cut, 0, true, 5}), x));
    CHECK(same(beyond(x, {kind::cut, 0, true, -1}), x));
    CHECK(is_empty(before(x, {kind::cut, 0, true, -1})));
    CHECK(is_empty(beyond(x, {kind::cut, 0, false, -1})));
    CHECK(same(beyond(x, {kind::cut, 0, false, 9}), x));
    CHECK(is_empty(before(x, {kind::cut, 0, false, 9})));
}

TEST_CASE("a log tells the tree from the prior on and leaves what it does not know") {
    box const prior{interval(0, 8)}, rest{interval(1, 7)};
    proof_log log(1U << 20);
    log.add(prior, {{kind::run, 0}}, rest, 0);    // cut at both ends, halved at 4
    log.add({interval(1, 4)}, {}, std::nullopt);  // nothing in it
    log.add({interval(9, 10)}, {}, std::nullopt); // never reached
    auto const proof = std::move(log).proof_from(prior);
    REQUIRE(proof.size() == 6);
    CHECK(proof[0].what == kind::run);
    CHECK((proof[1].what == kind::cut && !proof[1].upper && proof[1].at == 1));
    CHECK((proof[2].what == kind::cut && proof[2].upper && proof[2].at == 7));
    CHECK((proof[3].what == kind::split && proof[3].at == 4));
    CHECK(proof[4].what == kind::empty);
    CHECK(proof[5].what == kind::leaf);

    // Told again by another log, and gone on with.
    proof_log again(1U << 20);
    again.take_up(proof, prior);
    CHECK(again.proof_from(prior).size() == proof.size());
    again.add({interval(4, 7)}, {}, std::nullopt);
    auto const more = again.proof_from(prior);
    REQUIRE(more.size() == 6);
    CHECK(more[5].what == kind::empty);
    // A cut that cuts nothing leads back to the same box, once.
    proof_log idle(1U << 20);
    idle.take_up({{kind::cut, 0, true, 8}, {kind::leaf}}, prior);
    CHECK(idle.proof_from(prior).size() == 2);
    idle.take_up({{kind::split, 3, false, 8}, {kind::cut, 9, true, 8}, {}}, prior); // nonsense
    idle.take_up({{kind::split, 0, false, 80}, {}, {}, {}, {}}, prior);

    proof_log full(10);
    full.add(prior, {}, rest, 0);
    auto const none = std::move(full).proof_from(prior);
    REQUIRE(none.size() == 1);
    CHECK(none[0].what == kind::leaf);
}
