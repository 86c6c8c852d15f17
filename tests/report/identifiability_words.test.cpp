// SPDX-License-Identifier: MIT
#include <sivid/report/identifiability_words.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

using namespace sivid;
using support::between;

namespace {

identifiability some() {
    identifiability found;
    for (char const* name : {"a", "b", "c"}) {
        found.unknowns.push_back({name, found.unknowns.size(), std::nullopt, between(1, 2)});
    }
    found.outputs = 12;
    return found;
}
std::string joined(identifiability const& found) {
    std::string text;
    for (auto const& line : report::identifiability_words(found)) text += line + "\n";
    return text;
}

} // namespace

TEST_CASE("ranks say what is proved and what is not") {
    auto found = some();
    found.least_rank = found.approximate_rank = found.most_rank = 3;
    CHECK(joined(found) == "12 measured outputs and 3 unknowns: rank 3, proved\n");
    found.least_rank = 2;
    found.missing = 1;
    CHECK(joined(found) == "12 measured outputs and 3 unknowns: rank at least 2 and at most 3, "
                           "proved; 3 in floating point; 1 output not reached\n");
}

TEST_CASE("motions, formulas and directions in words") {
    auto found = some();
    found.least_rank = found.approximate_rank = found.most_rank = 1;
    found.free = {{motion_kind::scaling, {1, -2, 0}, 0, true},
                  {motion_kind::scaling, {0, 0, 1}, 0, false}};
    found.fixed = {{motion_kind::scaling, {2, 1, 0}, "a^2*b", true}};
    found.nearly_free = {{motion_kind::translation, {1, -2, 0}, 0.125, false}};
    found.nearly_fixed = {{motion_kind::translation, {2, 1, 0}, "2*a + b", false}};
    found.directions = {{{0.04, -0.5, 1}, 123}, {{1, 0, 0}, 0}, {{0, 0, 1}, 0}};
    auto const text = joined(found);
    CHECK_THAT(text, ContainsSubstring("free: a * k, b / k^2 (by the equations)\n"));
    CHECK_THAT(text, ContainsSubstring("free: c * k: it does not act on the outputs (numerically, "
                                       "not proved)\n"));
    CHECK_THAT(text, ContainsSubstring("these act through a^2*b alone\n"));
    CHECK_THAT(text, ContainsSubstring("hardly noticed: a + s, b - 2 s across the prior moves no "
                                       "output by more than 0.13 of its error bound"));
    CHECK_THAT(text, ContainsSubstring("these act nearly through 2*a + b alone\n"));
    CHECK_THAT(text, ContainsSubstring("along c +1.0, b -0.50 of the prior's width an output moves "
                                       "by 120 error bounds"));
    CHECK_THAT(text, !ContainsSubstring("along a"));
}
