// SPDX-License-Identifier: MIT
// A search that is interrupted anywhere, or works in parallel, finds what it finds undisturbed.
#include <sivid/paving/search/detail/paving_search.hpp>

#include <sivid/paving/invert.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>

#include "support/catch.hpp"
#include "support/problems.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

namespace {

using traits = interval_traits<interval>;

/// low <= x^2 + y^2 <= high
struct ring {
    double low, high;
    bool contracting = false;

    assessment<> operator()(box const& b) const {
        assessment<> a{box_verdict::undecided, b};
        auto const r = traits::add(traits::sqr(b[0]), traits::sqr(b[1]));
        auto const set = between(low, high);
        if (disjoint(r, set)) a.verdict = box_verdict::outside;
        if (subset(r, set)) a.verdict = box_verdict::inside;
        for (std::size_t i = 0; contracting && i < 2; ++i) {
            if (a.verdict != box_verdict::undecided) break;
            bool cut = false;
            auto const square = traits::sub(set, traits::sqr(b[1 - i]));
            auto const size = traits::sqrt(square, cut); // of what is not negative
            a.rest[i] = traits::intersect(a.rest[i], traits::hull(traits::neg(size), size));
        }
        return a;
    }
};

box const square{between(-5, 5), between(-5, 5)};

bool same(interval const& a, interval const& b) {
    return a.lower() == b.lower() && a.upper() == b.upper();
}
bool same(box const& a, box const& b) {
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(),
                      [](interval const& s, interval const& t) { return same(s, t); });
}
void check_same(inversion const& a, inversion const& b) {
    CHECK(a.reason == b.reason);
    CHECK(a.tested == b.tested);
    CHECK(a.cost == b.cost);
    REQUIRE(a.paving.boxes().size() == b.paving.boxes().size());
    std::size_t differing = 0;
    for (std::size_t k = 0; k < a.paving.boxes().size(); ++k) {
        auto const &x = a.paving.boxes()[k], &y = b.paving.boxes()[k];
        differing += x.verdict != y.verdict || !same(x.set, y.set);
    }
    CHECK(differing == 0);
    CHECK(same(a.paving.inner_volume(), b.paving.inner_volume()));
    CHECK(same(a.paving.outer_volume(), b.paving.outer_volume()));
}

template <class Test>
inversion finished(paving_search<Test>& search) {
    while (!search.done() && !search.must_stop()) search.step();
    return std::move(search).finish();
}

/// Interrupts after so many steps each, goes on with a fresh test each time, and ends.
template <class MakeTest>
inversion in_pieces(MakeTest const& make, box const& prior, inversion_options options,
                    std::vector<std::size_t> const& steps) {
    for (auto const count : steps) {
        auto test = make();
        paving_search search(test, prior, options);
        for (std::size_t k = 0; k < count && !search.done() && !search.must_stop(); ++k) {
            search.step();
        }
        options.resume = std::make_shared<search_state const>(search.state());
    }
    auto test = make();
    paving_search search(test, prior, options);
    return finished(search);
}

/// Runs the tasks in the wrong order.
executor backwards(std::size_t threads) {
    return {threads, [](std::size_t count, executor::task const& work) {
                for (std::size_t k = count; k-- > 0;) work(k);
            }};
}

struct posed {
    support::planted_problem planted;
    inversion_options search;
    feasibility_test_options test;
};
posed random_posed(draws& d) {
    support::planting how;
    how.experiments = 1 + d.below(2);
    how.samples = 5 + d.below(6);
    how.outliers = d.below(3);
    how.spread = d.below(3) == 0 ? 0.01 : 0;
    how.noise = d.uniform(0.005, 0.05);
    posed p{support::plant(d, d.below(support::planted_models), how), {}, {}};
    p.search.accuracy = d.coin() ? 1.0 / 32 : 1.0 / 200;
    p.search.boxes = 100 + d.below(200);
    p.search.seconds = 1e9;
    p.search.keep_outside = d.coin();
    p.search.sufficient_ratio = d.coin() ? 0.5 : 0.95;
    p.search.hull_gain = d.below(3) == 0 ? 0.02 : 0;
    p.search.small_hull = d.below(4) == 0 ? 0.1 : 0;
    p.search.accuracy_of_hull = d.coin();
    p.search.order = d.below(4) == 0 ? search_order::first_in : search_order::largest_first;
    p.search.batches = 1 + d.below(3);
    p.test.contract = d.below(4) != 0;
    if (d.below(4) == 0) p.test.set = carried_set::doubleton;
    return p;
}

} // namespace

TEST_CASE("a plain test may be interrupted before every single step") {
    inversion_options o;
    o.accuracy = 1.0 / 32;
    o.sufficient_ratio = 1;
    for (auto const order : {search_order::largest_first, search_order::first_in}) {
        o.order = order;
        auto const make = [] { return ring{1, 2, true}; };
        auto test = make();
        auto const whole = invert(test, square, o);
        for (std::size_t k = 0; k <= whole.tested + 1; k += 7) {
            check_same(in_pieces(make, square, o, {k}), whole);
        }
        check_same(in_pieces(make, square, o, std::vector<std::size_t>(whole.tested, 1)), whole);
    }
}

TEST_CASE("what was small against an old hull is looked at again, after any interruptions") {
    // Of boxes wider than 64 nothing is seen, so some are narrow enough before the hull is known.
    auto const make = [] {
        return [](box const& x) {
            assessment<> a{box_verdict::undecided, x};
            if (width(x[0]) > 64) return a;
            if (disjoint(x[0], between(0.3, 1))) a.verdict = box_verdict::outside;
            if (subset(x[0], between(0.3, 1))) a.verdict = box_verdict::inside;
            return a;
        };
    };
    box const prior{between(0, 1024)};
    inversion_options o;
    o.accuracy = 0.1;
    o.accuracy_of_hull = true;
    o.sufficient_ratio = 1;
    o.proof_bytes = 1 << 20;
    for (auto const order : {search_order::largest_first, search_order::first_in}) {
        o.order = order;
        auto test = make();
        auto const whole = invert(test, prior, o);
        auto const left = whole.paving.outer_hull();
        CHECK(whole.reason == stop_reason::accuracy_reached);
        CHECK(width(left[0]) < 1.2 * 0.7);
        CHECK(whole.paving.count(box_verdict::undecided) == 2);
        for (auto const& b : whole.paving.boxes()) {
            if (b.verdict == box_verdict::undecided) CHECK(width(b.set[0]) <= 0.1 * width(left[0]));
        }
        CHECK(
            std::count_if(whole.proof.begin(), whole.proof.end(),
                          [](proof_step const& s) { return s.what == proof_step::kind::leaf; }) ==
            std::ptrdiff_t(whole.paving.boxes().size() - whole.paving.count(box_verdict::outside)));
        for (std::size_t k = 0; k <= whole.tested + 1; ++k) {
            check_same(in_pieces(make, prior, o, {k}), whole);
        }
        check_same(in_pieces(make, prior, o, std::vector<std::size_t>(whole.tested, 1)), whole);
    }
}

TEST_CASE("a search that looks again at what it left may decide all of it") {
    std::size_t tested = 0;
    auto const test = [&](box const& x) {
        assessment<> a{box_verdict::undecided, x};
        if (++tested > 5) a.verdict = box_verdict::outside;
        return a;
    };
    inversion_options o{.accuracy = 0.4, .accuracy_of_hull = true};
    // [0, 1/4] is left, then the rest is proved outside; what was left is wide against itself.
    CHECK(invert(test, box{between(0, 1)}, o).reason == stop_reason::decided);
}

TEST_CASE("a search that learns finds the same box for box after any interruptions") {
    draws d(5001);
    std::size_t remembered = 0;
    for (int round = 0; round < 16; ++round) {
        auto const p = random_posed(d);
        auto const& problem = p.planted.problem;
        CAPTURE(round, p.search.batches, p.test.contract);
        auto const make = [&] { return feasibility_test(problem, p.test); };
        auto test = make();
        auto const whole = invert(test, problem.prior, p.search);
        CHECK(test.integrations() == whole.cost);
        bool covered = false;
        for (auto const& b : whole.paving.boxes()) {
            covered =
                covered || (b.verdict != box_verdict::outside && contains(b.set, p.planted.truth));
        }
        CHECK(covered);
        for (int k = 0; k < 3; ++k) {
            std::vector<std::size_t> steps;
            for (std::size_t n = 1 + d.below(4); n > 0; --n) steps.push_back(d.below(60));
            check_same(in_pieces(make, problem.prior, p.search, steps), whole);
        }
        // What was known is learnt again when it is needed, and not counted twice.
        auto interrupted = make();
        paving_search search(interrupted, problem.prior, p.search);
        for (int k = 0; k < 20 && !search.done() && !search.must_stop(); ++k) search.step();
        auto options = p.search;
        options.resume = std::make_shared<search_state const>(search.state());
        auto resumed = make();
        check_same(invert(resumed, problem.prior, options), whole);
        CHECK(resumed.integrations() + interrupted.integrations() >= whole.cost);
        remembered += resumed.integrations() + interrupted.integrations() > whole.cost ? 1 : 0;
    }
    CHECK(remembered > 3); // else nothing was tested
}

TEST_CASE("the executor changes nothing") {
    draws d(5002);
    for (int round = 0; round < 12; ++round) {
        auto const p = random_posed(d);
        auto const& problem = p.planted.problem;
        CAPTURE(round, p.search.batches);
        feasibility_test alone(problem, p.test);
        auto const whole = invert(alone, problem.prior, p.search);
        for (std::size_t const threads : {2u, 5u}) {
            auto options = p.search;
            options.workers = backwards(threads);
            feasibility_test test(problem, p.test);
            check_same(invert(test, problem.prior, options), whole);
            options.resume = [&] {
                feasibility_test first(problem, p.test);
                paving_search search(first, problem.prior, options);
                for (int k = 0; k < 15 && !search.done() && !search.must_stop(); ++k) search.step();
                return std::make_shared<search_state const>(search.state());
            }();
            feasibility_test second(problem, p.test);
            check_same(invert(second, problem.prior, options), whole);
        }
    }
}

TEST_CASE("learning depends on its boxes alone, not on what was learnt before") {
    draws d(5003);
    for (int round = 0; round < 10; ++round) {
        auto const p = random_posed(d);
        auto const& prior = p.planted.problem.prior;
        auto const some = [&] {
            std::vector<box> boxes;
            for (std::size_t k = 1 + d.below(9); k > 0; --k) {
                box part = prior;
                for (std::size_t j = 0; j < part.size(); ++j) {
                    double const a = d.uniform(part[j].lower(), part[j].upper());
                    double const b = d.uniform(part[j].lower(), part[j].upper());
                    part[j] = between(std::min(a, b), std::max(a, b));
                }
                boxes.push_back(part);
            }
            return boxes;
        };
        auto const boxes = some();
        feasibility_test fresh(p.planted.problem, p.test), used(p.planted.problem, p.test);
        for (int k = 0; k < 4; ++k) (void)used.learn(some());
        auto const a = fresh.learn(boxes), b = used.learn(boxes);
        REQUIRE(a.size() == b.size());
        for (std::size_t k = 0; k < a.size(); ++k) {
            CHECK(a[k].verdict == b[k].verdict);
            CHECK(same(a[k].rest, b[k].rest));
            CHECK(a[k].smear == b[k].smear);
            CHECK(a[k].cost == b[k].cost);
            REQUIRE((a[k].knowledge == nullptr) == (b[k].knowledge == nullptr));
            if (!a[k].knowledge) continue;
            CHECK(feasibility_test::bytes(*a[k].knowledge) ==
                  feasibility_test::bytes(*b[k].knowledge));
            for (std::size_t e = 0; e < a[k].knowledge->all_starts.size(); ++e) {
                auto const &x = *a[k].knowledge->all_starts[e], &y = *b[k].knowledge->all_starts[e];
                CHECK(x.coefficients == y.coefficients);
                CHECK(x.radius == y.radius);
                CHECK(x.outputs() == y.outputs());
                CHECK(x.bytes() > sizeof(double) * x.coefficients.size());
            }
        }
    }
}

TEST_CASE("the memory budget ends a search, which goes on with a larger one") {
    draws d(5004);
    support::planting how;
    how.experiments = 2;
    how.noise = 0.02;
    auto const planted = support::plant(d, 1, how);
    auto const make = [&] { return feasibility_test(planted.problem, {}); };
    inversion_options o;
    o.accuracy = 1.0 / 500;
    o.sufficient_ratio = 1;
    o.boxes = 300;
    auto test = make();
    auto const whole = invert(test, planted.problem.prior, o);
    auto less = o;
    less.memory = 20'000;
    std::size_t saved = 0;
    less.checkpoint_seconds = 1e9; // but when the budget ends it
    less.checkpoint = [&](search_state const& s) {
        ++saved;
        o.resume = std::make_shared<search_state const>(s);
    };
    auto short_of = make();
    auto const stopped = invert(short_of, planted.problem.prior, less);
    CHECK(stopped.reason == stop_reason::memory_budget);
    CHECK(stopped.tested < whole.tested);
    CHECK(stopped.paving.count(box_verdict::pending) > 0);
    REQUIRE(saved == 1);
    auto again = make();
    check_same(invert(again, planted.problem.prior, o), whole);

    // What is counted is what is held: all waiting knowledge, and no other.
    auto counted = make();
    o.resume = nullptr;
    paving_search search(counted, planted.problem.prior, o);
    std::size_t most = 0;
    while (!search.done() && !search.must_stop()) {
        search.step();
        most = std::max(most, search.bytes());
    }
    CHECK(most > 20'000);
    CHECK(most < 100'000'000);
    o.boxes = 1'000'000;
    o.accuracy = 1.0 / 16;
    auto to_end = make();
    paving_search complete(to_end, planted.problem.prior, o);
    while (!complete.done() && !complete.must_stop()) complete.step();
    REQUIRE(complete.done());
    auto const paved = complete.state().paved.size();
    CHECK(complete.bytes() == paved * (sizeof(paved_box) + 2 * sizeof(interval)));
}

namespace {

/// A ring whose test takes its time, so that checkpoints fall between.
struct slow_ring {
    ring set;

    assessment<> operator()(box const& b) {
        std::this_thread::sleep_for(std::chrono::microseconds{100});
        return set(b);
    }
};

} // namespace

TEST_CASE("checkpoints come at the interval and hold a search that can go on") {
    ring test{1, 2};
    inversion_options o;
    o.accuracy = 1.0 / 64;
    o.sufficient_ratio = 1;
    auto const whole = invert(test, square, o);
    std::vector<std::shared_ptr<search_state const>> saved;
    auto saving = o;
    saving.checkpoint_seconds = 0;
    saving.checkpoint = [&](search_state const& s) {
        saved.push_back(std::make_shared<search_state const>(s));
    };
    slow_ring slow{test};
    check_same(invert(slow, square, saving), whole);
    REQUIRE(saved.size() > 2);
    for (auto const& s : saved) {
        CHECK_NOTHROW(s->require_valid());
        auto again = o;
        again.resume = s;
        auto const found = invert(test, square, again);
        check_same(found, whole);
        CHECK(found.seconds >= s->seconds);
    }
    saved.clear();
    saving.checkpoint_seconds = 1e6;
    check_same(invert(test, square, saving), whole);
    CHECK(saved.empty());
    // What earlier runs spent counts.
    search_state late = paving_search(test, square, o).state();
    late.work = 100;
    o.resume = std::make_shared<search_state const>(late);
    CHECK(invert(test, square, o).reason == stop_reason::time_budget);
}

namespace {

/// A ring that is told to stop at some call; what it says from then on is nothing.
struct interrupted_ring {
    ring set;
    std::size_t last;
    std::size_t calls = 0;

    assessment<> operator()(box const& b) {
        if (++calls > last) return {box_verdict::undecided, b};
        return set(b);
    }
    [[nodiscard]] bool cancelled() const { return calls > last; }
};

} // namespace

TEST_CASE("a step during which the test is told to stop is undone, and can be made later") {
    inversion_options o;
    o.accuracy = 1.0 / 32;
    o.sufficient_ratio = 1;
    o.accuracy_of_hull = true;
    ring complete{1, 2, true};
    auto const whole = invert(complete, square, o);
    for (std::size_t last = 0; last < whole.tested; last += 7) {
        interrupted_ring test{complete, last};
        std::shared_ptr<search_state const> saved;
        auto first = o;
        first.checkpoint_seconds = 1e9;
        first.checkpoint = [&](search_state const& s) {
            saved = std::make_shared<search_state const>(s);
        };
        auto const part = invert(test, square, first);
        CHECK(part.reason == stop_reason::time_budget);
        CHECK(part.tested == last);
        REQUIRE(saved);
        CHECK_NOTHROW(saved->require_valid());
        auto again = o;
        again.resume = saved;
        check_same(invert(complete, square, again), whole);
    }
    // Who says stop to the search itself is told that it was.
    std::size_t asked = 0;
    o.keep_going = [&asked] { return ++asked < 20; };
    CHECK(invert(complete, square, o).reason == stop_reason::cancelled);
    // Who says stop to both, too, at whatever moment: here just after the search has asked.
    for (std::size_t const when : {1u, 5u, 20u}) {
        interrupted_ring test{complete, whole.tested};
        asked = 0;
        o.keep_going = [&] {
            bool const goes_on = test.calls <= test.last;
            if (++asked == when) test.last = 0, test.calls = 1;
            return goes_on;
        };
        CHECK(invert(test, square, o).reason == stop_reason::cancelled);
    }
}

TEST_CASE("integrations that are told to stop leave a search that goes on as if nothing had been") {
    draws d(4711);
    int stopped = 0;
    for (int k = 0; k < 12; ++k) {
        auto const p = random_posed(d);
        auto const& problem = p.planted.problem;
        feasibility_test complete(problem, p.test);
        auto const whole = invert(complete, problem.prior, p.search);
        for (std::size_t const most : {0u, 3u, 40u, 300u, 2000u}) {
            std::atomic<std::size_t> asked = 0;
            auto options = p.test;
            options.keep_going = [&] { return ++asked <= most; };
            feasibility_test test(problem, options);
            std::shared_ptr<search_state const> saved;
            auto first = p.search;
            first.checkpoint_seconds = 1e9;
            first.checkpoint = [&](search_state const& s) {
                saved = std::make_shared<search_state const>(s);
            };
            auto const part = invert(test, problem.prior, first);
            if (!saved) { // it was over before
                check_same(part, whole);
                continue;
            }
            ++stopped;
            auto again = p.search;
            again.resume = saved;
            feasibility_test fresh(problem, p.test);
            CAPTURE(k, most);
            check_same(invert(fresh, problem.prior, again), whole);
        }
    }
    CHECK(stopped > 20);
}

TEST_CASE("states of other searches, and what is no state, are refused") {
    ring test{1, 2};
    inversion_options o;
    paving_search search(test, square, o);
    for (int k = 0; k < 30; ++k) search.step();
    auto const good = search.state();
    auto const refused = [&](auto&& spoil, box const& prior = square) {
        auto bad = good;
        spoil(bad);
        auto options = o;
        options.resume = std::make_shared<search_state const>(bad);
        CHECK_THROWS_AS(invert(test, prior, options), std::invalid_argument);
    };
    refused([](search_state&) {}, box{between(-5, 5), between(-5, 4)});
    refused([](search_state&) {}, box{between(-5, 5)});
    refused([](search_state& s) { s.batches = 2; });
    refused([](search_state& s) { s.prior = box{}; });
    refused([](search_state& s) { s.waiting[0].set[0] = between(-6, 1); });
    refused([](search_state& s) { s.waiting[0].set = box{between(0, 1)}; });
    refused([](search_state& s) { s.waiting[0].number = s.pushed; });
    refused([](search_state& s) { s.waiting[0].known = search_state::origin{0, 0, 0}; });
    refused([](search_state& s) { s.paved[0].set = box{between(0, 9), between(0, 1)}; });
    refused([](search_state& s) { s.whole = box{between(0, 1)}; });
    refused([](search_state& s) { s.seconds = -1; });

    // A test that is neither plain nor learns in batches has knowledge of unknown origin.
    struct handing_on {
        struct knowledge {};
        assessment<knowledge> operator()(box const& x, std::shared_ptr<knowledge const> const&) {
            return {box_verdict::undecided, x, {}, std::make_shared<knowledge const>()};
        }
    } other;
    o.checkpoint = [](search_state const&) {};
    o.checkpoint_seconds = 0;
    CHECK_THROWS_AS(invert(other, square, o), std::invalid_argument);
}
