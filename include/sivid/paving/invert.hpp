// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_INVERT_HPP
#define SIVID_PAVING_INVERT_HPP

#include <sivid/paving/inversion_options.hpp>
#include <sivid/paving/search/detail/box_test.hpp>
#include <sivid/paving/search/detail/paving_search.hpp>
#include <sivid/paving/set_test.hpp>

#include <utility>

namespace sivid {

/// Set inversion via interval analysis (SIVIA) over any set test: paves `prior` with boxes that are
/// proved inside, proved outside, undecided, or still pending when the budget ends.
/// @guarantee  the boxes cover the prior; every verdict is the test's proof. The result does not
///             depend on the number of threads, nor on interruptions (budgets of time excepted).
/// @throws std::invalid_argument  for an empty or unbounded prior, or a state of another search;
///         whatever the test throws
/// @cost  one test for each box; boxes grow in number with the measure of the boundary
/// @ref  Jaulin and Walter, Automatica 29 (1993): SIVIA; Chabert and Jaulin 2009 (contractors)
template <set_test Test>
[[nodiscard]] inversion invert(Test& test, box const& prior,
                               inversion_options const& options = {}) {
    paving_search<Test> search(test, prior, options);
    while (!search.done() && !search.must_stop()) search.step();
    return std::move(search).finish();
}

/// The same with a test in any interval type; with packs, so many boxes at a time as they have
/// lanes: `invert<pack<8>>(test, prior)`. What is paved are boxes of doubles, which share their
/// faces exactly; each is handed to the test in type I, and what it answers is read outward.
template <interval_scalar I, box_test<I> Test>
[[nodiscard]] inversion invert(Test& test, box const& prior,
                               inversion_options const& options = {}) {
    paving_detail::box_test_in_lanes<I, Test> in_lanes(test);
    return invert(in_lanes, prior, options);
}

/// The same; the prior, a box in type I, is read outward.
template <class Test, single_interval I>
    requires box_test<Test, I>
[[nodiscard]] inversion invert(Test& test, basic_box<I> const& prior,
                               inversion_options const& options = {}) {
    return invert<I>(test, lane_of(prior), options);
}

} // namespace sivid

#endif
