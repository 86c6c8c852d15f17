// SPDX-License-Identifier: MIT
#include <sivid/paving/verdict.hpp>

#include "support/catch.hpp"

#include <set>
#include <string>

using namespace sivid;

TEST_CASE("every verdict and reason has its own words") {
    std::set<std::string> words;
    for (auto v : {box_verdict::inside, box_verdict::outside, box_verdict::undecided,
                   box_verdict::pending}) {
        words.insert(std::string(to_string(v)));
    }
    CHECK(words.size() == 4);
    words.clear();
    for (auto v : {verdict::consistent, verdict::inconsistent, verdict::undecided}) {
        words.insert(std::string(to_string(v)));
    }
    CHECK(words.size() == 3);
    words.clear();
    for (auto r : {stop_reason::decided, stop_reason::accuracy_reached, stop_reason::inside_share,
                   stop_reason::hulls_rest, stop_reason::too_blurred, stop_reason::time_budget,
                   stop_reason::box_budget, stop_reason::memory_budget, stop_reason::cancelled}) {
        words.insert(std::string(to_string(r)));
        bool const cut = r == stop_reason::time_budget || r == stop_reason::box_budget ||
                         r == stop_reason::memory_budget || r == stop_reason::cancelled;
        CHECK(is_complete(r) != cut);
    }
    CHECK(words.size() == 9);
    CHECK(words.count("") == 0);
    CHECK(to_string(verdict::inconsistent) == "inconsistent");
}
