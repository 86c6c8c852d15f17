// SPDX-License-Identifier: MIT
// Ten tenths: their double sum is not 1, the product of enclosures contains it. These headers
// compile in seconds; all of <sivid/sivid.hpp> does not.
#include <sivid/number/decimal_output.hpp>
#include <sivid/space/matrix.hpp>
#include <sivid/version.hpp>

#include <iostream>

int main() {
    using namespace sivid;

    std::size_t const count = 10;
    interval_matrix<interval> ones(1, count);
    box tenths(count);
    double approximate_sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        ones(0, i) = interval(1.0);
        tenths[i] = enclose(0.1_dec);
        approximate_sum += 0.1;
    }
    auto const sum = product(ones, tenths)[0];
    std::cout << "sivid " << version << ": 10 x 0.1 lies in " << to_string(sum) << '\n';
    return contains(sum, 1.0) && approximate_sum != 1.0 && width(sum) < 1e-14 ? 0 : 1;
}
