// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_DETAIL_RUN_POOL_HPP
#define SIVID_PAVING_RUN_DETAIL_RUN_POOL_HPP

#include <sivid/paving/run/experiment_run.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace sivid {

/// One run per experiment.
using run_set = std::vector<std::unique_ptr<experiment_run>>;

/// Sets of runs to borrow: a run is for one thread at a time, so there are as many sets as threads
/// have asked at once.
class run_pool {
public:
    /// @param make  a further set; called by several threads at once
    explicit run_pool(std::function<run_set()> make) : make_(std::move(make)) {
        free_.push_back(make_());
        for (auto const& run : free_[0]) at_once_ = std::max(at_once_, run->at_once());
    }

    /// A set of runs, given back at the end of its life.
    class loan {
    public:
        explicit loan(run_pool& from) : from_(&from), runs_(from.take()) {}
        loan(loan const&) = delete;
        loan& operator=(loan const&) = delete;
        ~loan() { from_->give_back(std::move(runs_)); }

        /// Runs experiment e over boxes of starts and parameters.
        [[nodiscard]] std::vector<std::shared_ptr<response const>>
        operator()(std::size_t e, box const& initial, std::vector<box> const& parameters) {
            from_->integrations_ += parameters.size();
            return (*runs_[e])(initial, parameters);
        }

    private:
        run_pool* from_;
        run_set runs_;
    };
    [[nodiscard]] loan borrow() { return loan(*this); }

    /// The most boxes that one of the runs takes together.
    [[nodiscard]] std::size_t at_once() const { return at_once_; }
    /// Runs until now: boxes times experiments.
    [[nodiscard]] std::size_t integrations() const { return integrations_; }
    void count(std::size_t more) { integrations_ += more; }

private:
    [[nodiscard]] run_set take() {
        {
            std::lock_guard const guard(mutex_);
            if (!free_.empty()) {
                auto runs = std::move(free_.back());
                free_.pop_back();
                return runs;
            }
        }
        return make_();
    }
    void give_back(run_set runs) {
        std::lock_guard const guard(mutex_);
        free_.push_back(std::move(runs));
    }

    std::function<run_set()> make_;
    std::size_t at_once_ = 1;
    std::mutex mutex_;
    std::vector<run_set> free_;
    std::atomic<std::size_t> integrations_ = 0;
};

} // namespace sivid

#endif
