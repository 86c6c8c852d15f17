// SPDX-License-Identifier: MIT
// The processor's own switches for flushing subnormals, whichever way sivid was compiled for it.
#ifndef SIVID_TESTS_SUPPORT_FLUSHING_HPP
#define SIVID_TESTS_SUPPORT_FLUSHING_HPP

#include <cstdint>
#include <vector>
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace flushing {

#if defined(__x86_64__)
using word = std::uint32_t;
inline constexpr word rounding = 0x6000;
[[gnu::always_inline]] inline word read() { return _mm_getcsr(); }
[[gnu::always_inline]] inline void write(word w) { _mm_setcsr(w); }
/// Flush to zero, denormals are zero.
inline std::vector<word> switches() { return {0x8000, 0x0040}; }
#elif defined(__aarch64__)
using word = std::uint64_t;
inline constexpr word rounding = 0xC0'0000;
[[gnu::always_inline]] inline word read() {
    word w;
    asm volatile("mrs %0, fpcr" : "=r"(w) : : "memory");
    return w;
}
[[gnu::always_inline]] inline void write(word w) {
    asm volatile("msr fpcr, %0" : : "r"(w) : "memory");
}
/// Both at once.
inline std::vector<word> switches() { return {0x100'0000}; }
#else
using word = std::uint32_t;
inline constexpr word rounding = 0;
inline word read() { return 0; }
inline void write(word) {}
inline std::vector<word> switches() { return {}; }
#endif

/// All switches at once.
inline word all() {
    word result = 0;
    for (word w : switches()) result |= w;
    return result;
}
/// Each switch, and all of them.
inline std::vector<word> combinations() {
    auto result = switches();
    if (result.size() > 1) result.push_back(all());
    return result;
}

/// The caller's state while this lives.
class state {
public:
    explicit state(word flags) : before_{read()} { write(before_ | flags); }
    ~state() { write(before_); }
    state(state const&) = delete;
    state& operator=(state const&) = delete;

private:
    word before_;
};

} // namespace flushing

#endif
