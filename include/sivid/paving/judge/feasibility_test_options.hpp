// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_JUDGE_FEASIBILITY_TEST_OPTIONS_HPP
#define SIVID_PAVING_JUDGE_FEASIBILITY_TEST_OPTIONS_HPP

#include <sivid/executor.hpp>
#include <sivid/paving/run_options.hpp>

#include <cstddef>
#include <functional>

namespace sivid {

/// How boxes of parameters are tested against the data, and how experiments are run for that.
struct feasibility_test_options : run_options {
    /// How a guessed point is verified: a point without unknowns by a Taylor model of degree 0, its
    /// kinks rounded off where they stop it; otherwise by first-order sets with fine steps.
    run_options witness{
        {.order = 14, .tolerance = 1e-11, .relative_tolerance = 1e-5, .minimum_step = 1e-7}};
    std::size_t witness_steps = 20'000; ///< at most, besides those that knots and samples end
    /// Contract boxes by the dependence of the outputs on the parameters, and decide parts of a box
    /// by what was computed for the whole. Without it the test is the report's: enclosure against
    /// measurement, one integration a box.
    bool contract = true;
    bool cut = true; ///< contract by linear programs over all measurements, too
    /// A part of a box is integrated anew when more than this share of an undecided output's width
    /// is neither affine in the parameters nor shrinks with the part.
    double sharp_enough = 0.5;
    /// Runs experiments at once where the least inflation is sought; that says the same with any.
    /// (Searches for what explains the data have `inversion_options::workers`.)
    executor workers{};
};

/// The same with all runs asking before each step whether to go on; a run that is ended keeps the
/// outputs it has, so that what follows from them is still proved.
/// @param keep_going  for any thread
[[nodiscard]] inline feasibility_test_options limited(feasibility_test_options test,
                                                      std::function<bool()> const& keep_going) {
    test.keep_going = test.witness.keep_going = keep_going;
    return test;
}

} // namespace sivid

#endif
