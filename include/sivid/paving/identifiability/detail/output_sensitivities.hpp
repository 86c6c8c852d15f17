// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IDENTIFIABILITY_DETAIL_OUTPUT_SENSITIVITIES_HPP
#define SIVID_PAVING_IDENTIFIABILITY_DETAIL_OUTPUT_SENSITIVITIES_HPP

#include <sivid/compiled.hpp>
#include <sivid/enclosure/flow.hpp>
#include <sivid/enclosure/options.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identifiability/detail/unknown_quantity.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/matrix.hpp>

#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

/// A point, or the enclosure of a decimal: nothing that data could determine.
[[nodiscard]] inline bool is_known(interval const& side) {
    return width(side) <= 1e-12 * mag(side);
}

/// The parameters and, with `starts`, the starts that are not known exactly.
[[nodiscard]] SIVID_DECL std::vector<unknown_quantity>
unknowns_of(identification_problem const& problem, bool starts);

/// The derivatives of the measured outputs by some unknowns.
struct output_sensitivities {
    interval_matrix<interval> values; ///< a row per measured output, a column per unknown
    std::vector<double> weights;      ///< per row: 1 / half-width of the measurement's bound
    std::size_t missing = 0; ///< outputs that the enclosure did not reach; they have no row
};

namespace paving_detail {

/// What a change of one output is compared with: the half-widths of the bounds.
SIVID_DECL std::vector<double> weights_of(record const& samples);

} // namespace paving_detail

/// The flows of a problem's experiments, with the inputs as recorded.
class sensitivity_runs {
public:
    sensitivity_runs(identification_problem const& problem, std::vector<unknown_quantity> unknowns,
                     enclosure_options const& options)
        : problem_(&problem), unknowns_(std::move(unknowns)), options_(options) {
        for (auto const& e : problem.experiments) {
            flows_.push_back(
                std::make_shared<flow const>(problem.model, problem.choice, nominal(e.inputs)));
            samples_.push_back(bounded(sorted(e.measurements)));
        }
    }

    [[nodiscard]] std::vector<unknown_quantity> const& unknowns() const { return unknowns_; }
    [[nodiscard]] flow const& equations(std::size_t experiment) const {
        return *flows_[experiment];
    }

    /// Encloses \f$ \partial y_i(t_i) / \partial (p, x_0)_c \f$ of all measured outputs, in the
    /// order of experiments and times, for all parameters and starts in the boxes. Measurements
    /// without a bound have no row.
    /// @param starts  one box per experiment
    /// @guarantee  holds for the recorded inputs
    /// @cost  one integration with derivatives per experiment; its steps end at measurements
    [[nodiscard]] output_sensitivities operator()(box const& parameters,
                                                  std::vector<box> const& starts) const;

private:
    static record bounded(record const& samples) {
        record kept;
        for (auto const& m : samples) {
            if (std::isfinite(mag(m.bound))) kept.push_back(m);
        }
        return kept;
    }

    identification_problem const* problem_;
    std::vector<unknown_quantity> unknowns_;
    enclosure_options options_;
    std::vector<std::shared_ptr<flow const>> flows_;
    std::vector<record> samples_;
};

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/identifiability/impl/output_sensitivities.ipp>
#endif

#endif
