// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_FIT_FIT_HPP
#define SIVID_APPROXIMATE_FIT_FIT_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

namespace approximate_detail {
class fit_search;
}

/// What a fit makes small, each without the q largest residuals of an experiment that its outlier
/// budget allows.
enum class fit_norm {
    largest, ///< the inflation: the largest residual
    squares  ///< the sum of squares
};

/// Where a fit begins. What lies outside of the prior and the boxes of starts is moved to their
/// edge.
struct fit_start {
    std::vector<double> parameters{};          ///< empty: chosen by the fit
    std::vector<std::vector<double>> starts{}; ///< an initial state per experiment; empty: middles
};

/// Fits problems in plain doubles, by simulations with sensitivities. Models with delays are
/// welcome. How the inflation is made small depends on what is known of the start:
///  - nothing: descents from the middle of the prior and, when that fails, from a few points spread
///    over it and over growing times;
///  - parameters: one descent. Least squares that leave out what looks like an outlier, then, where
///    they come close, a higher power, then Chebyshev steps on the largest residuals;
///  - parameters and starts: Chebyshev steps from there to a local minimum, a kink, sharply.
/// @guarantee  none; the point lies in the prior, the starts in their boxes
/// @cost  about twenty simulations with sensitivities a descent
class approximate_fitter {
public:
    /// @param problem     outlives this object
    /// @param keep_going  asked while simulating, false ends a fit with the best it has until then,
    ///                    which may be nothing; may be empty
    explicit approximate_fitter(identification_problem const& problem,
                                std::function<bool()> keep_going = nullptr);
    approximate_fitter(approximate_fitter&&) noexcept;
    approximate_fitter& operator=(approximate_fitter&&) noexcept;
    ~approximate_fitter();

    [[nodiscard]] approximate_fit operator()(fit_start const& start = {},
                                             fit_norm norm = fit_norm::largest);
    /// The residuals at a point, without any descent.
    [[nodiscard]] approximate_fit at(std::vector<double> const& parameters,
                                     std::vector<std::vector<double>> const& starts);
    /// The same by the longer steps of the descents, with errors far below the bounds of the
    /// measurements: for many points of which one is to be chosen.
    /// @cost  a third of `at`, or less
    [[nodiscard]] approximate_fit roughly_at(std::vector<double> const& parameters,
                                             std::vector<std::vector<double>> const& starts);

private:
    std::unique_ptr<approximate_detail::fit_search> work_;
};

/// One fit: see `approximate_fitter`.
[[nodiscard]] inline approximate_fit fit(identification_problem const& problem,
                                         fit_norm norm = fit_norm::largest,
                                         fit_start const& start = {},
                                         std::function<bool()> keep_going = nullptr) {
    return approximate_fitter(problem, std::move(keep_going))(start, norm);
}

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/approximate/fit/impl/fit.ipp>
#endif

#endif
