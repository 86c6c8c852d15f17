// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_DENSE_HPP
#define SIVID_SPACE_DENSE_HPP

/// @file
/// Dense linear algebra in doubles, compiled once. Nothing here is proved, and nothing throws: what
/// is singular gives entries that are not finite, unless said otherwise. No other header of sivid
/// includes a decomposition of Eigen's (a test enforces it), since each costs its users seconds.

#include <sivid/compiled.hpp>
#include <sivid/space/detail/compiled_eigen.hpp>

#include <Eigen/Core>

namespace sivid {

/// \f$ A^{-1} \f$ up to rounding, by LU with partial pivoting.
/// @cost  2 n^3
[[nodiscard]] SIVID_DECL Eigen::MatrixXd approximate_inverse(Eigen::MatrixXd const& a);

/// X with A X = B up to rounding, by LU with partial pivoting.
/// @cost  2/3 n^3, and 2 n^2 for a column of B
[[nodiscard]] SIVID_DECL Eigen::MatrixXd approximate_solution(Eigen::MatrixXd const& a,
                                                              Eigen::MatrixXd const& b);

/// X that minimises |A X - B|, by QR with pivoting; 0 for what A does not determine.
/// @cost  2 m n^2 for m rows and n columns
[[nodiscard]] SIVID_DECL Eigen::MatrixXd approximate_least_squares(Eigen::MatrixXd const& a,
                                                                   Eigen::MatrixXd const& b);

/// An orthonormal basis of what is orthogonal to all columns of A; A has at least one.
/// @cost  4/3 n^3
[[nodiscard]] SIVID_DECL Eigen::MatrixXd approximate_complement(Eigen::MatrixXd const& a);

/// A = L L^T for a symmetric positive definite A, of which the lower triangle is read.
/// @cost  n^3 / 3, and n^2 for a column solved by a triangle
class approximate_cholesky {
public:
    /// @returns false where a pivot is not positive; nothing can be solved then
    [[nodiscard]] SIVID_DECL bool compute(Eigen::MatrixXd const& a);
    [[nodiscard]] bool computed() const { return computed_; }

    /// X with A X = B.
    [[nodiscard]] SIVID_DECL Eigen::MatrixXd solve(Eigen::MatrixXd const& b) const;
    /// X with L X = B, of the size of B.
    [[nodiscard]] SIVID_DECL Eigen::MatrixXd solve_lower(Eigen::MatrixXd const& b) const;
    /// X with L^T X = B, of the size of B.
    [[nodiscard]] SIVID_DECL Eigen::MatrixXd solve_upper(Eigen::MatrixXd const& b) const;

private:
    Eigen::MatrixXd lower_;
    bool computed_ = false;
};

/// A = U diag(s) V^T with s descending, of n columns: U has n columns as well, and V is square.
/// Columns of U whose s is 0 are 0. By one-sided Jacobi rotations, which tell small singular
/// values beside large ones.
/// @cost  about 50 m n^2 for m rows
struct approximate_svd {
    Eigen::VectorXd values;
    Eigen::MatrixXd left, right;

    SIVID_DECL explicit approximate_svd(Eigen::MatrixXd const& a);
};

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/space/impl/dense.ipp>
#endif

#endif
