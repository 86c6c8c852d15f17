// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_EXACT_DETAIL_RATIONAL_BASIS_HPP
#define SIVID_SPACE_EXACT_DETAIL_RATIONAL_BASIS_HPP

#include <sivid/compiled.hpp>
#include <sivid/space/detail/compiled_eigen.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace sivid {

/// The smallest integers in the proportions of v, within `tolerance` of its largest entry.
/// @returns nothing when they would exceed `largest`, or v is 0
[[nodiscard]] SIVID_DECL std::optional<std::vector<int>>
approximate_integers(Eigen::VectorXd const& v, double tolerance, int largest = 6);

/// Vectors of small integers that span (part of) a space: its basis, brought to reduced echelon
/// form and rounded row by row.
/// @param basis  one column per vector, independent
/// @returns one vector for each row of the echelon form that is near one; the first entries that
/// are
///          not 0 are positive
[[nodiscard]] SIVID_DECL std::vector<std::vector<int>>
approximate_integer_basis(Eigen::MatrixXd const& basis, double tolerance, int largest = 6);

/// An orthonormal basis of what is orthogonal to all `vectors`, one column each.
[[nodiscard]] SIVID_DECL Eigen::MatrixXd
orthogonal_complement(std::vector<std::vector<int>> const& vectors, std::size_t dimension);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/space/exact/impl/rational_basis.ipp>
#endif

#endif
