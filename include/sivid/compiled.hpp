// SPDX-License-Identifier: MIT
#ifndef SIVID_COMPILED_HPP
#define SIVID_COMPILED_HPP

/// @file
/// sivid is header only: a header `x.hpp` declares, and includes `impl/x.ipp` at its end, which
/// defines what is no template. Where SIVID_COMPILED is defined headers declare only; one source of
/// the program then includes <sivid/impl/src.hpp>, or the program links to a library that was
/// compiled by the same compiler with the same flags (CMake: sivid::compiled).
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

struct by_clang;
struct by_gcc;
struct by_another;
#if defined(__clang__)
using compiler_of_this_source = by_clang;
#elif defined(__GNUC__)
using compiler_of_this_source = by_gcc;
#else
using compiler_of_this_source = by_another;
#endif

/// As `library_for`, for the compiler: clang and GCC lay out what a lambda captures in another
/// order, and of an inline function that both have compiled the linker keeps one.
template <class Compiler>
struct library_by {
    static char const sivid_compiled_is_of_another_compiler;
};

SIVID_KEPT static char const* const library_by_this_compiler =
    &library_by<compiler_of_this_source>::sivid_compiled_is_of_another_compiler;

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
