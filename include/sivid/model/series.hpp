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
          c_(program.slots() * stride_, arithmetic::point(0.0)) {
        for (std::size_t i = 0; i < program.literals().size(); ++i) {
            auto& slot = c_[program.literal_slots()[i] * stride_];
            if constexpr (std::is_same_v<T, double>) {
                slot = program.literals()[i].nearest;
            } else {
                auto const& l = program.literals()[i].enclosure;
                slot = arithmetic::bounds(l.lower(), l.upper());
            }
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
    [[nodiscard]] bool kinked() const { return kinked_; }
    /// A sign was taken of an argument that touches 0: the value is a set, the function may jump.
    [[nodiscard]] bool jumped() const { return jumped_; }

    /// Enters the parameters and computes what depends on them alone.
    template <class Box>
    void set_parameters(Box const& p) {
        constant_undefined_ = mask{};
        for (auto const& i : program_->constant()) {
            if (i.op == operation::constant) {
                at(i.target, 0) = p[static_cast<std::size_t>(i.index)];
            } else {
                at(i.target, 0) = value(i, constant_undefined_);
            }
        }
    }

    /// Enters time as t + slope * tau, and forgets what an earlier expansion reported.
    void start(T const& t, T const& slope = arithmetic::point(1.0)) {
        time_ = t;
        time_slope_ = slope;
        undefined_ = constant_undefined_;
        kinked_ = false;
        jumped_ = false;
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
            if (k == 0 && i.op == operation::sign && branch(get(i.a, 0)) == 0) jumped_ = true;
        }
    }

private:
    T& at(std::size_t slot, std::size_t k) { return c_[slot * stride_ + k]; }
    [[nodiscard]] T const& get(std::size_t slot, std::size_t k) const {
        return c_[slot * stride_ + k];
    }

    T value(instruction const& i, mask& undefined) const {
        return apply<arithmetic>(i.op, get(i.a, 0), get(i.b, 0), i.index, undefined);
    }

    /// \f$ \sum_{j=from}^{to} a_j b_{k-j} \f$
    T convolve(std::size_t a, std::size_t b, std::size_t k, std::size_t from,
               std::size_t to) const {
        T sum = arithmetic::point(0.0);
        for (std::size_t j = from; j <= to; ++j) {
            sum = arithmetic::add(sum, arithmetic::mul(get(a, j), get(b, k - j)));
        }
        return sum;
    }
    /// \f$ \sum_{j=1}^{to} j a_j b_{k-j} \f$
    T weighted(std::size_t a, std::size_t b, std::size_t k, std::size_t to) const {
        T sum = arithmetic::point(0.0);
        for (std::size_t j = 1; j <= to; ++j) {
            auto const term = arithmetic::mul(get(a, j), get(b, k - j));
            sum = arithmetic::add(sum, arithmetic::mul(number(j), term));
        }
        return sum;
    }
    /// Squares of a series: each product once, the middle one as a square.
    T square(std::size_t a, std::size_t k, std::size_t from) const {
        T sum = arithmetic::point(0.0);
        for (std::size_t j = from; 2 * j < k; ++j) {
            sum = arithmetic::add(sum, arithmetic::mul(get(a, j), get(a, k - j)));
        }
        sum = arithmetic::mul(number(2), sum);
        if (k % 2 == 0 && k / 2 >= from) {
            sum = arithmetic::add(sum, arithmetic::sqr(get(a, k / 2)));
        }
        return sum;
    }
    static T number(std::size_t k) { return arithmetic::point(static_cast<double>(k)); }
    T over(T const& a, std::size_t k) { return arithmetic::div(a, number(k), undefined_); }

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
            if (!i.b_varies) return A::div(get(a, k), get(i.b, 0), undefined_);
            if (!i.a_varies) {
                return A::neg(A::div(convolve(y, i.b, k, 0, k - 1), get(i.b, 0), undefined_));
            }
            return A::div(A::sub(get(a, k), convolve(y, i.b, k, 0, k - 1)), get(i.b, 0),
                          undefined_);
        case operation::sqr:
            return square(a, k, 0);
        case operation::sqrt:
            return A::div(A::sub(get(a, k), square(y, k, 1)), A::mul(number(2), get(y, 0)),
                          undefined_);
        case operation::exp:
            return over(weighted(a, y, k, k), k);
        case operation::log:
            return A::div(A::sub(get(a, k), over(weighted(y, a, k, k - 1), k)), get(a, 0),
                          undefined_);
        case operation::atan:
            return A::div(A::sub(get(a, k), over(weighted(y, i.companion, k, k - 1), k)),
                          get(i.companion, 0), undefined_);
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

    /// abs, sign, min, max: the smooth branch where the argument decides it, else a report. Packs
    /// take a branch only when all lanes do.
    T kink(instruction const& i, std::size_t k) {
        using A = arithmetic;
        auto const zero = A::point(0.0);
        bool const two = i.op == operation::min || i.op == operation::max;
        int const side = branch(two ? A::sub(get(i.a, 0), get(i.b, 0)) : get(i.a, 0));
        if (side == 0) {
            kinked_ = true;
            return zero;
        }
        auto const a = i.a_varies ? get(i.a, k) : zero;
        auto const b = i.b_varies ? get(i.b, k) : zero;
        switch (i.op) {
        case operation::abs:
            return side > 0 ? a : A::neg(a);
        case operation::min:
            return side > 0 ? b : a;
        case operation::max:
            return side > 0 ? a : b;
        default:
            return zero;
        }
    }
    /// +1 or -1 when every lane is positive or negative, else 0.
    static int branch(T const& d) {
        if constexpr (std::is_same_v<T, double>) {
            return d > 0 ? 1 : d < 0 ? -1 : 0;
        } else {
            bool positive = true;
            bool negative = true;
            for (std::size_t l = 0; l < arithmetic::lanes; ++l) {
                positive = positive && arithmetic::lower(d, l) > 0;
                negative = negative && arithmetic::upper(d, l) < 0;
            }
            return positive ? 1 : negative ? -1 : 0;
        }
    }

    tape const* program_;
    std::size_t stride_;
    std::vector<T> c_;
    T time_ = arithmetic::point(0.0);
    T time_slope_ = arithmetic::point(1.0);
    mask undefined_{};
    mask constant_undefined_{};
    bool kinked_ = false;
    bool jumped_ = false;
};

} // namespace sivid

#endif
