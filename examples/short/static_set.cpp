// SPDX-License-Identifier: MIT
// Static set inversion: which a, b let  y = a exp(-b t)  pass through all error bars?
#include <sivid/number/decimal_output.hpp>
#include <sivid/paving/static_inversion.hpp>
#include <sivid/paving/static_words.hpp>

#include <iostream>

using namespace sivid;

struct decay {
    static constexpr auto name = "decay";
    static constexpr auto channels = sivid::channels({{"y", "V"}});
    static constexpr auto constants = sivid::constants({{"a", "V", 1_dec}, {"b", "1/s", 1_dec}});

    template <class T>
    vec<T, 1> observe(T const& t, vec<T, 2> const& c) const {
        return {c[0] * exp(-c[1] * t)};
    }
};

int main() {
    record const data{{0.5, 0, hull(1.45_dec, 1.65_dec)}, // time, channel, what the meter proves
                      {1.0, 0, hull(1.10_dec, 1.30_dec)},
                      {2.0, 0, hull(0.65_dec, 0.80_dec)}};
    static_problem const problem{record_static_model<decay>(),
                                 {{"a", "b"}, {}},
                                 {hull(0_dec, 5_dec), hull(0_dec, 2_dec)},
                                 data};
    auto const found = invert_static(problem);
    std::cout << "of the prior's volume are feasible at least "
              << to_decimal_lower(found.inner_volume().lower(), 3) << ", at most "
              << to_decimal_upper((found.inner_volume() + found.uncertain_volume()).upper(), 3)
              << '\n';
    for (auto const& words : static_words(problem, found)) std::cout << words << '\n';
}
