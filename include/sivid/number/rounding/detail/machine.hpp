// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ROUNDING_DETAIL_MACHINE_HPP
#define SIVID_NUMBER_ROUNDING_DETAIL_MACHINE_HPP

/// @file
/// All that sivid knows of a processor besides its vectors: how a value is hidden from the
/// optimiser, and the control register that holds the rounding mode and flushes subnormals.
///
/// | machine                      | values are hidden by      | control               |
/// |------------------------------|---------------------------|-----------------------|
/// | x86-64                       | empty assembly statements | MXCSR                 |
/// | ARM64 with vectors           | empty assembly statements | FPCR                  |
/// | any other of IEEE 754 binary64 | volatile variables      | `std::fesetround`     |
///
/// The last needs neither assembler nor a header of the processor, and is chosen on any machine by
/// `SIVID_PORTABLE_ARITHMETIC` (the same in all files of a program: `interval` is another type).
///
/// Builds in which interval arithmetic would not prove anything are refused here.

#include <cfenv>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#if defined(__FAST_MATH__)
#error "sivid: -ffast-math breaks every inclusion; compile without it"
#endif
#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ != 0
#error "sivid: -ffinite-math-only removes infinities and the empty interval; compile without it"
#endif
#if defined(__ASSOCIATIVE_MATH__)
#error "sivid: -fassociative-math breaks exact residuals; compile without it"
#endif
#if defined(__RECIPROCAL_MATH__)
#error "sivid: -freciprocal-math replaces divisions; compile without it"
#endif
#if defined(__NO_SIGNED_ZEROS__)
#error "sivid: -fno-signed-zeros is part of fast-math; compile without it"
#endif
#if defined(_M_FP_FAST)
#error "sivid: /fp:fast breaks every inclusion; compile without it"
#endif
#if (defined(__x86_64__) || defined(__i386__)) && !defined(__SSE2_MATH__)
#error "sivid: x87 arithmetic rounds twice; compile with -mfpmath=sse"
#endif
#if defined(__MINGW32__) && defined(__AVX__) && !defined(__clang__)
#error "sivid: g++ for Windows misaligns vectors of AVX (GCC bug 54412); compile for SSE2"
#endif
#if !defined(FLT_EVAL_METHOD) || FLT_EVAL_METHOD != 0
#error "sivid: doubles must be evaluated as doubles (FLT_EVAL_METHOD == 0)"
#endif

namespace sivid {

static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<double>::digits == 53);
static_assert(sizeof(double) == 8 && sizeof(void*) == 8, "sivid: a 64-bit machine is needed");

/// The machine's floating-point state, or the way this file was compiled, makes proofs impossible.
class unsound_environment : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

} // namespace sivid

#if defined(SIVID_PORTABLE_ARITHMETIC)
#define SIVID_MACHINE portable
#elif defined(__x86_64__)
#define SIVID_MACHINE_X86_64 1
#define SIVID_MACHINE x86_64
#elif defined(__aarch64__) && defined(__ARM_NEON) && !defined(__AARCH64EB__)
#define SIVID_MACHINE_ARM64 1
#define SIVID_MACHINE arm64
#else
#define SIVID_MACHINE portable
#endif
#ifndef SIVID_MACHINE_X86_64
#define SIVID_MACHINE_X86_64 0
#endif
#ifndef SIVID_MACHINE_ARM64
#define SIVID_MACHINE_ARM64 0
#endif

/// The assembler's name for a register of floating-point numbers, in and out.
#if SIVID_MACHINE_X86_64
#define SIVID_REGISTER "+x"
#elif SIVID_MACHINE_ARM64
#define SIVID_REGISTER "+w"
#endif

/// Whether a product and a sum rounded once are one instruction. SIVID_UNFUSED: no such instruction
/// and no embedded rounding is used, so that the machines with and without them have the same bits
/// (with -ffp-contract=off): libsivid, which is compiled for several.
#if defined(SIVID_UNFUSED)
#define SIVID_FUSED 0
#elif defined(__FMA__) || defined(__FP_FAST_FMA) || defined(__ARM_FEATURE_FMA)
#define SIVID_FUSED 1
#else
#define SIVID_FUSED 0
#endif

#if SIVID_MACHINE_X86_64
#include <xmmintrin.h>
#endif

namespace sivid::detail {

enum class direction : unsigned { nearest = 0, down = 1, up = 2 };

inline namespace SIVID_MACHINE {

#if defined(SIVID_REGISTER)

/// The same value, about which the optimiser knows nothing: no folding, contraction, reassociation
/// across it.
[[gnu::always_inline]] inline double opaque(double x) noexcept {
    asm("" : SIVID_REGISTER(x));
    return x;
}
/// As `opaque`, and it stays where it stands between changes of the rounding mode.
[[gnu::always_inline]] inline double pinned(double x) noexcept {
    asm volatile("" : SIVID_REGISTER(x) : : "memory");
    return x;
}
[[gnu::always_inline]] inline std::uint64_t pinned(std::uint64_t x) noexcept {
    asm volatile("" : "+r"(x) : : "memory");
    return x;
}

#else

// Accesses to volatile objects are made as written, in their order, and before and after the calls
// that change the mode; what was read may be any value.
inline double opaque(double x) noexcept {
    double volatile kept = x;
    return kept;
}
inline double pinned(double x) noexcept { return opaque(x); }
inline std::uint64_t pinned(std::uint64_t x) noexcept {
    std::uint64_t volatile kept = x;
    return kept;
}

#endif

#if SIVID_FUSED
/// a b + c by one instruction, without optimisation too.
[[gnu::always_inline]] inline double fused(double a, double b, double c) noexcept {
#if defined(__GNUC__)
    return __builtin_fma(a, b, c);
#else
    return std::fma(a, b, c);
#endif
}
#endif

/// Neither flushed nor read as zero.
[[nodiscard]] inline bool subnormals_are_kept() noexcept {
    double const least = opaque(std::numeric_limits<double>::denorm_min());
    return opaque(least + least) != 0.0;
}

#if SIVID_MACHINE_X86_64

using control_word = unsigned;
inline constexpr control_word control_rounding = 0x6000; ///< 00 nearest, 01 down, 10 up, 11 to zero
inline constexpr control_word control_flush = 0x8040;    ///< FTZ (bit 15) and DAZ (bit 6)

[[nodiscard]] constexpr control_word rounding_bits(direction d) noexcept {
    return static_cast<control_word>(d) << 13;
}
[[gnu::always_inline]] inline control_word read_control() noexcept {
    control_word value;
    asm volatile("stmxcsr %0" : "=m"(value) : : "memory");
    return value;
}
[[gnu::always_inline]] inline void write_control(control_word value) noexcept {
    asm volatile("ldmxcsr %0" : : "m"(value) : "memory");
}
[[gnu::always_inline]] inline double plain_sqrt(double a) noexcept {
    double root;
    asm volatile("sqrtsd %1, %0" : "=x"(root) : "x"(a) : "memory");
    return root;
}
/// Round-to-nearest is set and subnormals are kept.
[[gnu::always_inline]] inline bool control_is_plain() noexcept {
    return (_mm_getcsr() & (control_rounding | control_flush)) == 0;
}

#else

/// Faithful in every mode.
[[gnu::always_inline]] inline double plain_sqrt(double a) noexcept {
    return pinned(std::sqrt(pinned(a)));
}

#if SIVID_MACHINE_ARM64

using control_word = std::uint64_t;
inline constexpr control_word control_rounding = 0xC0'0000; ///< 00 nearest, 01 up, 10 down, 11 zero
/// FZ (bit 24), which reads subnormals as zero as well; FIZ (bit 0) since ARMv8.7.
inline constexpr control_word control_flush = 0x100'0001;

[[nodiscard]] constexpr control_word rounding_bits(direction d) noexcept {
    return d == direction::up ? 0x40'0000 : d == direction::down ? 0x80'0000 : 0;
}
[[gnu::always_inline]] inline control_word read_control() noexcept {
    control_word value;
    asm volatile("mrs %0, fpcr" : "=r"(value) : : "memory");
    return value;
}
[[gnu::always_inline]] inline void write_control(control_word value) noexcept {
    asm volatile("msr fpcr, %0" : : "r"(value) : "memory");
}
[[gnu::always_inline]] inline bool control_is_plain() noexcept {
    return (read_control() & (control_rounding | control_flush)) == 0;
}

#else

/// A mode of `cfenv`. Flushing cannot be seen in it, only in its effect, and not be turned off.
using control_word = int;
inline constexpr control_word control_rounding = -1, control_flush = 0;

[[nodiscard]] constexpr control_word rounding_bits(direction) noexcept { return FE_TONEAREST; }
inline control_word read_control() noexcept { return std::fegetround(); }
inline void write_control(control_word value) noexcept { std::fesetround(value); }
inline bool control_is_plain() noexcept {
    return read_control() == FE_TONEAREST && subnormals_are_kept();
}

#endif
#endif

/// Whether this state of the machine rounds to nearest.
[[nodiscard]] inline bool rounds_to_nearest(control_word c) noexcept {
    return (c & control_rounding) == rounding_bits(direction::nearest);
}

/// This state with round-to-nearest, and subnormals kept where the machine lets us.
[[nodiscard]] constexpr control_word plain_control(control_word c) noexcept {
    return (c & ~(control_rounding | control_flush)) | rounding_bits(direction::nearest);
}

/// Sets a rounding direction, clears FTZ and DAZ where the machine lets us, and puts the caller's
/// state back at the end.
template <direction D>
class with_rounding {
    static_assert(SIVID_MACHINE_X86_64 || D == direction::nearest,
                  "directed rounding needs no mode elsewhere: number/rounding.hpp");

public:
    with_rounding() noexcept : saved_{read_control()} {
        control_word const wanted =
            (saved_ & ~(control_rounding | control_flush)) | rounding_bits(D);
        changed_ = wanted != saved_;
        if (changed_) write_control(wanted);
    }
    ~with_rounding() {
        if (changed_) write_control(saved_);
    }
    with_rounding(with_rounding const&) = delete;
    with_rounding& operator=(with_rounding const&) = delete;

private:
    control_word saved_;
    bool changed_;
};

} // namespace SIVID_MACHINE

} // namespace sivid::detail

#endif
