// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_DETAIL_LASTING_RADII_HPP
#define SIVID_PAVING_RUN_DETAIL_LASTING_RADII_HPP

#include <sivid/model/problem.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/paving/run/experiment_run.hpp>
#include <sivid/space/box.hpp>

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace sivid {

/// About how much of the radii of an experiment's responses stays however small the box
/// (`response::lasting`): those of a run at one point, where the inputs alone make them.
/// @cost  a run of the whole record, by whoever asks first
class lasting_radii {
public:
    /// @param f, samples, run  of the experiment; the flow and the samples are not copied
    lasting_radii(flow const& f, identification_problem const& problem, experiment const& e,
                  record const& samples, run_options run)
        : flow_(&f),
          problem_(&problem),
          experiment_(&e),
          samples_(&samples),
          run_(std::move(run)) {}

    /// @returns  by measurement. For several threads at once.
    [[nodiscard]] std::vector<double> const& operator()() {
        std::call_once(asked_, [this] {
            auto whole = *experiment_;
            whole.outliers = whole.measurements.size(); // misfits end nothing
            auto const& prior = problem_->prior;
            auto const at_point = make_run(*flow_, whole, *samples_, prior, run_);
            radii_ = (*at_point)(point_box(mid(whole.initial)), point_box(mid(prior)))->radius;
        });
        return radii_;
    }

private:
    flow const* flow_;
    identification_problem const* problem_;
    experiment const* experiment_;
    record const* samples_;
    run_options run_;
    std::once_flag asked_;
    std::vector<double> radii_;
};

} // namespace sivid

#endif
