// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_LIBRARY_IPP
#define SIVID_IMPL_LIBRARY_IPP

/// @file
/// What each source that is compiled with SIVID_COMPILED asks for: the machine and the layouts that
/// it and the library have in common.

#include <sivid/compiled.hpp>
#include <sivid/space/detail/compiled_eigen.hpp>

#include <cstddef>

namespace sivid {

template <class Compiler>
char const library_by<Compiler>::sivid_compiled_is_of_another_compiler = 0;

template <class Machine, class Containers>
char const library_for<Machine, Containers>::sivid_compiled_has_other_machine_flags = 0;

template <int Version, int MaxAlignBytes, int MaxStaticAlignBytes, std::size_t IndexBytes,
          int StorageOrder>
char const library_for_eigen<Version, MaxAlignBytes, MaxStaticAlignBytes, IndexBytes,
                             StorageOrder>::sivid_compiled_has_another_eigen_alignment = 0;

// Said outright: clang does not take them from their use, which stands before their definition.
template struct library_by<compiler_of_this_source>;
template struct library_for<this_machine, containers_of_this_source>;
template struct library_for<any_machine, containers_of_this_source>;
template struct library_for_eigen<EIGEN_WORLD_VERSION * 10000 + EIGEN_MAJOR_VERSION * 100 +
                                      EIGEN_MINOR_VERSION,
                                  EIGEN_MAX_ALIGN_BYTES, EIGEN_MAX_STATIC_ALIGN_BYTES,
                                  sizeof(Eigen::Index), EIGEN_DEFAULT_MATRIX_STORAGE_ORDER_OPTION>;

} // namespace sivid

#endif
