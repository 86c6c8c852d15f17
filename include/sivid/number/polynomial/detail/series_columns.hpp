// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_POLYNOMIAL_DETAIL_SERIES_COLUMNS_HPP
#define SIVID_NUMBER_POLYNOMIAL_DETAIL_SERIES_COLUMNS_HPP

#include <sivid/number/taylor_model.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace sivid {

/// Rows of a matrix of series in time of single Taylor models, with the columns side by side: what
/// multiplies such a row multiplies all columns at once, eight in a few vector registers.
class series_columns {
public:
    using model = taylor_model<double>;
    static constexpr std::size_t at_once = column_layout::at_once;

    series_columns() = default;
    /// @param orders  0 .. orders - 1 of each series will be kept
    series_columns(std::size_t rows, std::size_t columns, std::size_t orders,
                   model_shape<double> const& s)
        : shape_(&s),
          layout_{s.terms, s.degree},
          orders_(orders),
          groups_((columns + at_once - 1) / at_once),
          numbers_(rows * groups_ * orders_ * layout_.count() * at_once) {}

    /// How many times eight columns there are.
    [[nodiscard]] std::size_t groups() const { return groups_; }
    [[nodiscard]] model_shape<double> const& shape() const { return *shape_; }
    /// Coefficient k of eight columns of a row; that of k - 1 stands before it.
    [[nodiscard]] double* at(std::size_t row, std::size_t group, std::size_t k) {
        return numbers_.data() + place(row, group, k);
    }
    [[nodiscard]] double const* at(std::size_t row, std::size_t group, std::size_t k) const {
        return numbers_.data() + place(row, group, k);
    }

    /// @given  a has the size that was announced, or is a number
    void put(std::size_t row, std::size_t column, std::size_t k, model const& a) {
        if (&number_detail::common_shape(*shape_, a.shape()) != shape_)
            throw std::logic_error("series_columns: a model of another size");
        double* const p = at(row, column / at_once, k) + column % at_once;
        auto const norm = [&](std::size_t d) { return d <= a.degree() ? a.norms()[d] : 0.0; };
        for (std::size_t i = 0; i < layout_.terms; ++i) {
            p[i * at_once] = i < a.terms() ? a.c(i) : 0.0;
        }
        double beyond = 0;
        for (std::size_t d = 1; d <= layout_.degree; ++d) {
            beyond += norm(layout_.degree + 1 - d);
            p[(layout_.beyond() + d - 1) * at_once] = beyond * shape_->up;
        }
        p[layout_.whole_norm() * at_once] = a.polynomial_norm();
        p[layout_.radius() * at_once] = a.r();
        for (std::size_t d = 0; d <= layout_.degree; ++d) {
            p[(layout_.norms() + d) * at_once] = norm(d);
        }
        p[layout_.above() * at_once] = a.above();
    }
    void get_into(model& a, std::size_t row, std::size_t column, std::size_t k) const {
        a.reshape(*shape_);
        double const* const p = at(row, column / at_once, k) + column % at_once;
        for (std::size_t i = 0; i < layout_.terms; ++i) a.c(i) = p[i * at_once];
        std::fill(a.c() + layout_.terms, a.c() + shape_->radius, 0.0);
        a.r() = p[layout_.radius() * at_once];
        for (std::size_t d = 0; d <= layout_.degree; ++d) {
            a.norms()[d] = p[(layout_.norms() + d) * at_once];
        }
        a.above() = p[layout_.above() * at_once];
    }
    [[nodiscard]] model get(std::size_t row, std::size_t column, std::size_t k) const {
        model a(*shape_, model::unset{});
        get_into(a, row, column, k);
        return a;
    }

private:
    [[nodiscard]] std::size_t place(std::size_t row, std::size_t group, std::size_t k) const {
        return ((row * groups_ + group) * orders_ + k) * layout_.count() * at_once;
    }

    model_shape<double> const* shape_ = nullptr;
    column_layout layout_{1, 0};
    std::size_t orders_ = 0, groups_ = 0;
    number_detail::workspace<double> numbers_;
};

/// A series in time of single Taylor models, as what multiplies `series_columns`.
class column_multiplier {
public:
    using model = taylor_model<double>;
    /// Far above what the least double loses, far below what matters: the radius has that much
    /// more, so that a rounding bound may underflow beside it.
    static constexpr double floor = 1e-300;

    column_multiplier() = default;
    column_multiplier(std::size_t orders, model_shape<double> const& s)
        : shape_(&s), layout_{s.terms, s.degree}, numbers_(orders * layout_.count()) {}
    /// @given  a has the size that was announced, or is a number
    void put(std::size_t k, model const& a) {
        if (&number_detail::common_shape(*shape_, a.shape()) != shape_)
            throw std::logic_error("column_multiplier: a model of another size");
        double* const p = numbers_.data() + k * layout_.count();
        for (std::size_t i = 0; i < layout_.terms; ++i) p[i] = i < a.terms() ? a.c(i) : 0.0;
        for (std::size_t d = 1; d <= layout_.degree; ++d) {
            p[layout_.norms() + d - 1] = d <= a.degree() ? a.norms()[d] : 0.0;
        }
        p[layout_.everything()] = a.polynomial_norm() + a.r();
        p[layout_.radius()] = a.r() + floor;
        p[layout_.whole_norm()] = a.polynomial_norm();
    }
    [[nodiscard]] double const* data() const { return numbers_.data(); }

private:
    model_shape<double> const* shape_ = &model_shape<double>::number();
    multiplier_layout layout_{1, 0};
    std::vector<double> numbers_;
};

/// A sum of convolutions of single series with rows of columns, and of single models, in all
/// columns: one rounding bound for each of them (`docs/theory/taylor_models.md`, section 1.1).
class columns_sum {
    using columns = series_columns;
    using model = taylor_model<double>;

public:
    columns_sum() = default;
    columns_sum(std::size_t groups, model_shape<double> const& s)
        : shape_(&s), size_((s.terms + 1) * columns::at_once * groups), totals_(size_) {}

    /// Begins with 0.
    /// @param longest  orders of the longest convolution that is expected
    /// @param addends  how many convolutions and models are expected; both expectations should be
    ///                 near, but need not be right
    void start(std::size_t longest, std::size_t addends) {
        std::fill_n(totals_.data(), size_, 0.0);
        expected_ = roundings(longest, addends);
        rounding_ = expected_ * (model::unit * (1 + 1e-9));
        expected_joins_ = joins(addends);
        join_rounding_ = expected_joins_ * (model::unit * (1 + 1e-9));
        longest_ = addends_ = 0;
        operations_ = 0;
    }
    /// Adds a model in one column.
    void add(std::size_t column, model const& a) {
        double* const p = totals(column / columns::at_once) + column % columns::at_once;
        for (std::size_t i = 0; i < a.terms(); ++i) p[i * columns::at_once] += a.c(i);
        p[shape_->terms * columns::at_once] +=
            a.r() + join_rounding_ * a.polynomial_norm() + model::tiny;
        ++addends_;
        operations_ += 4;
    }
    /// Adds \f$ \sum_{j=0}^{to} a_j v_{k-j} \f$, v a row.
    void add_convolution(column_multiplier const& a, columns const& v, std::size_t row,
                         std::size_t k, std::size_t to) {
        for (std::size_t g = 0; g < v.groups(); ++g) {
            shape_->add_columns(*shape_->space, totals(g), a.data(), v.at(row, g, k), to,
                                rounding_);
        }
        ++addends_;
        longest_ = std::max(longest_, to + 1);
        operations_ += static_cast<double>((to + 1) * (shape_->degree + 2) + 4);
    }
    /// Enters the sum, divided by a natural number, as coefficient k of a row.
    void divide_into(columns& v, std::size_t row, std::size_t k, std::size_t divisor) const {
        double const short_of = std::max(
            {1.0, roundings(longest_, addends_) / expected_, joins(addends_) / expected_joins_});
        double const up = short_of * (1 + (4 * operations_ + 64) * model::unit);
        for (std::size_t g = 0; g < v.groups(); ++g) {
            product_detail::divide_columns(*shape_->space, shape_->up, totals(g),
                                           static_cast<double>(divisor), up, v.at(row, g, k));
        }
    }

private:
    [[nodiscard]] double* totals(std::size_t group) {
        return totals_.data() + group * (shape_->terms + 1) * columns::at_once;
    }
    [[nodiscard]] double const* totals(std::size_t group) const {
        return totals_.data() + group * (shape_->terms + 1) * columns::at_once;
    }
    /// How often addends are rounded where they join; the first one joins 0. At least 1, as it
    /// divides.
    [[nodiscard]] static double joins(std::size_t addends) {
        return static_cast<double>(std::max<std::size_t>(addends, 2) - 1);
    }
    /// How often a product is rounded at most: in its convolution, and where addends join.
    [[nodiscard]] double roundings(std::size_t longest, std::size_t addends) const {
        constexpr std::size_t chunk = product_detail::column_chunk;
        std::size_t const orders = std::max<std::size_t>(longest, 1);
        if (shape_->terms > 1) {
            return static_cast<double>(orders) * shape_->longest_sum + joins(addends);
        }
        return static_cast<double>(std::min(orders, chunk + (orders - 1) / chunk)) + joins(addends);
    }

    model_shape<double> const* shape_ = nullptr;
    std::size_t size_ = 0;
    number_detail::workspace<double> totals_;
    double expected_ = 1;
    double rounding_ = 0;
    double expected_joins_ = 1;
    double join_rounding_ = 0;
    double operations_ = 0;
    std::size_t longest_ = 0, addends_ = 0;
};

} // namespace sivid

#endif
