// SPDX-License-Identifier: MIT
// Random identification problems with a planted truth, by seed: models with products of parameters,
// kinks, dry friction and sampled inputs; some are the classic ones, some are drawn term by term.
#ifndef SIVID_TESTS_SUPPORT_PLANTED_PROBLEMS_HPP
#define SIVID_TESTS_SUPPORT_PLANTED_PROBLEMS_HPP

#include "support/problems.hpp"

namespace planted {

/// The problem of a seed: every other one drawn term by term.
support::planted_problem plant_by_seed(support::draws& d);

} // namespace planted

#endif
