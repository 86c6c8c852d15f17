// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_SERIES_DETAIL_TWOFOLD_ARITHMETIC_HPP
#define SIVID_MODEL_SERIES_DETAIL_TWOFOLD_ARITHMETIC_HPP

#include <sivid/model/graph/arithmetic.hpp>
#include <sivid/number/rounding/detail/twofold.hpp>

#include <cstddef>

namespace sivid {

/// Numbers of twice the digits behind the names of `interval_traits`, so that a recorded model and
/// its series in time run on them. The four operations, powers and sqrt keep all digits;
/// elementary functions and literals that are no doubles are known as intervals of doubles.
struct twofold_arithmetic {
    using value_type = twofold;
    using mask = bool;
    using traits = interval_traits<interval>;
    using accumulator = plain_accumulator<twofold_arithmetic>;
    static constexpr std::size_t lanes = 1;
    static constexpr bool keeps_reciprocals = false;
    static constexpr bool keeps_rows = false;

    static twofold point(double x) { return twofold(x); }
    static twofold enclose(interval const& x) { return twofold(x); }
    static twofold enclose(literal const& l) { return twofold(l.enclosure); }
    static twofold neg(twofold const& a) { return -a; }
    static twofold add(twofold const& a, twofold const& b) { return a + b; }
    static twofold sub(twofold const& a, twofold const& b) { return a - b; }
    static twofold mul(twofold const& a, twofold const& b) { return a * b; }
    static twofold div(twofold const& a, twofold const& b, bool& undefined) {
        return quotient(a, b, undefined);
    }
    static twofold over(twofold const& a, std::size_t k) {
        bool never = false;
        return quotient(a, twofold(static_cast<double>(k)), never);
    }
    static twofold sqr(twofold const& a) { return a * a; }
    static twofold pown(twofold const& a, int n, bool& undefined) {
        return model_detail::power_by_products<twofold_arithmetic>(a, n, undefined);
    }
    static twofold sqrt(twofold const& a, bool& undefined) { return sivid::sqrt(a, undefined); }
    static twofold exp(twofold const& a) { return twofold(traits::exp(a.bounds())); }
    static twofold log(twofold const& a, bool& undefined) {
        return twofold(traits::log(a.bounds(), undefined));
    }
    static twofold sin(twofold const& a) { return twofold(traits::sin(a.bounds())); }
    static twofold cos(twofold const& a) { return twofold(traits::cos(a.bounds())); }
    static twofold tan(twofold const& a, bool& undefined) {
        return twofold(traits::tan(a.bounds(), undefined));
    }
    static twofold atan(twofold const& a) { return twofold(traits::atan(a.bounds())); }
    static twofold tanh(twofold const& a) { return twofold(traits::tanh(a.bounds())); }
    static twofold tanh_slope(twofold const& a) {
        return twofold(number_detail::tanh_slope(a.bounds()));
    }

    static decided_sign<bool> sign_of(twofold const& a) {
        bool const decided = a.least() > 0;
        return {decided && a.head() > 0, decided && a.head() < 0, !decided};
    }
    static twofold select(bool m, twofold const& a, twofold const& b) { return m ? a : b; }
    static twofold abs(twofold const& a) {
        auto const side = sign_of(a);
        if (side.neither) return twofold(traits::abs(a.bounds()));
        return side.positive ? a : -a;
    }
    /// As a set: [-1, 1] where the argument touches 0.
    static twofold sign(twofold const& a) {
        auto const side = sign_of(a);
        if (side.neither) return twofold(interval(-1.0, 1.0));
        return twofold(side.positive ? 1.0 : -1.0);
    }
    static twofold min(twofold const& a, twofold const& b) {
        auto const side = sign_of(a - b);
        if (side.neither) return twofold(traits::min(a.bounds(), b.bounds()));
        return side.positive ? b : a;
    }
    static twofold max(twofold const& a, twofold const& b) { return -min(-a, -b); }
};

namespace model_detail {
template <>
struct arithmetic_for<twofold> {
    using type = twofold_arithmetic;
};
} // namespace model_detail

} // namespace sivid

#endif
