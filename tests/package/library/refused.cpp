// SPDX-License-Identifier: MIT
// What libsivid throws is caught by its type in the program.
#include <sivid/enclosure/enclose.hpp>

#include <array>
#include <cfenv>
#include <iostream>

using namespace sivid;

struct decay {
    static constexpr auto name = "decay";
    static constexpr auto states = sivid::states({{"x", "m", 7}});
    static constexpr auto inputs = no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "m"}});
    static constexpr auto constants = sivid::constants({{"k", "1/s", 1_dec}});
    auto rate(auto const&, auto const& x, auto const& k, auto const&) const {
        return std::array{-k[0] * x[0]};
    }
    auto observe(auto const&, auto const& x, auto const&, auto const&) const { return x; }
};

int main() {
    auto const model = record_model<decay>();
    std::fesetround(FE_UPWARD);
    try {
        static_cast<void>(enclose(model, {{"k"}, {}}, {1}, {interval(1)}, 0, 1));
    } catch (unsound_environment const&) {
        std::cout << "refused\n";
        return 0;
    }
    return 1;
}
