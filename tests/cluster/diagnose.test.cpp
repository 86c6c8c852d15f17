// SPDX-License-Identifier: MIT
// Candidates fitted by helpers: the diagnosis of one machine, word for word; requests that nobody
// writes are refused.
#include <sivid/cluster/diagnose.hpp>

#include <sivid/io/diagnosis_json.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

#include <memory>
#include <thread>
#include <vector>

using namespace sivid;

namespace {

std::string text_of(diagnosis_run run) {
    run.result.seconds = 0;
    for (auto& tried : run.result.journal) tried.seconds = 0;
    return diagnosis_json(run.result, "small");
}

struct helpers {
    cluster::memory_transport office;
    std::vector<std::thread> threads;

    helpers(std::size_t count, identification_problem const& problem,
            std::vector<effect> const& catalogue, std::string const& also = {})
        : office(count) {
        for (std::size_t k = 0; k < count; ++k) {
            threads.emplace_back([this, k, problem, catalogue, also] {
                cluster::help_diagnose(*office.of_workers[k], problem, catalogue, also);
            });
        }
    }
    ~helpers() {
        for (auto& t : threads) t.join(); // released by the diagnosis
    }
};

} // namespace

TEST_CASE("with helpers a diagnosis says the same") {
    auto real = small_campaign::with_drag(0.3);
    real.seen_position = small_campaign::with_scale(0.15).seen_position;
    auto const problem = small_campaign::problem(real);
    auto const catalogue = small_campaign::catalogue();
    diagnosis_options options;
    options.seconds = 600;
    auto const alone = diagnose(problem, catalogue, options);
    REQUIRE(alone.result.effects.size() == 2);
    for (std::size_t const count : {2u}) {
        helpers others(count, problem, catalogue);
        cluster::traffic spent;
        auto const shared =
            cluster::diagnose(*others.office.of_first, problem, catalogue, options, {}, &spent);
        CHECK(text_of(shared) == text_of(alone));
        CHECK(spent.requests >= catalogue.size());
        REQUIRE(shared.candidates.size() == alone.candidates.size());
        for (std::size_t k = 0; k < alone.candidates.size(); ++k) {
            CHECK(shared.candidates[k].fit.parameters == alone.candidates[k].fit.parameters);
            CHECK(shared.candidates[k].silent == alone.candidates[k].silent);
        }
    }
}

TEST_CASE("a diagnosis refuses helpers with another catalogue, and keeps to its time") {
    auto const problem = small_campaign::problem(small_campaign::with_drag(0.3));
    auto const catalogue = small_campaign::catalogue();
    diagnosis_options options;
    options.seconds = 600;
    auto fewer = catalogue;
    fewer.pop_back();
    std::string refused; // a helper that comes to speak after the end was not needed
    for (int n = 0; refused.empty() && n < 50; ++n) {
        helpers others(1, problem, fewer);
        try {
            (void)cluster::diagnose(*others.office.of_first, problem, catalogue, options);
        } catch (cluster::worker_mismatch const& e) {
            refused = e.what();
        }
    }
    CHECK_THAT(refused, ContainsSubstring("thread 0 differs"));
    options.seconds = 0;
    helpers others(1, problem, catalogue);
    auto const none = cluster::diagnose(*others.office.of_first, problem, catalogue, options);
    CHECK(none.result.interrupted);
}

TEST_CASE("requests for fits that nobody writes are refused") {
    auto const problem = small_campaign::problem(small_campaign::with_drag(0.3));
    auto const catalogue = small_campaign::catalogue();
    cluster::diagnose_detail::candidate_server const server(problem, catalogue);
    auto const wanted = [] { return true; };
    auto const ask = [&](std::size_t effect, std::size_t parameters) {
        cluster::diagnose_detail::fit_request r{{effect}, true, {}, {}};
        r.fit.parameters.assign(parameters, 1.0);
        return server.answer(cluster::packed(r), wanted);
    };
    CHECK_THROWS_AS(ask(catalogue.size(), problem.prior.size()), std::invalid_argument);
    CHECK_THROWS_AS(ask(0, problem.prior.size()), std::invalid_argument); // without residuals
}
