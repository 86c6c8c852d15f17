// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_TAYLOR_MODEL_HPP
#define SIVID_NUMBER_TAYLOR_MODEL_HPP

#include <sivid/number/interval_traits.hpp>
#include <sivid/number/pack/lanes.hpp>
#include <sivid/number/polynomial/detail/model_shape.hpp>
#include <sivid/number/polynomial/detail/product_kernels.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <stdexcept>
#include <tuple>
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

namespace sivid {

/// Series in time of single Taylor models, once more, with the orders side by side: one row for
/// each coefficient, each norm, the polynomial's norm and the radius. Coefficients of products of
/// two series are then dot products of rows, eight orders in one vector register.
class series_rows {
public:
    using model = taylor_model<double>;
    static constexpr std::size_t at_once = row_layout::at_once;

    series_rows() = default;
    /// @param orders  0 .. orders - 1 of each series will be kept
    series_rows(std::size_t series, std::size_t orders, model_shape<double> const& s)
        : shape_(&s),
          pitch_(at_once + (orders + at_once - 1) / at_once * at_once),
          numbers_(series * rows() * pitch_) {}

    /// Enters coefficient k of a series.
    /// @given  a has the size that was announced, or is a number
    void put(std::size_t series, std::size_t k, model const& a) {
        if (&number_detail::common_shape(*shape_, a.shape()) != shape_)
            throw std::logic_error("series_rows: a model of another size");
        double* p = numbers_.data() + series * rows() * pitch_ + at_once + k;
        std::size_t const terms = a.terms();
        for (std::size_t i = 0; i < terms; ++i, p += pitch_) *p = a.c(i);
        for (std::size_t i = terms; i < shape_->terms; ++i, p += pitch_) *p = 0;
        for (std::size_t d = 1; d <= shape_->degree; ++d, p += pitch_) {
            *p = d <= a.degree() ? a.norms()[d] : 0.0;
        }
        *p = a.polynomial_norm();
        *(p + pitch_) = a.r();
    }
    /// Where coefficient 0 of the first row of a series is; `at_once` numbers in front of each row
    /// may be read.
    [[nodiscard]] double const* begin(std::size_t series) const {
        return numbers_.data() + series * rows() * pitch_ + at_once;
    }
    /// Distance between rows.
    [[nodiscard]] std::size_t pitch() const { return pitch_; }
    [[nodiscard]] model_shape<double> const& shape() const { return *shape_; }

private:
    [[nodiscard]] std::size_t rows() const {
        return row_layout::rows(shape_->terms, shape_->degree);
    }

    model_shape<double> const* shape_ = nullptr;
    std::size_t pitch_ = at_once;
    number_detail::workspace<double> numbers_;
};

} // namespace sivid

namespace sivid {

/// Sums of products of Taylor models, with one rounding bound for the whole sum.
template <class C = double>
class product_sum {
    using model = taylor_model<C>;
    using shape_type = model_shape<C>;

public:
    /// 0, of whatever size the first addend has.
    product_sum() : sum_(own_memory_) {}
    /// The same, formed in the memory of `place`.
    /// @given  no addend is there
    explicit product_sum(model& place) : sum_(place) {}
    product_sum(product_sum const&) = delete;
    product_sum& operator=(product_sum const&) = delete;

    /// Adds factor * a * b, the factor a small integer.
    void add(model const& a, model const& b, double factor = 1) {
        if (a.is_constant()) return add_multiple(b, a, factor);
        if (b.is_constant()) return add_multiple(a, b, factor);
        auto const& s = begin(number_detail::common_shape(a.shape(), b.shape()));
        s.multiply(*s.space, sum_.c(), a.c(), b.c(), factor);
        // What the product has beyond degree D, and the radii times everything.
        double const up = s.up, size = std::abs(factor);
        C const* const x = a.c() + s.radius; // radius, norms 1 .. D together, norms 0 .. D
        C const* const y = b.c() + s.radius;
        C const pa = (x[1] + x[2]) * up;
        C const pb = (y[1] + y[2]) * up;
        C lost = x[0] * (pb + y[0]) + y[0] * pa;
        C high{};
        C const* from = y + 2 + s.degree;
        C const* const end = x + 2 + s.degree;
        for (C const* norm = x + 3; norm <= end; ++norm, --from) {
            high += *from;
            lost += *norm * high;
        }
        radius_ += lost * size;
        C const mass = pa * pb * size;
        mass_ += mass;
        own_ += mass * (s.longest_sum + rounds(factor));
        additions_ += 1;
    }
    /// Adds factor * a.
    void add(model const& a, double factor = 1) {
        begin(a.shape());
        product_detail::each_coefficient(
            a.shape(), [factor](auto& c, auto const& x) { c += x * factor; }, sum_.c(), a.c());
        radius_ += a.r() * std::abs(factor);
        C const mass = a.polynomial_norm() * std::abs(factor);
        mass_ += mass;
        own_ += mass * rounds(factor);
        additions_ += 1;
    }
    /// Adds factor * \f$ \sum_{j=from}^{to} w_j a_j b_{k-j} \f$ of two series that are kept in
    /// rows, the factor a small integer.
    void
    add_convolution(series_rows const& rows, std::size_t a, std::size_t b, std::size_t k,
                    std::size_t from, std::size_t to, double factor = 1,
                    convolved_by weight = convolved_by::one) requires(std::is_same_v<C, double>) {
        auto const& s = begin(rows.shape());
        bool const fresh = blocks_ == 0;
        if (fresh) partial_.resize(row_layout::sums(s.terms) * (row_layout::at_once + 1));
        blocks_ += static_cast<double>(to / row_layout::at_once - from / row_layout::at_once + 1);
        s.convolve(*s.space, partial_.data(),
                   {rows.begin(a), rows.begin(b), rows.pitch(), rows.pitch(), k, from, to, factor,
                    weight, fresh});
    }
    /// Completes the sum, in its place.
    void finish();
    [[nodiscard]] model result() {
        finish();
        return std::move(sum_);
    }
    void result_into(model& m) {
        finish();
        if (&m != &sum_) m = std::move(sum_);
    }

private:
    /// How often multiplying by it rounds.
    static double rounds(double factor) { return std::abs(factor) == 1 ? 0 : 1; }
    /// Makes the sum one of models of that size.
    shape_type const& begin(shape_type const& s) {
        if (&s == shape_) return s;
        if (shape_ != nullptr && &number_detail::common_shape(*shape_, s) == shape_) {
            return *shape_;
        }
        C const value = shape_ == nullptr ? C(0.0) : sum_.c(0);
        sum_.reshape(s);
        product_detail::each_coefficient(
            s, [](auto& c) { c = std::remove_reference_t<decltype(c)>{}; }, sum_.c());
        sum_.c(0) = value;
        shape_ = &s;
        return s;
    }
    /// The same for a factor that does not depend on the variables.
    void add_multiple(model const& a, model const& number, double factor) {
        begin(a.shape());
        C const times = number.c(0) * factor;
        product_detail::each_coefficient(
            a.shape(), [times](auto& c, auto const& x) { c += x * times; }, sum_.c(), a.c());
        C const norm = a.polynomial_norm();
        double const size = std::abs(factor);
        radius_ += (number.r() * (norm + a.r()) + a.r() * number.norms()[0]) * size;
        C const mass = norm * number.norms()[0] * size;
        mass_ += mass;
        own_ += mass * (1 + rounds(factor));
        additions_ += 1;
    }
    model own_memory_{typename model::unset{}};
    model& sum_;
    shape_type const* shape_ = nullptr; ///< of the sum, once there is an addend
    C radius_{}, mass_{}, own_{};
    double additions_ = 0;
    double blocks_ = 0; ///< vectors of products that were added to the partial sums
    struct nothing {};
    /// Eight partial sums of each coefficient, of what convolutions lose, and of their size; then
    /// room for their totals.
    [[no_unique_address]] std::conditional_t<std::is_same_v<C, double>,
                                             number_detail::scratch<double>, nothing>
        partial_;
};

template <class C>
void product_sum<C>::finish() {
    if (shape_ == nullptr) begin(shape_type::number());
    auto const& s = *shape_;
    double joined = additions_, operations = additions_;
    if constexpr (std::is_same_v<C, double>) {
        if (blocks_ > 0) {
            double* const total = partial_.data() + row_layout::sums(s.terms) * row_layout::at_once;
            product_detail::add_up_rows(s.terms, partial_.data(), total);
            double const size = total[s.terms + 1];
            radius_ += total[s.terms];
            mass_ += size;
            // These are no coefficients, and beyond them nothing was written.
            std::fill(total + s.terms, total + row_layout::sums(s.terms), 0.0);
            product_detail::each_coefficient(
                s, [](auto& c, auto const& x) { c += x; }, sum_.c(),
                static_cast<double const*>(total));
            // A term is weighted, multiplied, stands in the partial sum that is added to at
            // most `longest_sum` times a block, the first time to 0, and in three more where
            // the partial sums join.
            own_ += size * (blocks_ * s.longest_sum + 4);
            joined += 1;
            operations += 1 + blocks_ * (s.longest_sum + static_cast<double>(2 * s.degree + 4));
        }
    }
    // Each operation errs by a unit of its result: within a product by a unit of its own mass,
    // where its sum joins the total by a unit of the total mass; the first one joins 0.
    C const rounding = (own_ + mass_ * std::max(joined - 1, 0.0)) * model::unit;
    sum_.r() = (radius_ + rounding) * (s.up + 8 * operations * model::unit) + model::tiny;
    sum_.finish();
    sum_.give_up_when_huge(mass_);
}

} // namespace sivid

namespace sivid {

template <class C>
[[nodiscard]] taylor_model<C> operator-(taylor_model<C> const& a) {
    taylor_model<C> result(a.shape(), typename taylor_model<C>::unset{});
    auto const& s = a.shape();
    product_detail::each_coefficient(
        s, [](auto& y, auto const& x) { y = -x; }, result.c(), a.c());
    std::copy_n(a.c() + s.radius, s.numbers - s.radius, result.c() + s.radius);
    return result;
}

namespace number_detail {
template <int Sign, class C>
void sum_into(taylor_model<C>& result, taylor_model<C> const& a, taylor_model<C> const& b) {
    using model = taylor_model<C>;
    auto const signed_by = [](C const& x) { return Sign > 0 ? x : -x; };
    C const mass = a.polynomial_norm() + b.polynomial_norm();
    C const radius = a.r() + b.r();
    auto const& s = common_shape(a.shape(), b.shape());
    if (&a.shape() == &b.shape()) {
        result.reshape(s); // the same, where it is one of the operands
        product_detail::each_coefficient(
            s, [](auto& z, auto const& x, auto const& y) { z = Sign > 0 ? x + y : x - y; },
            result.c(), a.c(), b.c());
        result.r() = (radius + mass * model::unit) * s.up;
        result.finish();
    } else { // nothing but the constant term, and its norm, changes
        C const c = a.c(0) + signed_by(b.c(0));
        if (b.is_number()) {
            result = a;
        } else {
            result = b;
            for (std::size_t i = 0; i < s.terms; ++i) result.c(i) = signed_by(result.c(i));
        }
        result.c(0) = c;
        result.norms()[0] = model::side_by_side::abs(c) * s.up;
        result.r() = (radius + mass * model::unit) * s.up;
    }
    result.give_up_when_huge(mass);
}
template <int Sign, class C>
taylor_model<C> sum(taylor_model<C> const& a, taylor_model<C> const& b) {
    taylor_model<C> result(common_shape(a.shape(), b.shape()), typename taylor_model<C>::unset{});
    sum_into<Sign>(result, a, b);
    return result;
}
} // namespace number_detail

template <class C>
[[nodiscard]] taylor_model<C> operator+(taylor_model<C> const& a, taylor_model<C> const& b) {
    return number_detail::sum<1>(a, b);
}
template <class C>
[[nodiscard]] taylor_model<C> operator-(taylor_model<C> const& a, taylor_model<C> const& b) {
    return number_detail::sum<-1>(a, b);
}
template <class C>
[[nodiscard]] taylor_model<C> operator*(taylor_model<C> const& a, taylor_model<C> const& b) {
    product_sum<C> sum;
    sum.add(a, b);
    return sum.result();
}

namespace number_detail {
template <class C>
void scale_into(taylor_model<C>& result, taylor_model<C> const& a, C const& m, C const& rho) {
    using model = taylor_model<C>;
    C const norm = a.polynomial_norm();
    C const size = model::side_by_side::abs(m);
    result.reshape(a.shape()); // the same, where it is a
    // norm * size first: the unit times a tiny factor would underflow.
    C const radius =
        (a.r() * (size + rho) + norm * rho + norm * size * model::unit) * a.shape().up +
        model::tiny;
    if (a.is_number()) {
        C const c = a.c(0) * m;
        C const bound = a.norms()[0] * size * a.shape().up +
                        model::side_by_side::min(a.norms()[0], C(model::tiny));
        result.c(0) = c;
        result.above() = C(0.0);
        result.norms()[0] = bound;
    } else {
        product_detail::each_coefficient(
            a.shape(), [&m](auto& y, auto const& x) { y = x * m; }, result.c(), a.c());
        result.finish_multiple(a, size);
    }
    result.r() = radius;
    result.give_up_when_huge(norm * (size + rho));
}
} // namespace number_detail

/// a times a number from \f$ [m - \rho, m + \rho] \f$.
template <class C>
[[nodiscard]] taylor_model<C> scaled(taylor_model<C> const& a, std::type_identity_t<C> const& m,
                                     std::type_identity_t<C> const& rho = C(0.0)) {
    taylor_model<C> result(a.shape(), typename taylor_model<C>::unset{});
    number_detail::scale_into(result, a, m, rho);
    return result;
}
template <class C>
[[nodiscard]] taylor_model<C> scaled(taylor_model<C> const& a, interval const& s) {
    return scaled(a, C(mid(s)), C(rad(s)));
}

/// The same function with an interval \f$ [-w, w] \f$ added.
template <class C>
[[nodiscard]] taylor_model<C> widened(taylor_model<C> a, std::type_identity_t<C> const& w) {
    a.r() = (a.r() + w) * a.shape().up;
    a.give_up_when_huge(C(0.0));
    return a;
}

/// Lower and upper bounds, in each lane. Not finite where nothing is known.
template <class C>
struct value_bounds {
    C lower, upper;
    /// The least absolute value between them, 0 where they have different signs.
    [[nodiscard]] C least() const {
        using side_by_side = lane_traits<C>;
        return side_by_side::max(side_by_side::max(lower, -upper), C(0.0));
    }
};

/// Bounds by the norms alone: cheap, and wide when terms of high degree cancel.
template <class C>
[[nodiscard]] value_bounds<C> rough_bounds(taylor_model<C> const& a) {
    using model = taylor_model<C>;
    C const w = (a.spread() + a.r()) * a.shape().up;
    // Two subtractions, each off by less than two units of |c_0| + w.
    C const out = w + (model::side_by_side::abs(a.c(0)) + w) * (8 * model::unit) + model::tiny;
    return {a.c(0) - out, a.c(0) + out};
}
[[nodiscard]] inline interval rough_range(taylor_model<double> const& a) {
    auto const b = rough_bounds(a);
    if (!std::isfinite(b.lower) || !std::isfinite(b.upper))
        return interval_traits<interval>::entire();
    return interval(b.lower, b.upper);
}

/// One of the functions that lie side by side.
template <class C>
[[nodiscard]] taylor_model<double> lane_of(taylor_model<C> const& a, std::size_t lane) {
    auto const& s = a.shape().single();
    taylor_model<double> result(s);
    for (std::size_t i = 0; i < s.terms; ++i) result.c(i) = lane_traits<C>::get(a.c(i), lane);
    for (std::size_t i = 0; i < s.numbers - s.radius; ++i) {
        result.c(s.radius + i) = lane_traits<C>::get(a.c(a.shape().radius + i), lane);
    }
    return result;
}

/// a in so many variables: what is not there is 0.
template <class C>
[[nodiscard]] taylor_model<C> in_shape(taylor_model<C> const& a, model_shape<C> const& s) {
    if (&a.shape() == &s) return a;
    taylor_model<C> result(s);
    result.c(0) = a.c(0);
    result.r() = a.r();
    result.norms()[0] = a.norms()[0];
    if (a.is_number()) return result;
    throw std::logic_error("taylor_model: two sizes in one operation");
}

/// a where the mask is set, else b.
template <class C>
[[nodiscard]] taylor_model<C> select(typename lane_traits<C>::mask const& m,
                                     taylor_model<C> const& a, taylor_model<C> const& b) {
    using side_by_side = lane_traits<C>;
    if (side_by_side::all(m)) return a;
    if (!side_by_side::any(m)) return b;
    if (&a.shape() != &b.shape()) {
        auto const& s = a.is_number() ? b.shape() : a.shape();
        return select(m, in_shape(a, s), in_shape(b, s));
    }
    taylor_model<C> result(a.shape(), typename taylor_model<C>::unset{});
    for (std::size_t i = 0; i < a.shape().numbers; ++i) {
        result.c(i) = side_by_side::select(m, a.c(i), b.c(i));
    }
    return result;
}

template <class C>
[[nodiscard]] taylor_model<C> select(typename lane_traits<C>::mask const& m, taylor_model<C>&& a,
                                     taylor_model<C> const& b) {
    if (lane_traits<C>::all(m)) return std::move(a);
    return select(m, std::as_const(a), b);
}

namespace number_detail {
/// Where each monomial of one space stands in another when it is multiplied by a power of that
/// one's last variable; `wide.terms()` where its degree is too high.
/// @given  power > 0 only where `wide` has more variables
[[nodiscard]] inline std::vector<std::uint32_t> const&
image_of(monomial_space const& narrow, monomial_space const& wide, std::size_t power) {
    using key = std::tuple<monomial_space const*, monomial_space const*, std::size_t>;
    static std::mutex guard;
    static std::map<key, std::unique_ptr<std::vector<std::uint32_t>>> made;
    std::scoped_lock const lock(guard);
    auto& image = made[{&narrow, &wide, power}];
    if (image) return *image;
    image = std::make_unique<std::vector<std::uint32_t>>();
    for (std::size_t m = 0; m < narrow.terms(); ++m) {
        auto const* const e = narrow.exponents(m);
        image->push_back(static_cast<std::uint32_t>(wide.find([&](std::size_t v) -> std::size_t {
            std::size_t const own = v < narrow.variables() ? e[v] : 0;
            return v + 1 == wide.variables() ? own + power : own;
        })));
    }
    return *image;
}
} // namespace number_detail

/// Re-expresses a model in other variables and degree: variable v becomes variable v of at least as
/// many; terms beyond the degree go into the radius.
template <class C>
[[nodiscard]] taylor_model<C> converted(taylor_model<C> const& a, model_shape<C> const& s) {
    if (a.is_number()) return a;
    if (s.variables < a.shape().variables) {
        throw std::logic_error("taylor_model: converted to fewer variables");
    }
    taylor_model<C> result(s);
    if (s.variables == a.shape().variables) {
        std::copy_n(a.c(), std::min(s.terms, a.terms()), result.c());
    } else {
        auto const& image = number_detail::image_of(a.space(), *s.space, 0);
        for (std::size_t i = 0; i < a.terms(); ++i) {
            if (image[i] < s.terms) result.c(image[i]) = a.c(i);
        }
    }
    C cut{};
    for (std::size_t k = s.degree + 1; k <= a.degree(); ++k) cut += a.norms()[k];
    result.r() = (a.r() + cut) * a.shape().up;
    result.finish();
    return result;
}

/// Forgets the last variable: for each q, all values over \f$ [-1,1] \f$ of that variable.
/// @param s  one variable less, and any degree
template <class C>
[[nodiscard]] taylor_model<C> without_last_variable(taylor_model<C> const& a,
                                                    model_shape<C> const& s) {
    using side_by_side = lane_traits<C>;
    if (a.is_number()) return a;
    auto const& small = model_shape<C>::of(s.variables, a.degree());
    auto const& image = number_detail::image_of(*small.space, a.space(), 0);
    taylor_model<C> result(small);
    for (std::size_t i = 0; i < small.terms; ++i) result.c(i) = a.c(image[i]);
    // Where the last variable is absent stands in the image, in rising order.
    C moved{};
    std::size_t next = 0;
    for (std::size_t k = 0; k < a.terms(); ++k) {
        if (next < small.terms && image[next] == k) {
            ++next;
        } else {
            moved += side_by_side::abs(a.c(k));
        }
    }
    result.r() = (a.r() + moved * a.shape().up) * a.shape().up;
    result.finish();
    return converted(result, s);
}

} // namespace sivid

#endif
