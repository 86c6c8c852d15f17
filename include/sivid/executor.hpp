// SPDX-License-Identifier: MIT
#ifndef SIVID_EXECUTOR_HPP
#define SIVID_EXECUTOR_HPP

#include <cstddef>
#include <functional>

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

    void operator()(std::size_t count, task const& work) const {
        if (run && threads > 1 && count > 1) {
            run(count, work);
        } else {
            for (std::size_t k = 0; k < count; ++k) work(k);
        }
    }
};

} // namespace sivid

#endif
