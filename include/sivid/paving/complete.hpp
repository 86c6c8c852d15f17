// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_COMPLETE_HPP
#define SIVID_PAVING_COMPLETE_HPP

/// @file
/// All that `identify` and its like can use. sivid::compiled has it. A program from headers alone
/// has it where one of its sources includes this header, and compiles for twice as long; without it
/// searches go by runs of Taylor models in lanes alone:
///   - no fit: a witness is found only as the search meets it,
///   - no contractors before the search (`default_strategy`); the journal says so,
///   - no sets of first order (`carried_set::doubleton`): they are refused,
///   - points and single boxes take as long as eight boxes.
/// What is proved is proved either way.

#include <sivid/compiled.hpp>
#include <sivid/paving/detail/program_parts.hpp>

#ifndef SIVID_COMPILED
#include <sivid/paving/impl/complete.ipp>
#endif

#endif
