// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_EFFECT_HULL_OPTIONS_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_EFFECT_HULL_OPTIONS_HPP

#include <sivid/paving/judge/feasibility_test_options.hpp>
#include <sivid/paving/strategy/strategy.hpp>

#include <cstddef>
#include <functional>

namespace sivid {

/// How much time and memory the hulls of effects may take.
struct effect_hull_options {
    double seconds = 10;
    std::size_t boxes = 4000; ///< of the last search; a slice gets a share of them
    /// A delay, a play or a threshold is told no more finely than this share of its prior, where it
    /// is not a parameter.
    double accuracy = 1.0 / 128;
    std::function<bool()> keep_going{}; ///< false ends it with what is proved until then
    feasibility_test_options test{};
    /// What is tried on each part before it is searched, and while.
    sivid::strategy strategy = default_strategy(search_kind::parts);
    std::function<void(contraction_journal const&)> tried{}; ///< told of each part; may be empty
};

} // namespace sivid

#endif
