// SPDX-License-Identifier: MIT
#include <sivid/decision/requirement.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

#include <sivid/decision/requirement/robustness.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace {

using kind = sivid::requirement::kind;

/// States x0, x1, a constant p0, an input u0, a channel y0 = 2 x0.
sivid::recorded_model model() {
    return support::model_of(
        {.states = 2, .constants = 1, .inputs = 1},
        [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{x[1], u[0] - p[0] * x[0]};
        },
        [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{x[0] * 2.0};
        });
}
sivid::requirement read(std::string const& text, double end = 10) {
    auto m = model();
    return sivid::parse_requirement(text, m, end);
}
std::string error_of(std::string const& text) {
    try {
        static_cast<void>(read(text));
    } catch (sivid::requirement_error const& e) {
        return e.what();
    }
    return "none";
}

} // namespace

TEST_CASE("a requirement becomes operations, margins and times") {
    auto const r = read("eventually(abs(x1) < 0.01) and x0 at end in [3, 7]");
    CHECK(r.parts.back().what == kind::conjunction);
    CHECK(r.margins.size() == 4); // |a| < b is a < b and -a < b
    CHECK(r.labels.size() == 4);
    CHECK(r.labels[0] == "abs(x1) < 0.01");
    CHECK(r.labels[2] == "x0 at end in [3, 7]");
    CHECK(r.times == std::vector<double>{0, 10});
}

TEST_CASE("windows add up, and their ends become instants") {
    auto const r = read("always[1, 4] eventually[0.5, 2] x0 > 1");
    CHECK(r.times == std::vector<double>{0, 1, 1.5, 4, 6, 10});
    CHECK(read("(x0 > 1) at 2.5").times == std::vector<double>{0, 2.5, 10});
    CHECK(read("x0 > 1 at 2.5").times == std::vector<double>{0, 2.5, 10});
    CHECK(read("x0 > 1 until[1, end] x1 > 0").parts.back().what == kind::until);
}

TEST_CASE("operators bind as documented") {
    CHECK(read("x0 > 1 or x0 > 2 and x1 > 0").parts.back().what == kind::disjunction);
    CHECK(read("not x0 > 1 and x1 > 0").parts.back().what == kind::conjunction);
    CHECK(read("always x0 > 1 and x1 > 0").parts.back().what == kind::conjunction);
    CHECK(read("x0 > 1 and x1 > 0 until x0 > 3").parts.back().what == kind::conjunction);
    CHECK(read("x0 > 1 implies x1 > 0").parts.back().what == kind::disjunction);
    CHECK(read("x0 > 1 or x1 > 0 provided x0 > 2").parts.back().what == kind::provided);
    CHECK(read("1 < x0 <= 3").parts.back().what == kind::conjunction);
    CHECK(read("-x0^2 < -p0*2+1").margins.size() == 1);
}

TEST_CASE("a margin is what the comparison asks for") {
    auto m = model();
    auto const r = sivid::parse_requirement("2 * x0 - u0 <= y0 / 4 + t", m, 1);
    REQUIRE(r.margins.size() == 1);
    CHECK_FALSE(r.parts.back().strict);
    CHECK((m.g.depends(r.margins[0]) & sivid::on_time) != 0);
    CHECK((m.g.depends(r.margins[0]) & sivid::on_input) != 0);
    // A channel with the name of no state is found by it, and by measured().
    CHECK(sivid::parse_requirement("measured(y0) > 1", m, 1).margins ==
          sivid::parse_requirement("y0 > 1", m, 1).margins);
}

TEST_CASE("errors name place and remedy") {
    struct bad {
        char const *text, *words;
    };
    for (auto const& [text, words] :
         std::vector<bad>{{"", "something is missing"},
                          {"x0", "compare it"},
                          {"x0 == 3", "tolerance"},
                          {"nan > 1", "unknown name 'nan'"},
                          {"x0 > inf", "unknown name 'inf'"},
                          {"x0 > -inf", "unknown name 'inf'"},
                          {"x0 > 1e999", "no finite number"},
                          {"x0 > 1/0", "division by 0"},
                          {"always(x0 > 0", "')' is missing"},
                          {"always[0, 12](x0 > 0)", "the motion ends at 10 s"},
                          {"always(eventually[0, 2](x0 > 1))", "the motion ends at 10 s"},
                          {"always[3, 1] x0 > 1", "ends before it begins"},
                          {"always[-1, 1] x0 > 1", "a time in s is"},
                          {"always[0, nan] x0 > 1", "a time in s is"},
                          {"always[0, 1e999] x0 > 1", "a time in s is"},
                          {"x0 at 11 > 2", "beyond the end"},
                          {"x0 at 2 > x1", "not asked at the same time"},
                          {"x0 > x1 at 2", "not asked at the same time"},
                          {"x0 at 2 > 1 at 3", "not asked at the same time"},
                          {"0 < x0 < x1 at 2", "not asked at the same time"},
                          {"x0 at 2 < 3 < x1", "not asked at the same time"},
                          {"x0 in [0, x1 at 2]", "not asked at the same time"},
                          {"x0 at 2 + 1 > 3", "comparison is missing"},
                          {"(x0 at 2) + 1 > 3", "comparison is missing"},
                          {"(x0 > 1) + 2 > 3", "a number is needed"},
                          {"x0 and x1 > 1", "compare it"},
                          {"x0 ^ 0 > 1", "whole number from 1 to 32"},
                          {"foo(x0) > 1", "unknown function 'foo'"},
                          {"measured(x0) > 1", "no channel"},
                          {"x0 > 1 2", "nothing can follow"},
                          {"x0 > 1 provided x1", "provided needs something that holds"},
                          {"(x0 > 1 provided x1 > 0)", "')' is missing"},
                          {"2x0 > 1", "no number"},
                          {"x0 in 3", "[lower, upper]"},
                          {"max(x0) > 1", "two numbers"},
                          {"x0 > end", "cannot stand here"}}) {
        CAPTURE(text);
        CHECK_THAT(error_of(text), ContainsSubstring(words));
        CHECK_THAT(error_of(text), ContainsSubstring("requirement: character "));
    }
    CHECK_THAT(error_of("x0 > 1 \x01\x1b[31m"), !ContainsSubstring("\x1b"));
}

TEST_CASE("depth and length are bounded") {
    CHECK_THAT(error_of(std::string(5000, '(') + "x0 > 1"), ContainsSubstring("too deep"));
    CHECK_THAT(error_of(std::string(5000, '-') + "x0 > 1"), ContainsSubstring("too deep"));
    std::string nots;
    for (int k = 0; k < 2000; ++k) nots += "not ";
    CHECK_THAT(error_of(nots + "x0 > 1"), ContainsSubstring("too deep"));
    CHECK_THAT(error_of(std::string(10'001, ' ')), ContainsSubstring("too long"));
    std::string many = "x0 > 0";
    for (int k = 1; k < 1000; ++k) many += " and x0>" + std::to_string(k % 7);
    CHECK(read(many).margins.size() == 7);
    std::string greatest = "x0";
    for (int k = 0; k < 50; ++k) greatest = "max(" + greatest + ", x1 + " + std::to_string(k) + ")";
    CHECK(read(greatest + " < 1").margins.size() <= 65);
}

TEST_CASE("any text ends in a requirement or an error") {
    support::draws d{11};
    std::vector<std::string> const words{
        "always", "eventually", "until", "not",  "and",    "or",     "implies", "(",
        ")",      "[",          "]",     ",",    "x0",     "x1",     "u0",      "p0",
        "t",      "1",          "2.5",   "1e3",  "<",      "<=",     ">",       "+",
        "-",      "*",          "/",     "^",    "abs(",   "max(",   "at",      "end",
        "in",     "measured(",  "sqrt(", "\xff", "[0, 1]", "x0 > 1", "(x1 < 2)"};
    std::vector<std::string> const good{"eventually(abs(x1) < 0.01) and x0 at end in [3, 7]",
                                        "always[1, 4] eventually[0.5, 2] x0 > 1",
                                        "x0 > 1 until[1, end] x1 > 0 or max(x0, x1)^2 < sqrt(p0)",
                                        "x0 > 1 provided always(x1 < 2)"};
    std::size_t accepted = 0;
    for (int n = 0; n < 3000; ++n) {
        std::string text;
        if (n % 2 == 0) {
            for (std::size_t k = d.below(12); k > 0; --k)
                text += words[d.below(words.size())] + " ";
        } else {
            text = good[d.below(good.size())];
            for (std::size_t k = 1 + d.below(3); k > 0; --k) {
                auto const at = d.below(text.size());
                if (d.below(2) == 0)
                    text.erase(at, 1 + d.below(6));
                else
                    text.insert(at, words[d.below(words.size())]);
            }
        }
        try {
            auto const r = read(text);
            ++accepted;
            REQUIRE(r.labels.size() == r.margins.size());
            REQUIRE(std::is_sorted(r.times.begin(), r.times.end()));
            sivid::margin_bounds unknown{r.times, {}, {}};
            unknown.low.assign(r.margins.size(),
                               std::vector<double>(unknown.segments(), -HUGE_VAL));
            unknown.high.assign(r.margins.size(),
                                std::vector<double>(unknown.segments(), HUGE_VAL));
            auto const says = sivid::evaluate(r, unknown);
            REQUIRE_FALSE((says.proved() && says.refuted()));
        } catch (sivid::requirement_error const&) {
        }
    }
    CHECK(accepted > 15);
}
