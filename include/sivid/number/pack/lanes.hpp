// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_LANES_HPP
#define SIVID_NUMBER_PACK_LANES_HPP

#include <sivid/number/pack/detail/vectors.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace sivid {
inline namespace SIVID_PACK_TARGET {

/// One truth value for each of W lanes.
template <std::size_t W>
class lanes_mask {
public:
    static_assert(W <= 64);
    static constexpr std::uint64_t full = W == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << W) - 1;

    lanes_mask() = default;
    lanes_mask(bool all) : bits_{all ? full : 0} {} // NOLINT: a bool is the same in every lane
    [[nodiscard]] static lanes_mask from_bits(std::uint64_t bits) {
        lanes_mask m;
        m.bits_ = bits & full;
        return m;
    }
    [[nodiscard]] static lanes_mask only(std::size_t lane) {
        return from_bits(std::uint64_t{1} << lane);
    }
    [[nodiscard]] std::uint64_t bits() const { return bits_; }
    [[nodiscard]] bool operator[](std::size_t lane) const { return ((bits_ >> lane) & 1U) != 0; }

    friend lanes_mask operator&(lanes_mask a, lanes_mask b) { return from_bits(a.bits_ & b.bits_); }
    friend lanes_mask operator|(lanes_mask a, lanes_mask b) { return from_bits(a.bits_ | b.bits_); }
    friend lanes_mask operator!(lanes_mask a) { return from_bits(~a.bits_); }
    lanes_mask& operator|=(lanes_mask b) { return *this = *this | b; }
    lanes_mask& operator&=(lanes_mask b) { return *this = *this & b; }
    friend bool operator==(lanes_mask a, lanes_mask b) { return a.bits_ == b.bits_; }

private:
    std::uint64_t bits_ = 0;
};

/// W doubles in vector registers: the coefficient of W Taylor models side by side. Plain floating
/// point, in whatever rounding mode; proofs come from error bounds that hold in each of them.
template <std::size_t W>
class lanes {
    using vector = lanes_detail::vector;

public:
    static_assert(W % lanes_detail::per_vector == 0);
    static constexpr std::size_t parts = W / lanes_detail::per_vector;
    using mask = lanes_mask<W>;

    lanes() = default;
    lanes(double x) { // NOLINT: a number is the same in every lane
        for (auto& p : parts_) p = vector{} + x;
    }
    [[nodiscard]] double operator[](std::size_t lane) const {
        return parts_[lane / lanes_detail::per_vector][lane % lanes_detail::per_vector];
    }
    void set(std::size_t lane, double x) {
        parts_[lane / lanes_detail::per_vector][lane % lanes_detail::per_vector] = x;
    }
    [[nodiscard]] vector const& part(std::size_t p) const { return parts_[p]; }
    [[nodiscard]] vector& part(std::size_t p) { return parts_[p]; }

    lanes& operator+=(lanes const& b) { return *this = *this + b; }
    lanes& operator-=(lanes const& b) { return *this = *this - b; }
    lanes& operator*=(lanes const& b) { return *this = *this * b; }

    [[gnu::always_inline]] friend lanes operator+(lanes const& a, lanes const& b) {
        lanes r;
        for (std::size_t p = 0; p < parts; ++p) r.parts_[p] = a.parts_[p] + b.parts_[p];
        return r;
    }
    [[gnu::always_inline]] friend lanes operator-(lanes const& a, lanes const& b) {
        lanes r;
        for (std::size_t p = 0; p < parts; ++p) r.parts_[p] = a.parts_[p] - b.parts_[p];
        return r;
    }
    [[gnu::always_inline]] friend lanes operator*(lanes const& a, lanes const& b) {
        lanes r;
        for (std::size_t p = 0; p < parts; ++p) r.parts_[p] = a.parts_[p] * b.parts_[p];
        return r;
    }
    [[gnu::always_inline]] friend lanes operator/(lanes const& a, lanes const& b) {
        lanes r;
        for (std::size_t p = 0; p < parts; ++p) r.parts_[p] = a.parts_[p] / b.parts_[p];
        return r;
    }
    [[gnu::always_inline]] friend lanes operator-(lanes const& a) {
        lanes r;
        for (std::size_t p = 0; p < parts; ++p) r.parts_[p] = -a.parts_[p];
        return r;
    }
    [[gnu::always_inline]] friend mask operator<(lanes const& a, lanes const& b) {
        std::uint64_t bits = 0;
        for (std::size_t p = 0; p < parts; ++p) bits |= signs(a.parts_[p] < b.parts_[p], p);
        return mask::from_bits(bits);
    }
    [[gnu::always_inline]] friend mask operator<=(lanes const& a, lanes const& b) {
        std::uint64_t bits = 0;
        for (std::size_t p = 0; p < parts; ++p) bits |= signs(a.parts_[p] <= b.parts_[p], p);
        return mask::from_bits(bits);
    }
    [[gnu::always_inline]] friend mask operator==(lanes const& a, lanes const& b) {
        std::uint64_t bits = 0;
        for (std::size_t p = 0; p < parts; ++p) bits |= signs(a.parts_[p] == b.parts_[p], p);
        return mask::from_bits(bits);
    }
    friend mask operator>(lanes const& a, lanes const& b) { return b < a; }
    friend mask operator>=(lanes const& a, lanes const& b) { return b <= a; }

    [[nodiscard, gnu::always_inline]] static lanes abs(lanes const& a) {
        lanes r;
        for (std::size_t p = 0; p < parts; ++p) {
            auto const bits = lanes_detail::bits_of(a.parts_[p]);
            r.parts_[p] = lanes_detail::vector_of(bits & std::numeric_limits<std::int64_t>::max());
        }
        return r;
    }
    /// The second operand where one of them is NaN.
    [[nodiscard, gnu::always_inline]] static lanes max(lanes const& a, lanes const& b) {
        lanes r;
        for (std::size_t p = 0; p < parts; ++p) {
            r.parts_[p] = a.parts_[p] > b.parts_[p] ? a.parts_[p] : b.parts_[p];
        }
        return r;
    }
    [[nodiscard, gnu::always_inline]] static lanes min(lanes const& a, lanes const& b) {
        lanes r;
        for (std::size_t p = 0; p < parts; ++p) {
            r.parts_[p] = a.parts_[p] < b.parts_[p] ? a.parts_[p] : b.parts_[p];
        }
        return r;
    }
    [[nodiscard, gnu::always_inline]] static lanes select(mask m, lanes const& a, lanes const& b) {
        lanes r;
        for (std::size_t p = 0; p < parts; ++p) {
            auto const bits = static_cast<std::int64_t>(m.bits() >> (p * lanes_detail::per_vector));
            auto const chosen = (lanes_detail::lane_bits() & bits) != 0;
            r.parts_[p] = chosen ? a.parts_[p] : b.parts_[p];
        }
        return r;
    }
    /// a where x is below a limit, else b. NaN is not below.
    [[nodiscard, gnu::always_inline]] static lanes where_below(lanes const& x, double limit,
                                                               lanes const& a, double b) {
        lanes r;
        for (std::size_t p = 0; p < parts; ++p) {
            r.parts_[p] = x.parts_[p] < vector{} + limit ? a.parts_[p] : vector{} + b;
        }
        return r;
    }

private:
    static std::uint64_t signs(lanes_detail::vector_mask m, std::size_t p) {
        return lanes_detail::sign_bits(m) << (p * lanes_detail::per_vector);
    }
    std::array<vector, parts> parts_;
};

} // namespace SIVID_PACK_TARGET

/// What algorithms that run on one number or on several side by side say of their scalar.
template <class C>
struct lane_traits;

template <>
struct lane_traits<double> {
    using mask = bool;
    static constexpr std::size_t count = 1;
    static double get(double x, std::size_t) { return x; }
    static void put(double& x, std::size_t, double value) { x = value; }
    static double select(bool m, double a, double b) { return m ? a : b; }
    static double where_below(double x, double limit, double a, double b) {
        return x < limit ? a : b;
    }
    static double abs(double x) { return std::abs(x); }
    static double max(double a, double b) { return a > b ? a : b; }
    static double min(double a, double b) { return a < b ? a : b; }
    static bool any(bool m) { return m; }
    static bool all(bool m) { return m; }
    static bool test(bool m, std::size_t) { return m; }
    static bool only(std::size_t) { return true; }
};

template <std::size_t W>
struct lane_traits<lanes<W>> {
    using mask = lanes_mask<W>;
    static constexpr std::size_t count = W;
    static double get(lanes<W> const& x, std::size_t lane) { return x[lane]; }
    static void put(lanes<W>& x, std::size_t lane, double value) { x.set(lane, value); }
    static lanes<W> select(mask m, lanes<W> const& a, lanes<W> const& b) {
        return lanes<W>::select(m, a, b);
    }
    static lanes<W> where_below(lanes<W> const& x, double limit, lanes<W> const& a, double b) {
        return lanes<W>::where_below(x, limit, a, b);
    }
    static lanes<W> abs(lanes<W> const& x) { return lanes<W>::abs(x); }
    static lanes<W> max(lanes<W> const& a, lanes<W> const& b) { return lanes<W>::max(a, b); }
    static lanes<W> min(lanes<W> const& a, lanes<W> const& b) { return lanes<W>::min(a, b); }
    static bool any(mask m) { return m.bits() != 0; }
    static bool all(mask m) { return m == mask(true); }
    static bool test(mask m, std::size_t lane) { return m[lane]; }
    static mask only(std::size_t lane) { return mask::only(lane); }
};

/// f applied to each lane.
template <class C, class F>
[[nodiscard]] C each_lane(F const& f) {
    C result{};
    for (std::size_t l = 0; l < lane_traits<C>::count; ++l) lane_traits<C>::put(result, l, f(l));
    return result;
}

/// The power of two next below each lane, to measure in: it makes products without a rounding. 1
/// where a lane is beyond 1e100, below 1e-100 or no number.
template <class C>
[[nodiscard]] C unit_below(C const& x) {
    return each_lane<C>([&](std::size_t l) {
        double const y = lane_traits<C>::get(x, l);
        return y > 1e-100 && y < 1e100 ? std::ldexp(1.0, std::ilogb(y)) : 1.0;
    });
}

} // namespace sivid

#endif
