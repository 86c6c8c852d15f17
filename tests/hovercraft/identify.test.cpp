// SPDX-License-Identifier: MIT
// Round trips: generated data are identified, the planted truth is never excluded.
#include "craft.hpp"
#include "model.hpp"

#include "support/catch.hpp"

#include <sivid/app/generate.hpp>
#include <sivid/io/dataset.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/paving/identify.hpp>

#include <filesystem>

using namespace sivid::app;
using sivid::exact_decimal;
using sivid::verdict;

namespace {

/// By contraction, or those of the report; the first allows no outlier.
enum class algorithm { contracting, report_1, report_2 };

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
    [[nodiscard]] generated make(std::string const& scenario) const {
        return generate(model, find_scenarios(hovercraft_example::craft(), scenario), options);
    }
    [[nodiscard]] sivid::identification run(generated const& g, algorithm how, double seconds,
                                            std::size_t q, std::size_t boxes = 100000) const {
        sivid::identify_options o;
        if (how != algorithm::contracting) o = by_bisection(o);
        o.search.seconds = seconds;
        o.search.boxes = boxes;
        return sivid::identify(sivid::problem_from_dataset(g.data, model, q), o);
    }
};

/// One scenario of sections 3.2 and 4.1, as bundled.
struct report_campaign {
    sivid::recorded_model model = sivid::record_model(hovercraft{});
    sivid::dataset data;

    explicit report_campaign(std::string const& scenario)
        : data(sivid::read_dataset(std::filesystem::path{SIVID_SOURCE_DIR} /
                                       "examples/hovercraft/data/section41" / scenario,
                                   sivid::names_of(model.about))) {}
    [[nodiscard]] sivid::identification
    run(algorithm how, double seconds, sivid::outlier_rule const& rule, std::size_t boxes) const {
        sivid::identify_options o;
        if (how != algorithm::contracting) o = by_bisection(o);
        o.search.seconds = seconds;
        o.search.boxes = boxes;
        return sivid::identify(sivid::problem_from_dataset(data, model, rule), o);
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

// Sections 3.2 and 4.1 of the report, on its own prior: bounds of 10 % of the value, two gross
// outliers in each scenario, a tolerance of three.
TEST_CASE("two gross outliers: Algorithm 1 says inconsistent, a tolerance of 3 consistent") {
    for (std::string const scenario : {"S1", "S2", "S3"}) {
        INFO(scenario);
        report_campaign const c(scenario);
        CHECK(c.run(algorithm::report_1, 20, 0, 1000).verdict == verdict::inconsistent);
        // Whatever the algorithm, the budget of 2 that the data set states is enough, 1 is not.
        CHECK(c.run(algorithm::contracting, 20, 1, 1000).verdict == verdict::inconsistent);
        CHECK(c.run(algorithm::contracting, 20, 2, 300).verdict == verdict::consistent);
        auto const found = c.run(algorithm::contracting, 20, 3, 700);
        CHECK(found.verdict == verdict::consistent);
        CHECK(found.forced.size() == 2);
        if (scenario == "S3") continue;
        // These scenarios know nothing of the parameters: one box.
        auto const second = c.run(algorithm::report_2, 20, 3, 1000);
        CHECK(second.verdict == verdict::consistent);
        CHECK(second.paving.inner_volume().lower() > 0.999999);
        CHECK(second.forced.size() == 2);
        auto const printed =
            c.run(algorithm::report_2, 20,
                  sivid::outlier_rule::threshold(dec(scenario == "S1" ? "0.2" : "0.02")), 1000);
        CHECK(printed.verdict == verdict::consistent);
    }
}

TEST_CASE("Algorithm 2 decides as the report prints it, for every count of misfits") {
    campaign c;
    auto made = c.make("S1");
    auto& measurements = made.data.scenarios[0].measurements;
    auto const n = measurements.size();
    for (std::size_t failing = 0; failing <= 8; ++failing) {
        for (std::size_t const h : {1u, 2u, 5u, 7u, 10u, 12u, 15u}) { // per cent
            INFO(failing << " of " << n << " fail, threshold " << h << " %");
            sivid::identify_options o;
            o = by_bisection(o);
            auto const threshold = sivid::outlier_rule::threshold(dec("0.01").times(h));
            auto const found =
                sivid::identify(sivid::problem_from_dataset(made.data, c.model, threshold), o);
            bool const inside = 100 * (n - failing) > n * (100 - h);
            bool const outside = 100 * failing >= n * h;
            CHECK(inside != outside);
            CHECK(found.verdict == (inside ? verdict::consistent : verdict::inconsistent));
        }
        // One more that certainly fails.
        auto& bound = measurements[7 * failing].bound;
        bound = sivid::interval(bound.lower() + 9, bound.upper() + 9);
    }
}

TEST_CASE("scenario 3 by Algorithm 2 on the prior of the report takes 11 000 boxes and more",
          "[.long]") {
    report_campaign const c("S3");
    auto const found =
        c.run(algorithm::report_2, 3600, sivid::outlier_rule::threshold(dec("0.02")), 15000);
    CHECK(found.verdict == verdict::consistent);
    CHECK(found.forced.size() == 2);
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

TEST_CASE("with D unknown A follows it, in what is generated and in what is identified") {
    campaign c;
    c.options.unknown = {{"Sv", dec("0.20"), dec("0.25")}, {"D", dec("0.16"), dec("0.20")}};
    c.options.set = {{"D", dec("0.19")}};
    c.options.noise = 1;
    auto const made = c.make("S3");
    auto const problem = sivid::problem_from_dataset(made.data, c.model);
    CHECK(sivid::followed(problem.model, problem.choice).size() == 1);
    auto const found = c.run(made, algorithm::contracting, 20, 0, 200);
    CHECK(found.verdict == verdict::consistent);
    CHECK(keeps_truth(found, made));
    // The same data, with A as Table 2.3 has it: the rudder is 11 % stronger than it was.
    auto stated = made;
    stated.data.fixed.push_back({10, dec("0.025447"), *sivid::enclose(dec("0.025447"))});
    CHECK(c.names.constants[10].name == "A");
    CHECK(c.run(stated, algorithm::contracting, 20, 0, 200).verdict == verdict::inconsistent);
}

TEST_CASE("the development campaigns are read, and become valid problems") {
    namespace fs = std::filesystem;
    campaign const c;
    std::size_t count = 0;
    for (auto const& entry :
         fs::directory_iterator{fs::path{SIVID_SOURCE_DIR} / "tests/data/campaigns"}) {
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
    CHECK(count == 5);
}
