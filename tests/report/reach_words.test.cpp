// SPDX-License-Identifier: MIT
#include <sivid/report/reach_words.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

#include <string>

using namespace sivid;

namespace {

bool has(std::string const& text, std::string const& part) {
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("words on runs name the scenario and its state and what to change") {
    auto const p = plain_problem::make();
    identification found(p.prior);
    CHECK(report::reach_words(p, found).empty());
    run_reach r;
    r.until = 1.2;
    r.end = 3;
    r.width = 7.5;
    r.causes = {{false, 0, "a", 0.8}, {true, 0, "x", 0.15}};
    r.moved = 40;
    found.reach = {r};
    auto const early = report::reach_words(p, found).at(0);
    for (auto const* part : {"run: ", "1.2 of 3.0 s", "x is 7.5",
                             "a (80 %), the start of x (15 %)", "Windows of less than"}) {
        CAPTURE(early, part);
        CHECK(has(early, part));
    }
    found.reach[0].until = 0;
    CHECK(has(report::reach_words(p, found).at(0), "no trajectory is carried"));
    found.reach[0].until = 3;
    CHECK(report::reach_words(p, found).empty()); // what is left is a matter of time
    found.reach[0].lost = 5;
    CHECK(has(report::reach_words(p, found).at(0), "blur by 5.0 error bounds"));
    found.reach[0].moved = 0.3;
    CHECK(has(report::reach_words(p, found).at(0), "by more than 0.30 of its error bound"));
}
