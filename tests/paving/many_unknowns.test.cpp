// SPDX-License-Identifier: MIT
// Identification with more unknowns in an experiment than any size that is compiled apart.
#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"

#include <sivid/paving/identify.hpp>
#include <sivid/paving/run/experiment_run.hpp>

#include <cstddef>
#include <vector>

using namespace sivid;
using support::between;
using support::extended;

TEST_CASE("two parameters behind fourteen uncertain starts are identified") {
    // A bar of fourteen cells that conducts heat and loses some: x_i' = k (neighbours) - c x_i.
    constexpr std::size_t cells = 14;
    auto const rate = [](auto const&, auto const& x, auto const& p, auto const&) {
        auto result = x;
        for (std::size_t i = 0; i < cells; ++i) {
            auto const& left = x[i == 0 ? 0 : i - 1];
            auto const& right = x[i + 1 == cells ? i : i + 1];
            result[i] = p[0] * (left + right - 2 * x[i]) - p[1] * x[i];
        }
        return result;
    };
    std::vector<double> const truth{0.6, 0.15};
    support::extended_state start(cells), constants{truth[0], truth[1]};
    experiment e;
    e.name = "bar";
    e.initial = box(cells);
    for (std::size_t i = 0; i < cells; ++i) {
        start[i] = i < cells / 2 ? 4 : 1;
        double const x = static_cast<double>(start[i]);
        e.initial[i] = between(x - 0.01, x + 0.02);
    }
    std::vector<double> const times{0.5, 1.0, 2.0};
    auto const exact = support::reference_states(rate, start, constants, 0, times, {});
    for (std::size_t k = 0; k < times.size(); ++k) {
        for (std::size_t i = 0; i < cells; ++i) {
            double const y = static_cast<double>(exact[k][i]);
            e.measurements.push_back({times[k], i, between(y - 0.03, y + 0.02)});
        }
    }
    box const prior{between(0.3, 1), between(0.05, 0.3)};
    CHECK(paving_detail::unknown_count(e.initial, prior) == cells + 2);
    identify_options options;
    options.search.seconds = 60;
    options.search.boxes = 300;
    auto const found = identify(
        {support::model_of({cells, 2, 0, 10}, rate), {{"p0", "p1"}, {}}, prior, {e}}, options);
    CHECK(found.verdict == verdict::consistent);
    REQUIRE(found.hull.size() == 2);
    for (std::size_t j = 0; j < 2; ++j) {
        CHECK(contains(found.hull[j], truth[j]));
        CHECK(width(found.hull[j]) < 0.2 * width(prior[j]));
    }
}
