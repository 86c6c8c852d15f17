// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_FIT_FIT_HPP
#define SIVID_APPROXIMATE_FIT_FIT_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace sivid {

namespace approximate_detail {
class fit_search;
}

/// Minimises the inflation: least squares that leave out what looks like an outlier, then a higher
/// power, then Chebyshev steps on the largest residuals, without the q largest of each experiment.
/// Models with delays are welcome. All in plain doubles.
/// @cost  about twenty simulations with sensitivities
class fitter {
public:
    /// @param problem     outlives this object
    /// @param keep_going  asked while simulating, false ends a fit with the best it has until then,
    ///                    which may be nothing; may be empty
    explicit fitter(identification_problem const& problem,
                    std::function<bool()> keep_going = nullptr);
    fitter(fitter&&) noexcept;
    fitter& operator=(fitter&&) noexcept;
    ~fitter();

    /// From the centre of the prior and, when that fails, from a few points spread over it.
    [[nodiscard]] approximate_fit operator()();
    /// From a point given for the parameters.
    [[nodiscard]] approximate_fit operator()(std::vector<double> const& parameters);
    /// Minimises the sum of squared residuals instead, without the q largest of each experiment.
    /// @param parameters  where to begin; empty: at the centre of the prior
    [[nodiscard]] approximate_fit least_squares(std::vector<double> const& parameters = {});
    /// The residuals at a point, without any descent.
    [[nodiscard]] approximate_fit at(std::vector<double> const& parameters,
                                     std::vector<std::vector<double>> const& starts);

private:
    std::unique_ptr<approximate_detail::fit_search> work_;
};

} // namespace sivid

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_FITTER)
#include <sivid/approximate/fit/detail/fit_search.hpp>
#endif

#endif
