// SPDX-License-Identifier: MIT
#include <sivid/model/structure/homogeneity.hpp>

#include <sivid/model/structure/find_combinations.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

using namespace sivid;

namespace {

template <class Rate>
bound_model bound(std::size_t constants, Rate const& rate) {
    return bind(support::model_of({1, constants}, rate), {support::all_constants(constants), {}},
                {});
}

} // namespace

TEST_CASE("scalings that leave the equations as they are are recognised, others are not") {
    auto const ratio = bound(4, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{(p[0] * p[1] * sin(x[0]) - p[2] * x[0]) / p[3]};
    });
    CHECK(is_scale_invariant(ratio, {0, 0, 0, 0}));
    CHECK(is_scale_invariant(ratio, {1, -1, 0, 0}));
    CHECK(is_scale_invariant(ratio, {1, 0, 1, 1}));
    CHECK_FALSE(is_scale_invariant(ratio, {1, 1, 1, 1}));
    CHECK_FALSE(is_scale_invariant(ratio, {0, 0, 1, 0}));
    auto const powers = bound(2, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{exp(-(pown(p[0], 4) / sqr(p[1])) * x[0])};
    });
    CHECK(is_scale_invariant(powers, {1, 2}));
    CHECK_FALSE(is_scale_invariant(powers, {2, 1}));
    auto const root = bound(2, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{sqrt(p[0]) * p[1] * x[0]}; // not for negative factors: not recognised
    });
    CHECK_FALSE(is_scale_invariant(root, {2, -1}));
    auto const size = bound(2, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{abs(p[0]) * p[1] * x[0]}; // not for a negative scale
    });
    CHECK_FALSE(is_scale_invariant(size, {1, -1}));
}

TEST_CASE("a factor that stands alone, too, must keep its scale") {
    auto const model = bound(3, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{p[2] - p[0] * p[1] * p[2] * x[0]};
    });
    CHECK(is_scale_invariant(model, {1, -1, 0}));
    CHECK_FALSE(is_scale_invariant(model, {1, 0, -1}));
}
