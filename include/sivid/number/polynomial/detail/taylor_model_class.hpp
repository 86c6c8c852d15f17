// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_POLYNOMIAL_DETAIL_TAYLOR_MODEL_CLASS_HPP
#define SIVID_NUMBER_POLYNOMIAL_DETAIL_TAYLOR_MODEL_CLASS_HPP

#include <sivid/number/interval_traits.hpp>
#include <sivid/number/pack/lanes.hpp>
#include <sivid/number/polynomial/detail/aligned_blocks.hpp>
#include <sivid/number/polynomial/detail/model_shape.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <limits>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace sivid {

/// A function on \f$ [-1,1]^N \f$ enclosed by a polynomial of total degree D and a radius:
///   \f$ f(q) \in \sum_{|\alpha| \le D} c_\alpha q^\alpha + [-r, r] \f$ for all q.
/// Coefficients are doubles; every rounding and truncation error is in the radius. The arithmetic
/// needs no rounding mode: error bounds hold for any mode (unit 2^-52) and for fused operations.
/// A radius that is not finite means that nothing is known.
///
/// N and D are values. A model that no variable can enter (`is_number`) has N = D = 0 and goes with
/// models of any size; two others go together where their sizes are the same.
///
/// In memory: coefficients in the order of `monomial_space`, zeros up to whole vectors, the radius,
/// the norms 1 .. D together, the norms 0 .. D; all lanes of a number side by side. A model owns
/// its memory (a single number within itself), or borrows a place in a `taylor_models`: then
/// assignment writes into that place.
/// @tparam C  `double`, or `lanes<W>`: W such functions side by side
/// @cost      copies copy the numbers; memory of temporaries is used again, see `aligned_blocks`
/// @ref  Makino and Berz, Int. J. Pure Appl. Math. 4 (2003); rounding bounds: Higham 2002, chapter
/// 3
template <class C = double>
class taylor_model {
public:
    using scalar = C;
    using side_by_side = lane_traits<C>;
    using shape_type = model_shape<C>;

    /// Twice the unit roundoff: an error bound of one operation in any rounding mode.
    static constexpr double unit = std::numeric_limits<double>::epsilon();
    /// More than all underflow errors of one operation.
    static constexpr double tiny = 1e-290;
    /// Values beyond this are given up: near the overflow, what happens depends on the rounding
    /// mode.
    static constexpr double largest = 1e300;

    /// The number 0.
    taylor_model() : taylor_model(shape_type::number()) {}
    /// The function 0 in so many variables.
    explicit taylor_model(shape_type const& s) : taylor_model(s, unset{}) {
        if (s.terms == 1) {
            std::fill_n(p_, number_size, C(0.0));
        } else {
            number_detail::clear_lines(p_, s.lines);
        }
    }
    /// For a result that is written at once, whole vectors at a time.
    struct unset {};
    taylor_model(shape_type const& s, unset) : shape_(&s) { take(s); }
    /// Without memory, to be given a size by `reshape` before anything else.
    explicit taylor_model(unset) {}
    /// Memory, so many cache lines of it, that belongs to somebody else.
    struct place {
        C* first;
        std::size_t lines;
    };
    /// The number 0 there.
    explicit taylor_model(place const& p)
        : shape_(&shape_type::number()), p_(p.first), room_(p.lines) {
        std::fill_n(p_, number_size, C(0.0));
    }
    taylor_model(taylor_model const& a) : shape_(a.shape_) {
        take(*shape_);
        copy_numbers(a);
    }
    /// From memory that belongs to somebody else it copies; where there is none for that, the
    /// program ends. It says that it does not throw, so that growing vectors move.
    taylor_model(taylor_model&& a) noexcept : shape_(a.shape_) {
        if (a.lines_ == 0 && a.p_ != nullptr) {
            take(*shape_);
            copy_numbers(a);
        } else {
            p_ = std::exchange(a.p_, nullptr);
            lines_ = std::exchange(a.lines_, 0);
        }
    }
    taylor_model& operator=(taylor_model const& a) {
        if (this == &a) return *this;
        reshape(*a.shape_);
        copy_numbers(a);
        return *this;
    }
    taylor_model& operator=(taylor_model&& a) {
        if (borrowed() || a.lines_ == 0) return *this = std::as_const(a);
        if (lines_ == 0) p_ = nullptr; // what it held within itself is lost
        std::swap(shape_, a.shape_);
        std::swap(p_, a.p_);
        std::swap(lines_, a.lines_);
        return *this;
    }
    ~taylor_model() {
        if (lines_ > 0) number_detail::aligned_blocks::give_back(p_, lines_);
    }

    [[nodiscard]] shape_type const& shape() const { return *shape_; }
    [[nodiscard]] monomial_space const& space() const { return *shape_->space; }
    [[nodiscard]] std::size_t terms() const { return shape_->terms; }
    [[nodiscard]] std::size_t degree() const { return shape_->degree; }
    [[nodiscard]] bool is_number() const { return shape_->terms == 1; }

    [[nodiscard]] C* c() { return p_; }
    [[nodiscard]] C const* c() const { return p_; }
    [[nodiscard]] std::span<C> coefficients() { return {p_, shape_->terms}; }
    [[nodiscard]] std::span<C const> coefficients() const { return {p_, shape_->terms}; }
    [[nodiscard]] C& c(std::size_t i) { return p_[i]; }
    [[nodiscard]] C const& c(std::size_t i) const { return p_[i]; }
    [[nodiscard]] C& r() { return p_[shape_->radius]; }
    [[nodiscard]] C const& r() const { return p_[shape_->radius]; }
    /// Upper bound of the norms 1 .. D together.
    [[nodiscard]] C& above() { return p_[shape_->radius + 1]; }
    [[nodiscard]] C const& above() const { return p_[shape_->radius + 1]; }
    /// Upper bounds of \f$ \sum_{|\alpha|=k} |c_\alpha| \f$.
    [[nodiscard]] C* norms() { return p_ + shape_->radius + 2; }
    [[nodiscard]] C const* norms() const { return p_ + shape_->radius + 2; }

    /// Makes room for other sizes; what it held is lost, and zeros behind the coefficients are to
    /// be written with them.
    void reshape(shape_type const& s) {
        if (&s == shape_ && p_ != nullptr) return;
        if (borrowed()) {
            if (s.lines > room_) throw std::logic_error("taylor_model: too large for its place");
        } else if (lines_ == 0 || s.lines > lines_) {
            if (lines_ > 0) {
                number_detail::aligned_blocks::give_back(std::exchange(p_, nullptr),
                                                         std::exchange(lines_, 0));
            }
            take(s); // where it throws, this holds nothing
        }
        shape_ = &s;
    }
    /// Forgets everything when an operation on values of size `mass` may have overflowed.
    void give_up_when_huge(C const& mass) {
        constexpr double never = std::numeric_limits<double>::infinity();
        r() = side_by_side::where_below(r(), largest, r(), never);
        r() = side_by_side::where_below(mass, largest, r(), never);
    }
    /// Recomputes the norms; to be called after `c` was written.
    void finish() {
        if (is_number()) {
            p_[2] = C(0.0);
            p_[3] = side_by_side::abs(p_[0]) * shape_->up;
        } else {
            shape_->norms(*shape_->space, p_, p_ + shape_->radius + 1, shape_->up);
        }
    }
    /// The norms of a multiple, from those of what was multiplied: each coefficient that is not 0
    /// is rounded once, in the subnormal range by less than itself. The radius is overwritten.
    void finish_multiple(taylor_model const& a, C const& size) {
        double const up = shape_->up;
        product_detail::each_bound(
            *shape_,
            [&size, up](auto& y, auto const& x) {
                // x or tiny, whatever is less
                using number = std::remove_cvref_t<decltype(x)>;
                if constexpr (std::is_same_v<number, C>) {
                    y = x * size * up + side_by_side::min(x, C(tiny));
                } else {
                    number const least = number{} + tiny;
                    y = x * size * up + (x < least ? x : least);
                }
            },
            p_, a.p_);
    }

    /// Bound of the polynomial without its constant term.
    [[nodiscard]] C const& spread() const { return above(); }
    /// Bound of the polynomial.
    [[nodiscard, gnu::always_inline]] C polynomial_norm() const {
        C const* const end = p_ + shape_->radius;
        return (end[1] + end[2]) * shape_->up;
    }
    /// Bound of everything: \f$ |f(q)| \f$.
    [[nodiscard]] C norm() const { return (polynomial_norm() + r()) * shape_->up; }

    [[nodiscard]] static taylor_model constant(C const& v) {
        taylor_model result(shape_type::number(), unset{});
        result.p_[0] = v;
        result.r() = 0.0;
        result.above() = 0.0;
        result.norms()[0] = side_by_side::abs(v);
        result.give_up_when_huge(result.norms()[0]);
        return result;
    }
    [[nodiscard]] static taylor_model constant(interval const& v) {
        auto result = constant(C(mid(v)));
        result.r() = is_empty(v) ? std::numeric_limits<double>::infinity() : rad(v);
        return result;
    }
    /// No variable has an influence, in any lane.
    [[nodiscard]] bool is_constant() const {
        return is_number() || side_by_side::all(above() == C(0.0));
    }
    /// centre + slope * q_v
    /// @given  v < s.variables, s.degree >= 1
    [[nodiscard]] static taylor_model variable(shape_type const& s, std::size_t v, C const& centre,
                                               C const& slope) {
        taylor_model result(s);
        result.p_[0] = centre;
        result.p_[s.space->variable(v)] = slope;
        result.finish();
        result.give_up_when_huge(result.norms()[0]);
        return result;
    }

private:
    /// Coefficient, radius, norms.
    static constexpr std::size_t number_size = 4;
    /// Single numbers need no block: lanes of them would make each handle too large.
    static constexpr bool holds_numbers = std::is_same_v<C, double>;

    [[nodiscard]] bool borrowed() const { return room_ > 0; }
    void take(shape_type const& s) {
        if constexpr (holds_numbers) {
            if (s.terms == 1) {
                lines_ = 0;
                p_ = number_.data();
                return;
            }
        }
        p_ = static_cast<C*>(number_detail::aligned_blocks::take(s.lines));
        lines_ = s.lines;
    }
    /// @given  the same shape
    [[gnu::always_inline]] void copy_numbers(taylor_model const& a) {
        if (shape_->terms == 1) {
            std::copy_n(a.p_, number_size, p_);
        } else {
            number_detail::copy_lines(p_, a.p_, shape_->lines);
        }
    }
    shape_type const* shape_ = nullptr;
    C* p_ = nullptr;
    std::size_t lines_ = 0; ///< of memory that it owns
    std::size_t room_ = 0;  ///< lines of a borrowed place
    [[no_unique_address]] std::conditional_t<holds_numbers, std::array<double, number_size>, unset>
        number_; ///< where it has no variable and no place
};

namespace number_detail {
/// The size of a result of models of these sizes. @throws std::logic_error if they do not go
/// together
template <class C>
[[nodiscard, gnu::always_inline]] inline model_shape<C> const&
common_shape(model_shape<C> const& a, model_shape<C> const& b) {
    if (&a == &b || b.terms == 1) return a;
    if (a.terms != 1) throw std::logic_error("taylor_model: two sizes in one operation");
    return b;
}
} // namespace number_detail

/// Models up to one size, one behind the other in memory of their own: numbers until they are
/// assigned to. `taylor_models[i]` is a model that borrows its place.
template <class C>
class taylor_models {
public:
    using model = taylor_model<C>;

    taylor_models() = default;
    taylor_models(std::size_t count, model_shape<C> const& s) {
        if (s.terms == 1 && std::is_same_v<C, double>) {
            models_.resize(count); // these have their numbers within themselves
            return;
        }
        memory_ = number_detail::workspace<C>(count * numbers(s),
                                              typename number_detail::workspace<C>::unset{});
        models_.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            models_.emplace_back(typename model::place{memory_.data() + i * numbers(s), s.lines});
        }
    }
    taylor_models(taylor_models&&) noexcept = default;
    taylor_models& operator=(taylor_models&&) noexcept = default;

    [[nodiscard]] std::size_t size() const { return models_.size(); }
    [[nodiscard]] model& operator[](std::size_t i) { return models_[i]; }
    [[nodiscard]] model const& operator[](std::size_t i) const { return models_[i]; }

private:
    static std::size_t numbers(model_shape<C> const& s) {
        return s.lines * number_detail::aligned_blocks::line / sizeof(C);
    }

    number_detail::workspace<C> memory_;
    std::vector<model> models_;
};

} // namespace sivid

#endif
