// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_SERIES_HPP
#define SIVID_MODEL_SERIES_HPP

#include <sivid/model/arithmetic.hpp>
#include <sivid/model/tape.hpp>

#include <cstddef>
#include <type_traits>
#include <vector>

namespace sivid {

/// Taylor series in time of every quantity of a tape, computed order by order.
///   Slot s holds \f$ s^{[k]} = s^{(k)}/k! \f$ for k = 0 .. order, where the states' coefficients
///   are given by the caller (for an ODE: \f$ x^{[k+1]} = f^{[k]}/(k+1) \f$).
/// @tparam T  an interval type (the coefficients are enclosures, at each point of the arguments'
///            ranges) or double (approximate)
/// @guarantee if neither `undefined()` nor `kinked()` is set, each coefficient of order k encloses
///            the true one for all arguments in the given ranges. If `kinked()`, order 0 still
///            does.
/// @cost  O(nodes * order^2); no allocation after construction
/// @ref   Moore 1966; Griewank and Walther 2008, table 13.2
template <class T>
class series {
public:
    using arithmetic = arithmetic_of<T>;
    using mask = typename arithmetic::mask;

    series(tape const& program, std::size_t max_order)
        : program_(&program),
          stride_(max_order + 1),
          c_(program.slots() * stride_, arithmetic::point(0.0)),
          reciprocal_(arithmetic::keeps_reciprocals ? program.slots() : 0, arithmetic::point(0.0)) {
        for (std::size_t i = 0; i < program.literals().size(); ++i) {
            c_[program.literal_slots()[i] * stride_] = arithmetic::enclose(program.literals()[i]);
        }
    }

    [[nodiscard]] std::size_t max_order() const { return stride_ - 1; }
    [[nodiscard]] T const& coefficient(std::size_t slot, std::size_t k) const {
        return c_[slot * stride_ + k];
    }
    [[nodiscard]] T const& output(std::size_t o, std::size_t k) const {
        return coefficient(program_->output(o), k);
    }
    /// A function was not defined on all of its argument.
    [[nodiscard]] mask undefined() const { return undefined_; }
    /// A kink lies in an argument: orders above 0 are not derivatives.
    [[nodiscard]] mask kinked() const { return kinked_; }
    /// A sign was taken of an argument that touches 0: the value is a set, the function may jump.
    [[nodiscard]] mask jumped() const { return jumped_; }

    /// Enters the parameters and computes what depends on them alone.
    template <class Box>
    void set_parameters(Box const& p) {
        constant_undefined_ = mask{};
        constant_jumped_ = mask{};
        for (auto const& i : program_->constant()) {
            if (i.op == operation::constant) {
                at(i.target, 0) = p[static_cast<std::size_t>(i.index)];
            } else {
                at(i.target, 0) = value(i, constant_undefined_);
            }
            if (i.op == operation::sign) constant_jumped_ |= jumps(i);
        }
    }

    /// Enters time as t + slope * tau, and forgets what an earlier expansion reported.
    void start(T const& t, T const& slope = arithmetic::point(1.0)) {
        time_ = t;
        time_slope_ = slope;
        undefined_ = constant_undefined_;
        kinked_ = mask{};
        jumped_ = constant_jumped_;
    }
    /// Computes coefficient k of everything that varies.
    /// @param state  (i, k) -> coefficient k of state i
    /// @param input  (i, k) -> coefficient k of input i
    template <class State, class Input>
    void advance(std::size_t k, State const& state, Input const& input) {
        for (auto const& i : program_->varying()) {
            auto& result = at(i.target, k);
            switch (i.op) {
            case operation::time:
                result = k == 0 ? time_ : k == 1 ? time_slope_ : arithmetic::point(0.0);
                break;
            case operation::state:
                result = state(static_cast<std::size_t>(i.index), k);
                break;
            case operation::input:
                result = input(static_cast<std::size_t>(i.index), k);
                break;
            default:
                result = k == 0 ? value(i, undefined_) : higher(i, k);
                break;
            }
            if (k == 0 && i.op == operation::sign) jumped_ |= jumps(i);
        }
    }

private:
    T& at(std::size_t slot, std::size_t k) { return c_[slot * stride_ + k]; }
    [[nodiscard]] T const& get(std::size_t slot, std::size_t k) const {
        return c_[slot * stride_ + k];
    }

    [[nodiscard]] mask jumps(instruction const& i) const {
        return arithmetic::sign_of(get(i.a, 0)).neither;
    }

    T value(instruction const& i, mask& undefined) {
        if constexpr (arithmetic::keeps_reciprocals) {
            auto& inverse = reciprocal_[i.target];
            auto const invert = [&](T const& b) { return arithmetic::reciprocal(b, undefined); };
            switch (i.op) {
            case operation::div:
                inverse = invert(get(i.b, 0));
                return arithmetic::mul(get(i.a, 0), inverse);
            case operation::sqrt: {
                auto const y = arithmetic::sqrt(get(i.a, 0), undefined);
                inverse = invert(arithmetic::mul(number(2), y));
                return y;
            }
            case operation::log:
                inverse = invert(get(i.a, 0));
                break;
            case operation::atan:
                inverse = invert(get(i.companion, 0));
                break;
            default:
                break;
            }
        }
        return apply<arithmetic>(i.op, get(i.a, 0), get(i.b, 0), i.index, undefined);
    }

    /// \f$ \sum_{j=from}^{to} a_j b_{k-j} \f$
    T convolve(std::size_t a, std::size_t b, std::size_t k, std::size_t from,
               std::size_t to) const {
        typename arithmetic::accumulator sum;
        for (std::size_t j = from; j <= to; ++j) sum.add_product(get(a, j), get(b, k - j));
        return sum.result();
    }
    /// \f$ \sum_{j=1}^{to} j a_j b_{k-j} \f$
    T weighted(std::size_t a, std::size_t b, std::size_t k, std::size_t to) const {
        typename arithmetic::accumulator sum;
        for (std::size_t j = 1; j <= to; ++j) {
            sum.add_product(arithmetic::mul(number(j), get(a, j)), get(b, k - j));
        }
        return sum.result();
    }
    /// Squares of a series: each product once, the middle one as a square.
    T square(std::size_t a, std::size_t k, std::size_t from) const {
        typename arithmetic::accumulator half;
        for (std::size_t j = from; 2 * j < k; ++j) half.add_product(get(a, j), get(a, k - j));
        T sum = arithmetic::mul(number(2), half.result());
        if (k % 2 == 0 && k / 2 >= from) {
            sum = arithmetic::add(sum, arithmetic::sqr(get(a, k / 2)));
        }
        return sum;
    }
    static T number(std::size_t k) { return arithmetic::point(static_cast<double>(k)); }
    T over(T const& a, std::size_t k) const { return arithmetic::over(a, k); }
    /// a divided by coefficient 0 of a slot, or of twice it.
    T divide(T const& a, instruction const& i, std::size_t slot, bool twice = false) {
        if constexpr (arithmetic::keeps_reciprocals) {
            return arithmetic::mul(a, reciprocal_[i.target]);
        } else {
            auto const& b = get(slot, 0);
            return arithmetic::div(a, twice ? arithmetic::mul(number(2), b) : b, undefined_);
        }
    }

    T higher(instruction const& i, std::size_t k) {
        using A = arithmetic;
        auto const a = i.a;
        auto const y = i.target;
        switch (i.op) {
        case operation::neg:
            return A::neg(get(a, k));
        case operation::add:
            return sum(i, k, false);
        case operation::sub:
            return sum(i, k, true);
        case operation::mul:
            if (!i.a_varies) return A::mul(get(a, 0), get(i.b, k));
            if (!i.b_varies) return A::mul(get(a, k), get(i.b, 0));
            return convolve(a, i.b, k, 0, k);
        case operation::div:
            if (!i.b_varies) return divide(get(a, k), i, i.b);
            if (!i.a_varies) return A::neg(divide(convolve(y, i.b, k, 0, k - 1), i, i.b));
            return divide(A::sub(get(a, k), convolve(y, i.b, k, 0, k - 1)), i, i.b);
        case operation::sqr:
            return square(a, k, 0);
        case operation::sqrt:
            return divide(A::sub(get(a, k), square(y, k, 1)), i, y, true);
        case operation::exp:
            return over(weighted(a, y, k, k), k);
        case operation::log:
            return divide(A::sub(get(a, k), over(weighted(y, a, k, k - 1), k)), i, a);
        case operation::atan:
            return divide(A::sub(get(a, k), over(weighted(y, i.companion, k, k - 1), k)), i,
                          i.companion);
        case operation::sin:
        case operation::tan:
        case operation::tanh:
            return over(weighted(a, i.companion, k, k), k);
        case operation::cos:
            return A::neg(over(weighted(a, i.companion, k, k), k));
        case operation::pown:
            return over(A::mul(A::point(i.index), weighted(a, i.companion, k, k)), k);
        default:
            return kink(i, k);
        }
    }

    T sum(instruction const& i, std::size_t k, bool minus) const {
        using A = arithmetic;
        if (!i.b_varies) return get(i.a, k);
        auto const b = minus ? A::neg(get(i.b, k)) : get(i.b, k);
        return i.a_varies ? A::add(get(i.a, k), b) : b;
    }

    /// abs, sign, min, max: the smooth branch where the argument decides it, else a report.
    T kink(instruction const& i, std::size_t k) {
        using A = arithmetic;
        auto const zero = A::point(0.0);
        bool const two = i.op == operation::min || i.op == operation::max;
        auto const side = A::sign_of(two ? A::sub(get(i.a, 0), get(i.b, 0)) : get(i.a, 0));
        kinked_ |= side.neither;
        auto const a = i.a_varies ? get(i.a, k) : zero;
        auto const b = i.b_varies ? get(i.b, k) : zero;
        auto const choose = [&](T const& above, T const& below) {
            return A::select(side.positive, above, A::select(side.negative, below, zero));
        };
        switch (i.op) {
        case operation::abs:
            return choose(a, A::neg(a));
        case operation::min:
            return choose(b, a);
        case operation::max:
            return choose(a, b);
        default:
            return zero;
        }
    }
    tape const* program_;
    std::size_t stride_;
    std::vector<T> c_;
    std::vector<T> reciprocal_; ///< of what order 0 divides by, where the arithmetic keeps it
    T time_ = arithmetic::point(0.0);
    T time_slope_ = arithmetic::point(1.0);
    mask undefined_{};
    mask constant_undefined_{};
    mask kinked_{};
    mask jumped_{};
    mask constant_jumped_{};
};

} // namespace sivid

#endif
