// SPDX-License-Identifier: MIT
#include "pack_backends/backend.hpp"

#include <iostream>

#define SIVID_TEXT(x) #x
#define SIVID_TEXT_OF(x) SIVID_TEXT(x)

namespace {

/// Arithmetic is tight, so its bits are the same with every back end on every machine.
std::uint64_t hash(backends::fingerprint const& bits) {
    std::uint64_t h = 0xcbf29ce484222325;
    for (auto b : bits) h = (h ^ b) * 0x100000001b3;
    return h;
}
constexpr std::uint64_t known = 9867175372350988394u;

} // namespace

int main() {
    if (!backends::machine_has(SIVID_TEXT_OF(SIVID_BACKEND))) {
        std::cout << "skipped: this machine lacks the instructions of " SIVID_TEXT_OF(
            SIVID_BACKEND) "\n";
        return 77;
    }
    auto const result = backends::SIVID_BACKEND::check_all();
    std::cout << SIVID_TEXT_OF(SIVID_BACKEND) << ": " << result.checks << " checks, "
              << result.failures.size() << " failures\n";
    std::uint64_t const bits = hash(backends::SIVID_BACKEND::arithmetic_bits());
    if (bits != known) std::cout << "  arithmetic differs from other machines: " << bits << '\n';
    for (auto const& failure : result.failures) std::cout << "  " << failure << '\n';
    return result.checks > 100'000 && result.failures.empty() && bits == known ? 0 : 1;
}
