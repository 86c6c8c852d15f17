// SPDX-License-Identifier: MIT
// Which rates k of x' = -k x, x(0) = 1, do two measurements allow? These headers compile in seconds;
// all of <sivid/sivid.hpp> does not.
#include <sivid/number/decimal_output.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/version.hpp>

#include <iostream>

/// x = exp(-k t) lies in [0.58, 0.63] at 1 s and in [0.35, 0.39] at 2 s.
struct decay {
    sivid::assessment<> operator()(sivid::box const& k) const {
        using namespace sivid;
        sivid::assessment<> says{.rest = k};
        auto const x = exp(-k[0]), y = exp(-2 * k[0]);
        auto const first = hull(0.58_dec, 0.63_dec), second = hull(0.35_dec, 0.39_dec);
        if (subset(x, first) && subset(y, second)) says.verdict = box_verdict::inside;
        if (disjoint(x, first) || disjoint(y, second)) says.verdict = box_verdict::outside;
        return says;
    }
};

int main() {
    decay test;
    auto const found = sivid::invert(test, {sivid::interval(0, 10)}, {.accuracy = 1e-4});
    auto const k = found.paving.outer_hull()[0];
    std::cout << "sivid " << sivid::version << ": k in " << to_string(k) << " 1/s\n";
    return contains(k, 0.5) && k.lower() > 0.46 && k.upper() < 0.54 ? 0 : 1;
}
