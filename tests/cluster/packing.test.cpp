// SPDX-License-Identifier: MIT
// Values as bytes: every bit comes back.
#include <sivid/cluster/packing.hpp>

#include <sivid/number/decimal.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

using namespace sivid;
using cluster::packed;
using cluster::unpacker;

namespace {

struct nothing {};

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool same(box const& a, box const& b) {
    bool equal = a.size() == b.size();
    for (std::size_t i = 0; equal && i < a.size(); ++i) {
        equal = same_bits(a[i].lower(), b[i].lower()) && same_bits(a[i].upper(), b[i].upper());
    }
    return equal;
}
box drawn(support::draws& d) {
    std::vector<interval> sides;
    for (int k = 0; k < 3; ++k) {
        double const x = d.uniform(-1, 1) * std::ldexp(1.0, static_cast<int>(d.below(2000)) - 1000);
        sides.push_back(hull(interval(x), interval(d.uniform(-1, 1))));
    }
    return box(sides);
}

assessment<nothing> drawn_answer(support::draws& d, box const& x) {
    assessment<nothing> a{.rest = x};
    a.verdict = static_cast<box_verdict>(d.below(3));
    if (d.below(2) == 0) a.smear = {d.uniform(0, 1), 0, std::nan("")};
    a.blind = d.below(2) == 0;
    a.cost = d.below(1000);
    for (auto n = d.below(4); n > 0; --n) {
        proof_step s;
        s.what = static_cast<proof_step::kind>(d.below(5));
        s.index = d.below(3);
        s.upper = d.below(2) == 0;
        s.at = d.uniform(-1, 1);
        for (auto g = d.below(3); g > 0; --g) s.why.push_back({{d.below(9), d.below(99), 1e-300}});
        a.proof.push_back(s);
    }
    return a;
}

} // namespace

TEST_CASE("numbers, texts and boxes come back bit for bit") {
    std::vector<double> const odd{0.0,
                                  -0.0,
                                  std::numeric_limits<double>::denorm_min(),
                                  std::numeric_limits<double>::infinity(),
                                  std::nan("7"),
                                  1.0 / 3};
    support::draws d(7101);
    auto const x = drawn(d);
    std::string const text{"a\0b", 3};
    auto const bytes = packed(std::uint64_t{1} << 63, odd, text, true, x);
    unpacker in(bytes);
    CHECK(in.take<std::uint64_t>() == std::uint64_t{1} << 63);
    auto const back = in.take<std::vector<double>>();
    REQUIRE(back.size() == odd.size());
    for (std::size_t k = 0; k < odd.size(); ++k) CHECK(same_bits(back[k], odd[k]));
    CHECK(in.take<std::string>() == text);
    CHECK(in.take<bool>());
    CHECK(same(in.take<box>(), x));
    CHECK_THROWS_AS(in.take<double>(), boost::archive::archive_exception);
}

TEST_CASE("answers come back whole, and what is left of a box may be nothing") {
    support::draws d(7102);
    for (int round = 0; round < 30; ++round) {
        auto const x = drawn(d);
        auto const a = drawn_answer(d, x);
        auto const bytes = packed(a);
        auto const b = unpacker(bytes).take<assessment<nothing>>();
        CHECK(b.verdict == a.verdict);
        CHECK(same(b.rest, a.rest));
        CHECK(b.blind == a.blind);
        CHECK(b.cost == a.cost);
        CHECK(packed(b) == bytes);
        CHECK(same(b.rest, x));
    }
    box const gone{interval_traits<interval>::empty(), hull(2_dec, 3_dec)};
    CHECK(is_empty(unpacker(packed(gone)).take<box>()));
}
