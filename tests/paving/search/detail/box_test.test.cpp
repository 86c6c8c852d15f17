// SPDX-License-Identifier: MIT
// Set inversion with tests in any interval type, on sets that are known.
#include <sivid/paving/invert.hpp>
#include <sivid/paving/search/detail/box_test.hpp>

#include "support/boxes.hpp"
#include "support/catch.hpp"
#include "support/interval_types.hpp"
#include "support/random.hpp"

#include <cmath>
#include <map>
#include <vector>

using namespace sivid;
using support::draws;
using support::mp;

namespace {

/// sqrt(x) + y and x / y, where they are defined.
struct formulas {
    template <class I>
    basic_box<I> operator()(basic_box<I> const& x, lane_mask<I>& cut) const {
        using t = interval_traits<I>;
        return {t::add(t::sqrt(x[0], cut), x[1]), t::div(x[0], x[1], cut)};
    }
};
/// Where the two are in this box: 0.5 <= sqrt(x) + y <= 2, 0 <= x / y <= 1.5, y not 0.
box const target{interval(0.5, 2), interval(0, 1.5)};
box const prior{interval(-1, 2), interval(-1, 2)};

bool belongs(mp const& x, mp const& y) {
    if (x < 0 || y == 0) return false;
    mp const a = sqrt(x) + y, b = x / y;
    return a >= 0.5 && a <= 2 && b >= 0 && b <= 1.5;
}

inversion_options rough() {
    inversion_options options;
    options.accuracy = 1.0 / 64;
    options.sufficient_ratio = 1;
    return options;
}

/// Covers the prior without overlaps, and is right at random points.
void check(subpaving const& paving, std::uint64_t seed) {
    draws d(seed);
    mp sum = 0;
    for (auto const& b : paving.boxes()) {
        sum += support::volume(b.set);
        for (int round = 0; round < 4; ++round) {
            auto const p = d.in(b.set);
            if (b.verdict == box_verdict::inside) CHECK(belongs(p[0], p[1]));
            if (b.verdict == box_verdict::outside) CHECK_FALSE(belongs(p[0], p[1]));
        }
    }
    CHECK(sum == support::volume(paving.prior()));
}

} // namespace

TEMPLATE_TEST_CASE("a static inversion is right in every interval type, domain cuts included", "",
                   SIVID_INTERVAL_TYPES) {
    image_test<TestType, formulas> test(formulas{}, target);
    auto const found = invert<TestType>(test, prior, rough());
    check(found.paving, 5);
    CHECK(found.paving.count(box_verdict::inside) > 20);
    CHECK(proved_verdict(found.paving) == verdict::consistent);
    CHECK(found.paving.outer_volume().upper() < 0.35);
    CHECK(found.reason == stop_reason::accuracy_reached);
}

TEMPLATE_TEST_CASE("types of the same tightness say the same of every box", "", support::boost_type,
                   sivid::pack<1>, sivid::pack<3>, sivid::pack<8>) {
    auto options = rough();
    options.order = search_order::first_in; // boxes are not halved to fill lanes
    image_test<interval, formulas> one(formulas{}, target);
    auto const reference = invert<interval>(one, prior, options);
    image_test<TestType, formulas> test(formulas{}, target);
    auto const found = invert<TestType>(test, prior, options);
    CHECK(found.tested == reference.tested);
    std::map<std::vector<double>, box_verdict> says;
    auto const key = [](box const& x) {
        return std::vector<double>{x[0].lower(), x[0].upper(), x[1].lower(), x[1].upper()};
    };
    for (auto const& b : reference.paving.boxes()) says[key(b.set)] = b.verdict;
    REQUIRE(says.size() == found.paving.boxes().size());
    for (auto const& b : found.paving.boxes()) {
        REQUIRE(says.count(key(b.set)) == 1);
        CHECK(says[key(b.set)] == b.verdict);
    }
}

TEST_CASE("what a coarser type proves the vocabulary type does not deny") {
    image_test<interval, formulas> one(formulas{}, target);
    image_test<support::coarse, formulas> test(formulas{}, target);
    auto const found = invert<support::coarse>(test, prior, rough());
    for (auto const& b : found.paving.boxes()) {
        auto const says = one(b.set);
        if (b.verdict == box_verdict::inside) CHECK(says.inside);
        if (b.verdict == box_verdict::outside) CHECK(says.outside);
    }
}

TEST_CASE("a target between the type's numbers is not widened to them") {
    // [0.1, 0.3] of doubles lies strictly inside its single-precision enclosure.
    using t = interval_traits<support::coarse>;
    auto const itself = [](basic_box<support::coarse> const& x, bool&) { return x; };
    interval const bound(0.1, 0.3);
    image_test<support::coarse, decltype(itself)> const test(itself, box{bound});
    auto const wider = t::bounds(0.1, 0.3);
    REQUIRE(t::lower(wider) < 0.1);
    CHECK_FALSE(test({wider}).inside);
    CHECK(test({t::bounds(0.125, 0.25)}).inside);
}

namespace {

/// Contracts to a rest whose bounds are no doubles, and says that all of it is inside.
struct thirds {
    finding<mp_interval> operator()(basic_box<mp_interval> const& x) const {
        using t = interval_traits<mp_interval>;
        bool cut = false;
        auto const set =
            t::hull(t::div(t::point(1), t::point(3), cut), t::div(t::point(2), t::point(3), cut));
        finding<mp_interval> says{.rest = {t::intersect(x[0], set)}};
        says.outside = is_empty(says.rest);
        says.inside = true;
        return says;
    }
};

} // namespace

TEST_CASE("what is proved inside between doubles is not claimed for the doubles around it") {
    thirds test;
    auto options = rough();
    options.accuracy = 1e-4;
    auto const found = invert(test, basic_box<mp_interval>{mp_interval(0, 1)}, options);
    for (auto const& b : found.paving.boxes()) {
        if (b.verdict != box_verdict::inside) continue;
        CHECK(3 * mp(b.set[0].lower()) >= 1);
        CHECK(3 * mp(b.set[0].upper()) <= 2);
    }
    CHECK(found.paving.inner_volume().upper() > 0.33);
    CHECK(found.paving.outer_volume().upper() < 0.334);
}

namespace {

struct answers_with {
    basic_box<interval> rest;
    bool inside = true, outside = false;
    finding<interval> operator()(box const&) const { return {inside, outside, rest}; }
};

} // namespace

TEST_CASE("careless tests cannot lose or claim what they did not prove") {
    box const unit{interval(0, 1)};
    auto const none = interval_traits<interval>::empty();
    SECTION("a rest beyond the box is cut to the box") {
        answers_with test{{interval_traits<interval>::entire()}};
        auto const found = invert<interval>(test, unit, rough());
        CHECK(found.paving.boxes().size() == 1);
        CHECK(subset(found.paving.boxes()[0].set, unit));
    }
    SECTION("inside and outside at once is outside: the box holds no point of the set") {
        answers_with test{unit, true, true};
        CHECK(proved_verdict(invert<interval>(test, unit, rough()).paving) ==
              verdict::inconsistent);
    }
    SECTION("an empty rest excludes the box") {
        answers_with test{{none}};
        CHECK(proved_verdict(invert<interval>(test, unit, rough()).paving) ==
              verdict::inconsistent);
    }
    SECTION("a rest of another size is refused") {
        answers_with test{{none, none}};
        CHECK_THROWS_AS(invert<interval>(test, unit, rough()), std::invalid_argument);
    }
    SECTION("priors that cannot be searched are refused") {
        answers_with test{unit};
        CHECK_THROWS_AS(invert<interval>(test, box{none}, rough()), std::invalid_argument);
        CHECK_THROWS_AS(invert<interval>(test, box{interval_traits<interval>::entire()}, rough()),
                        std::invalid_argument);
    }
}

TEST_CASE("an enclosure that is empty without a cut domain proves nothing") {
    auto const broken = [](box const&, bool&) { return box{interval_traits<interval>::empty()}; };
    image_test<interval, decltype(broken)> const test(broken, box{interval(0, 1)});
    auto const says = test(box{interval(0, 1)});
    CHECK_FALSE(says.inside);
    CHECK_FALSE(says.outside);
}

TEST_CASE("a test that is told to stop ends the search") {
    struct stopped {
        int left = 5;
        finding<interval> operator()(box const& x) {
            --left;
            return {.rest = x};
        }
        bool cancelled() const { return left <= 0; }
    } test;
    auto const found = invert<interval>(test, box{interval(0, 1)}, rough());
    CHECK(found.reason == stop_reason::time_budget);
    CHECK(found.paving.outer_volume().lower() > 0.99);
}
