// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_INTERVAL_HPP
#define SIVID_NUMBER_INTERVAL_HPP

/// @file
/// The vocabulary type: Boost.Interval over double with a rounding policy that optimisers cannot
/// break, the functions that read it, and its arithmetic.
///
/// A plain double stands for its exact value. The empty set has NaN bounds; an infinite bound means
/// unbounded, infinity itself is never a member.

#include <sivid/number/rounding.hpp>
#include <sivid/number/rounding/detail/machine.hpp>

#include <boost/numeric/interval/arith.hpp>
#include <boost/numeric/interval/checking.hpp>
#include <boost/numeric/interval/compare.hpp>
#include <boost/numeric/interval/interval.hpp>
#include <boost/numeric/interval/policies.hpp>
#include <boost/numeric/interval/rounding.hpp>
#include <boost/numeric/interval/utility.hpp>

#include <bit>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace sivid {

inline namespace SIVID_MACHINE {

#if SIVID_MACHINE_X86_64

/// Rounding policy of Boost.Interval: upward mode of MXCSR set once for each operation, FTZ and DAZ
/// cleared, lower bounds through negation. Operands and results pass through volatile empty
/// assembly between the two changes of the mode, so no compiler can fold, share or move the
/// operation. It has no transcendental functions: Boost's own are unsound with every policy.
class opaque_rounding {
public:
    using rounding_mode = detail::control_word;

    static void get_rounding_mode(rounding_mode& mode) noexcept { mode = detail::read_control(); }
    static void set_rounding_mode(rounding_mode mode) noexcept { detail::write_control(mode); }
    static void upward() noexcept { enter(detail::direction::up); }
    static void downward() noexcept { enter(detail::direction::down); }
    static void to_nearest() noexcept { enter(detail::direction::nearest); }
    static void init() noexcept { upward(); }

    static double add_up(double x, double y) noexcept { return pin(pin(x) + pin(y)); }
    static double sub_up(double x, double y) noexcept { return pin(pin(x) - pin(y)); }
    static double mul_up(double x, double y) noexcept { return pin(pin(x) * pin(y)); }
    static double div_up(double x, double y) noexcept { return pin(pin(x) / pin(y)); }
    static double add_down(double x, double y) noexcept { return -pin(pin(-x) - pin(y)); }
    static double sub_down(double x, double y) noexcept { return -pin(pin(y) - pin(x)); }
    static double mul_down(double x, double y) noexcept { return -pin(pin(x) * pin(-y)); }
    static double div_down(double x, double y) noexcept { return -pin(pin(x) / pin(-y)); }
    static double sqrt_up(double x) noexcept { return pin(detail::plain_sqrt(pin(x))); }
    static double sqrt_down(double x) noexcept {
        downward();
        double const root = pin(detail::plain_sqrt(pin(x)));
        upward();
        return root;
    }
    static double median(double x, double y) noexcept {
        to_nearest();
        double const middle = pin(pin(x) + pin(y)) / 2.0;
        double const result = pin(middle);
        upward();
        return result;
    }
    template <std::integral N>
    static double conv_up(N n) noexcept {
        return converted(n);
    }
    template <std::integral N>
    static double conv_down(N n) noexcept {
        downward();
        double const result = converted(n);
        upward();
        return result;
    }
    // Every float is a double.
    static double conv_up(float x) noexcept { return static_cast<double>(x); }
    static double conv_down(float x) noexcept { return static_cast<double>(x); }
    static double conv_up(double x) noexcept { return x; }
    static double conv_down(double x) noexcept { return x; }

private:
    static double pin(double x) noexcept { return detail::pinned(x); }
    template <std::integral N>
    static double converted(N n) noexcept {
        std::conditional_t<std::unsigned_integral<N>, std::uint64_t, std::int64_t> wide = n;
        wide = static_cast<decltype(wide)>(detail::pinned(static_cast<std::uint64_t>(wide)));
        return pin(static_cast<double>(wide));
    }
    /// All exceptions masked, FTZ and DAZ off. A constant: reading the register is what costs.
    static void enter(detail::direction d) noexcept {
        detail::write_control(0x1f80u | detail::rounding_bits(d));
    }
};

#else

/// Rounding policy of Boost.Interval: every operation finds its directed result in whatever mode,
/// by exact residuals and integers (number/rounding.hpp). Around an operation flushing of
/// subnormals is off, where the machine lets us. It has no transcendental functions: Boost's own
/// are unsound with every policy.
class opaque_rounding {
public:
    using rounding_mode = detail::control_word;

    static void get_rounding_mode(rounding_mode& mode) noexcept { mode = detail::read_control(); }
    static void set_rounding_mode(rounding_mode mode) noexcept {
        if (mode != detail::plain_control(mode)) detail::write_control(mode);
    }
    static void init() noexcept {
        rounding_mode const mode = detail::read_control();
        if (mode != detail::plain_control(mode)) detail::write_control(detail::plain_control(mode));
    }
    static void upward() noexcept {}
    static void downward() noexcept {}
    static void to_nearest() noexcept {}

    static double add_up(double x, double y) noexcept { return detail::add_up(x, y); }
    static double sub_up(double x, double y) noexcept { return detail::add_up(x, -y); }
    static double mul_up(double x, double y) noexcept { return detail::mul_up(x, y); }
    static double div_up(double x, double y) noexcept { return detail::div_up(x, y); }
    static double sqrt_up(double x) noexcept { return detail::sqrt_up(x); }
    static double add_down(double x, double y) noexcept { return detail::add_down(x, y); }
    static double sub_down(double x, double y) noexcept { return detail::add_down(x, -y); }
    static double mul_down(double x, double y) noexcept { return detail::mul_down(x, y); }
    static double div_down(double x, double y) noexcept { return detail::div_down(x, y); }
    static double sqrt_down(double x) noexcept { return detail::sqrt_down(x); }
    static double median(double x, double y) noexcept {
        return detail::pinned(detail::pinned(x) + detail::pinned(y)) / 2.0;
    }
    template <std::integral N>
    static double conv_up(N n) noexcept {
        return converted<detail::direction::up>(n);
    }
    template <std::integral N>
    static double conv_down(N n) noexcept {
        return converted<detail::direction::down>(n);
    }
    // Every float is a double.
    static double conv_up(float x) noexcept { return static_cast<double>(x); }
    static double conv_down(float x) noexcept { return static_cast<double>(x); }
    static double conv_up(double x) noexcept { return x; }
    static double conv_down(double x) noexcept { return x; }

private:
    template <detail::direction D, std::integral N>
    static double converted(N n) noexcept {
        auto const wide = static_cast<std::uint64_t>(n);
        bool const negative = n < N{};
        return detail::exactly_rounded_integer<D>(negative,
                                                  negative ? std::uint64_t{0} - wide : wide);
    }
};

#endif

} // namespace SIVID_MACHINE

} // namespace sivid

namespace sivid {

/// The interval type that users see. `+ - * /` of Boost are sound on it; `interval_traits` is
/// tighter (division), faster, and the way by which the library computes.
using interval =
    boost::numeric::interval<double, boost::numeric::interval_lib::policies<
                                         boost::numeric::interval_lib::save_state<opaque_rounding>,
                                         boost::numeric::interval_lib::checking_base<double>>>;

namespace detail {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double greatest = std::numeric_limits<double>::max();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// [lo, hi] as given, unchecked.
[[gnu::always_inline]] inline interval unchecked_interval(double lo, double hi) noexcept {
    return interval{lo, hi, true};
}
[[gnu::always_inline]] inline interval empty_interval() noexcept {
    return unchecked_interval(not_a_number, not_a_number);
}
[[gnu::always_inline]] inline interval entire_interval() noexcept {
    return unchecked_interval(-infinity, infinity);
}
/// [lo, hi] of bounds that were computed outward. A bound that overflowed to the wrong infinity
/// stands for finite numbers beyond the greatest double.
inline interval bounded(double lo, double hi) noexcept {
    if (!(lo <= hi)) return empty_interval();
    if (lo == infinity) lo = greatest;
    if (hi == -infinity) hi = -greatest;
    return unchecked_interval(lo, hi);
}

/// The same interval, computed where this stands between changes of the control register.
[[gnu::always_inline]] inline interval pinned(interval const& x) noexcept {
    return unchecked_interval(pinned(x.lower()), pinned(x.upper()));
}

/// The rest of a computation in round-to-nearest, whatever the caller's mode; restored at the end.
using nearest_mode = with_rounding<direction::nearest>;

/// f(x...) in round-to-nearest, without FTZ and DAZ, whatever the caller's state. Comparisons
/// belong into f, too: under DAZ a subnormal number equals zero.
template <class F, class... X>
[[gnu::always_inline]] inline interval in_nearest_mode(F const& f, X const&... x) noexcept {
    nearest_mode const mode;
    return pinned(f(pinned(x)...));
}
/// The same for a function that says by its last argument whether its domain was cut.
template <class F, class... X>
[[gnu::always_inline]] inline interval in_nearest_mode_cut(bool& cut, F const& f,
                                                           X const&... x) noexcept {
    nearest_mode const mode;
    bool left = false;
    interval const y = pinned(f(pinned(x)..., left));
    if (pinned(std::uint64_t{left}) != 0) cut = true;
    return y;
}

} // namespace detail

// Reading. Bounds are exact; derived numbers are rounded to the safe side.
inline double lower(interval const& x) noexcept { return x.lower(); }
inline double upper(interval const& x) noexcept { return x.upper(); }
inline bool is_empty(interval const& x) noexcept { return !(x.lower() <= x.upper()); }
inline bool is_point(interval const& x) noexcept { return x.lower() == x.upper(); }
inline bool is_entire(interval const& x) noexcept {
    return x.lower() == -detail::infinity && x.upper() == detail::infinity;
}
/// Non-empty and bounded.
inline bool is_bounded(interval const& x) noexcept {
    return x.lower() > -detail::infinity && x.upper() < detail::infinity;
}

/// A finite number inside x: the nearest to the middle (0 for the whole line, the greatest finite
/// number for a half-line); NaN if x is empty.
inline double mid(interval const& x) noexcept {
    double const lo = x.lower(), hi = x.upper();
    if (is_empty(x)) return detail::not_a_number;
    if (lo == -detail::infinity) return hi == detail::infinity ? 0.0 : -detail::greatest;
    if (hi == detail::infinity) return detail::greatest;
    double const sum = detail::opaque(detail::opaque(lo) + detail::opaque(hi));
    double m = detail::is_infinite(sum) ? 0.5 * lo + 0.5 * hi : 0.5 * sum;
    m = m < lo ? lo : m;
    return m > hi ? hi : m;
}
/// The least double r with x inside [mid(x) - r, mid(x) + r].
inline double rad(interval const& x) noexcept {
    if (is_empty(x)) return detail::not_a_number;
    double const m = mid(x);
    double const below = detail::add_up(m, -x.lower()), above = detail::add_up(x.upper(), -m);
    return below > above ? below : above;
}
/// upper - lower, rounded up.
inline double width(interval const& x) noexcept {
    return is_empty(x) ? detail::not_a_number : detail::add_up(x.upper(), -x.lower());
}
/// The greatest |t| in x.
inline double mag(interval const& x) noexcept {
    double const a = x.lower() < 0.0 ? -x.lower() : x.lower();
    double const b = x.upper() < 0.0 ? -x.upper() : x.upper();
    return a > b ? a : b;
}
/// The least |t| in x.
inline double mig(interval const& x) noexcept {
    if (is_empty(x)) return detail::not_a_number;
    if (x.lower() > 0.0) return x.lower();
    return x.upper() < 0.0 ? -x.upper() : 0.0;
}

// Sets.
inline bool contains(interval const& x, double t) noexcept {
    return x.lower() <= t && t <= x.upper() && !detail::is_infinite(t);
}
/// Every element of a is in b; the empty set is in every set.
inline bool subset(interval const& a, interval const& b) noexcept {
    return is_empty(a) || (b.lower() <= a.lower() && a.upper() <= b.upper());
}
/// a lies in the topological interior of b.
inline bool interior(interval const& a, interval const& b) noexcept {
    if (is_empty(a)) return true;
    bool const below = b.lower() < a.lower() || b.lower() == -detail::infinity;
    bool const above = a.upper() < b.upper() || b.upper() == detail::infinity;
    return below && above && !is_empty(b);
}
inline bool disjoint(interval const& a, interval const& b) noexcept {
    return !(a.lower() <= b.upper() && b.lower() <= a.upper()) || is_empty(a) || is_empty(b);
}
/// The same set.
inline bool equal(interval const& a, interval const& b) noexcept {
    return (is_empty(a) && is_empty(b)) || (a.lower() == b.lower() && a.upper() == b.upper());
}
/// The least interval that contains both.
inline interval hull(interval const& a, interval const& b) noexcept {
    if (is_empty(a)) return b;
    if (is_empty(b)) return a;
    return detail::unchecked_interval(b.lower() < a.lower() ? b.lower() : a.lower(),
                                      b.upper() > a.upper() ? b.upper() : a.upper());
}
/// The common elements.
inline interval intersect(interval const& a, interval const& b) noexcept {
    if (disjoint(a, b)) return detail::empty_interval();
    return detail::unchecked_interval(b.lower() > a.lower() ? b.lower() : a.lower(),
                                      b.upper() < a.upper() ? b.upper() : a.upper());
}
// Comparisons are about all elements: true if certain, false if not (Boost's own throw where
// intervals overlap). `!(a < b)` does not mean `a >= b`; `a != b` means "not certainly equal". Sets
// are compared by `equal` and `subset`.
inline bool operator<(interval const& a, interval const& b) noexcept {
    return a.upper() < b.lower();
}
inline bool operator<=(interval const& a, interval const& b) noexcept {
    return a.upper() <= b.lower();
}
inline bool operator>(interval const& a, interval const& b) noexcept { return b < a; }
inline bool operator>=(interval const& a, interval const& b) noexcept { return b <= a; }
inline bool operator==(interval const& a, interval const& b) noexcept {
    return is_point(a) && a.lower() == b.lower() && a.lower() == b.upper();
}
inline bool operator!=(interval const& a, interval const& b) noexcept { return !(a == b); }

/// A rounded decimal such as 0.10 is not the decimal: write hull(0.10_dec, 0.12_dec), or
/// `interval_traits<interval>::bounds` for two exact doubles.
template <std::floating_point A, std::floating_point B>
interval hull(A, B) = delete;

// Boost's division asks whether the divisor contains zero before it sets the mode; under DAZ a
// subnormal divisor would be zero. The other operators of Boost do not depend on such questions.
// Templates on the policies: deduced, so that nothing is converted to an interval for them.
template <class P>
    requires std::same_as<boost::numeric::interval<double, P>, interval>
        boost::numeric::interval<double, P>
operator/(boost::numeric::interval<double, P> const& x,
          boost::numeric::interval<double, P> const& y) noexcept {
    return detail::in_nearest_mode(
        [](interval const& a, interval const& b) { return boost::numeric::operator/(a, b); }, x, y);
}
template <class P>
    requires std::same_as<boost::numeric::interval<double, P>, interval>
        boost::numeric::interval<double, P>
operator/(boost::numeric::interval<double, P> const& x, double y) noexcept {
    return x / interval{y};
}
template <class P>
    requires std::same_as<boost::numeric::interval<double, P>, interval>
        boost::numeric::interval<double, P>
operator/(double x, boost::numeric::interval<double, P> const& y) noexcept {
    return interval{x} / y;
}

namespace detail {
/// Whether a T stands for one exact number, which `interval{n, n}` or `enclose(n)` encloses.
template <class T>
inline constexpr bool is_exact = std::integral<T>;

/// The tightest interval that contains n, or the interval n.
template <class T>
interval exactly(T const& n) {
    if constexpr (std::integral<T>)
        return {n, n};
    else if constexpr (std::same_as<T, interval>)
        return n;
    else
        return enclose(n);
}
} // namespace detail

/// What has an exact meaning beside an interval: whole numbers, and decimals (decimal.hpp).
template <class T>
concept exact_operand = detail::is_exact<T>;

// Whole numbers beside intervals are exact (or enclosed above 2^53); Boost offers doubles only.
// Templates on the interval, since Boost's implicit constructor would let any type convert to it.
template <std::same_as<interval> I, exact_operand T>
I operator+(I const& x, T n) {
    return x + detail::exactly(n);
}
template <exact_operand T, std::same_as<interval> I>
I operator+(T n, I const& x) {
    return detail::exactly(n) + x;
}
template <std::same_as<interval> I, exact_operand T>
I operator-(I const& x, T n) {
    return x - detail::exactly(n);
}
template <exact_operand T, std::same_as<interval> I>
I operator-(T n, I const& x) {
    return detail::exactly(n) - x;
}
template <std::same_as<interval> I, exact_operand T>
I operator*(I const& x, T n) {
    return x * detail::exactly(n);
}
template <exact_operand T, std::same_as<interval> I>
I operator*(T n, I const& x) {
    return detail::exactly(n) * x;
}
template <std::same_as<interval> I, exact_operand T>
I operator/(I const& x, T n) {
    return x / detail::exactly(n);
}
template <exact_operand T, std::same_as<interval> I>
I operator/(T n, I const& x) {
    return detail::exactly(n) / x;
}

} // namespace sivid

/// An interval has no smallest or greatest value and no precision: algorithms that use such numbers
/// as thresholds for neglecting something get 0.
template <>
class std::numeric_limits<sivid::interval> {
public:
    static constexpr bool is_specialized = false, is_integer = false, is_signed = true,
                          is_exact = false;
    static constexpr bool is_iec559 = false, is_bounded = false, has_infinity = false;
    static constexpr bool has_quiet_NaN = false, has_signaling_NaN = false, is_modulo = false;
    static constexpr int digits = 53, digits10 = 15, max_digits10 = 17, radix = 2;
    static constexpr std::float_round_style round_style = std::round_indeterminate;
    static sivid::interval(min)() noexcept { return {}; }
    static sivid::interval(max)() noexcept { return {}; }
    static sivid::interval lowest() noexcept { return {}; }
    static sivid::interval epsilon() noexcept { return {}; }
    static sivid::interval round_error() noexcept { return {}; }
    static sivid::interval denorm_min() noexcept { return {}; }
    static sivid::interval infinity() noexcept { return {}; }
    // NOLINTNEXTLINE(readability-identifier-naming): the standard's name
    static sivid::interval quiet_NaN() noexcept { return {}; }
};

// ---- Tight interval arithmetic on the vocabulary type: every bound is the nearest double on its
// side. Set semantics of IEEE 1788: 0 * inf = 0, operations on the empty set are empty, a divisor
// that contains zero gives the hull of the quotients that exist.

namespace sivid::detail {

inline namespace SIVID_ROUNDING_KERNELS {

inline interval neg(interval const& x) noexcept {
    return unchecked_interval(-x.upper(), -x.lower());
}

[[gnu::always_inline]] inline interval add(interval const& x, interval const& y) noexcept {
    return unchecked_interval(add_down(x.lower(), y.lower()), add_up(x.upper(), y.upper()));
}

[[gnu::always_inline]] inline interval sub(interval const& x, interval const& y) noexcept {
    return unchecked_interval(add_down(x.lower(), -y.upper()), add_up(x.upper(), -y.lower()));
}

#if SIVID_EMBEDDED_ROUNDING

/// All four products at once: lanes 0 to 3 hold x y, lanes 4 to 7 hold x (-y), both rounded upward;
/// the greatest of each half are the upper bound and minus the lower bound. (The zero-masking forms
/// of the intrinsics keep g++ from warning about its own header.)
inline interval mul(interval const& x, interval const& y) noexcept {
    if (is_empty(x) || is_empty(y)) [[unlikely]]
        return empty_interval();
    constexpr __mmask8 all = 0xff;
    __m512d const xx = _mm512_zextpd128_pd512(_mm_set_pd(opaque(x.upper()), opaque(x.lower())));
    __m512d const yy = _mm512_zextpd128_pd512(_mm_set_pd(opaque(y.upper()), opaque(y.lower())));
    __m512d const a =
        _mm512_maskz_permutexvar_pd(all, _mm512_set_epi64(1, 1, 0, 0, 1, 1, 0, 0), xx);
    __m512d const b =
        _mm512_maskz_permutexvar_pd(all, _mm512_set_epi64(1, 0, 1, 0, 1, 0, 1, 0), yy);
    constexpr auto minus = std::bit_cast<long long>(sign_bit);
    __m512d const c = _mm512_castsi512_pd(_mm512_xor_si512(
        _mm512_castpd_si512(b), _mm512_set_epi64(minus, minus, minus, minus, 0, 0, 0, 0)));
    __m512d p = _mm512_maskz_mul_round_pd(all, a, c, embedded<direction::up>);
    p = _mm512_maskz_mov_pd(_mm512_cmp_pd_mask(p, p, _CMP_ORD_Q), p);
    p = _mm512_maskz_max_pd(all, p, _mm512_maskz_permute_pd(all, p, 0x55));
    p = _mm512_maskz_max_pd(all, p, _mm512_maskz_permutex_pd(all, p, 0x4e));
    double const hi = _mm512_cvtsd_f64(p);
    double const minus_lo = _mm256_cvtsd_f64(_mm512_maskz_extractf64x4_pd(all, p, 1));
    return unchecked_interval(-minus_lo, hi);
}

#else

/// Two products a_i b_i as [a_0 b_0 rounded down, a_1 b_1 rounded up]; 0 * inf is 0.
[[gnu::always_inline]] inline interval products(std::uint64_t a0, std::uint64_t b0,
                                                std::uint64_t a1, std::uint64_t b1) noexcept {
#if SIVID_MACHINE_X86_64
    std::uint64_t const minus_a0 = a0 ^ sign_bit;
    __m128d const up =
        mul_up_pair(_mm_set_pd(std::bit_cast<double>(a1), std::bit_cast<double>(minus_a0)),
                    _mm_set_pd(std::bit_cast<double>(b1), std::bit_cast<double>(b0)));
    return unchecked_interval(-_mm_cvtsd_f64(up), _mm_cvtsd_f64(_mm_unpackhi_pd(up, up)));
#else
    auto const x0 = std::bit_cast<double>(a0), y0 = std::bit_cast<double>(b0);
    auto const x1 = std::bit_cast<double>(a1), y1 = std::bit_cast<double>(b1);
    return unchecked_interval(is_zero(x0) || is_zero(y0) ? 0.0 : mul_down(x0, y0),
                              is_zero(x1) || is_zero(y1) ? 0.0 : mul_up(x1, y1));
#endif
}

/// Unless both factors have both signs, the end points that make the lower bound are given by two
/// signs (the upper bound is minus the lower bound of x (-y)):
///   from x: the upper end if y_l < 0 (if y_u < 0 where x <= 0), else the lower end; from y
///   likewise.
/// Signs are sign bits: a zero counts as a tiny number of its sign, which selects products with the
/// same limit. Selection is by masks, since signs of operands cannot be predicted.
inline interval mul(interval const& x, interval const& y) noexcept {
    if (is_empty(x) || is_empty(y)) [[unlikely]]
        return empty_interval();
    std::uint64_t const xl = bits(x.lower()), xu = bits(x.upper());
    std::uint64_t const yl = bits(y.lower()), yu = bits(y.upper());
    auto const negative = [](std::uint64_t b) {
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(b) >> 63);
    };
    auto const select = [](std::uint64_t mask, std::uint64_t a, std::uint64_t b) {
        return (a & mask) | (b & ~mask);
    };
    std::uint64_t const nxl = negative(xl), nxu = negative(xu), nyl = negative(yl),
                        nyu = negative(yu);
    if ((nxl & ~nxu & nyl & ~nyu) != 0) {
        interval const p = products(xl, yu, xl, yl), q = products(xu, yl, xu, yu);
        return unchecked_interval(p.lower() < q.lower() ? p.lower() : q.lower(),
                                  p.upper() > q.upper() ? p.upper() : q.upper());
    }
    return products(select(select(nxu, nyu, nyl), xu, xl), select(select(nyu, nxu, nxl), yu, yl),
                    select(select(nxu, nyl, nyu), xl, xu), select(select(nyl, nxl, nxu), yl, yu));
}

#endif

inline interval sqr(interval const& x) noexcept {
    if (is_empty(x)) [[unlikely]]
        return empty_interval();
    double const least = mig(x), most = mag(x);
#if SIVID_EMBEDDED_ROUNDING
    return unchecked_interval(mul_down(least, least), mul_up(most, most));
#else
    return products(bits(least), bits(least), bits(most), bits(most));
#endif
}

/// Quotients x/y with y in Y, y != 0; `undefined` if Y contains 0 (and X is not empty).
inline interval div(interval const& x, interval const& y, bool& undefined) noexcept {
    if (is_empty(x) || is_empty(y)) return empty_interval();
    double const xl = x.lower(), xu = x.upper(), yl = y.lower(), yu = y.upper();
    if (yl <= 0.0 && yu >= 0.0) {
        undefined = true;
        if (is_zero(yl) && is_zero(yu)) return empty_interval();
        if (is_zero(xl) && is_zero(xu)) return unchecked_interval(0.0, 0.0);
        if ((yl < 0.0 && yu > 0.0) || (xl < 0.0 && xu > 0.0)) return entire_interval();
        // One end of y is zero, x is on one side: a half-line from the quotient nearest to zero.
        bool const positive = (xl >= 0.0) == (yu > 0.0);
        double const nearest_x = xl >= 0.0 ? xl : xu, farthest_y = yu > 0.0 ? yu : yl;
        // An infinite divisor or zero numerator brings the quotients down to 0.
        if (is_zero(nearest_x) || is_infinite(farthest_y))
            return positive ? unchecked_interval(0.0, infinity)
                            : unchecked_interval(-infinity, 0.0);
        return positive ? unchecked_interval(div_down(nearest_x, farthest_y), infinity)
                        : unchecked_interval(-infinity, div_up(nearest_x, farthest_y));
    }
    double a, b, c, d; // the result is [a/b, c/d]
    if (yl > 0.0) {
        a = xl;
        b = xl >= 0.0 ? yu : yl;
        c = xu;
        d = xu >= 0.0 ? yl : yu;
    } else {
        a = xu;
        b = xu >= 0.0 ? yu : yl;
        c = xl;
        d = xl >= 0.0 ? yl : yu;
    }
    return unchecked_interval(div_down(a, b), div_up(c, d));
}

} // namespace SIVID_ROUNDING_KERNELS

} // namespace sivid::detail

#endif
