// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_SRC_HPP
#define SIVID_IMPL_SRC_HPP

/// @file
/// All of the core that need be compiled but once. A program of several sources, or one that is
/// often compiled anew, defines SIVID_COMPILED for all of them and includes this header in one
/// source alone; the others then find declarations only.
///   CMake's sivid::compiled does the same in several sources, which takes less memory and compiles
/// side by side. Data sets, results and reports: `impl/io.ipp`, `impl/verifier.ipp`,
/// `impl/report.ipp` and `impl/text.ipp` beside it.

#ifndef SIVID_COMPILED
#error "define SIVID_COMPILED for all sources of the program; without it the headers are complete"
#endif

#include <sivid/impl/library.ipp>

#include <sivid/impl/approximate.ipp>
#include <sivid/impl/decision.ipp>
#include <sivid/impl/diagnosis.ipp>
#include <sivid/impl/enclosure.ipp>
#include <sivid/impl/flow.ipp>
#include <sivid/impl/flow_lanes.ipp>
#include <sivid/impl/measurement.ipp>
#include <sivid/impl/model.ipp>
#include <sivid/impl/number.ipp>
#include <sivid/impl/paving.ipp>
#include <sivid/impl/paving_further.ipp>
#include <sivid/impl/paving_lanes.ipp>
#include <sivid/impl/space.ipp>
#include <sivid/impl/tube.ipp>

#endif
