// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_DETAIL_EXPERIMENT_RUN_CLASS_HPP
#define SIVID_PAVING_RUN_DETAIL_EXPERIMENT_RUN_CLASS_HPP

#include <sivid/enclosure/flow.hpp>
#include <sivid/enclosure/suggested_degree.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/paving/run_options.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// One experiment over boxes of parameters and starts: integrates, stepping onto the measurements,
/// and keeps the measured outputs as polynomials. Owns its work space; one object per thread.
class experiment_run {
public:
    virtual ~experiment_run() = default;
    /// @returns for each box of parameters the outputs that were reached; fewer than all when the
    ///          enclosure failed, became hopeless, or more measurements than allowed already fail
    ///          for the whole box
    [[nodiscard]] virtual std::vector<std::shared_ptr<response const>>
    operator()(box const& initial, std::vector<box> const& parameters) = 0;
    [[nodiscard]] std::shared_ptr<response const> operator()(box const& initial,
                                                             box const& parameters) {
        return (*this)(initial, std::vector<box>{parameters})[0];
    }
    /// How many boxes are best given together.
    [[nodiscard]] virtual std::size_t at_once() const { return 1; }
};

namespace paving_detail {

/// Number of sides of an experiment that have a width.
[[nodiscard]] inline std::size_t unknown_count(box const& initial, box const& prior) {
    return normalised_unknowns(initial, prior).variables;
}

/// Of Taylor models in so many unknowns.
[[nodiscard]] inline std::size_t degree_for(run_options const& options, std::size_t unknowns) {
    return unknowns > 0 && options.degree > 0 ? options.degree : suggested_degree(unknowns);
}

/// The steps of an experiment, relative to what it lasts (`for_span`).
///   A smallest step that is not much shorter than the pieces of an input ends runs that only have
/// to start gently after each knot: then every piece may take 500 steps. Samples that nearly
/// coincide do not count.
[[nodiscard]] inline enclosure_options steps_for(experiment const& e, enclosure_options options) {
    double const lasts = e.end() - e.begin;
    double const unit = lasts > 0 ? std::min(1.0, lasts) : 1.0;
    options = for_span(std::move(options), lasts);
    double shortest = detail::infinity;
    for (auto const& input : e.inputs) {
        auto const* u = std::get_if<sampled_signal>(&input);
        if (u == nullptr) continue;
        for (std::size_t k = 1; k < u->times().size(); ++k) {
            shortest = std::min(shortest, u->times()[k] - u->times()[k - 1]);
        }
    }
    if (shortest < 40 * options.minimum_step)
        options.minimum_step =
            std::min(options.minimum_step, std::max(shortest / 500, 1e-6 * unit));
    return options;
}

} // namespace paving_detail

} // namespace sivid

#endif
