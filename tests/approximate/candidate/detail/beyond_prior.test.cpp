// SPDX-License-Identifier: MIT
#include <sivid/approximate/candidate/detail/beyond_prior.hpp>
#include <sivid/approximate/candidate/screening.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

#include <sivid/model/effects.hpp>

#include <cstddef>
#include <vector>

using namespace sivid;

TEST_CASE("only effects whose fit ends at a prior that can be left are widened, each once") {
    auto catalogue = small_campaign::catalogue();
    screening tried(small_campaign::problem(small_campaign::with_drag(1.5)), catalogue);
    tried.try_all({{0}, {2}});
    auto const planned = catalogue.size();
    auto const further = beyond_prior(*tried.find({0}), catalogue, planned);
    REQUIRE(catalogue.size() == planned + 1);
    CHECK(further == std::vector<std::size_t>{planned});
    CHECK(catalogue[planned].name == "quadratic_wider");
    CHECK(beyond_prior(*tried.find({0}), catalogue, planned) == further);
    CHECK(catalogue.size() == planned + 1);
    auto inside = *tried.find({0});
    inside.fit.parameters.back() = 0.5;
    CHECK(beyond_prior(inside, catalogue, planned) == std::vector<std::size_t>{0});
    inside.fit.parameters.back() = 0; // no drag is where the effect ends by its nature
    CHECK(beyond_prior(inside, catalogue, planned) == std::vector<std::size_t>{0});
    auto wider = inside; // once is enough
    wider.figures.effects = {planned};
    CHECK(beyond_prior(wider, catalogue, planned) == std::vector<std::size_t>{planned});
}

TEST_CASE("the prior of a turn stays, since it tells how many turns there were") {
    using namespace literals;
    std::vector<effect> catalogue{
        effects::sensor_wrap("wraps", "p", "m", {0.85_dec, 0.95_dec}, 0.45)};
    screening tried(small_campaign::problem(), catalogue);
    tried.try_one({0});
    auto ends = *tried.find({0});
    ends.fit.parameters.back() = 0.95;
    CHECK(beyond_prior(ends, catalogue, 1) == std::vector<std::size_t>{0});
    CHECK(catalogue.size() == 1);
}

TEST_CASE("an effect has one index in a catalogue") {
    auto catalogue = small_campaign::catalogue();
    auto const n = catalogue.size();
    CHECK(index_of_effect(catalogue, catalogue[2]) == 2);
    CHECK(index_of_effect(catalogue, only_within(catalogue[2], {"E1"})) == n);
    CHECK(index_of_effect(catalogue, only_within(catalogue[2], {"E1"})) == n);
    CHECK(catalogue.size() == n + 1);
}
