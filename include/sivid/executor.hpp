// SPDX-License-Identifier: MIT
#ifndef SIVID_EXECUTOR_HPP
#define SIVID_EXECUTOR_HPP

#include <sivid/work_clock.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <vector>

namespace sivid {

/// Runs independent tasks, for instance on several threads (`parallel/tbb_executor.hpp`). What is
/// computed does not depend on it; only the time does.
struct executor {
    using task = std::function<void(std::size_t)>;

    /// How many tasks may run at once.
    std::size_t threads = 1;
    /// Calls task(0), ..., task(count - 1), each once, in any order and perhaps at once; returns
    /// when all have ended, and throws what one of them threw. Empty: one after the other.
    std::function<void(std::size_t count, task const&)> run = nullptr;

    /// The tasks of a round begin at one time of the `work_clock`, whoever runs them: a budget that
    /// ends meanwhile ends those that reach it alone.
    void operator()(std::size_t count, task const& work) const {
        for (std::size_t first = 0; first < count; first += round)
            work_clock::set(work_clock::now() +
                            run_round(first, std::min(round, count - first), work));
    }

private:
    /// So many tasks at once keep the threads of a machine busy; more would let a budget that ends
    /// within a round be exceeded by more.
    static constexpr std::size_t round = 16;

    /// @returns what the tasks have computed
    double run_round(std::size_t first, std::size_t count, task const& work) const {
        double const begin = work_clock::now();
        std::vector<double> done(count, 0.0);
        auto const timed = [&](std::size_t k) {
            double const here = work_clock::now(); // of a task that waits for others, say
            struct restored {
                double to;
                ~restored() { work_clock::set(to); }
            } const after{here};
            work_clock::set(begin);
            work(first + k);
            done[k] = work_clock::now() - begin;
        };
        if (run && threads > 1 && count > 1) {
            run(count, timed);
        } else {
            for (std::size_t k = 0; k < count; ++k) timed(k);
        }
        return std::accumulate(done.begin(), done.end(), 0.0);
    }
};

} // namespace sivid

#endif
