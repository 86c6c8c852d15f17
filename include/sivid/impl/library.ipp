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

inline namespace SIVID_PACK_TARGET {

template <class Containers>
char library_for<Containers>::sivid_compiled_has_other_machine_flags = 0;

} // namespace SIVID_PACK_TARGET

template <int Version, int MaxAlignBytes, int MaxStaticAlignBytes, std::size_t IndexBytes,
          int StorageOrder>
char library_for_eigen<Version, MaxAlignBytes, MaxStaticAlignBytes, IndexBytes,
                       StorageOrder>::sivid_compiled_has_another_eigen_alignment = 0;

} // namespace sivid

#endif
