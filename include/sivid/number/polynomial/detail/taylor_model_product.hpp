// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_POLYNOMIAL_DETAIL_TAYLOR_MODEL_PRODUCT_HPP
#define SIVID_NUMBER_POLYNOMIAL_DETAIL_TAYLOR_MODEL_PRODUCT_HPP

#include <sivid/number/polynomial/detail/series_rows.hpp>
#include <sivid/number/polynomial/detail/taylor_model_class.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

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

#endif
