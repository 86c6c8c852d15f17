// SPDX-License-Identifier: MIT
// Efforts of a diagnosis.
#ifndef EXAMPLES_CONSOLE_THOROUGH_DIAGNOSIS_HPP
#define EXAMPLES_CONSOLE_THOROUGH_DIAGNOSIS_HPP

#include "threads.hpp"

#include <sivid/diagnosis/diagnosis_run.hpp>

namespace console {

/// Efforts for a machine of which nothing is known: whatever is still open may use most of the
/// time, since on an unknown model nobody can say after how many boxes it pays. Each step ends
/// after so many boxes of parameters, or this share of the time, whichever is less.
/// On all threads where the program links to `sivid::parallel`.
/// @param seconds  for the diagnosis
inline sivid::diagnosis_options thorough_diagnosis(double seconds) {
    sivid::diagnosis_options options;
    options.seconds = seconds;
    options.test.workers = threads_for(0);
    options.gap.bound = {300, 0.12};
    options.gap.further_boxes = 900;
    options.answer = {60, 0.05};
    options.hulls = {20000, 1};
    options.exclusion = {60, 0.04};
    options.exclusions = {600, 0.37};
    options.part = {20, 0.02};
    options.screening.most_effects = 3;
    return options;
}

} // namespace console

#endif
