// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_DETAIL_COMPILED_EIGEN_HPP
#define SIVID_SPACE_DETAIL_COMPILED_EIGEN_HPP

#include <sivid/compiled.hpp>

#include <Eigen/Core>

#include <cstddef>

#ifdef SIVID_COMPILED

namespace sivid {

/// As `library_for`, for what the layout of Eigen's matrices and the alignment of their memory
/// depend on: the instructions of the machine and Eigen's own macros and version.
template <int Version, int MaxAlignBytes, int MaxStaticAlignBytes, std::size_t IndexBytes,
          int StorageOrder>
struct SIVID_SHOWN library_for_eigen {
    static char const sivid_compiled_has_another_eigen_alignment;
};

SIVID_KEPT static char const* const library_for_this_eigen = &library_for_eigen<
    EIGEN_WORLD_VERSION * 10000 + EIGEN_MAJOR_VERSION * 100 + EIGEN_MINOR_VERSION,
    EIGEN_MAX_ALIGN_BYTES, EIGEN_MAX_STATIC_ALIGN_BYTES, sizeof(Eigen::Index),
    EIGEN_DEFAULT_MATRIX_STORAGE_ORDER_OPTION>::sivid_compiled_has_another_eigen_alignment;

} // namespace sivid

#endif

#endif
