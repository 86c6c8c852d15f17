// SPDX-License-Identifier: MIT
#include <sivid/io/result/certificates_csv.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <string>

using namespace sivid;
using kind = proof_step::kind;

namespace {

std::string const headings = "step,of,end,at,weights\n";
exclusion_proof read(std::string const& text) {
    return read_certificates(csv_table("certificates.csv", text));
}

} // namespace

TEST_CASE("a proof is read as it was written but for the digits of weights") {
    exclusion_proof const proof{
        {kind::run, 3},
        {kind::cut, 2, true, 0.1 + 0.2, {{{0, 12, 1.0 / 3}, {3, 0, -2e-7}}, {{1, 5, 1}}}},
        {kind::cut, 0, false, 5e-324},
        {kind::split, 1, false, -1e300},
        {kind::empty, 0, false, 0, {{{2, 7, -0.5}}}},
        {kind::leaf}};
    auto const text = certificates_csv(proof);
    CHECK(text.find("cut,2,upper,0.30000000000000004,0:12:0.333333333 3:0:-2e-07|1:5:1\n") !=
          text.npos);
    auto const again = read(text);
    REQUIRE(again.size() == proof.size());
    for (std::size_t k = 0; k < proof.size(); ++k) {
        CAPTURE(k);
        CHECK(again[k].what == proof[k].what);
        CHECK(again[k].index == proof[k].index);
        CHECK(again[k].upper == proof[k].upper);
        CHECK(again[k].at == proof[k].at);
        REQUIRE(again[k].why.size() == proof[k].why.size());
    }
    REQUIRE(again[1].why[0].size() == 2);
    CHECK(again[1].why[0][1].experiment == 3);
    CHECK(again[1].why[0][0].output == 12);
    CHECK(std::abs(again[1].why[0][0].value - 1.0 / 3) < 1e-9);
    CHECK(read(headings).empty());
}

TEST_CASE("what is no proof is refused with line and remedy") {
    for (auto const* const bad :
         {"jump,0,,,\n", "cut,0,upper,,\n", "cut,0,left,1,\n", "cut,x,upper,1,\n",
          "cut,-1,upper,1,\n", "cut,0,upper,inf,\n", "run,,,,\n", "split,0,,1e999,\n",
          "cut,0,upper,1,0:1\n", "cut,0,upper,1,0:1:2|\n", "cut,0,upper,1,0:1:2 x\n",
          "empty,0,,,0;1;2\n", "run,99999999999999999999999,,,\n", "leaf,0\n"}) {
        CAPTURE(bad);
        CHECK_THROWS_AS(read(headings + bad), input_error);
    }
    CHECK_THROWS_AS(read("step,of\nrun,0\n"), input_error);
}
