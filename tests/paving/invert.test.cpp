// SPDX-License-Identifier: MIT
// Set inversion on sets whose areas are known.
#include <sivid/paving/invert.hpp>

#include "support/boxes.hpp"
#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/power_series.hpp"
#include "support/random.hpp"

#include <cmath>
#include <limits>
#include <numbers>

using namespace sivid;
using support::between;
using support::draws;
using support::interiors_meet;
using support::mp;
using support::volume;

namespace {

using traits = interval_traits<interval>;

/// low <= x^2 + y^2 <= high
struct ring {
    double low, high;
    bool contracting = false;
    std::vector<double> smear = {};

    assessment<> operator()(box const& b) const {
        assessment<> a{box_verdict::undecided, b, smear};
        auto const r = traits::add(traits::sqr(b[0]), traits::sqr(b[1]));
        auto const set = between(low, high);
        if (disjoint(r, set)) a.verdict = box_verdict::outside;
        if (subset(r, set)) a.verdict = box_verdict::inside;
        if (contracting && a.verdict == box_verdict::undecided) {
            for (std::size_t i = 0; i < 2; ++i) {
                bool cut = false;
                auto const square = traits::sub(set, traits::sqr(b[1 - i]));
                auto const size = traits::sqrt(square, cut); // of what is not negative
                a.rest[i] = traits::intersect(a.rest[i], traits::hull(traits::neg(size), size));
            }
        }
        return a;
    }
    bool has(double x, double y) const {
        mp const r = mp(x) * x + mp(y) * y;
        return low <= r && r <= high;
    }
};

/// The boxes cover the prior, overlap in faces only, and their verdicts hold for random points.
void check_paving(subpaving const& paving, ring const& set, draws& d, bool exact_volume) {
    mp sum = 0;
    auto const& boxes = paving.boxes();
    for (auto const& b : boxes) {
        CHECK(subset(b.set, paving.prior()));
        sum += volume(b.set);
        for (int k = 0; k < 4; ++k) {
            auto const x = d.in(b.set);
            if (b.verdict == box_verdict::inside) CHECK(set.has(x[0], x[1]));
            if (b.verdict == box_verdict::outside) {
                // Of a contracted box the cut faces may touch the set.
                double const margin = set.contracting ? 1e-9 : 0;
                mp const r = mp(x[0]) * x[0] + mp(x[1]) * x[1];
                CHECK((r < set.low + margin || r > set.high - margin));
            }
        }
    }
    mp const whole = volume(paving.prior());
    if (exact_volume) {
        CHECK(sum == whole);
    } else {
        CHECK(abs(sum - whole) < 1e-30);
    }
    std::size_t overlaps = 0;
    std::size_t const checked = std::min<std::size_t>(boxes.size(), 1500);
    for (std::size_t i = 0; i < checked; ++i) {
        for (std::size_t j = 0; j < i; ++j) overlaps += interiors_meet(boxes[i].set, boxes[j].set);
    }
    CHECK(overlaps == 0);
    for (int k = 0; k < 500; ++k) {
        auto const x = d.in(paving.prior());
        bool covered = false;
        bool outer = false;
        for (auto const& b : boxes) {
            if (!contains(b.set, x)) continue;
            covered = true;
            outer = outer || b.verdict != box_verdict::outside;
        }
        CHECK(covered);
        if (set.has(x[0], x[1])) CHECK(outer);
    }
}

box const square{between(-5, 5), between(-5, 5)};
constexpr double ring_share = std::numbers::pi / 100; // of [-5, 5]^2, for 1 <= r^2 <= 2

inversion_options accuracy(double a) {
    inversion_options o;
    o.accuracy = a;
    o.sufficient_ratio = 1;
    return o;
}

} // namespace

TEST_CASE("the ring: inner and outer volumes bracket the true area and close on it") {
    draws d(321);
    double last = 1;
    for (double const a : {1.0 / 16, 1.0 / 64, 1.0 / 256}) {
        for (bool const contracting : {false, true}) {
            ring set{1, 2, contracting};
            auto const found = invert(set, square, accuracy(a));
            CHECK(found.paving.inner_volume().lower() <= ring_share);
            CHECK(found.paving.outer_volume().upper() >= ring_share);
            CHECK(found.reason == stop_reason::accuracy_reached);
            CHECK(found.paving.count(box_verdict::pending) == 0);
            for (auto const& b : found.paving.boxes()) {
                if (b.verdict == box_verdict::undecided) CHECK(width(b.set) <= 10 * a);
            }
            check_paving(found.paving, set, d, !contracting);
            double const gap =
                found.paving.outer_volume().upper() - found.paving.inner_volume().lower();
            if (!contracting) {
                CHECK(gap < last);
                last = gap;
            }
        }
    }
    CHECK(last < 0.3 * ring_share);
}

TEST_CASE("a disc in three dimensions with a side of zero width") {
    struct disc {
        assessment<> operator()(box const& b) const { return ring{-1, 1}(box{b[0], b[2]}); }
    };
    // The assessment's box must have the test's size: wrap it.
    struct test {
        assessment<> operator()(box const& b) const {
            auto a = disc{}(b);
            a.rest = b;
            return a;
        }
    } set;
    auto const found =
        invert(set, box{between(-1, 1), interval(3.0), between(-1, 1)}, accuracy(1.0 / 64));
    CHECK(found.paving.inner_volume().lower() <= std::numbers::pi / 4);
    CHECK(found.paving.outer_volume().upper() >= std::numbers::pi / 4);
    CHECK(found.paving.inner_volume().lower() > 0.7);
}

TEST_CASE("a budget or a cancellation leaves pending boxes and still a cover") {
    draws d(322);
    ring set{1, 2};
    auto few = accuracy(1.0 / 256);
    few.boxes = 100;
    auto const stopped = invert(set, square, few);
    CHECK(stopped.reason == stop_reason::box_budget);
    CHECK(stopped.tested == 100);
    CHECK(stopped.paving.count(box_verdict::pending) > 0);
    CHECK(stopped.paving.outer_volume().upper() >= ring_share);
    check_paving(stopped.paving, set, d, true);

    auto cancel = accuracy(1.0 / 256);
    std::size_t calls = 0;
    double last_outer = 1;
    cancel.progress = [&](paving_progress const& p) {
        CHECK(p.outer <= last_outer + 1e-12);
        last_outer = p.outer;
        CHECK(p.inner <= ring_share + 1e-12);
        CHECK(p.tested == calls);
        return ++calls <= 50;
    };
    auto const cancelled = invert(set, square, cancel);
    CHECK(cancelled.reason == stop_reason::cancelled);
    CHECK(calls == 51);
    check_paving(cancelled.paving, set, d, true);

    auto late = accuracy(1.0 / 256);
    late.seconds = 0;
    auto const none = invert(set, square, late);
    CHECK(none.reason == stop_reason::time_budget);
    CHECK(none.paving.count(box_verdict::pending) + none.tested >= 1);
    check_paving(none.paving, set, d, true);

    auto never = accuracy(1.0 / 256);
    never.progress = [](paving_progress const&) { return false; };
    auto const untouched = invert(set, square, never);
    REQUIRE(untouched.paving.boxes().size() == 1);
    CHECK(untouched.paving.boxes()[0].verdict == box_verdict::pending);
    CHECK(untouched.paving.outer_volume().upper() >= 1);
}

TEST_CASE("the search stops when enough is proved inside") {
    ring set{0, 20};
    auto options = accuracy(1e-6);
    options.sufficient_ratio = 0.9;
    auto const found = invert(set, square, options);
    CHECK(found.reason == stop_reason::inside_share);
    CHECK(found.paving.inner_volume().upper() >= 0.89 * found.paving.outer_volume().lower());
    CHECK(found.paving.outer_volume().upper() >= 20 * std::numbers::pi / 100);
}

TEST_CASE("both orders of search and dropped outside boxes give sound results") {
    draws d(323);
    ring set{1, 2};
    auto options = accuracy(1.0 / 64);
    options.order = search_order::first_in;
    auto const queue = invert(set, square, options);
    check_paving(queue.paving, set, d, true);
    options.keep_outside = false;
    auto const slim = invert(set, square, options);
    CHECK(slim.paving.count(box_verdict::outside) == 0);
    CHECK(slim.paving.boxes().size() + queue.paving.count(box_verdict::outside) ==
          queue.paving.boxes().size());
    CHECK(slim.paving.outer_volume().upper() == queue.paving.outer_volume().upper());
    // A whole box decided at once.
    ring all{0, 100};
    auto const full = invert(all, square, options);
    CHECK(full.reason == stop_reason::decided);
    CHECK(full.tested == 1);
    CHECK(full.paving.count(box_verdict::inside) == 1);
    ring nothing{300, 400};
    CHECK_FALSE(invert(nothing, square, options).paving.has_outer());
}

TEST_CASE("a smear that says nothing does not stop the splitting") {
    for (double const useless : {0.0, HUGE_VAL, std::numeric_limits<double>::quiet_NaN()}) {
        ring set{1, 2, false, {useless, useless}};
        auto const found = invert(set, square, accuracy(1.0 / 32));
        CAPTURE(useless);
        for (auto const& b : found.paving.boxes()) {
            if (b.verdict == box_verdict::undecided) CHECK(width(b.set) <= 10.0 / 32);
        }
        CHECK(found.tested > 10);
    }
}

TEST_CASE("a thin set is not halved along sides that say nothing of it") {
    // What the prior leaves for the first of four unknowns is narrower than the accuracy at once.
    auto const thin = [](box const& b) {
        assessment<> a{box_verdict::undecided, b};
        auto const set = between(0.50001, 0.50002);
        a.rest[0] = traits::intersect(b[0], set);
        if (is_empty(a.rest)) a.verdict = box_verdict::outside;
        // Nothing is seen to be inside of what is wider than a part of it.
        else if (width(b[0]) < 0.1 * width(set))
            a.verdict = box_verdict::inside;
        a.smear = {1, 0, 0, 0};
        return a;
    };
    inversion_options options;
    options.accuracy = 0.003;
    options.accuracy_of_hull = true;
    options.boxes = 100000;
    options.sufficient_ratio = 1;
    auto const found = invert(thin, box(std::vector(4, between(0, 1))), options);
    CHECK(found.tested < 200);
    CHECK(found.reason == stop_reason::decided);
}

TEST_CASE("knowledge is handed to parts of its box only") {
    struct remembering {
        struct knowledge {
            box of;
        };
        bool good = true;
        std::size_t used = 0;
        assessment<knowledge> operator()(box const& x,
                                         std::shared_ptr<knowledge const> const& known) {
            if (known) {
                ++used;
                good = good && subset(x, known->of);
            }
            auto const a = ring{1, 2}(x);
            return {a.verdict, a.rest, {}, std::make_shared<knowledge const>(knowledge{x})};
        }
    } test;
    auto const found = invert(test, square, accuracy(1.0 / 32));
    CHECK(test.good);
    CHECK(test.used > 10);
    CHECK(found.paving.outer_volume().upper() >= ring_share);
}

/// Learns about boxes, and sees a ring in those only that are narrow enough.
struct blurred_ring {
    struct knowledge {};
    double sharp; ///< widest side of boxes that are seen sharply
    std::size_t learnt = 0;

    assessment<knowledge> judge(box const& x, std::shared_ptr<knowledge const> const&) const {
        return {.rest = x, .blind = true};
    }
    std::vector<assessment<knowledge>> learn(std::vector<box> const& boxes) {
        std::vector<assessment<knowledge>> says;
        for (auto const& x : boxes) {
            says.push_back({.rest = x});
            if (width(x) <= sharp) says.back().verdict = ring{1, 20}(x).verdict;
            ++learnt;
        }
        return says;
    }
    [[nodiscard]] static std::size_t at_once() { return 8; }
};

TEST_CASE("a search ends where the smallest boxes decide as little as large ones") {
    auto options = accuracy(1.0 / 256); // of sides of 10: 0.039
    options.sufficient_ratio = 1;
    options.boxes = 300'000;
    blurred_ring never{0};
    auto const blind = invert(never, square, options);
    CHECK(blind.reason == stop_reason::too_blurred);
    CHECK(blind.tested < 2000);
    CHECK(never.learnt < blind.tested + 32);
    CHECK(blind.paving.outer_volume().lower() == 1); // nothing is lost
    CHECK(blind.paving.count(box_verdict::pending) == blind.paving.boxes().size());
    // The last halving but one shows the set: the search goes on through all that is blurred.
    blurred_ring late{0.04};
    auto const sharp = invert(late, square, options);
    CHECK(sharp.reason == stop_reason::accuracy_reached);
    CHECK(sharp.tested > 50'000);
    CHECK(sharp.paving.inner_volume().lower() > 0.9 * 19 * std::numbers::pi / 100);
    // From any state on the search ends as one that was never interrupted, to the last box.
    for (std::size_t boxes = 1; boxes < blind.tested; boxes *= 3) {
        std::shared_ptr<search_state const> state;
        auto cut = options;
        cut.boxes = boxes;
        cut.checkpoint = [&](search_state const& s) { state = std::make_shared<search_state>(s); };
        CHECK(invert(never, square, cut).reason == stop_reason::box_budget);
        auto rest = options;
        rest.resume = state;
        auto const resumed = invert(never, square, rest);
        CHECK(resumed.reason == stop_reason::too_blurred);
        CHECK(resumed.tested == blind.tested);
        CHECK(resumed.paving.boxes().size() == blind.paving.boxes().size());
    }
}

TEST_CASE("invert refuses priors it cannot pave") {
    ring set{1, 2};
    CHECK_THROWS_AS(invert(set, box{}), std::invalid_argument);
    CHECK_THROWS_AS(invert(set, box{between(0, 1), traits::empty()}), std::invalid_argument);
    CHECK_THROWS_AS(invert(set, box{between(0, 1), between(0, HUGE_VAL)}), std::invalid_argument);
}
