// SPDX-License-Identifier: MIT
// A search whose boxes a pool of workers answers for: bit for bit the search of one, by any pool.
#include <sivid/cluster/detail/delegated_test.hpp>
#include <sivid/cluster/identify.hpp>

#include <sivid/io/checkpoint.hpp>

#include "cluster/rings.hpp"
#include "cluster/threads.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <memory>

using namespace sivid;
using namespace sivid::cluster;
using cluster_test::ring_prior;
using cluster_test::ring_test;
using cluster_test::workers_in_threads;

namespace {

/// Members with a test of their own each.
struct ring_workers {
    std::vector<std::unique_ptr<ring_test>> tests;
    std::unique_ptr<workers_in_threads> all;

    explicit ring_workers(std::size_t workers) {
        for (std::size_t k = 0; k < workers; ++k) tests.push_back(std::make_unique<ring_test>());
        all = std::make_unique<workers_in_threads>(workers, [this](std::size_t k, worker& m) {
            tests[k]->keep_going = [&m] { return m.wanted(); };
            box_server<ring_test> boxes(*tests[k], ring_prior());
            m.serve({[](std::string_view) { return identity{}; },
                     [&boxes](std::string_view text) { return boxes(text); }});
        });
        all->helpers.begin("", {});
    }
};

/// All that a search found, as text; what it took is left out.
std::string text_of(inversion const& found) {
    packer out;
    for (auto const& b : found.paving.boxes()) out.put(b.set).put(b.verdict);
    out.put(found.reason).put(found.tested).put(found.cost).put(found.proof);
    return out.take();
}
std::string text_of(search_state state) {
    state.seconds = 0;
    identification_state whole;
    whole.search = std::move(state);
    return checkpoint_text(whole, "rings");
}

inversion_options options_of(support::draws& d) {
    inversion_options o;
    o.accuracy = 0.01;
    o.sufficient_ratio = 0.97;
    o.batches = 1 + d.below(5);
    o.boxes = 200 + d.below(1500);
    o.seconds = 1e9;
    o.proof_bytes = 1U << 20;
    if (d.below(3) == 0) o.order = search_order::first_in;
    if (d.below(3) == 0) o.hull_gain = 0.02;
    return o;
}

} // namespace

TEST_CASE("a pool of 1 to 5 workers finds what one finds, box for box and step for step") {
    static_assert(delegating_set_test<delegated_test<ring_test>>);
    static_assert(interruptible_set_test<delegated_test<ring_test>>);
    support::draws d(7301);
    for (int round = 0; round < 6; ++round) {
        auto options = options_of(d);
        ring_test alone;
        auto const expected = text_of(sivid::invert(alone, ring_prior(), options));
        for (std::size_t const workers : {1u, 2u, 3u, 5u}) {
            CAPTURE(round, workers, options.batches);
            ring_workers ring(workers);
            ring_test own;
            auto const found = cluster::invert(ring.all->helpers, own, ring_prior(), options);
            CHECK(text_of(found) == expected);
            CHECK(own.learnt == 0);
        }
    }
}

TEST_CASE("stopped and resumed by other worker pools, the states and the end are those of one") {
    support::draws d(7302);
    for (int round = 0; round < 4; ++round) {
        auto options = options_of(d);
        ring_test alone;
        auto const expected = text_of(sivid::invert(alone, ring_prior(), options));
        std::shared_ptr<search_state const> state, state_of_one;
        auto const most = options.boxes;
        for (std::size_t part = 1; part <= 4; ++part) {
            auto now = options;
            now.boxes = part == 4 ? most : most * part / 4;
            now.checkpoint_seconds = 1e9; // at the end alone
            auto one = now;
            std::shared_ptr<search_state const> next, next_of_one;
            now.resume = state;
            now.checkpoint = [&](search_state const& s) {
                next = std::make_shared<search_state const>(s);
            };
            one.resume = state_of_one;
            one.checkpoint = [&](search_state const& s) {
                next_of_one = std::make_shared<search_state const>(s);
            };
            ring_workers ring(1 + d.below(4));
            ring_test own, of_one;
            auto const found = cluster::invert(ring.all->helpers, own, ring_prior(), now);
            auto const by_one = sivid::invert(of_one, ring_prior(), one);
            if (part == 4) CHECK(text_of(found) == expected);
            REQUIRE((next != nullptr) == (next_of_one != nullptr));
            if (!next) break;
            CHECK(text_of(*next) == text_of(*next_of_one));
            state = next;
            state_of_one = next_of_one;
        }
    }
}

TEST_CASE("a memory budget counts what one machine would hold") {
    inversion_options options;
    options.accuracy = 1e-3;
    options.sufficient_ratio = 1;
    options.seconds = 1e9;
    options.memory = 60'000;
    ring_test alone;
    auto const by_one = sivid::invert(alone, ring_prior(), options);
    CHECK(by_one.reason == stop_reason::memory_budget);
    ring_workers ring(3);
    ring_test own;
    CHECK(text_of(cluster::invert(ring.all->helpers, own, ring_prior(), options)) ==
          text_of(by_one));
}

TEST_CASE("interrupted at any moment, a search with workers loses nothing") {
    support::draws d(7303);
    auto options = options_of(d);
    options.boxes = 1200;
    options.accuracy = 1e-6;
    options.sufficient_ratio = 1;
    options.hull_gain = 0;
    ring_test alone;
    auto const expected = text_of(sivid::invert(alone, ring_prior(), options));
    std::shared_ptr<search_state const> state;
    options.checkpoint_seconds = 1e9;
    options.checkpoint = [&](search_state const& s) {
        state = std::make_shared<search_state const>(s);
    };
    int interruptions = 0;
    for (int run = 0; run < 500; ++run) {
        ring_workers ring(2);
        ring_test own;
        auto questions = d.below(200);
        own.keep_going = [&questions] { return questions == 0 ? false : --questions > 0; };
        auto now = options;
        now.resume = state;
        now.keep_going = own.keep_going;
        if (run == 499 || run % 10 == 9) own.keep_going = now.keep_going = nullptr;
        auto const found = cluster::invert(ring.all->helpers, own, ring_prior(), now);
        if (found.reason == stop_reason::box_budget) {
            CHECK(text_of(found) == expected);
            break;
        }
        ++interruptions;
        REQUIRE(state);
        state->require_valid();
    }
    CHECK(interruptions >= 3);
}
