// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_ADVICE_DETAIL_FAILURE_ADVICE_HPP
#define SIVID_ENCLOSURE_ADVICE_DETAIL_FAILURE_ADVICE_HPP

#include <sivid/enclosure/advice/detail/failure_trials.hpp>

#include <optional>

namespace sivid {

/// Encloses a family once more, and where that fails, tries what could help: higher orders, shorter
/// steps, another set, ever smaller parts of the box; and whether single trajectories, from the
/// middle of the box and from the two corners that move the state that stopped it most, get further
/// at all. A remedy helps when it proves a twentieth more of the time than the failed run. Nothing
/// helps all of the box where one of its trajectories, alone, with a higher order, shorter steps
/// and a smaller tolerance, gets no further.
/// @returns nothing when the enclosure reaches `end`
/// @guarantee  what it says was reached, was proved. That nothing helps, or that a trajectory
///             grows without bound, is what the trials show, and no proof.
/// @tparam Run    `trajectory<interval>`, `parametric_flow<>` or `parametric_runge_kutta<>`;
///                Taylor models get the degree that suits the unknowns (`suggested_degree`)
/// @tparam Other  another set to try, or void
/// @given  boxes that `Run` and `Other` take (checked there: std::invalid_argument)
/// @cost  some ten runs, and two for each halving of each side with a width where only parts help,
///        each of at most 200 steps more than the failed one, or than twice what that took for
///        nine tenths of its way
template <class Run, class Other = void>
[[nodiscard]] std::optional<advised_failure>
explain_failure(flow const& f, enclosure_options const& options, box const& initial,
                box const& parameters, double begin, double end) {
    return enclosure_detail::failure_trials<Run, Other>(f, options, initial, parameters, begin, end)
        .explain();
}

} // namespace sivid

#endif
