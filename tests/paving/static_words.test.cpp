// SPDX-License-Identifier: MIT
#include <sivid/paving/static_words.hpp>

#include "paving/static_models.hpp"
#include "support/catch.hpp"

#include <sivid/paving/static_inversion.hpp>

#include <algorithm>
#include <string>

using namespace sivid;

namespace {

/// 0/0 along a diagonal, though the limit is p + q.
struct quotient {
    static constexpr auto name = "quotient";
    static constexpr auto channels = sivid::channels({{"y", "1"}, {"z", "1"}});
    static constexpr auto constants = static_models::ring::constants;
    template <class T>
    sivid::channels_of<quotient, T> observe(T const&,
                                            sivid::constants_of<quotient, T> const& c) const {
        return {(sqr(c[0]) - sqr(c[1])) / (c[0] - c[1]), c[0]};
    }
};
std::string all_words(static_problem const& problem, flat_paving const& found) {
    std::string all;
    for (auto const& w : static_words(problem, found)) all += w + "\n";
    return all;
}

} // namespace

TEST_CASE("a set inversion says its verdict, and which ends of the prior it reaches") {
    auto problem = static_models::ring_problem();
    auto found = invert_static(problem, {.accuracy = 0.01});
    CHECK(proved_verdict(found) == verdict::consistent);
    CHECK(found.ends().empty());
    CHECK(all_words(problem, found) == "proved: parameters of the prior explain the data\n");
    problem = static_models::ring_problem(interval(60, 61));
    found = invert_static(problem, {.accuracy = 0.01});
    CHECK(proved_verdict(found) == verdict::inconsistent);
    CHECK(found.ends().empty());
    problem = static_models::ring_problem(interval(4.0)); // a curve
    found = invert_static(problem, {.accuracy = 0.01});
    CHECK(proved_verdict(found) == verdict::undecided);
    problem = static_models::ring_problem();
    problem.prior = {interval(0, 5), interval(-1.1, 1.1)}; // (1, -1.1) is feasible, (0, 1.1) too
    found = invert_static(problem, {.accuracy = 1e-3});
    auto const ends = found.ends();
    REQUIRE(ends.size() == 3);
    CHECK((ends[0].side == 0 && ends[0].end == prior_end::lower && ends[0].proved));
    CHECK((ends[1].side == 1 && ends[1].end == prior_end::lower && ends[1].proved));
    CHECK((ends[2].side == 1 && ends[2].end == prior_end::upper && ends[2].proved));
    CHECK_THAT(all_words(problem, found), ContainsSubstring("p reaches the lower end"));
    found = invert_static(problem, {.boxes = 1});
    for (auto const& e : found.ends()) CHECK_FALSE(e.proved);
    CHECK_THAT(all_words(problem, found), ContainsSubstring("p may reach the lower end"));
}

TEST_CASE("measurements that no parameter meets are told, planted ones and no others") {
    for (std::size_t const spoilt : {0U, 1U, 3U}) {
        auto problem = static_models::mixed_problem(1.2, 0.7, 0, 3);
        for (std::size_t k = 0; k < spoilt; ++k)
            problem.measurements[2 * k].bound = interval(40.0 + double(k), 41.0 + double(k));
        auto const found = invert_static(problem, {.accuracy = 1.0 / 256});
        std::vector<std::size_t> planted;
        for (std::size_t k = 0; k < spoilt; ++k) planted.push_back(2 * k);
        CHECK(found.forced == planted);
        auto const words = all_words(problem, found);
        CHECK((words.find("proved outlier: y at 0,") != std::string::npos) == (spoilt > 0));
    }
    auto none = static_models::mixed_problem(1.2, 0.7, 0, 1); // nothing is feasible
    for (std::size_t k = 0; k < 2; ++k) none.measurements[k].bound = interval(40, 41);
    CHECK(invert_static(none, {.accuracy = 1.0 / 64}).forced.empty());
}

TEST_CASE("a formula without a value leaves boxes open, and is named") {
    static_problem problem{record_static_model<quotient>(),
                           {{"p", "q"}, {}},
                           {interval(0, 1), interval(0, 1)},
                           {{0, 1, interval(0, 1)}, {2, 0, interval(0.5, 1)}}};
    auto const found = invert_static(problem, {.accuracy = 1.0 / 64});
    REQUIRE(found.undefined.size() == 1);
    CHECK(found.undefined[0].measurement == 1);
    auto const& where = found.undefined[0].where;
    CHECK(!is_empty(intersect(where[0], where[1]))); // it meets the diagonal
    CHECK_THAT(all_words(problem, found), ContainsSubstring("y at 2 may have no value in p in ["));
    problem.prior = {interval(0.6, 1), interval(0, 0.5)};
    CHECK(invert_static(problem, {.accuracy = 1.0 / 64}).undefined.empty());
}
