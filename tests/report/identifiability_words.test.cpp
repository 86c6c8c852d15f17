// SPDX-License-Identifier: MIT
#include <sivid/report/identification_report.hpp>

#include "report/facts.hpp"
#include "support/catch.hpp"
#include "support/models.hpp"

using namespace sivid;
using sivid_tests::missing_fact;
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
    CHECK(missing_fact(joined(found), {"12", "3 unknowns", "rank 3", "proved"}) == "");
    found.least_rank = 2;
    found.missing = 1;
    CHECK(missing_fact(joined(found), {"rank", "2", "3", "proved", "3", "1 output"}) == "");
}

TEST_CASE("motions, formulas and directions in words") {
    auto found = some();
    found.least_rank = found.approximate_rank = found.most_rank = 1;
    found.free = {{motion_kind::scaling, {1, -2, 0}, 0, true},
                  {motion_kind::scaling, {0, 0, 1}, 0, false}};
    found.fixed = {{motion_kind::scaling, {2, 1, 0}, "a^2*b", true}};
    found.nearly_free = {{motion_kind::translation, {1, -2, 0}, 0.121, false}};
    found.nearly_fixed = {{motion_kind::translation, {2, 1, 0}, "2*a + b", false}};
    found.directions = {{{0.04, -0.5, 1}, 123}, {{1, 0, 0}, 0}, {{0, 0, 1}, 0}};
    auto const text = joined(found);
    CHECK(missing_fact(text, {"free", "a * k, b / k^2", "equations"}) == "");
    CHECK(missing_fact(text, {"free", "c * k", "not proved"}) == "");
    CHECK(missing_fact(text, {"through", "a^2*b"}) == "");
    CHECK(missing_fact(text, {"a + s, b - 2 s", "0.13"}) == "");
    CHECK(missing_fact(text, {"nearly", "2*a + b"}) == "");
    CHECK(missing_fact(text, {"c +1.0, b -0.50", "120"}) == "");
    CHECK_THAT(text, !ContainsSubstring("along a")); // a direction without effect is no direction
}
