// SPDX-License-Identifier: MIT
// Identification with helpers: the bits of one machine; helpers with another problem are refused.
#include <sivid/cluster/identify.hpp>

#include <sivid/io/identification_json.hpp>

#include "support/catch.hpp"
#include "support/problems.hpp"

#include <exception>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

struct helpers {
    std::unique_ptr<cluster::memory_transport> office;
    std::vector<std::thread> threads;

    helpers(std::size_t count, identification_problem const& problem,
            identify_options const& options, std::string const& also = {})
        : office(std::make_unique<cluster::memory_transport>(count)) {
        for (std::size_t k = 0; k < count; ++k) {
            threads.emplace_back([this, k, &problem, &options, also] {
                cluster::help_identify(*office->of_workers[k], problem, options, also);
            });
        }
    }
    ~helpers() {
        for (std::size_t k = 0; k < threads.size(); ++k)
            office->of_first->send(k, {cluster::message::kind::end});
        for (auto& t : threads) t.join();
    }
};

std::string text_of(identification_problem const& problem, identification found) {
    found.seconds = 0;
    if (found.effort) found.effort->seconds = found.effort->most_seconds = 0;
    for (auto& r : found.journal) r.seconds = 0;
    auto text = identification_json(problem, found, {});
    for (auto const& b : found.paving.boxes()) {
        for (auto const& side : b.set) text += to_hex(side.lower()) + " " + to_hex(side.upper());
        text += std::to_string(static_cast<int>(b.verdict));
    }
    return text + std::to_string(found.integrations) + " " + std::to_string(found.boxes);
}

} // namespace

TEST_CASE("identified with 0 to 3 helpers, planted problems are told the same, bit for bit") {
    draws d(7401);
    for (int round = 0; round < 8; ++round) {
        support::planting how;
        how.experiments = 1 + d.below(2);
        how.samples = 5 + d.below(6);
        how.outliers = d.below(3);
        how.spread = d.below(2) == 0 ? 0.01 : 0;
        how.noise = d.uniform(0.005, 0.04);
        auto const model = d.below(support::planted_models);
        auto const planted = support::plant(d, model, how);
        identify_options options;
        options.search.accuracy = 1.0 / 100;
        options.search.boxes = 100 + d.below(200);
        options.search.seconds = 1e9;
        options.search.sufficient_ratio = 0.95;
        options.search.batches = 1 + d.below(4);
        options.drawn_boxes = 100;
        if (d.below(4) == 0) options = by_bisection(options);
        if (d.below(4) == 0) options.test.set = carried_set::doubleton;
        CAPTURE(round, model, options.search.batches);
        auto const alone = text_of(planted.problem, sivid::identify(planted.problem, options));
        for (std::size_t const count : {0u, 1u, 3u}) {
            CAPTURE(count);
            helpers const others(count, planted.problem, options);
            cluster::traffic spent;
            auto const found =
                cluster::identify(*others.office->of_first, planted.problem, options, {}, &spent);
            CHECK(text_of(planted.problem, found) == alone);
            CHECK(spent.messages > 0);
        }
    }
}

TEST_CASE("a helper with another problem is refused by name, with a remedy") {
    draws d(7402);
    auto const planted = support::plant(d, 0, {.experiments = 1, .samples = 8});
    identify_options options;
    options.search.accuracy = 1e-6;
    options.search.sufficient_ratio = 1;
    options.search.seconds = 30;
    auto other = planted.problem;
    other.experiments[0].measurements[0].bound = hull(-1_dec, 1_dec);
    auto const expect_refusal = [&](identification_problem const& theirs,
                                    identify_options const& how, std::string const& also) {
        helpers const others(1, theirs, how, also);
        CHECK_THROWS_WITH(
            (void)cluster::identify(*others.office->of_first, planted.problem, options, "data"),
            ContainsSubstring("thread 0 differs") && ContainsSubstring("problem") &&
                ContainsSubstring("same data"));
    };
    expect_refusal(other, options, "data");
    expect_refusal(planted.problem, options, "other data");
    auto finer = options;
    finer.test.tolerance = 1e-9;
    expect_refusal(planted.problem, finer, "data");
}

TEST_CASE("budgets end the work of all") {
    draws d(7403);
    auto const planted =
        support::plant(d, 0, {.experiments = 2, .samples = 30, .noise = 0.01, .spread = 0.01});
    identify_options options;
    options.search.accuracy = 1e-12;
    options.search.sufficient_ratio = 1;
    options.search.seconds = 0.5;
    helpers const others(2, planted.problem, options);
    auto const found = cluster::identify(*others.office->of_first, planted.problem, options);
    CHECK(found.reason == stop_reason::time_budget);
    CHECK(contains(found.hull, planted.truth));
}

TEST_CASE("helpers are let go when the work ends before it was handed out") {
    draws d(7404);
    auto const planted = support::plant(d, 0, {.experiments = 1, .samples = 8});
    auto broken = planted.problem;
    broken.experiments[0].measurements[0].bound = interval_traits<interval>::empty();
    cluster::memory_transport office(2);
    std::vector<std::thread> threads; // who nobody else lets go
    for (auto& end : office.of_workers) {
        threads.emplace_back(
            [&planted, &end] { cluster::help_identify(*end, planted.problem, {}); });
    }
    CHECK_THROWS_AS(cluster::identify(*office.of_first, broken, {}), std::invalid_argument);
    for (auto& t : threads) t.join();
}
