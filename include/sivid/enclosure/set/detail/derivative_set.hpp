// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_SET_DETAIL_DERIVATIVE_SET_HPP
#define SIVID_ENCLOSURE_SET_DETAIL_DERIVATIVE_SET_HPP

#include <sivid/space/box.hpp>
#include <sivid/space/frame/orthogonal_frame.hpp>
#include <sivid/space/matrix.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// What is not known of the columns of a matrix that linear maps carry along: column c lies within
/// \f$ B r_c \f$ of its centre, with one orthogonal frame B for all columns, so that intervals do
/// not wrap from step to step.
/// @ref  Lohner 1987; Zgliczynski 2002 (C1-Lohner)
template <class I>
class framed_columns {
    using traits = interval_traits<I>;

public:
    framed_columns() = default;
    framed_columns(std::size_t n, std::size_t columns)
        : axes_(Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(n),
                                          static_cast<Eigen::Index>(n))),
          inside_(n, columns) {}

    /// The whole of \f$ \{ A B r_c + d_c \} \f$ for A in `a` and d in `rest`, in a new frame.
    /// @param a     n x n
    /// @param rest  n x columns
    void map(interval_matrix<I> const& a, interval_matrix<I> const& rest) {
        auto const turned = product(a, axes_);
        std::vector<double> weights(inside_.rows(), 0.0);
        for (std::size_t i = 0; i < inside_.rows(); ++i) {
            for (std::size_t c = 0; c < inside_.cols(); ++c) {
                weights[i] = std::max(weights[i], traits::mag(inside_(i, c)));
            }
        }
        auto frame = make_frame<I>(approximate_mid(turned), weights);
        auto const old = product(product(frame.inverse, turned), inside_);
        auto const fresh = product(frame.inverse, rest);
        for (std::size_t i = 0; i < inside_.rows(); ++i) {
            for (std::size_t c = 0; c < inside_.cols(); ++c) {
                inside_(i, c) = traits::add(old(i, c), fresh(i, c));
            }
        }
        axes_ = std::move(frame.axes);
    }

    /// \f$ (B r_c)_i \f$
    [[nodiscard]] I operator()(std::size_t i, std::size_t c) const {
        I sum = traits::point(0.0);
        for (std::size_t k = 0; k < inside_.rows(); ++k) {
            double const b = axes_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
            sum = traits::add(sum, traits::mul(traits::point(b), inside_(k, c)));
        }
        return sum;
    }

private:
    Eigen::MatrixXd axes_;      ///< B
    interval_matrix<I> inside_; ///< r
};

/// The derivatives \f$ S = \partial x(t) / \partial (x_0, p) \f$ of all members of a family, an
/// n x (n + parameters) matrix: \f$ S_c \in centre_c + B r_c \f$, and S in a hull.
template <class I>
class derivative_set {
    using traits = interval_traits<I>;

public:
    derivative_set() = default;
    /// [1, 0]: at the start.
    derivative_set(std::size_t n, std::size_t parameters)
        : centre_(Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n),
                                        static_cast<Eigen::Index>(n + parameters))),
          rest_(n, n + parameters),
          hull_(n, n + parameters) {
        centre_.leftCols(static_cast<Eigen::Index>(n)).setIdentity();
        for (std::size_t i = 0; i < n; ++i) hull_(i, i) = traits::point(1.0);
    }

    /// An enclosure of S, entry by entry.
    [[nodiscard]] interval_matrix<I> const& hull() const { return hull_; }

    /// \f$ J_x S + [0, J_p] \f$ for all J in j, n x (n + parameters).
    [[nodiscard]] derivative_set mapped(interval_matrix<I> const& j) const {
        auto const n = j.rows();
        auto const columns = j.cols();
        interval_matrix<I> jx(n, n);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t k = 0; k < n; ++k) jx(i, k) = j(i, k);
        }
        auto image = product(jx, centre_);
        auto direct = product(jx, hull_);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = n; c < columns; ++c) {
                image(i, c) = traits::add(image(i, c), j(i, c));
                direct(i, c) = traits::add(direct(i, c), j(i, c));
            }
        }
        derivative_set next = *this;
        next.centre_ = approximate_mid(image);
        if (!next.centre_.allFinite()) next.centre_.setZero();
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = 0; c < columns; ++c) {
                image(i, c) = traits::sub(image(i, c), traits::point(next.centre(i, c)));
            }
        }
        next.rest_.map(jx, image);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = 0; c < columns; ++c) {
                auto const framed = traits::add(traits::point(next.centre(i, c)), next.rest_(i, c));
                next.hull_(i, c) = traits::intersect(direct(i, c), framed);
            }
        }
        return next;
    }

private:
    [[nodiscard]] double centre(std::size_t i, std::size_t c) const {
        return centre_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c));
    }

    Eigen::MatrixXd centre_;
    framed_columns<I> rest_;
    interval_matrix<I> hull_;
};

} // namespace sivid

#endif
