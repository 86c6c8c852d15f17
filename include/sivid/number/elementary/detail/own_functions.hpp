// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ELEMENTARY_DETAIL_OWN_FUNCTIONS_HPP
#define SIVID_NUMBER_ELEMENTARY_DETAIL_OWN_FUNCTIONS_HPP

/// @file
/// Elementary functions at one number with proved bounds and without the C library: the kernels of
/// packs in one lane, arguments of sin, cos and tan beyond their limit reduced in integers, powers
/// in integers, and what follows from these by directed arithmetic (docs/pack_functions.md, section
/// 11). All are given round-to-nearest.

#include <sivid/number/elementary/detail/own_power.hpp>
#include <sivid/number/elementary/detail/own_turns.hpp>
#include <sivid/number/pack/detail/pack_arctangent.hpp>
#include <sivid/number/pack/detail/pack_logarithm.hpp>
#include <sivid/number/pack/detail/pack_portable.hpp>
#include <sivid/number/pack/detail/pack_trigonometric.hpp>
#include <sivid/number/rounding.hpp>

#include <limits>

namespace sivid::detail::own {
inline namespace SIVID_PACK_TARGET {

struct bounds_at {
    double lower, upper;
};

using lane = simd::vector_portable;

/// A kernel's operations stay between the changes of the mode around them.
template <class Kernel>
[[nodiscard]] double in_lane(Kernel const& kernel, double x) noexcept {
    return detail::pinned(kernel(lane(detail::pinned(x))).raw());
}

struct exp {
    static double down(double x) noexcept { return in_lane(simd::exp_lower<lane>, x); }
    static double up(double x) noexcept { return in_lane(simd::exp_upper<lane>, x); }
};
struct expm1 {
    static double down(double x) noexcept { return in_lane(simd::expm1_lower<lane>, x); }
    static double up(double x) noexcept { return in_lane(simd::expm1_upper<lane>, x); }
};
struct log {
    static double down(double x) noexcept { return in_lane(simd::log_lower<lane>, x); }
    static double up(double x) noexcept { return in_lane(simd::log_upper<lane>, x); }
};
struct log1p {
    static double down(double x) noexcept { return in_lane(simd::log1p_lower<lane>, x); }
    static double up(double x) noexcept { return in_lane(simd::log1p_upper<lane>, x); }
};
struct asin {
    static double down(double x) noexcept { return in_lane(simd::asin_lower<lane>, x); }
    static double up(double x) noexcept { return in_lane(simd::asin_upper<lane>, x); }
};
struct acos {
    static double down(double x) noexcept { return in_lane(simd::acos_lower<lane>, x); }
    static double up(double x) noexcept { return in_lane(simd::acos_upper<lane>, x); }
};
struct atan {
    static double down(double x) noexcept { return in_lane(simd::atan_lower<lane>, x); }
    static double up(double x) noexcept { return in_lane(simd::atan_upper<lane>, x); }
};
struct sinh {
    static double down(double x) noexcept { return in_lane(simd::sinh_lower<lane>, x); }
    static double up(double x) noexcept { return in_lane(simd::sinh_upper<lane>, x); }
};
/// For x >= 0.
struct cosh {
    static double down(double x) noexcept { return in_lane(simd::cosh_lower<lane>, x); }
    static double up(double x) noexcept { return in_lane(simd::cosh_upper<lane>, x); }
};
struct tanh {
    static double down(double x) noexcept { return in_lane(simd::tanh_lower<lane>, x); }
    static double up(double x) noexcept { return in_lane(simd::tanh_upper<lane>, x); }
};

[[nodiscard]] inline bool is_far(double x) noexcept {
    return !(x >= -simd::trigonometric_limit && x <= simd::trigonometric_limit);
}
/// What the kernels take, of |x| where x is far.
[[nodiscard]] inline simd::turn_argument<lane> turns_of(double x, bool far) noexcept {
    if (!far) return simd::reduce_turns(lane(detail::pinned(x)));
    reduced_turns const a = reduce_far(x);
    return {lane(0x1.8p52 + static_cast<double>(a.k)), lane(detail::pinned(a.head)),
            lane(detail::pinned(a.tail))};
}
/// sin(x + shift pi/2); x may be infinite.
[[nodiscard]] inline bounds_at sine(double x, double shift) noexcept {
    bool const far = is_far(x);
    if (far && !is_finite_other_than_zero(x)) return {-1.0, 1.0};
    simd::turn_argument<lane> const a = turns_of(x, far);
    if (far && is_zero(a.r.raw())) return {-1.0, 1.0};
    simd::bounds<lane> const y = simd::wave_bounds(a, shift);
    bounds_at const result{detail::pinned(y.lo.raw()), detail::pinned(y.hi.raw())};
    bool const turned = far && x < 0.0 && shift == 0.0;
    return turned ? bounds_at{-result.upper, -result.lower} : result;
}
struct sin {
    static bounds_at both(double x) noexcept { return sine(x, 0.0); }
};
struct cos {
    static bounds_at both(double x) noexcept { return sine(x, 1.0); }
};
struct tan {
    static bounds_at both(double x) noexcept {
        constexpr double delta = simd::kernel_error::tan * simd::unit_roundoff;
        bool const far = is_far(x);
        if (far && !is_finite_other_than_zero(x)) return {-infinite, infinite};
        simd::turn_argument<lane> const a = turns_of(x, far);
        if (far && is_zero(a.r.raw())) return {-infinite, infinite};
        simd::expansion<lane> const y = simd::tan_kernel(a);
        double const lo = detail::pinned(simd::lower_bound_of_any(y, delta).raw());
        double const hi = detail::pinned(simd::upper_bound_of_any(y, delta).raw());
        return far && x < 0.0 ? bounds_at{-hi, -lo} : bounds_at{lo, hi};
    }
    static double down(double x) noexcept { return both(x).lower; }
    static double up(double x) noexcept { return both(x).upper; }

private:
    static constexpr double infinite = std::numeric_limits<double>::infinity();
};

// ln 2 between neighbours, as half_pi and pi below.
inline constexpr double ln2_down = 0x1.62e42fefa39efp-1, ln2_up = 0x1.62e42fefa39f0p-1;
/// From here on area functions are ln 2x, but for less than 2^-59.
inline constexpr double area_limit = 0x1p30;

/// ln(x + sqrt(x^2 + 1)) = ln(1 + a) with a = x + x^2/(1 + sqrt(1 + x^2)); odd. For large x less
/// than 1/(4 x^2) is added to ln 2x.
struct asinh {
    static double down(double x) noexcept { return x < 0.0 ? -positive_up(-x) : positive_down(x); }
    static double up(double x) noexcept { return x < 0.0 ? -positive_down(-x) : positive_up(x); }

private:
    static double positive_down(double x) noexcept {
        if (x >= area_limit) return add_down(log::down(x), ln2_down);
        double const divisor = add_up(1.0, sqrt_up(add_up(1.0, mul_up(x, x))));
        return log1p::down(add_down(x, div_down(mul_down(x, x), divisor)));
    }
    static double positive_up(double x) noexcept {
        if (x >= area_limit) return add_up(add_up(log::up(x), ln2_up), 0x1p-59);
        double const divisor = add_down(1.0, sqrt_down(add_down(1.0, mul_down(x, x))));
        double const y = log1p::up(add_up(x, div_up(mul_up(x, x), divisor)));
        return y > x ? x : y;
    }
};
/// ln(x + sqrt(x^2 - 1)) = ln(1 + a) with a = x - 1 + sqrt((x - 1)(x + 1)), for x >= 1. For large x
/// less than 1/x^2 is missing from ln 2x.
struct acosh {
    static double down(double x) noexcept {
        if (x >= area_limit) return add_down(add_down(log::down(x), ln2_down), -0x1p-59);
        double const below = add_down(x, -1.0);
        return log1p::down(add_down(below, sqrt_down(mul_down(below, add_down(x, 1.0)))));
    }
    static double up(double x) noexcept {
        if (x >= area_limit) return add_up(log::up(x), ln2_up);
        double const below = add_up(x, -1.0);
        return log1p::up(add_up(below, sqrt_up(mul_up(below, add_up(x, 1.0)))));
    }
};
/// ln((1 + x)/(1 - x))/2 = ln(1 + 2x/(1 - x))/2, for -1 < x < 1; odd.
struct atanh {
    static double down(double x) noexcept { return x < 0.0 ? -positive_up(-x) : positive_down(x); }
    static double up(double x) noexcept { return x < 0.0 ? -positive_down(-x) : positive_up(x); }

private:
    static double positive_down(double x) noexcept {
        double const y = mul_down(0.5, log1p::down(div_down(2.0 * x, add_up(1.0, -x))));
        return y < x ? x : y;
    }
    static double positive_up(double x) noexcept {
        return mul_up(0.5, log1p::up(div_up(2.0 * x, add_down(1.0, -x))));
    }
};

/// The angle of (x, y) for finite y > 0, x != 0: arctan(y/x), on the left pi less that of (-x, y).
struct atan2 {
    static double down(double y, double x) noexcept {
        if (x > 0.0) return atan::down(div_down(y, x));
        return add_down(0x1.921fb54442d18p+1, -atan::up(div_up(y, -x)));
    }
    static double up(double y, double x) noexcept {
        if (x > 0.0) return atan::up(div_up(y, x));
        return add_up(0x1.921fb54442d19p+1, -atan::down(div_down(y, -x)));
    }
};

/// x^y for x > 0 other than 1, y != 0 finite.
struct pow {
    static double down(double x, double y) noexcept {
        if (is_infinite(x)) return y < 0.0 ? 0.0 : std::numeric_limits<double>::max();
        return power<direction::down>(x, y);
    }
    static double up(double x, double y) noexcept {
        if (is_infinite(x)) return y < 0.0 ? std::numeric_limits<double>::denorm_min() : x;
        return power<direction::up>(x, y);
    }
    static bounds_at both(double x, double y) noexcept { return {down(x, y), up(x, y)}; }
};

} // namespace SIVID_PACK_TARGET
} // namespace sivid::detail::own

#endif
