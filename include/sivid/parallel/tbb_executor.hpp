// SPDX-License-Identifier: MIT
#ifndef SIVID_PARALLEL_TBB_EXECUTOR_HPP
#define SIVID_PARALLEL_TBB_EXECUTOR_HPP

#include <sivid/executor.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

namespace sivid {

/// Runs tasks on so many threads of oneTBB, the calling one included.
///   options.search.workers = tbb_executor(2);
/// Every task is scheduled on its own. More threads than the machine has are allowed while the
/// executor lives, unless the program has set a limit of its own. The threads take over the
/// floating-point settings of the caller, and every solver of sivid checks those of its thread.
/// @param threads  0: as many as the machine has
[[nodiscard]] inline executor tbb_executor(std::size_t threads = 0) {
    auto const all = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    auto const used = std::min<std::size_t>(threads == 0 ? all : threads, 1024);
    using limit = tbb::global_control;
    auto const more = used > limit::active_value(limit::max_allowed_parallelism)
                          ? std::make_shared<limit>(limit::max_allowed_parallelism, used)
                          : nullptr;
    auto const arena = std::make_shared<tbb::task_arena>(static_cast<int>(used));
    return {used, [arena, more](std::size_t count, executor::task const& work) {
                arena->execute([&] {
                    tbb::parallel_for(
                        std::size_t{0}, count, [&work](std::size_t k) { work(k); },
                        tbb::simple_partitioner{});
                });
            }};
}

} // namespace sivid

#endif
