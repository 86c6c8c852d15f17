// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_DENSE_HPP
#define SIVID_SPACE_DENSE_HPP

/// @file
/// Dense linear algebra in doubles, compiled once: by LU with partial pivoting. Nothing is proved;
/// what is singular gives entries that are not finite.

#include <sivid/compiled.hpp>
#include <sivid/space/detail/compiled_eigen.hpp>

#include <Eigen/Core>

namespace sivid {

/// \f$ A^{-1} \f$ up to rounding.
/// @cost  2 n^3
[[nodiscard]] SIVID_DECL Eigen::MatrixXd approximate_inverse(Eigen::MatrixXd const& a);

/// X with A X = B up to rounding.
/// @cost  2/3 n^3, and 2 n^2 for a column of B
[[nodiscard]] SIVID_DECL Eigen::MatrixXd approximate_solution(Eigen::MatrixXd const& a,
                                                              Eigen::MatrixXd const& b);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/space/impl/dense.ipp>
#endif

#endif
