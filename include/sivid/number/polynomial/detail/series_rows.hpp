// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_POLYNOMIAL_DETAIL_SERIES_ROWS_HPP
#define SIVID_NUMBER_POLYNOMIAL_DETAIL_SERIES_ROWS_HPP

#include <sivid/number/polynomial/detail/taylor_model_class.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

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

#endif
