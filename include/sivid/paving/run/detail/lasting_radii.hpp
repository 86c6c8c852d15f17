// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_DETAIL_LASTING_RADII_HPP
#define SIVID_PAVING_RUN_DETAIL_LASTING_RADII_HPP

#include <sivid/model/problem.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/paving/run/experiment_run.hpp>
#include <sivid/space/box.hpp>

#include <mutex>
#include <utility>
#include <vector>

namespace sivid {

/// About how much of the radii of an experiment's responses stays however small the box
/// (`response::lasting`): those of a run at one point, where the inputs alone make them.
/// @cost  a run of the whole record, by whoever asks first; `run_pool` does not count it
class lasting_radii {
public:
    /// @param f, e, samples, prior  outlive this
    lasting_radii(flow const& f, experiment const& e, record const& samples, box const& prior,
                  run_options run)
        : flow_(&f), experiment_(&e), samples_(&samples), prior_(&prior), run_(std::move(run)) {}

    /// @returns  by measurement. For several threads at once.
    [[nodiscard]] std::vector<double> const& operator()() {
        std::call_once(asked_, [this] {
            auto whole = *experiment_;
            whole.outliers = whole.measurements.size(); // misfits end nothing
            auto const at_point = make_run(*flow_, whole, *samples_, *prior_, run_);
            radii_ = (*at_point)(point_box(mid(whole.initial)), point_box(mid(*prior_)))->radius;
        });
        return radii_;
    }

private:
    flow const* flow_;
    experiment const* experiment_;
    record const* samples_;
    box const* prior_;
    run_options run_;
    std::once_flag asked_;
    std::vector<double> radii_;
};

} // namespace sivid

#endif
