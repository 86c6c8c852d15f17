// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_SERIES_SERIES_HPP
#define SIVID_MODEL_SERIES_SERIES_HPP

#include <sivid/model/graph/arithmetic.hpp>
#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/tape.hpp>
#include <sivid/model/series/detail/series_storage.hpp>
#include <sivid/number/polynomial/detail/bernstein.hpp>
#include <sivid/work_clock.hpp>

#include <cstddef>
#include <limits>
#include <vector>

namespace sivid {

/// Ranges of the slots of a tape by interval evaluation, beside the polynomials that they hold. A
/// polynomial says how a value depends on the unknowns, but not that max(h, 0) or 1 + exp(z) is
/// never below 0 or 1: intervals do. Computed when a polynomial does not decide a domain, and then
/// once for each evaluation of the tape.
/// @tparam T   a Taylor model; with lanes, a range in each lane
/// @guarantee  `of` contains every value of the slot at which all that it is made of is defined
/// @cost       an interval operation for each slot and lane, at most once until `forget`
template <class T>
class slot_ranges {
    using scalar = typename T::scalar;
    using side_by_side = lane_traits<scalar>;
    using arithmetic = proven_arithmetic<interval>;
    static constexpr std::size_t width = side_by_side::count;

public:
    /// Of what varies, or also of what depends on the parameters alone.
    void forget(bool parameters) {
        varying_ = 0;
        if (parameters) constant_ = 0;
    }
    /// Evaluates what stands before an instruction.
    /// @param varies    whether that is one of `varying()`, else of `constant()`
    /// @param leaf    (instruction) -> the model of time, a state or an input
    /// @param first   (slot) -> its model, which is another one by now where a slot that varies
    ///                keeps no history
    template <class Leaf, class First>
    void evaluate(tape const& program, bool varies, std::size_t before, Leaf const& leaf,
                  First const& first) {
        if (range_.empty()) {
            range_.assign(program.slots() * width, interval(0.0));
            for (std::size_t i = 0; i < program.literals().size(); ++i) {
                for (std::size_t l = 0; l < width; ++l)
                    at(program.literal_slots()[i], l) = program.literals()[i].enclosure;
            }
        }
        for (std::size_t const end = varies ? program.constant().size() : before; constant_ < end;
             ++constant_) {
            auto const& i = program.constant()[constant_];
            bool const given = i.op == operation::constant;
            enter(program, i, given,
                  given ? bounds(first(i.target)) : rough_bounds(first(i.target)));
        }
        for (; varies && varying_ < before; ++varying_) {
            auto const& i = program.varying()[varying_];
            bool const given = is_leaf(i.op);
            bool const kept = program.keeps_history(i.target);
            enter(program, i, given,
                  given  ? bounds(leaf(i))
                  : kept ? rough_bounds(first(i.target))
                         : unknown());
        }
    }
    /// @given  `evaluate` for an instruction behind
    [[nodiscard]] interval const& of(std::size_t slot, std::size_t lane) const {
        return range_[slot * width + lane];
    }

private:
    interval& at(std::size_t slot, std::size_t lane) { return range_[slot * width + lane]; }

    void enter(tape const& program, instruction const& i, bool given,
               value_bounds<scalar> const& values) {
        for (std::size_t l = 0; l < width; ++l) {
            double const lower = side_by_side::get(values.lower, l);
            double const upper = side_by_side::get(values.upper, l);
            auto const seen =
                lower <= upper ? arithmetic::bounds(lower, upper) : arithmetic::entire(); // NaN
            auto const both = given ? seen : intersect(seen, natural(program, i, l));
            at(i.target, l) = is_empty(both) ? arithmetic::entire() : both;
        }
    }
    [[nodiscard]] interval natural(tape const& program, instruction const& i,
                                   std::size_t lane) const {
        bool undefined = false; // the evaluation itself says so
        if (!i.is_sum())
            return apply<arithmetic>(i.op, of(i.a, lane), of(i.b, lane), i.index, undefined);
        interval sum(0.0);
        for (auto n = i.first_term; n < i.last_term; ++n) {
            auto const& t = program.terms(i)[n - i.first_term];
            auto const term =
                t.product ? arithmetic::mul(of(t.a, lane), of(t.b, lane)) : of(t.a, lane);
            sum = t.minus ? arithmetic::sub(sum, term) : arithmetic::add(sum, term);
        }
        return sum;
    }
    static value_bounds<scalar> unknown() {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        return {scalar(-infinity), scalar(infinity)};
    }

    std::vector<interval> range_;            ///< slot by slot, in each lane
    std::size_t constant_ = 0, varying_ = 0; ///< how many instructions are evaluated
};

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

    /// @param values  their size, where values of the type have different ones
    series(tape const& program, std::size_t max_order, size_of_values<T> const& values = {})
        : program_(&program),
          stride_(max_order + 1),
          place_(program.slots()),
          first_(program, values) {
        std::size_t next = 0;
        for (std::size_t slot = 0; slot < program.slots(); ++slot) {
            bool const all = program.keeps_history(slot);
            place_[slot] = {next, all ? ~std::size_t{0} : std::size_t{0}};
            next += all ? stride_ : 1;
        }
        c_ = storage::make(next, values);
        if constexpr (arithmetic::keeps_rows) {
            row_.assign(program.slots(), no_row);
            std::size_t rows = 0;
            for (std::size_t slot = 0; slot < program.slots(); ++slot) {
                if (program.convolved(slot)) row_[slot] = rows++;
            }
            using rows_type = typename model_detail::rows_of<arithmetic>::type;
            rows_ = storage::template make_rows<rows_type>(rows, stride_, values);
        }
        for (std::size_t i = 0; i < program.literals().size(); ++i) {
            at(program.literal_slots()[i], 0) = arithmetic::enclose(program.literals()[i]);
        }
    }

    [[nodiscard]] std::size_t max_order() const { return stride_ - 1; }
    /// The last one computed where the tape keeps no history.
    [[nodiscard]] T const& coefficient(std::size_t slot, std::size_t k) const {
        return get(slot, k);
    }
    [[nodiscard]] T const& output(std::size_t o, std::size_t k) const {
        return coefficient(program_->output(o), k);
    }
    /// A function was not defined on all of its argument.
    [[nodiscard]] mask undefined() const { return now_.undefined; }
    /// A kink lies in an argument: orders above 0 are not derivatives.
    [[nodiscard]] mask kinked() const { return now_.kinked; }
    /// A sign was taken of an argument that touches 0: the value is a set, the function may jump.
    [[nodiscard]] mask jumped() const { return now_.jumped; }

    /// Enters the parameters and computes what depends on them alone.
    template <class Box>
    void set_parameters(Box const& p) {
        constant_ = flags{};
        rest_constant_ = flags{};
        first_.forget(true);
        auto const none = [](instruction const&) { return T(arithmetic::point(0.0)); };
        for (std::size_t n = 0; n < program_->constant().size(); ++n) {
            auto const& i = program_->constant()[n];
            auto& report = n < program_->principal_constant() ? constant_ : rest_constant_;
            if (i.op == operation::constant) {
                at(i.target, 0) = p[static_cast<std::size_t>(i.index)];
            } else {
                at(i.target, 0) = value(false, n, none, report.undefined);
            }
            if (i.op == operation::sign) report.jumped |= jumps(i);
        }
    }

    /// Enters time as t + slope * tau, and forgets what an earlier expansion reported.
    void start(T const& t, T const& slope = arithmetic::point(1.0)) {
        time_ = t;
        time_slope_ = slope;
        now_ = constant_;
        first_.forget(false);
    }
    /// Computes coefficient k of everything that varies.
    /// @param state  (i, k) -> coefficient k of state i
    /// @param input  (i, k) -> coefficient k of input i
    template <class State, class Input>
    void advance(std::size_t k, State const& state, Input const& input) {
        advance_principal(k, state, input);
        advance_rest(k, state, input);
    }
    /// The same for what the tape's principal outputs need alone.
    template <class State, class Input>
    void advance_principal(std::size_t k, State const& state, Input const& input) {
        advance(0, program_->principal_varying(), k, state, input);
    }
    /// The same for everything else, after the principal part has reached order k or beyond.
    template <class State, class Input>
    void advance_rest(std::size_t k, State const& state, Input const& input) {
        if (k == 0) {
            now_.undefined |= rest_constant_.undefined;
            now_.jumped |= rest_constant_.jumped;
        }
        advance(program_->principal_varying(), program_->varying().size(), k, state, input);
    }
    /// The values of everything at a time, where the states are x.
    template <class States, class Input>
    void evaluate(T const& t, States const& x, Input const& input) {
        start(t);
        advance(
            0, [&x](std::size_t i, std::size_t) -> decltype(auto) { return x[i]; }, input);
    }

private:
    using storage = model_detail::storage_of<T>;
    static constexpr std::size_t no_row = ~std::size_t{0};
    /// Fewer products than that are faster one by one.
    static constexpr std::size_t worth_rows = 3;

    struct flags {
        mask undefined{}, kinked{}, jumped{};
    };
    template <class State, class Input>
    void advance(std::size_t first, std::size_t last, std::size_t k, State const& state,
                 Input const& input) {
        auto const leaf = [&](instruction const& i) -> T {
            auto const index = static_cast<std::size_t>(i.index);
            if (i.op == operation::time) return time_;
            return i.op == operation::state ? T(state(index, 0)) : T(input(index, 0));
        };
        double work = 0;
        for (std::size_t n = first; n < last; ++n) {
            auto const& i = program_->varying()[n];
            auto& result = at(i.target, k);
            work += model_detail::work_of(result) * products(i, k);
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
                if (k == 0 && i.tanh_slope_at &&
                    model_detail::find_tanh_slope<arithmetic>(get(*i.tanh_slope_at, 0), result))
                    break;
                if (i.is_sum()) {
                    sum(i, k, result);
                } else if (k > 0 && i.op == operation::mul && i.a_varies && i.b_varies) {
                    accumulator total(result);
                    convolve(total, i.a, i.b, k, 0, k);
                    total.result_into(result);
                } else if (k == 0) {
                    result = value(true, n, leaf, now_.undefined);
                } else {
                    higher(i, k, result);
                }
                break;
            }
            if (k == 0 && i.op == operation::sign) now_.jumped |= jumps(i);
            if constexpr (arithmetic::keeps_rows) {
                if (row_[i.target] != no_row) rows_.put(row_[i.target], k, result);
            }
        }
        work_clock::count(1, work);
    }

    /// Products that coefficient k takes, for the `work_clock`.
    [[nodiscard]] double products(instruction const& i, std::size_t k) const {
        constexpr double addition = 0.2; // of a product
        auto const convolution = static_cast<double>(k + 1);
        if (is_leaf(i.op)) return addition;
        if (!i.is_sum()) {
            bool const one = (i.op == operation::mul && !(i.a_varies && i.b_varies)) ||
                             (i.op == operation::div && !i.b_varies);
            return one ? 1 : convolution;
        }
        double result = 0;
        auto const* const terms = program_->terms(i);
        for (std::size_t n = 0; n < i.last_term - i.first_term; ++n) {
            auto const& t = terms[n];
            result += !t.product ? addition : t.a_varies && t.b_varies ? convolution : 1;
        }
        return result;
    }

    T& at(std::size_t slot, std::size_t k) {
        return c_[place_[slot].first + (k & place_[slot].orders)];
    }
    [[nodiscard]] T const& get(std::size_t slot, std::size_t k) const {
        return c_[place_[slot].first + (k & place_[slot].orders)];
    }

    [[nodiscard]] mask jumps(instruction const& i) const {
        return arithmetic::sign_of(get(i.a, 0)).neither;
    }

    /// Coefficient 0 of instruction n of what varies, or of what does not.
    /// @param leaf  (instruction) -> coefficient 0 of time, a state or an input
    template <class Leaf>
    T value(bool varies, std::size_t n, Leaf const& leaf, mask& undefined) {
        auto const first = [this](std::size_t slot) -> T const& { return get(slot, 0); };
        auto const before = [&](auto& ranges) {
            ranges.evaluate(*program_, varies, n, leaf, first);
        };
        auto const& i = (varies ? program_->varying() : program_->constant())[n];
        return first_.value(i, first, before, undefined);
    }

    using accumulator = typename arithmetic::accumulator;

    /// Adds \f$ \pm \sum_{j=from}^{to} a_j b_{k-j} \f$.
    void convolve(accumulator& sum, std::size_t a, std::size_t b, std::size_t k, std::size_t from,
                  std::size_t to, double sign = 1) const {
        if constexpr (arithmetic::keeps_rows) {
            if (to - from + 1 >= worth_rows && from <= to) {
                return sum.add_convolution(rows_, row_[a], rows_, row_[b], k, from, to, sign);
            }
        }
        for (std::size_t j = from; j <= to; ++j) sum.add_product(get(a, j), get(b, k - j), sign);
    }
    /// \f$ \sum_{j=1}^{to} j a_j b_{k-j} \f$
    /// @param result  none of the operands
    void weighted(std::size_t a, std::size_t b, std::size_t k, std::size_t to, T& result) const {
        accumulator total(result);
        if constexpr (arithmetic::keeps_rows) {
            if (to >= worth_rows) {
                total.add_convolution(rows_, row_[a], rows_, row_[b], k, 1, to, 1,
                                      arithmetic::by_order);
                return total.result_into(result);
            }
        }
        for (std::size_t j = 1; j <= to; ++j)
            total.add_product(get(a, j), get(b, k - j), static_cast<double>(j));
        total.result_into(result);
    }
    /// The same divided by k.
    void mean(std::size_t a, std::size_t b, std::size_t k, std::size_t to, T& result) const {
        weighted(a, b, k, to, result);
        over(result, k, result);
    }
    /// Adds \f$ \pm \sum_{j=from}^{k-from} a_j a_{k-j} \f$: each product once, the middle one as a
    /// square.
    void square(accumulator& sum, std::size_t a, std::size_t k, std::size_t from,
                double sign = 1) const {
        if constexpr (arithmetic::keeps_rows) {
            if (k >= 2 * from && k - 2 * from + 1 >= worth_rows) {
                if (k < model_detail::rows_of<arithmetic>::type::at_once) // one register holds it
                    return sum.add_convolution(rows_, row_[a], rows_, row_[a], k, from, k - from,
                                               sign);
                sum.add_convolution(rows_, row_[a], rows_, row_[a], k, from, (k - 1) / 2, 2 * sign);
                if (k % 2 == 0) sum.add_square(get(a, k / 2), sign);
                return;
            }
        }
        for (std::size_t j = from; 2 * j < k; ++j)
            sum.add_product(get(a, j), get(a, k - j), 2 * sign);
        if (k % 2 == 0 && k / 2 >= from) sum.add_square(get(a, k / 2), sign);
    }
    void sum(instruction const& i, std::size_t k, T& result) const {
        accumulator total(result);
        auto const* const terms = program_->terms(i);
        for (std::size_t n = 0; n < i.last_term - i.first_term; ++n) {
            auto const& t = terms[n];
            double const sign = t.minus ? -1 : 1;
            if (!t.product) {
                if (k == 0 || t.a_varies) total.add(get(t.a, k), sign);
            } else if (t.a_varies && t.b_varies) {
                convolve(total, t.a, t.b, k, 0, k, sign);
            } else {
                total.add_product(get(t.a, t.a_varies ? k : 0), get(t.b, t.b_varies ? k : 0), sign);
            }
        }
        total.result_into(result);
    }
    static T number(std::size_t k) { return arithmetic::point(static_cast<double>(k)); }
    /// a divided by k.
    static void over(T const& a, std::size_t k, T& result) {
        if constexpr (requires { arithmetic::over_into(result, a, k); }) {
            arithmetic::over_into(result, a, k);
        } else {
            result = arithmetic::over(a, k);
        }
    }
    /// @param result  none of the factors
    static void multiply(T const& a, T const& b, T& result) {
        if constexpr (requires { arithmetic::mul_into(result, a, b); }) {
            arithmetic::mul_into(result, a, b);
        } else {
            result = arithmetic::mul(a, b);
        }
    }
    /// a divided by coefficient 0 of a slot; of a root by twice it.
    void divide(T const& a, instruction const& i, std::size_t slot, T& result) {
        first_.divide(a, i, get(slot, 0), result, now_.undefined);
    }

    /// At 0 a root has a value, but no derivative.
    void root(instruction const& i, std::size_t k, T& result) {
        accumulator rest;
        rest.add(get(i.a, k));
        square(rest, i.target, k, 1, -1);
        mask edge{};
        first_.divide(rest.result(), i, get(i.target, 0), result, edge);
        if (edge == mask{}) return;
        now_.kinked |= edge;
        result = arithmetic::select(edge, arithmetic::point(0.0), result);
    }

    void higher(instruction const& i, std::size_t k, T& result) {
        using A = arithmetic;
        auto const a = i.a;
        auto const y = i.target;
        switch (i.op) {
        case operation::mul:
            if (!i.a_varies) return multiply(get(a, 0), get(i.b, k), result);
            return multiply(get(a, k), get(i.b, 0), result);
        case operation::div:
            if (!i.b_varies) return divide(get(a, k), i, i.b, result);
            {
                accumulator rest; // a_k - sum_{j<k} y_j b_{k-j}
                if (i.a_varies) rest.add(get(a, k));
                convolve(rest, y, i.b, k, 0, k - 1, -1);
                return divide(rest.result(), i, i.b, result);
            }
        case operation::sqr: {
            accumulator total(result);
            square(total, a, k, 0);
            return total.result_into(result);
        }
        case operation::sqrt:
            return root(i, k, result);
        case operation::exp:
            return mean(a, y, k, k, result);
        case operation::log:
            mean(y, a, k, k - 1, result);
            return divide(A::sub(get(a, k), result), i, a, result);
        case operation::atan:
            mean(y, i.companion, k, k - 1, result);
            return divide(A::sub(get(a, k), result), i, i.companion, result);
        case operation::sin:
        case operation::tan:
        case operation::tanh:
            return mean(a, i.companion, k, k, result);
        case operation::cos:
            mean(a, i.companion, k, k, result);
            result = A::neg(result);
            return;
        case operation::pown:
            if (is_squared_power(i.index)) {
                accumulator total(result);
                square(total, i.companion, k, 0);
                return total.result_into(result);
            }
            weighted(a, i.companion, k, k, result);
            result = A::mul(A::point(i.index), result);
            return over(result, k, result);
        default:
            result = kink(i, k);
        }
    }

    /// abs, sign, min, max: the smooth branch where the argument decides it, else a report.
    T kink(instruction const& i, std::size_t k) {
        using A = arithmetic;
        auto const zero = A::point(0.0);
        bool const two = i.op == operation::min || i.op == operation::max;
        auto const side = A::sign_of(two ? A::sub(get(i.a, 0), get(i.b, 0)) : get(i.a, 0));
        now_.kinked |= side.neither;
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
    struct place {
        std::size_t first = 0;  ///< where coefficient 0 is
        std::size_t orders = 0; ///< all bits set where the others follow it, else none
    };
    std::vector<place> place_;
    typename storage::type c_;
    first_coefficient<T> first_;
    T time_ = arithmetic::point(0.0);
    T time_slope_ = arithmetic::point(1.0);
    [[no_unique_address]]
    typename model_detail::rows_of<arithmetic>::type rows_; ///< of what is convolved
    std::vector<std::size_t> row_;                          ///< the series of each slot in there
    flags now_;                                             ///< of the present expansion
    flags constant_;      ///< of what depends on the parameters alone: for the principal outputs,
    flags rest_constant_; ///< and for the others
};

} // namespace sivid

#endif
