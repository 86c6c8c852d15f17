// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_MATRIX_HPP
#define SIVID_SPACE_MATRIX_HPP

#include <sivid/number/interval_traits.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/detail/compiled_eigen.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace sivid {

/// A small dense matrix of intervals, stored by rows. Its products go through `interval_traits`, so
/// that every scalar type, packs included, uses its own kernels; Eigen holds the matrices of
/// doubles.
template <class I>
class interval_matrix {
    using traits = interval_traits<I>;

public:
    interval_matrix() = default;
    interval_matrix(std::size_t rows, std::size_t cols)
        : rows_(rows), cols_(cols), entries_(rows * cols, traits::point(0.0)) {}

    [[nodiscard]] static interval_matrix identity(std::size_t n) {
        interval_matrix result(n, n);
        for (std::size_t i = 0; i < n; ++i) result(i, i) = traits::point(1.0);
        return result;
    }

    [[nodiscard]] std::size_t rows() const { return rows_; }
    [[nodiscard]] std::size_t cols() const { return cols_; }
    I& operator()(std::size_t i, std::size_t j) { return entries_[i * cols_ + j]; }
    I const& operator()(std::size_t i, std::size_t j) const { return entries_[i * cols_ + j]; }

private:
    std::size_t rows_ = 0;
    std::size_t cols_ = 0;
    std::vector<I> entries_;
};

/// \f$ A x \f$.
template <class I>
[[nodiscard]] basic_box<I> product(interval_matrix<I> const& a, basic_box<I> const& x) {
    using traits = interval_traits<I>;
    basic_box<I> result(a.rows());
    for (std::size_t i = 0; i < a.rows(); ++i) {
        for (std::size_t j = 0; j < a.cols(); ++j) {
            result[i] = traits::add(result[i], traits::mul(a(i, j), x[j]));
        }
    }
    return result;
}

/// \f$ A B \f$.
template <class I>
[[nodiscard]] interval_matrix<I> product(interval_matrix<I> const& a, interval_matrix<I> const& b) {
    using traits = interval_traits<I>;
    interval_matrix<I> result(a.rows(), b.cols());
    for (std::size_t i = 0; i < a.rows(); ++i) {
        for (std::size_t k = 0; k < a.cols(); ++k) {
            for (std::size_t j = 0; j < b.cols(); ++j) {
                result(i, j) = traits::add(result(i, j), traits::mul(a(i, k), b(k, j)));
            }
        }
    }
    return result;
}

/// \f$ A B \f$ with a matrix of doubles on the right; zero entries of B cost nothing.
template <class I>
[[nodiscard]] interval_matrix<I> product(interval_matrix<I> const& a, Eigen::MatrixXd const& b) {
    using traits = interval_traits<I>;
    interval_matrix<I> result(a.rows(), static_cast<std::size_t>(b.cols()));
    for (std::size_t k = 0; k < a.cols(); ++k) {
        for (std::size_t j = 0; j < result.cols(); ++j) {
            double const factor = b(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j));
            if (factor == 0) continue;
            for (std::size_t i = 0; i < a.rows(); ++i) {
                result(i, j) =
                    traits::add(result(i, j), traits::mul(a(i, k), traits::point(factor)));
            }
        }
    }
    return result;
}

/// \f$ A x \f$ with a matrix of doubles.
template <class I>
[[nodiscard]] basic_box<I> product(Eigen::MatrixXd const& a, basic_box<I> const& x) {
    using traits = interval_traits<I>;
    basic_box<I> result(static_cast<std::size_t>(a.rows()));
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
        for (Eigen::Index j = 0; j < a.cols(); ++j) {
            auto& sum = result[static_cast<std::size_t>(i)];
            sum = traits::add(sum,
                              traits::mul(traits::point(a(i, j)), x[static_cast<std::size_t>(j)]));
        }
    }
    return result;
}

/// The doubles closest to the centres of the entries.
template <class I>
[[nodiscard]] Eigen::MatrixXd approximate_mid(interval_matrix<I> const& a) {
    Eigen::MatrixXd result(static_cast<Eigen::Index>(a.rows()),
                           static_cast<Eigen::Index>(a.cols()));
    for (std::size_t i = 0; i < a.rows(); ++i) {
        for (std::size_t j = 0; j < a.cols(); ++j) {
            result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
                interval_traits<I>::mid(a(i, j));
        }
    }
    return result;
}

template <class I>
[[nodiscard]] basic_box<I> add(basic_box<I> a, basic_box<I> const& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] = interval_traits<I>::add(a[i], b[i]);
    return a;
}

/// \f$ x - c \f$ for a vector of doubles.
template <class I>
[[nodiscard]] basic_box<I> subtract(basic_box<I> x, std::vector<double> const& c) {
    using traits = interval_traits<I>;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = traits::sub(x[i], traits::point(c[i]));
    return x;
}

} // namespace sivid

#endif
