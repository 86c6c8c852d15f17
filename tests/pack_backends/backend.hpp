// SPDX-License-Identifier: MIT
// What the object of each back end offers to programs that are compiled for any machine of its
// kind. The inline namespaces are those of the packs, so that several back ends fit into one
// program.
#ifndef SIVID_TESTS_PACK_BACKENDS_BACKEND_HPP
#define SIVID_TESTS_PACK_BACKENDS_BACKEND_HPP

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace backends {

struct outcome {
    std::size_t checks = 0;
    std::vector<std::string> failures;
};

/// Bounds of some operations on fixed and random numbers, for comparison between back ends.
using fingerprint = std::vector<std::uint64_t>;

#define SIVID_DECLARE_BACKEND(name)                                                                \
    namespace name {                                                                               \
    outcome check_all();                                                                           \
    fingerprint arithmetic_bits();                                                                 \
    }
SIVID_DECLARE_BACKEND(pack_avx512)
SIVID_DECLARE_BACKEND(pack_avx2)
SIVID_DECLARE_BACKEND(pack_sse2)
SIVID_DECLARE_BACKEND(pack_neon)
SIVID_DECLARE_BACKEND(pack_portable)
SIVID_DECLARE_BACKEND(pack_portable_fma)
#undef SIVID_DECLARE_BACKEND

/// Asked before anything of the back end runs.
inline bool machine_has([[maybe_unused]] std::string const& name) {
#if defined(__x86_64__)
    if (name == "pack_portable_fma") return __builtin_cpu_supports("fma");
    bool const avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (name == "pack_avx2") return avx2;
    if (name == "pack_avx512")
        return avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
#endif
    return true;
}

} // namespace backends

#endif
