// SPDX-License-Identifier: MIT
// What `identify --by-bounds` says.
#include <sivid/app/detail/bounds_output.hpp>

#include "app/cup.hpp"

#include "support/catch.hpp"

#include <utility>

using namespace sivid;
using Catch::Matchers::ContainsSubstring;

namespace {

identification_problem cup() {
    experiment e;
    e.name = "tea";
    return {app_test::cup().model, {{"k"}, {}}, {interval(0.2, 1)}, {e}};
}
bound_influence line(double scale, verdict found, box hull, bool ended = true) {
    return {{}, scale, found, ended, std::move(hull)};
}

} // namespace

TEST_CASE("ranges with other bounds are shares of those with the stated ones") {
    auto const text = app::detail::bounds_text(
        cup(), {line(1, verdict::consistent, {interval(0.4, 0.6)}),
                line(0.5, verdict::inconsistent, empty_box(1)),
                line(2, verdict::consistent, {interval(0.3, 0.7)}, false)});
    CHECK_THAT(text, ContainsSubstring("all channels x 0.5: no parameter explains the data\n"));
    CHECK_THAT(text, ContainsSubstring("all channels x 2: k 2 (at most: the budget ended)\n"));
}

TEST_CASE("where the stated bounds are contradicted, others that are not are named") {
    auto const text =
        app::detail::bounds_text(cup(), {line(1, verdict::inconsistent, empty_box(1)),
                                         line(0.5, verdict::inconsistent, empty_box(1)),
                                         line(2, verdict::consistent, {interval(0.3, 0.7)}),
                                         line(4, verdict::undecided, {interval(0.2, 1)}, false)});
    CHECK_THAT(text, ContainsSubstring("x 0.5: no parameter explains the data\n"));
    CHECK_THAT(text, ContainsSubstring("x 2: some parameter explains the data\n"));
    CHECK_THAT(text, ContainsSubstring("x 4: undecided (the budget ended)\n"));
    auto const csv = app::detail::bounds_csv(cup(), {line(1, verdict::inconsistent, empty_box(1))});
    CHECK_THAT(csv, ContainsSubstring("all channels,1,inconsistent,1,k,,\n"));
}
