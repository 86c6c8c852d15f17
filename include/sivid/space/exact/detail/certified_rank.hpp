// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_EXACT_DETAIL_CERTIFIED_RANK_HPP
#define SIVID_SPACE_EXACT_DETAIL_CERTIFIED_RANK_HPP

#include <sivid/compiled.hpp>
#include <sivid/space/matrix.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

/// A number r such that every matrix within A has rank at least r.
///   With an approximate singular value decomposition \f$ M \approx U \Sigma V^T \f$ of the
///   centres, \f$ B = \Sigma_r^{-1} U_r^T A V_r \f$ is near the identity; where \f$ \| 1 - B
///   \|_\infty < 1 \f$ every member of B is regular, and \f$ rank(A) \ge rank(C A W) \f$ whatever C
///   and W are. The largest such r is taken. Rows that are unbounded or empty are left out.
/// @param weights  one positive number per row, by which rows are scaled for the decomposition; a
///                 preference. Empty: all equal
/// @guarantee  holds for every member; when r is the number of columns, one matrix is a left
/// inverse
///             of all members up to a regular factor, so that averages of members are injective too
/// @cost  about 3 rows columns^2 products and one decomposition
/// @ref   Rump, Verification methods, Acta Numerica 2010 (regularity by approximate inverses)
[[nodiscard]] SIVID_DECL std::size_t certified_rank(interval_matrix<interval> const& a,
                                                    std::vector<double> weights = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/space/exact/impl/certified_rank.ipp>
#endif

#endif
