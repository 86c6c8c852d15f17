// SPDX-License-Identifier: MIT
#ifndef SIVID_COMPILED_HPP
#define SIVID_COMPILED_HPP

/// @file
/// sivid is header only: a header `x.hpp` declares, and includes `impl/x.ipp` at its end, which
/// defines what is no template. Where SIVID_COMPILED is defined headers declare only; one source of
/// the program then includes <sivid/impl/src.hpp>, or the program links to a library that was
/// compiled by the same compiler with the same flags (CMake: sivid::compiled).
///   With SIVID_LIBRARY beside it, the program links to libsivid (CMake: sivid::library), which any
/// compiler and machine flags serve: what crosses its border is laid out alike for all of them.
/// What depends on the instructions of the machine does not cross it, and is compiled in the
/// program.
#if defined(SIVID_LIBRARY) && !defined(SIVID_COMPILED)
#error "with SIVID_LIBRARY define SIVID_COMPILED, too"
#endif

/// What libsivid shows of itself; all else is hidden, so that nothing of a program takes its place.
#ifdef __ELF__
#define SIVID_SHOWN [[gnu::visibility("default")]]
#else
#define SIVID_SHOWN
#endif

#ifdef SIVID_COMPILED
#define SIVID_DECL SIVID_SHOWN
#else
#define SIVID_DECL inline
#endif
/// The same for what needs MPFI, too (CMake: sivid::compiled_mpfi).
#ifdef SIVID_COMPILED_MPFI
#define SIVID_MPFI_DECL SIVID_SHOWN
#else
#define SIVID_MPFI_DECL inline
#endif

/// Program and library are compiled alike: the library has templates for the program's machine,
/// too.
#if defined(SIVID_COMPILED) && !defined(SIVID_LIBRARY)
#define SIVID_COMPILED_ALIKE
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

struct SIVID_SHOWN plain_containers;
struct SIVID_SHOWN debug_containers;
#ifdef _GLIBCXX_DEBUG
using containers_of_this_source = debug_containers;
#else
using containers_of_this_source = plain_containers;
#endif

struct SIVID_SHOWN any_machine;
inline namespace SIVID_PACK_TARGET {
struct SIVID_SHOWN this_machine;
} // namespace SIVID_PACK_TARGET

/// The library defines this for its own vector instructions and standard containers, each source
/// asks for its own: objects have the same layout in both, or the program does not link. Programs
/// for libsivid ask for `any_machine`.
template <class Machine, class Containers>
struct SIVID_SHOWN library_for {
    static char const sivid_compiled_has_other_machine_flags;
};

#ifdef SIVID_COMPILED_ALIKE

struct SIVID_SHOWN by_clang;
struct SIVID_SHOWN by_gcc;
struct SIVID_SHOWN by_another;
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
struct SIVID_SHOWN library_by {
    static char const sivid_compiled_is_of_another_compiler;
};

SIVID_KEPT static char const* const library_by_this_compiler =
    &library_by<compiler_of_this_source>::sivid_compiled_is_of_another_compiler;

using machine_asked_for = this_machine;
#else
using machine_asked_for = any_machine;
#endif

SIVID_KEPT static char const* const library_for_this_source =
    &library_for<machine_asked_for,
                 containers_of_this_source>::sivid_compiled_has_other_machine_flags;

} // namespace sivid

#endif

#endif
