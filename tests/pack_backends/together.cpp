// SPDX-License-Identifier: MIT
// All back ends in one program: the linker must not have merged their functions, and arithmetic,
// being tight, has the same bits in each.
#include "pack_backends/backend.hpp"

#include <iostream>

int main() {
    // Inline functions that do not belong to packs may have been merged in their AVX-512 form.
    if (!backends::machine_has("pack_avx512")) {
        std::cout << "skipped: this machine lacks AVX-512\n";
        return 77;
    }
    int failures = 0;
    auto const expected = backends::pack_sse2::arithmetic_bits();
    auto const compare = [&](char const* name, backends::fingerprint const& bits,
                             backends::outcome const& checked) {
        if (bits != expected || bits.size() < 10'000) {
            std::cout << name << " differs from pack_sse2\n";
            ++failures;
        }
        for (auto const& failure : checked.failures) {
            std::cout << name << ": " << failure << '\n';
            ++failures;
        }
    };
    compare("pack_sse2", expected, backends::pack_sse2::check_all());
    compare("pack_avx2", backends::pack_avx2::arithmetic_bits(), backends::pack_avx2::check_all());
    compare("pack_avx512", backends::pack_avx512::arithmetic_bits(),
            backends::pack_avx512::check_all());
    return failures == 0 ? 0 : 1;
}
