// SPDX-License-Identifier: MIT
#ifndef SIVID_COMPILED_HPP
#define SIVID_COMPILED_HPP

/// @file
/// sivid is header only: a header `x.hpp` declares, and includes `impl/x.ipp` at its end, which
/// defines what is no template. Where SIVID_COMPILED is defined headers declare only; one source of
/// the program then includes <sivid/impl/src.hpp>, or the program links to a library that was
/// compiled with the same flags (CMake: sivid::compiled).
#ifdef SIVID_COMPILED
#define SIVID_DECL
#else
#define SIVID_DECL inline
#endif
/// The same for what needs MPFI, too (CMake: sivid::compiled_mpfi).
#ifdef SIVID_COMPILED_MPFI
#define SIVID_MPFI_DECL
#else
#define SIVID_MPFI_DECL inline
#endif

#ifdef SIVID_COMPILED

#include <sivid/number/pack/detail/pack_target.hpp>

#include <string> // the macros of the standard library

// Linkers that drop unused sections would drop the question with them.
#if defined(__has_attribute) && __has_attribute(retain)
#define SIVID_KEPT [[gnu::used, gnu::retain]]
#else
#define SIVID_KEPT [[gnu::used]]
#endif

namespace sivid {

struct plain_containers;
struct debug_containers;
#ifdef _GLIBCXX_DEBUG
using containers_of_this_source = debug_containers;
#else
using containers_of_this_source = plain_containers;
#endif

inline namespace SIVID_PACK_TARGET {

/// The library defines this for its own vector instructions and standard containers, each source
/// asks for its own: objects have the same layout in both, or the program does not link.
template <class Containers>
struct library_for {
    static char const sivid_compiled_has_other_machine_flags;
};

} // namespace SIVID_PACK_TARGET

SIVID_KEPT static char const* const library_for_this_source =
    &library_for<containers_of_this_source>::sivid_compiled_has_other_machine_flags;

} // namespace sivid

#endif

#endif
