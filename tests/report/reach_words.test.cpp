// SPDX-License-Identifier: MIT
#include <sivid/report/reach_words.hpp>

#include "support/catch.hpp"

#include <string>

using namespace sivid;

namespace {

bool has(std::string const& text, std::string const& part) {
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("words on runs name the scenario and its state and what to change") {
    CHECK(report::reach_words({}).empty());
    run_reach r;
    r.scenario = "run";
    r.until = 1.2;
    r.end = 3;
    r.state = "x";
    r.unit = "m";
    r.width = 7.5;
    r.causes = {{false, 0, "a", 0.8}, {true, 0, "x", 0.15}};
    r.moved = 40;
    auto const words = [&] { return report::reach_words({r}).at(0); };
    auto const early = words();
    for (auto const* part : {"run: ", "1.2 of 3.0 s", "x is 7.5 m",
                             "a (80 %), the start of x (15 %)", "Windows of less than"}) {
        CAPTURE(early, part);
        CHECK(has(early, part));
    }
    r.until = 0;
    CHECK(has(words(), "no trajectory is carried"));
    r.until = 3;
    CHECK(report::reach_words({r}).empty()); // what is left is a matter of time
    r.lost = 5;
    CHECK(has(words(), "blur by 5.0 error bounds"));
    r.moved = 0.3;
    CHECK(has(words(), "by more than 0.30 of its error bound"));
}
