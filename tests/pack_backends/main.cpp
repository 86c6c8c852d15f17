// SPDX-License-Identifier: MIT
#include "pack_backends/backend.hpp"

#include <iostream>

#define SIVID_TEXT(x) #x
#define SIVID_TEXT_OF(x) SIVID_TEXT(x)

int main() {
    if (!backends::machine_has(SIVID_TEXT_OF(SIVID_BACKEND))) {
        std::cout << "skipped: this machine lacks the instructions of " SIVID_TEXT_OF(
            SIVID_BACKEND) "\n";
        return 77;
    }
    auto const result = backends::SIVID_BACKEND::check_all();
    std::cout << SIVID_TEXT_OF(SIVID_BACKEND) << ": " << result.checks << " checks, "
              << result.failures.size() << " failures\n";
    for (auto const& failure : result.failures) std::cout << "  " << failure << '\n';
    return result.checks > 100'000 && result.failures.empty() ? 0 : 1;
}
