// SPDX-License-Identifier: MIT
#include <sivid/number/pack.hpp>

#include "support/catch.hpp"

#include <limits>
#include <type_traits>

using sivid::interval;
using sivid::pack;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

bool empty(interval const& x) { return x.lower() != x.lower() && x.upper() != x.upper(); }

template <std::size_t W>
void lanes_are_kept() {
    double lo[W], hi[W], lo2[W], hi2[W];
    for (std::size_t i = 0; i < W; ++i) {
        lo[i] = -static_cast<double>(i);
        hi[i] = static_cast<double>(i * i);
    }
    auto x = pack<W>::load(lo, hi);
    x.store(lo2, hi2);
    for (std::size_t i = 0; i < W; ++i) {
        CHECK(lo2[i] == lo[i]);
        CHECK(hi2[i] == hi[i]);
        CHECK(x.lower(i) == lo[i]);
        CHECK(x.upper(i) == hi[i]);
        CHECK(x[i].lower() == lo[i]);
    }
    x.set(W - 1, interval{5.0, 7.0});
    CHECK(x[W - 1].lower() == 5.0);
    CHECK(x[W - 1].upper() == 7.0);
    if constexpr (W > 1) CHECK(x[W - 2].upper() == hi[W - 2]);
    pack<W> const zero;
    pack<W> const everywhere{interval{-1.0, 2.0}};
    for (std::size_t i = 0; i < W; ++i) {
        CHECK(zero.lower(i) == 0.0);
        CHECK(zero.upper(i) == 0.0);
        CHECK(everywhere.lower(i) == -1.0);
        CHECK(everywhere.upper(i) == 2.0);
    }
    static_assert(std::is_trivially_copyable_v<pack<W>>);
    static_assert(pack<W>::parts * pack<W>::vector::lanes == W);
    static_assert(sizeof(pack<W>) == 2 * W * sizeof(double));
}

} // namespace

TEST_CASE("pack: every lane is read back as it was written") {
    REQUIRE(sivid::pack_supported());
    lanes_are_kept<1>();
    lanes_are_kept<2>();
    lanes_are_kept<3>();
    lanes_are_kept<4>();
    lanes_are_kept<6>();
    lanes_are_kept<8>();
    lanes_are_kept<12>();
    lanes_are_kept<16>();
    lanes_are_kept<64>();
}

TEST_CASE("pack: what is no interval is empty") {
    double const lo[]{1.0, not_a_number, 0.0, -inf}, hi[]{0.0, 1.0, not_a_number, inf};
    auto const x = pack<4>::load(lo, hi);
    CHECK(empty(x[0]));
    CHECK(empty(x[1]));
    CHECK(empty(x[2]));
    CHECK(x[3].lower() == -inf);
    CHECK(x[3].upper() == inf);
}

TEST_CASE("pack: the back end is the widest that the target has") {
    bool const has_pairs = SIVID_MACHINE_X86_64 || SIVID_MACHINE_ARM64;
    std::size_t const widest = SIVID_PACK_AVX512 ? 8 : SIVID_PACK_AVX2 ? 4 : has_pairs ? 2 : 1;
    CHECK(pack<16>::vector::lanes == widest);
    CHECK(pack<8>::vector::lanes == widest);
    CHECK(pack<2>::vector::lanes == (has_pairs ? 2 : 1));
    CHECK(pack<3>::vector::lanes == 1);
    CHECK(sivid::pack_target() == (widest == 8            ? "avx512"
                                   : widest == 4          ? "avx2"
                                   : SIVID_MACHINE_X86_64 ? "sse2"
                                   : SIVID_MACHINE_ARM64  ? "neon"
                                                          : "portable"));
}
