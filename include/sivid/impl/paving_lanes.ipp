// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_PAVING_LANES_IPP
#define SIVID_IMPL_PAVING_LANES_IPP

/// @file
/// What runs Taylor models in lanes: the most expensive part to compile.

#include <sivid/paving/run/impl/continued_run.ipp>
#include <sivid/paving/run/impl/experiment_run.ipp>
#include <sivid/paving/run/impl/further_runs.ipp>
#include <sivid/paving/run/impl/run_parts.ipp>

#endif
