// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_DETAIL_RUN_POOL_HPP
#define SIVID_PAVING_RUN_DETAIL_RUN_POOL_HPP

#include <sivid/paving/run/detail/lending_pool.hpp>
#include <sivid/paving/run/experiment_run.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

/// One run per experiment.
using run_set = std::vector<std::unique_ptr<experiment_run>>;

/// Sets of runs to borrow.
class run_pool {
public:
    /// @param make  a further set; called by several threads at once
    explicit run_pool(std::function<run_set()> make) : sets_(std::move(make)) {
        auto first = sets_.borrow();
        for (auto const& run : *first) at_once_ = std::max(at_once_, run->at_once());
    }

    /// A set of runs, given back at the end of its life.
    class loan {
    public:
        explicit loan(run_pool& from) : from_(&from), runs_(from.sets_) {}

        /// Runs experiment e over boxes of starts and parameters.
        [[nodiscard]] std::vector<std::shared_ptr<response const>>
        operator()(std::size_t e, box const& initial, std::vector<box> const& parameters) {
            from_->integrations_ += parameters.size();
            return (*(*runs_)[e])(initial, parameters);
        }

    private:
        run_pool* from_;
        lending_pool<run_set>::loan runs_;
    };
    [[nodiscard]] loan borrow() { return loan(*this); }

    /// The most boxes that one of the runs takes together.
    [[nodiscard]] std::size_t at_once() const { return at_once_; }
    /// Runs until now: boxes times experiments.
    [[nodiscard]] std::size_t integrations() const { return integrations_; }
    void count(std::size_t more) { integrations_ += more; }

private:
    lending_pool<run_set> sets_;
    std::size_t at_once_ = 1;
    std::atomic<std::size_t> integrations_ = 0;
};

} // namespace sivid

#endif
