// SPDX-License-Identifier: MIT
#include "diagnosis/small_campaign.hpp"
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/report/diagnosis_report.hpp>
#include <sivid/report/fill/detail/diagnosis_plot_data.hpp>

#include <cmath>

using namespace sivid::report;

TEST_CASE("plot data: fits to a campaign become measured intervals and outputs") {
    small_campaign::truth real;
    real.missing = [](double, double v, double) { return -0.5 * v; };
    auto problem = small_campaign::problem(real);
    auto const fit = sivid::fitter(problem)();
    REQUIRE(fit.inflation > 1);
    auto const all = compared_scenarios(problem, fit);
    REQUIRE(all.size() == 2);
    CHECK(all[1].name == "E2");
    REQUIRE(all[0].channels.size() == 2);
    auto const& p = all[0].channels[0];
    CHECK(p.name == "p");
    CHECK(p.unit == "m");
    REQUIRE(p.times.size() == 40);
    REQUIRE(p.base.size() == 40);
    CHECK(p.after.empty());
    CHECK(std::count(p.outliers.begin(), p.outliers.end(), true) == 0);
    // The largest misfit of the plot is the inflation of the fit.
    double largest = 0;
    for (auto const& s : all) {
        for (auto const& c : s.channels) {
            for (std::size_t k = 0; k < c.times.size(); ++k) {
                largest = std::max(largest, std::fabs(c.base[k] - c.values[k]) / c.bounds[k]);
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
    std::vector<double> const r{0.5, -3, 2, 1.5, NAN};
    CHECK(detail::suspects(r, 5, 2) == std::vector<bool>{false, true, true, false, false});
    CHECK(detail::suspects(r, 5, 9) == std::vector<bool>{false, true, true, true, false});
    CHECK(detail::suspects(r, 5, 0) == std::vector<bool>(5, false));
    CHECK(detail::suspects({}, 3, 2) == std::vector<bool>(3, false));
}

TEST_CASE("plot data: without a fit the measurements remain") {
    auto const all = compared_scenarios(small_campaign::problem(), {}, {}, true);
    REQUIRE(all.size() == 2);
    CHECK(all[0].holdout);
    CHECK(all[0].channels[1].base.empty());
    CHECK(all[0].channels[1].values.size() == 40);
}
