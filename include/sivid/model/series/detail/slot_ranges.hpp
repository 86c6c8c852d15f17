// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_SERIES_DETAIL_SLOT_RANGES_HPP
#define SIVID_MODEL_SERIES_DETAIL_SLOT_RANGES_HPP

#include <sivid/model/graph/arithmetic.hpp>
#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/tape.hpp>
#include <sivid/number/polynomial/detail/bernstein.hpp>

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

} // namespace sivid

#endif
