// SPDX-License-Identifier: MIT
// The interval types that are judged, for TEMPLATE_TEST_CASE: the vocabulary type, packs in each
// width of vector (the widest of the build, 4 lanes, plain C++), and the multiprecision type.
#ifndef SIVID_TESTS_CONFORMANCE_TYPES_HPP
#define SIVID_TESTS_CONFORMANCE_TYPES_HPP

#include <sivid/number/interval_traits.hpp>
#include "support/pack_functions.hpp"

#if defined(SIVID_HAS_MPFI)
#include <sivid/number/mp_interval.hpp>
#define SIVID_MULTIPRECISION_TYPES , sivid::mp_interval
#define SIVID_PROVEN_TYPES , sivid::proven_interval
#else
#define SIVID_MULTIPRECISION_TYPES
#define SIVID_PROVEN_TYPES
#endif

#define SIVID_TESTED_TYPES                                                                         \
    sivid::interval, sivid::pack<8>, sivid::pack<4>, sivid::pack<1> SIVID_MULTIPRECISION_TYPES

/// One width for each kind of vector of the build: the code of a wider pack is the same, repeated.
#if SIVID_PACK_AVX512
#define SIVID_VECTOR_TYPES sivid::pack<8>, sivid::pack<4>
#elif SIVID_PACK_AVX2
#define SIVID_VECTOR_TYPES sivid::pack<4>
#else
#define SIVID_VECTOR_TYPES sivid::pack<2>
#endif
#define SIVID_COMPILED_TYPES sivid::interval, SIVID_VECTOR_TYPES, sivid::pack<1>

#endif
