// SPDX-License-Identifier: MIT
#ifndef SIVID_COMPILED_HPP
#define SIVID_COMPILED_HPP

/// Before the few functions that most of the compile time goes into.
/// sivid is header only. Where SIVID_COMPILED is defined these functions, and the kernels of
/// `taylor_kernels.hpp`, are declared alone, and a library that was compiled with the same flags
/// defines them (CMake: sivid::compiled); each of its sources defines SIVID_COMPILE_<FUNCTION>.
#ifdef SIVID_COMPILED
#define SIVID_ENTRY
#else
#define SIVID_ENTRY inline
#endif

#endif
