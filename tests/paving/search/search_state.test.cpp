// SPDX-License-Identifier: MIT
#include <sivid/paving/search/search_state.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <stdexcept>

using namespace sivid;

namespace {

search_state good() {
    search_state s;
    s.prior = s.whole = s.last_hull = box{interval(0, 1), interval(2, 4)};
    s.paved = {{box{interval(0, 0.5), interval(2, 4)}, box_verdict::outside}};
    s.lessons = {{box{interval(0.5, 1), interval(2, 4)}}};
    s.waiting = {{box{interval(0.5, 1), interval(2, 3)}, 0.25, 1, search_state::origin{0, 0, 64}},
                 {box{interval(0.5, 1), interval(3, 4)}, 0.25, 2}};
    s.pushed = 3;
    s.waiting_volume = 0.5;
    return s;
}

} // namespace

TEST_CASE("the state of a search is accepted") { CHECK_NOTHROW(good().require_valid()); }

TEST_CASE("what cannot be the state of a search is refused") {
    auto const refused = [](auto const& spoil) {
        auto s = good();
        spoil(s);
        CHECK_THROWS_AS(s.require_valid(), std::invalid_argument);
    };
    refused([](auto& s) { s.prior = box(0); });
    refused([](auto& s) { s.prior[0] = interval(0, INFINITY); });
    refused([](auto& s) { s.whole[1] = interval(1, 4); });
    refused([](auto& s) { s.last_hull = box{interval(0, 1)}; });
    refused([](auto& s) { s.paved[0].set[0] = interval(-1, 0); });
    refused([](auto& s) { s.lessons[0][0][0] = interval(0, 2); });
    refused([](auto& s) { s.waiting[0].set[0] = interval_traits<interval>::empty(); });
    refused([](auto& s) { s.waiting[1].number = 3; });
    refused([](auto& s) { s.waiting[1].volume = -1; });
    refused([](auto& s) { s.waiting[0].known->lesson = 1; });
    refused([](auto& s) { s.waiting[0].known->place = 1; });
    refused([](auto& s) { s.seconds = -1; });
    refused([](auto& s) { s.waiting_volume = NAN; });
    refused([](auto& s) { s.batches = 0; });
}

TEST_CASE("boxes that do not cover the prior or overlap are no state of a search") {
    auto const refused = [](auto const& spoil) {
        auto s = good();
        spoil(s);
        CHECK_THROWS_AS(s.require_valid(), std::invalid_argument);
    };
    refused([](auto& s) { // a waiting box removed, the volume adapted
        s.waiting.pop_back();
        s.waiting_volume = 0.25;
    });
    refused([](auto& s) { s.paved.clear(); });
    refused([](auto& s) { s.paved[0].set[0] = interval(0, std::nextafter(0.5, 0)); });
    refused([](auto& s) { s.waiting[1].set[1] = interval(2.5, 4); });
    refused([](auto& s) { // the same box twice
        s.paved.push_back(s.paved[0]);
    });
    refused([](auto& s) { s.waiting[0].volume = 0.2; });
    refused([](auto& s) { s.waiting_volume = 0.4; });
    // Where the outside boxes were not kept, nobody can tell.
    auto s = good();
    s.paved.clear();
    s.outside_kept = false;
    CHECK_NOTHROW(s.require_valid());
}
