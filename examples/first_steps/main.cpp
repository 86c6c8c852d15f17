// SPDX-License-Identifier: MIT
#include <sivid/number/decimal_output.hpp>
#include <sivid/paving/identify.hpp>

#include <iostream>

using namespace sivid;

/// Logistic growth  x' = r x (1 - x/K),  y = x.   x [g/L], t [h], r [1/h], K [g/L]
struct logistic_growth {
    static constexpr auto name = "logistic growth";
    static constexpr auto states = sivid::states({{"x", "g/L", 10}});
    static constexpr auto inputs = no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "g/L"}});
    static constexpr auto constants = sivid::constants({{"r", "1/h", 1_dec}, {"K", "g/L", 1_dec}});

    template <class T>
    vec<T, 1> rate(T const&, vec<T, 1> const& x, vec<T, 2> const& c, vec<T, 0> const&) const {
        auto const& [r, K] = c;
        return {r * x[0] * (1 - x[0] / K)};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 1> const& x, vec<T, 2> const&, vec<T, 0> const&) const {
        return x;
    }
};

int main() {
    experiment culture;
    culture.name = "culture";
    culture.initial = {hull(0.10_dec, 0.12_dec)};
    culture.measurements = {{1, 0, hull(0.24_dec, 0.29_dec)}, // what the instrument proves:
                            {2, 0, hull(0.47_dec, 0.55_dec)}, // time, channel, bounds
                            {4, 0, hull(0.89_dec, 0.96_dec)}};
    box const prior{hull(0.1_dec, 3_dec), hull(0.5_dec, 2_dec)};
    auto const found =
        identify({record_model<logistic_growth>(), {{"r", "K"}, {}}, prior, {culture}});
    std::cout << to_string(found.verdict) << ": r in " << to_string(found.hull[0]) << ", K in "
              << to_string(found.hull[1]) << '\n';
}
