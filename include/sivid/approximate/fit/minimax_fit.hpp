// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_FIT_MINIMAX_FIT_HPP
#define SIVID_APPROXIMATE_FIT_MINIMAX_FIT_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace sivid {

namespace approximate_detail {
class minimax_search;
}

/// Descends to a local minimum of the inflation: successive linear programs over a box around the
/// present point, which grows while they foretell well and shrinks otherwise. The q measurements of
/// an experiment that are worst at the present point are left out of its program.
///   Each program is solved by exchanges, exactly: it ends at the kink where the least inflation
///   lies, which `minimax`, made for many unknowns, only comes near. Models with delays are
///   welcome.
/// @guarantee  none; the point lies in the prior, the starts in their boxes
/// @cost  one simulation with sensitivities per step; some ten steps
class minimax_fitter {
public:
    /// @param problem  outlives this object
    explicit minimax_fitter(identification_problem const& problem);
    ~minimax_fitter();

    /// @param go_on  asked within the simulations; false ends the descent with the best point so
    ///               far, or with one that has no parameters
    [[nodiscard]] approximate_fit operator()(std::vector<double> const& parameters,
                                             std::vector<std::vector<double>> const& starts,
                                             std::function<bool()> const& go_on = {});

private:
    std::unique_ptr<approximate_detail::minimax_search> work_;
};

} // namespace sivid

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_MINIMAX_FITTER)
#include <sivid/approximate/fit/detail/minimax_search.hpp>
#endif

#endif
