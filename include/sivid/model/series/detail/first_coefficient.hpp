// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_SERIES_DETAIL_FIRST_COEFFICIENT_HPP
#define SIVID_MODEL_SERIES_DETAIL_FIRST_COEFFICIENT_HPP

#include <sivid/model/graph/arithmetic.hpp>
#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/tape.hpp>
#include <sivid/model/series/detail/series_storage.hpp>
#include <sivid/model/series/detail/slot_ranges.hpp>

#include <cstddef>

namespace sivid {

/// Coefficient 0 of an operation, from those of its operands.
template <class T>
class first_coefficient {
    using arithmetic = arithmetic_of<T>;
    using mask = typename arithmetic::mask;

public:
    first_coefficient(tape const&, size_of_values<T> const&) {}

    void forget(bool /*parameters*/) {}
    /// @param get  (slot) -> its coefficient 0
    template <class Get, class Before>
    T value(instruction const& i, Get const& get, Before const&, mask& undefined) {
        return apply<arithmetic>(i.op, get(i.a), get(i.b), i.index, undefined);
    }
    /// a / b, where b is coefficient 0 of what `i` divides by; of a root: of twice itself.
    /// @param undefined  where b touches 0
    static void divide(T const& a, instruction const& i, T const& b, T& result, mask& undefined) {
        bool const twice = i.op == operation::sqrt;
        result =
            arithmetic::div(a, twice ? arithmetic::mul(arithmetic::point(2.0), b) : b, undefined);
    }
};

/// Of Taylor models: keeps the reciprocals of divisors for the higher coefficients, and the ranges
/// of the slots where a polynomial leaves the domain of a function.
template <class T>
    requires(arithmetic_of<T>::keeps_reciprocals)
class first_coefficient<T> {
    using arithmetic = arithmetic_of<T>;
    using mask = typename arithmetic::mask;
    using storage = model_detail::storage_of<T>;
    using side_by_side = typename arithmetic::side_by_side;
    using scalar = typename T::scalar;
    using traits = interval_traits<interval>;

public:
    first_coefficient(tape const& program, size_of_values<T> const& values)
        : reciprocal_(storage::make(program.slots(), values)) {}

    /// The ranges, where the leaves have other values now.
    void forget(bool parameters) { ranges_.forget(parameters); }

    /// @param before  (ranges) evaluates them up to the instruction
    template <class Get, class Before>
    T value(instruction const& i, Get const& get, Before const& before, mask& undefined) {
        auto& inverse = reciprocal_[i.target];
        auto const known = [&](std::size_t slot, auto const& of) {
            return [this, &before, slot, &of] {
                before(ranges_);
                value_bounds<scalar> result;
                for (std::size_t l = 0; l < side_by_side::count; ++l) {
                    interval const x = of(ranges_.of(slot, l));
                    side_by_side::put(result.lower, l, x.lower());
                    side_by_side::put(result.upper, l, x.upper());
                }
                return result;
            };
        };
        auto const itself = [](interval const& x) { return x; };
        switch (i.op) {
        case operation::div:
            inverse = arithmetic::reciprocal(get(i.b), undefined, known(i.b, itself));
            return arithmetic::mul(get(i.a), inverse);
        case operation::sqrt: {
            auto const y = arithmetic::sqrt(get(i.a), undefined, known(i.a, itself));
            auto const twice_root = [](interval const& x) {
                bool cut = false; // `undefined` says so
                return traits::mul(traits::point(2.0), traits::sqrt(x, cut));
            };
            mask edge{}; // of a root of 0 the value is known, its derivatives are not
            inverse = arithmetic::reciprocal(arithmetic::mul(arithmetic::point(2.0), y), edge,
                                             known(i.a, twice_root));
            return y;
        }
        case operation::log:
            inverse = arithmetic::reciprocal(get(i.a), undefined, known(i.a, itself));
            return arithmetic::log(get(i.a), undefined, known(i.a, itself));
        case operation::atan: {
            mask never{}; // 1 + a^2
            inverse = arithmetic::reciprocal(get(i.companion), never, known(i.companion, itself));
            return arithmetic::atan(get(i.a));
        }
        case operation::tan:
            return arithmetic::tan(get(i.a), undefined, known(i.a, itself));
        default:
            return apply<arithmetic>(i.op, get(i.a), get(i.b), i.index, undefined);
        }
    }
    void divide(T const& a, instruction const& i, T const& /*b*/, T& result,
                mask& undefined) const {
        auto const& inverse = reciprocal_[i.target];
        undefined |= arithmetic::unknown(inverse);
        arithmetic::mul_into(result, a, inverse);
    }

private:
    typename storage::type reciprocal_;
    slot_ranges<T> ranges_;
};

} // namespace sivid

#endif
