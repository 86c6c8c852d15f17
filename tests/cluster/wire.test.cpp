// SPDX-License-Identifier: MIT
// Values as bytes: every bit comes back, and whatever was not written so is refused.
#include <sivid/cluster/wire.hpp>

#include <sivid/number/decimal.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

using namespace sivid;
using cluster::wire_error;
using cluster::wire_reader;
using cluster::wire_writer;

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
    wire_writer out;
    std::vector<double> const odd{0.0,
                                  -0.0,
                                  std::numeric_limits<double>::denorm_min(),
                                  std::numeric_limits<double>::infinity(),
                                  std::nan("7"),
                                  1.0 / 3};
    support::draws d(7101);
    auto const x = drawn(d);
    out.put(std::uint64_t{1} << 63).put(odd).put(std::string_view{"a\0b", 3}).put(true).put(x);
    auto const bytes = out.take();
    wire_reader in(bytes);
    CHECK(in.number() == std::uint64_t{1} << 63);
    auto const back = in.reals();
    REQUIRE(back.size() == odd.size());
    for (std::size_t k = 0; k < odd.size(); ++k) CHECK(same_bits(back[k], odd[k]));
    CHECK(in.text() == std::string_view{"a\0b", 3});
    CHECK(in.flag());
    CHECK(same(in.sides(3), x));
    in.finish();
    CHECK_THROWS_AS(in.number(), wire_error);
}

TEST_CASE("answers come back whole, and cut anywhere they are refused") {
    support::draws d(7102);
    for (int round = 0; round < 30; ++round) {
        auto const x = drawn(d);
        auto const a = drawn_answer(d, x);
        auto const bytes = wire_writer().put(a).take();
        wire_reader in(bytes);
        auto const b = in.answer<nothing>(x);
        in.finish();
        CHECK(b.verdict == a.verdict);
        CHECK(same(b.rest, a.rest));
        CHECK(b.blind == a.blind);
        CHECK(b.cost == a.cost);
        CHECK(wire_writer().put(b).take() == bytes);
        for (std::size_t cut = 0; cut < bytes.size(); cut += 1 + d.below(9)) {
            auto const part = std::string_view{bytes}.substr(0, cut);
            wire_reader some(part);
            CHECK_THROWS_AS((void)some.answer<nothing>(x), wire_error);
        }
        auto const more = bytes + "x";
        wire_reader longer(more);
        (void)longer.answer<nothing>(x);
        CHECK_THROWS_AS(longer.finish(), wire_error);
    }
}

TEST_CASE("what is left of a box is a part of it, or it is no answer") {
    box const x{hull(0_dec, 1_dec), hull(2_dec, 3_dec)};
    box const beyond{hull(0_dec, 1.5_dec), hull(2_dec, 3_dec)};
    auto const bytes = wire_writer().put(assessment<nothing>{.rest = beyond}).take();
    wire_reader in(bytes);
    CHECK_THROWS_AS((void)in.answer<nothing>(x), wire_error);
    box const gone{interval_traits<interval>::empty(), hull(2_dec, 3_dec)};
    auto const nothing_left = wire_writer().put(assessment<nothing>{.rest = gone}).take();
    wire_reader read(nothing_left);
    CHECK(is_empty(read.answer<nothing>(x).rest));
    auto const flat = wire_writer().put(gone).take();
    wire_reader sides(flat);
    CHECK_THROWS_AS((void)sides.sides(2), wire_error);
    auto const other = wire_writer().put(x).take();
    wire_reader dimension(other);
    CHECK_THROWS_AS((void)dimension.sides(3), wire_error);
}

TEST_CASE("a length beyond the message asks for no memory") {
    auto const bytes = wire_writer().put(std::uint64_t{1} << 60).take() + std::string(80, 'x');
    for (auto read :
         {+[](wire_reader& in) { (void)in.reals(); }, +[](wire_reader& in) { (void)in.text(); },
          +[](wire_reader& in) { (void)in.proof(); },
          +[](wire_reader& in) { (void)in.sides(2); }}) {
        wire_reader in(bytes);
        CHECK_THROWS_AS(read(in), wire_error);
    }
    auto const two = wire_writer().put(std::uint64_t{2}).take();
    wire_reader in(two);
    CHECK_THROWS_AS((void)in.flag(), wire_error);
}
