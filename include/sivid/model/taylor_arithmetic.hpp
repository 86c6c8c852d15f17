// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_TAYLOR_ARITHMETIC_HPP
#define SIVID_MODEL_TAYLOR_ARITHMETIC_HPP

#include <sivid/model/arithmetic.hpp>
#include <sivid/number/taylor_model_functions.hpp>

#include <cmath>
#include <cstddef>

namespace sivid {

/// Taylor models behind the names of `interval_traits`, so that a recorded model and its series in
/// time run on them as on intervals.
template <std::size_t N, std::size_t D>
struct taylor_arithmetic {
    using value_type = taylor_model<N, D>;
    using mask = bool;
    static constexpr std::size_t lanes = 1;
    static constexpr bool keeps_reciprocals = true;

    class accumulator {
    public:
        void add(value_type const& a) { sum_.add(a); }
        void add_product(value_type const& a, value_type const& b) { sum_.add(a, b); }
        [[nodiscard]] value_type result() const { return sum_.result(); }

    private:
        product_sum<N, D> sum_;
    };

    static value_type point(double x) { return value_type::constant(x); }
    static value_type enclose(interval const& x) { return value_type::constant(x); }
    static value_type enclose(literal const& l) { return value_type::constant(l.enclosure); }
    static value_type neg(value_type const& a) { return -a; }
    static value_type add(value_type const& a, value_type const& b) { return a + b; }
    static value_type sub(value_type const& a, value_type const& b) { return a - b; }
    static value_type mul(value_type const& a, value_type const& b) {
        if (is_constant(a)) return scaled(b, a.c[0], a.r);
        if (is_constant(b)) return scaled(a, b.c[0], b.r);
        return a * b;
    }
    static value_type over(value_type const& a, std::size_t k) {
        using traits = interval_traits<interval>;
        bool never = false;
        return scaled(
            a, traits::div(traits::point(1.0), traits::point(static_cast<double>(k)), never));
    }
    static value_type reciprocal(value_type const& a, bool& undefined) {
        return sivid::reciprocal(a, undefined);
    }
    static value_type div(value_type const& a, value_type const& b, bool& undefined) {
        return mul(a, reciprocal(b, undefined));
    }
    static value_type sqr(value_type const& a) { return mul(a, a); }
    static value_type pown(value_type const& a, int n, bool&) {
        value_type result = point(1.0);
        for (int k = 0; k < n; ++k) result = mul(result, a);
        return result;
    }
    static value_type sqrt(value_type const& a, bool& undefined) {
        return sivid::sqrt(a, undefined);
    }
    static value_type exp(value_type const& a) {
        bool undefined = false;
        return sivid::apply(univariate::exp, a, undefined);
    }
    static value_type log(value_type const& a, bool& undefined) {
        return sivid::apply(univariate::log, a, undefined);
    }
    static value_type sin(value_type const& a) { return everywhere(univariate::sin, a); }
    static value_type cos(value_type const& a) { return everywhere(univariate::cos, a); }
    static value_type tan(value_type const& a, bool& undefined) {
        return sivid::apply(univariate::tan, a, undefined);
    }
    static value_type atan(value_type const& a) { return everywhere(univariate::atan, a); }
    static value_type tanh(value_type const& a) { return everywhere(univariate::tanh, a); }

    /// The sign of all values, or 0.
    static int branch(value_type const& a) {
        auto const values = range(a);
        return values.lower() > 0 ? 1 : values.upper() < 0 ? -1 : 0;
    }
    static value_type abs(value_type const& a) {
        int const side = branch(a);
        if (side != 0) return side > 0 ? a : -a;
        return enclose(interval_traits<interval>::abs(range(a)));
    }
    /// As a set: [-1, 1] where the argument touches 0.
    static value_type sign(value_type const& a) {
        int const side = branch(a);
        return side != 0 ? point(side) : enclose(interval(-1.0, 1.0));
    }
    static value_type min(value_type const& a, value_type const& b) {
        int const side = branch(a - b);
        if (side != 0) return side > 0 ? b : a;
        return enclose(interval_traits<interval>::min(range(a), range(b)));
    }
    static value_type max(value_type const& a, value_type const& b) {
        int const side = branch(a - b);
        if (side != 0) return side > 0 ? a : b;
        return enclose(interval_traits<interval>::max(range(a), range(b)));
    }

private:
    static bool is_constant(value_type const& a) {
        for (std::size_t k = 1; k <= D; ++k) {
            if (a.norms[k] != 0) return false;
        }
        return true;
    }
    /// A bounded function: its range is the answer where the polynomial fails.
    static value_type everywhere(univariate f, value_type const& a) {
        bool undefined = false;
        auto const result = sivid::apply(f, a, undefined);
        if (!undefined) return result;
        auto never = false;
        return enclose(taylor_coefficients<0>(f, interval_traits<interval>::entire(), never)[0]);
    }
};

namespace model_detail {
template <std::size_t N, std::size_t D>
struct arithmetic_for<taylor_model<N, D>> {
    using type = taylor_arithmetic<N, D>;
};
} // namespace model_detail

} // namespace sivid

#endif
