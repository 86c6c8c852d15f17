// SPDX-License-Identifier: MIT
// Ten additions of a tenth: the double result is not 1, the enclosure contains it.
#include <sivid/sivid.hpp>

#include <iostream>

int main() {
    using namespace sivid;

    interval sum{0};
    double approximate_sum = 0;
    for (int i = 0; i < 10; ++i) {
        sum += enclose(0.1_dec);
        approximate_sum += 0.1;
    }
    std::cout << "sivid " << version << ": 10 x 0.1 lies in " << to_string(sum) << '\n';
    return contains(sum, 1.0) && approximate_sum != 1.0 && width(sum) < 1e-14 ? 0 : 1;
}
