// SPDX-License-Identifier: MIT
// Compiled or linked with flags that break interval arithmetic: the run-time guard has to throw.
#include <sivid/number/guard.hpp>

#include <iostream>

int main() {
    try {
        sivid::require_sound_environment();
    } catch (sivid::unsound_environment const& e) {
        std::cout << "refused: " << e.what() << '\n';
        return 0;
    }
    std::cout << "accepted\n";
    return 0;
}
