// SPDX-License-Identifier: MIT
#include "diagnosis/small_campaign.hpp"
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/report/diagnosis_page.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace sivid::report;

TEST_CASE("plot data: fits to a campaign become measured intervals and outputs") {
    small_campaign::truth real;
    real.missing = [](double, double v, double) { return -0.5 * v; };
    auto problem = small_campaign::problem(real);
    auto const fit = sivid::approximate_fitter(problem)();
    REQUIRE(fit.inflation > 1);
    auto const all = compared_scenarios(problem, fit);
    REQUIRE(all.size() == 2);
    CHECK(all[1].name == "E2");
    REQUIRE(all[0].channels.size() == 2);
    auto const& p = all[0].channels[0];
    CHECK(p.name == "p");
    CHECK(p.unit == "m");
    REQUIRE(p.measured.size() == 40);
    REQUIRE(p.before.size() == 40);
    CHECK(p.after.empty());
    CHECK(std::all_of(p.measured.begin(), p.measured.end(),
                      [](measured_sample const& m) { return m.state == sample_state::regular; }));
    // The largest misfit of the plot is the inflation of the fit.
    double largest = 0;
    for (auto const& s : all) {
        for (auto const& c : s.channels) {
            REQUIRE(c.misfit_before.size() == c.measured.size());
            for (std::size_t k = 0; k < c.measured.size(); ++k) {
                auto const& m = c.measured[k].value;
                double const off = std::fabs(c.before[k].y - (m.lo + m.hi) / 2);
                CHECK_THAT(c.misfit_before[k].y, WithinAbs(off / ((m.hi - m.lo) / 2), 1e-9));
                largest = std::max(largest, c.misfit_before[k].y);
            }
        }
    }
    CHECK_THAT(largest, WithinAbs(fit.inflation, 1e-6));
    std::string const page =
        diagnosis_page(view_of({}, {.scenarios = all}, {.dataset = "cart"})).str();
    CHECK(sivid_tests::markup_error(sivid_tests::body_of(page)) == "");
    CHECK(sivid_tests::occurrences(page, ", before and after\"") == 4);
}

TEST_CASE("plot data: at most the budget is suspected, and only beyond its bounds") {
    auto problem = small_campaign::problem();
    problem.experiments.resize(1);
    auto& experiment = problem.experiments[0];
    sivid::approximate_fit fit;
    fit.residuals = {std::vector<double>(experiment.measurements.size(), 0.5)};
    fit.residuals[0][1] = -3;
    fit.residuals[0][2] = 2;
    fit.residuals[0][3] = 1.5;
    fit.residuals[0][4] = NAN;
    auto const samples = sorted(experiment.measurements);
    for (std::size_t const budget : {std::size_t{0}, std::size_t{2}, std::size_t{9}}) {
        experiment.outliers = budget;
        std::size_t suspected = 0;
        auto const all = compared_scenarios(problem, fit);
        for (auto const& c : all.at(0).channels) {
            for (auto const& m : c.measured) {
                if (m.state != sample_state::suspect) continue;
                ++suspected;
                bool const largest = m.time <= samples[budget == 2 ? 2 : 3].time;
                CHECK(largest);
            }
        }
        CHECK(suspected == std::min<std::size_t>(budget, 3));
    }
}

TEST_CASE("plot data: without a fit the measurements remain") {
    auto const all = compared_scenarios(small_campaign::problem(), {}, {}, true);
    REQUIRE(all.size() == 2);
    CHECK(all[0].holdout);
    CHECK(all[0].channels[1].before.empty());
    CHECK(all[0].channels[1].measured.size() == 40);
}

TEST_CASE("plot data: a suspected outlier has a line, and no misfit") {
    auto problem = small_campaign::problem();
    problem.experiments.resize(1);
    auto& experiment = problem.experiments[0];
    experiment.outliers = 1;
    sivid::approximate_fit fit, better;
    fit.residuals = {std::vector<double>(experiment.measurements.size(), 0.5)};
    better.residuals = fit.residuals;
    better.residuals[0][2] = 3; // the better fit tells what is suspected
    auto const all = compared_scenarios(problem, fit, better);
    std::size_t suspected = 0, before = 0, after = 0, misfits = 0;
    for (auto const& c : all[0].channels) {
        for (auto const& m : c.measured) suspected += m.state == sample_state::suspect ? 1 : 0;
        before += c.before.size();
        after += c.after.size();
        misfits += c.misfit_before.size();
        CHECK(c.misfit_before.size() == c.misfit_after.size());
    }
    CHECK(suspected == 1);
    CHECK(before == experiment.measurements.size());
    CHECK(after == before);
    CHECK(misfits == before - 1);
}
