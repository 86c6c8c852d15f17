// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CONFIDENCE_REGION_HPP
#define SIVID_PAVING_CONFIDENCE_REGION_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/inversion_options.hpp>
#include <sivid/paving/judge/feasibility_test_options.hpp>
#include <sivid/space/box.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace sivid {

class confidence_test;

struct confidence_options {
    /// Of signs and order, chosen without a look at the measured values: a region that is drawn
    /// until it pleases has another probability.
    std::uint64_t seed = 1;
    /// So many sums m are compared, at least. More make the region depend less on the signs.
    std::size_t sums = 100;
    /// Where the model is linearised for the weights: values of unknowns by name, known without the
    /// measured values, else the middle of the prior. The nearer the truth, the smaller the region.
    std::map<std::string, double> nominal = {};
    inversion_options search{.accuracy_of_hull = true, .sufficient_ratio = 0.8};
    feasibility_test_options test{};
};

/// A region that holds the truth with probability 1 - above / sums.
struct confident_region {
    std::size_t sums = 0, above = 0;
    std::uint64_t seed = 0;
    std::vector<std::string> names, units; ///< of the unknowns
    std::vector<double> nominal;
    Eigen::VectorXd measured; ///< middles of the bounds; by experiment, in the order of time
    Eigen::MatrixXd weights;  ///< a row for each: see `confidence_region`
    std::vector<std::string> assumptions; ///< that the probability rests on
    std::vector<std::string> remarks;     ///< what makes the region wider than it might be
    /// Inside boxes are in the region; what no box covers, or outside ones do, is not.
    inversion found{.paving = subpaving({})};

    [[nodiscard]] double probability() const {
        return static_cast<double>(sums - above) / static_cast<double>(sums);
    }
};

/// Finds the parameters, and the starts that have a width, among which the truth is with exactly
/// this probability for finitely many data, if the errors of measurements are independent and
/// symmetric about zero, whatever their distributions and sizes: `sign_perturbed_sums`, inverted.
///   Weights: an orthonormal basis, by rows, of what the derivatives of all outputs at the nominal
/// point span, each channel counted in the largest effect of the unknowns on it. Any weights that
/// no measured value chose give the probability; where the model is bent between the nominal point
/// and the truth the region is wider. The prior is used, error bounds and budgets of outliers are
/// not.
/// @param probability  a fraction of at most 10 000 parts: 0.95, 0.999, 2.0 / 3
/// @throws std::invalid_argument  for an invalid problem or probability; where the theorem does not
///         cover the problem, with the remedy: inputs with errors, effects with a memory, starts
///         that follow parameters, conditions, measurements bounded on one side; where the data
///         cannot tell anything
/// @guarantee  the boxes, as of `invert`; the probability rests on `assumptions`
/// @cost  integrations as of `identify`, and O(sums N n^2) a box
/// @ref   M. Kieffer, E. Walter, Automatica 50 (2014) 507
[[nodiscard]] SIVID_DECL confident_region confidence_region(identification_problem const& problem,
                                                            double probability,
                                                            confidence_options const& options = {});

/// All but the boxes, and the test to be inverted, which may be asked of single boxes and points.
SIVID_DECL confident_region prepare_confidence(confidence_test& test, double probability,
                                               confidence_options const& options = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/impl/confidence_region.ipp>
#endif

#endif
