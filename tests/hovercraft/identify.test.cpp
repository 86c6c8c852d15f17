// SPDX-License-Identifier: MIT
// Round trips: generated data are identified, the planted truth is never excluded.
#include "generate.hpp"
#include "model.hpp"

#include "support/catch.hpp"

#include <sivid/io/dataset.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/paving/identify.hpp>

#include <filesystem>

using namespace hovercraft_example;
using sivid::algorithm;
using sivid::exact_decimal;
using sivid::verdict;

namespace {

exact_decimal dec(char const* text) { return exact_decimal::parse(text).value(); }

struct campaign {
    sivid::recorded_model model = sivid::record_model(hovercraft{});
    sivid::model_names names = sivid::names_of(model.about);
    generate_options options;

    campaign() {
        options.unknown = {{"Sv", dec("0.20"), dec("0.25")},
                           {"Sg", dec("0.0042"), dec("0.0754")},
                           {"L", dec("0.25"), dec("0.35")}};
        for (auto const* e : {"0.02", "0.02", "0.05", "0.02", "0.02", "0.03"})
            options.absolute.push_back(dec(e));
    }
    /// Priors around the truth, and wide bounds, so that plain bisection gets there.
    void narrow() {
        options.unknown = {{"Sv", dec("0.21"), dec("0.23")},
                           {"Sg", dec("0.038"), dec("0.042")},
                           {"L", dec("0.29"), dec("0.31")}};
        for (auto& e : options.absolute) e = e.times(4);
        options.outlier_size = 15;
    }
    [[nodiscard]] generated make(std::string const& scenario) const {
        return generate(model, find_scenarios(scenario, names), options);
    }
    [[nodiscard]] sivid::identification run(generated const& g, sivid::algorithm how,
                                            double seconds, std::size_t q,
                                            std::size_t boxes = 100000) const {
        sivid::identify_options o;
        o.algorithm = how;
        o.search.seconds = seconds;
        o.search.boxes = boxes;
        return sivid::identify(sivid::problem_from_dataset(g.data, model, q), o);
    }
};

/// Whether no outside box holds the truth and the hull does.
bool keeps_truth(sivid::identification const& found, generated const& g) {
    std::size_t j = 0;
    sivid::box truth(g.data.parameters.size());
    for (auto const& p : g.data.parameters) truth[j++] = *sivid::enclose(g.truth.at(p.name));
    bool somewhere = false;
    for (auto const& b : found.paving.boxes()) {
        auto const part = intersect(b.set, truth);
        somewhere = somewhere || (b.verdict != sivid::box_verdict::outside && !is_empty(part));
    }
    return somewhere && subset(truth, found.hull);
}

} // namespace

TEST_CASE("generated data are consistent, and the truth is never excluded") {
    campaign c;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        INFO(seed);
        c.options.seed = seed;
        c.options.noise = 0.9;
        auto const made = c.make("S3");
        auto const found = c.run(made, algorithm::contracting, 8, 0, 150);
        CHECK(found.verdict == verdict::consistent);
        CHECK(keeps_truth(found, made));
    }
    c.options.relative = dec("0.05");
    c.options.set = {{"Sg", dec("0.06")}, {"L", dec("0.27")}, {"Ff", dec("0.45")}};
    auto const made = c.make("S3");
    auto const found = c.run(made, algorithm::contracting, 8, 0, 150);
    CHECK(found.verdict == verdict::consistent);
    CHECK(keeps_truth(found, made));
}

TEST_CASE("L and S_g are known only through their product") {
    campaign c;
    auto const found = c.run(c.make("S3"), algorithm::contracting, 8, 0, 100);
    CHECK(found.entangled == std::vector<std::size_t>{1, 2});
    REQUIRE(found.combinations.size() == 1);
    CHECK(contains(found.combinations[0].hull, 0.012));
    CHECK(found.combinations[0].what.unit == "m^3");
}

TEST_CASE("two gross outliers: Algorithm 1 says inconsistent, Algorithm 2 with q = 3 consistent") {
    for (std::string const scenario : {"S1", "S2"}) {
        INFO(scenario);
        campaign c; // the whole prior: these scenarios know nothing of the parameters
        c.options.outliers = 2;
        auto const made = c.make(scenario);
        auto const first = c.run(made, algorithm::report_1, 20, 0);
        CHECK(first.verdict == verdict::inconsistent);
        auto const second = c.run(made, algorithm::report_2, 20, 3);
        CHECK(second.verdict == verdict::consistent);
        CHECK(second.paving.inner_volume().lower() > 0.999999); // volumes stay at the whole prior
        CHECK(keeps_truth(second, made));
        CHECK(second.forced.size() == 2);
        auto const default_one = c.run(made, algorithm::contracting, 20, 3, 100);
        CHECK(default_one.verdict == verdict::consistent);
    }
    campaign c;
    c.narrow();
    c.options.outliers = 2;
    auto const made = c.make("S3");
    auto const first = c.run(made, algorithm::report_1, 30, 0);
    CHECK(first.verdict == verdict::inconsistent);
    auto const second = c.run(made, algorithm::report_2, 30, 3, 600);
    CHECK(second.verdict == verdict::consistent);
    CHECK(keeps_truth(second, made));
}

TEST_CASE("outliers in scenario 3 over the whole prior: Algorithm 1 fails, the default succeeds") {
    campaign c;
    c.options.outliers = 2;
    c.options.outlier_size = 60;
    auto const made = c.make("S3");
    auto const first = c.run(made, algorithm::report_1, 120, 0);
    CHECK(first.verdict == verdict::inconsistent);
    auto const second = c.run(made, algorithm::contracting, 60, 3, 1000);
    CHECK(second.verdict == verdict::consistent);
    CHECK(keeps_truth(second, made));
}

TEST_CASE("the development campaigns are read, and become valid problems") {
#ifndef SIVID_SHARED_DIR
    WARN("the shared data are not beside the checkout: skipped");
#else
    namespace fs = std::filesystem;
    campaign const c;
    std::size_t count = 0;
    for (auto const& entry : fs::directory_iterator{fs::path{SIVID_SHARED_DIR} / "data/dev"}) {
        if (!entry.is_directory()) continue;
        INFO(entry.path().filename().string());
        auto const data = sivid::read_dataset(entry.path(), c.names);
        auto const problem = sivid::problem_from_dataset(data, c.model);
        CHECK_NOTHROW(problem.require_valid());
        std::size_t fit = 0, rows = 0;
        for (auto const& s : data.scenarios) {
            fit += s.role == sivid::scenario_role::fit ? 1 : 0;
            rows += s.measurements.size();
        }
        CHECK(problem.experiments.size() == fit);
        CHECK(fit < data.scenarios.size()); // hold-out scenarios stay out
        CHECK(rows > 100);
        ++count;
    }
    CHECK(count == 15);
#endif
}
