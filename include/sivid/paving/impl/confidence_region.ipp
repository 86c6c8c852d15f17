// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IMPL_CONFIDENCE_REGION_IPP
#define SIVID_PAVING_IMPL_CONFIDENCE_REGION_IPP

#include <sivid/paving/confidence_region.hpp>

#include <sivid/model/change/added_start.hpp>
#include <sivid/paving/confidence/confidence_test.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/space/dense.hpp>
#include <sivid/work_limit.hpp>

#include <map>
#include <stdexcept>

namespace sivid {

namespace paving_detail {

inline void require(bool holds, std::string const& otherwise) {
    if (!holds) throw std::invalid_argument("confidence region: " + otherwise);
}

/// sums and above, with 1 - above / sums = probability.
inline std::pair<std::size_t, std::size_t> counts_for(double probability, std::size_t least) {
    auto const text = "the probability " + nearest_text(probability);
    require(probability > 0 && probability < 1, text + " is not between 0 and 1");
    constexpr std::size_t most = 10'000;
    for (std::size_t parts = 2; parts <= most; ++parts) {
        double const all = static_cast<double>(parts);
        auto const held = static_cast<std::size_t>(std::lround(probability * all));
        if (held == 0 || held == parts || static_cast<double>(held) / all != probability) continue;
        auto const times = std::max<std::size_t>(1, (std::min(least, most) + parts - 1) / parts);
        return {parts * times, (parts - held) * times};
    }
    require(false, text + " is no fraction of at most 10000 parts; round it to four digits");
    return {};
}

inline void require_covered(identification_problem const& problem) {
    require(!problem.model.has_memory() && !starts_follow_parameters(problem),
            "effects that remember, or add a state that starts where parameters say, are not "
            "covered; fix their parameters or leave them out");
    for (auto const& e : problem.experiments) {
        auto const where = "experiment '" + e.name + "' has ";
        for (auto const& u : e.inputs)
            require(!is_uncertain(u), where + "inputs with errors, which move all later outputs "
                                              "together: not covered. State inputs without errors, "
                                              "or identify by bounds");
        for (auto const& m : e.measurements)
            require(std::isfinite(mag(m.bound)),
                    where + "a measurement bounded on one side, at " + nearest_text(m.time) +
                        ": it has no middle. Leave out such ones, by their times, not by values");
    }
}

/// The derivatives of all outputs at a point by the unknowns, times half their priors: slopes over
/// a small box. They need no proof.
inline Eigen::MatrixXd slopes_at(confidence_test& test, std::vector<double> const& nominal) {
    auto const& prior = test.prior();
    auto around = prior;
    confidence_test::places at;
    std::optional<output_forms> outputs;
    for (double share = 1e-3; share > 1e-10 && !outputs; share *= 1e-2) {
        for (std::size_t s = 0; s < prior.size(); ++s) {
            double const reach = share * rad(prior[s]);
            around[s] = intersect(prior[s], interval(nominal[s] - reach, nominal[s] + reach));
        }
        outputs = test.outputs_over(*test.learn({around})[0].knowledge, around, at);
    }
    require(outputs || !test.cancelled(), "it was stopped before the weights; allow more time");
    require(outputs.has_value(),
            "the motion of the nominal point cannot be enclosed until the "
            "last measurement; narrow the prior, or give another nominal point");
    Eigen::MatrixXd slopes(outputs->rest.size(), 0);
    for (std::size_t s = 0; s < prior.size(); ++s) {
        if (!at[s]) continue;
        slopes.conservativeResize(Eigen::NoChange, slopes.cols() + 1);
        slopes.rightCols(1) = outputs->forms.col(static_cast<Eigen::Index>(at[s]->second)) *
                              (rad(prior[s]) / rad(around[s]));
    }
    return slopes;
}

/// Weights by the derivatives at the nominal point.
/// @param channels  of the measurements
inline void design(confidence_test& test, std::vector<std::size_t> const& channels,
                   confident_region& region) {
    require(contains(test.prior(), region.nominal), "the nominal point is not in the prior");
    auto slopes = slopes_at(test, region.nominal);
    require(slopes.allFinite(), "an output has no derivative at the nominal point");
    std::map<std::size_t, double> most; // of a channel, whose unit it takes away
    auto const size = [&](std::size_t i) { return slopes.row(Eigen::Index(i)).cwiseAbs().sum(); };
    for (std::size_t i = 0; i < channels.size(); ++i)
        most[channels[i]] = std::max(most[channels[i]], size(i));
    Eigen::VectorXd share(slopes.rows());
    for (std::size_t i = 0; i < channels.size(); ++i)
        share[Eigen::Index(i)] = most[channels[i]] > 0 ? 1 / most[channels[i]] : 0;
    approximate_svd const parts(share.asDiagonal() * slopes);
    auto const rank = (parts.values.array() > 1e-7 * parts.values.array().maxCoeff()).count();
    require(rank > 0, "no unknown moves any measured output at the nominal point");
    require(slopes.rows() > rank, std::to_string(slopes.rows()) +
                                      " measurements cannot test unknowns that move them in " +
                                      std::to_string(rank) +
                                      " ways; measure more, or fix unknowns");
    require(static_cast<double>(slopes.rows()) * static_cast<double>(region.sums) < 1e8,
            "so many sums of so many measurements take too much memory; ask for fewer sums, or a "
            "probability of fewer digits");
    region.weights = share.asDiagonal() * parts.left.leftCols(rank);
    if (rank < slopes.cols())
        region.remarks.push_back(std::to_string(slopes.cols()) + " unknowns move the outputs in " +
                                 std::to_string(rank) +
                                 " ways only, at the nominal point: along the others the region "
                                 "is as long as the prior lets it be");
}

} // namespace paving_detail

SIVID_DECL confident_region prepare_confidence(confidence_test& test, double probability,
                                               confidence_options const& options) {
    auto const& problem = test.problem();
    auto const& about = problem.model.about;
    confident_region region;
    std::tie(region.sums, region.above) = paving_detail::counts_for(probability, options.sums);
    region.seed = options.seed;
    region.nominal = mid(test.prior());
    region.assumptions = {
        "the model is right: a region does not show what a model lacks, as bounds do",
        "errors of measurements are independent and symmetric about zero; their distributions and "
        "sizes are free and may differ, gross errors included. Correlated errors, clipped "
        "readings and steps of resolution that are coarse beside the errors are not covered",
        "a measured value is the middle of its bounds. Bounds limit no error here, and budgets of "
        "outliers are not used",
        "the truth lies in the prior; prior, nominal point and seed were chosen without a look at "
        "the measured values. The probability is over errors and random signs together",
        input_assumption(problem.experiments)};
    std::vector<std::size_t> channels;
    for (std::size_t e = 0; e < problem.experiments.size(); ++e)
        for (auto const& m : test.record_of(e)) {
            channels.push_back(m.channel);
            region.measured.conservativeResize(Eigen::Index(channels.size()));
            region.measured.tail(1)[0] = mid(m.bound);
        }
    for (auto const& [in, index] : test.unknowns()) {
        auto const name = in ? about.states[index].name : problem.choice.unknown[index];
        auto const constant = in ? 0 : index_of(about.constants, name, "constant");
        region.units.push_back(in ? about.states[index].unit : about.constants[constant].unit);
        region.names.push_back(in ? name + " at the start of " + problem.experiments[*in].name
                                  : name);
    }
    for (auto const& [name, value] : options.nominal) {
        auto const at = std::find(region.names.begin(), region.names.end(), name);
        paving_detail::require(at != region.names.end(), "there is no unknown '" + name + "'");
        region.nominal[static_cast<std::size_t>(at - region.names.begin())] = value;
    }
    paving_detail::design(test, channels, region);
    test.set_sums({region.measured, region.weights, region.seed, region.sums, region.above});
    return region;
}

SIVID_DECL confident_region confidence_region(identification_problem const& problem,
                                              double probability,
                                              confidence_options const& options) {
    problem.require_data();
    paving_detail::require_covered(problem);
    work_limit const limit(options.search.seconds, options.search.keep_going);
    confidence_test test(problem, limited(options.test, limit));
    auto region = prepare_confidence(test, probability, options);
    auto search = options.search;
    search.seconds = limit.seconds();
    region.found = invert(test, test.prior(), search);
    return region;
}

} // namespace sivid

#endif
