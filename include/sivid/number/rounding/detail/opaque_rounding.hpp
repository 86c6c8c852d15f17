// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ROUNDING_DETAIL_OPAQUE_ROUNDING_HPP
#define SIVID_NUMBER_ROUNDING_DETAIL_OPAQUE_ROUNDING_HPP

/// @file
/// The rounding policy with which Boost.Interval is sound: by the control register on x86-64, by
/// exact residuals elsewhere.

#include <sivid/number/rounding.hpp>

#include <concepts>
#include <cstdint>
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

#endif
