// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPL_FLEET_IPP
#define SIVID_APP_IMPL_FLEET_IPP

#include <sivid/app/commands.hpp>

#include <sivid/app/console.hpp>
#include <sivid/app/detail/fleet_summary.hpp>
#include <sivid/app/detail/fleet_task.hpp>
#include <sivid/app/program.hpp>
#include <sivid/app/ranks.hpp>
#include <sivid/cluster/identity.hpp>
#include <sivid/cluster/transport.hpp>
#include <sivid/cluster/worker.hpp>
#include <sivid/cluster/worker_pool.hpp>
#include <sivid/number/text/sha256.hpp>

#include <exception>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace sivid::app {

namespace detail {

/// Works on tasks of the list for whoever coordinates, until the service is over.
inline void work_on(std::vector<fleet_task> const& list, std::string const& digest,
                    cluster::transport& coordinator, cluster::identity const& who) {
    cluster::worker self(coordinator, who);
    self.serve({[&digest](std::string_view) {
                    return cluster::identity{
                        {{"list of data sets", digest, "give all ranks the same command"}}};
                },
                [&](std::string_view request) {
                    auto const k = std::stoul(std::string{request});
                    return list.at(k).run([&] { return self.wanted(); });
                }});
}

/// What must be the same on all ranks.
inline std::string digest_of(std::vector<fleet_task> const& list) {
    std::string text;
    for (auto const& t : list) text += t.key() + "\n";
    return sha256(text);
}

} // namespace detail

SIVID_DECL int run_fleet(fleet_command const& c) {
    auto const list = fleet_tasks(c.folders, c.out, c.words, c.options);
    [[maybe_unused]] bool const several = c.all != nullptr && c.all->several(); // ranks
    if (c.all != nullptr) c.all->watch_interrupts();
    auto const digest = detail::digest_of(list);
    auto const who = cluster::identity_of_program();
#ifdef SIVID_HAS_MPI
    if (several && c.all->helps()) {
        detail::work_on(list, digest, c.all->others(), who);
        return done;
    }
#endif
    prepare_folder(c.out);
    progress_line progress(c.quiet);
    std::vector<std::size_t> open;
    std::size_t finished = 0;
    for (std::size_t k = 0; k < list.size(); ++k) {
        if (c.task && k % c.task->second != c.task->first - 1) continue;
        if (!c.again && list[k].is_finished()) {
            ++finished;
        } else {
            open.push_back(k);
        }
    }
    progress.note(std::to_string(open.size()) + (open.size() == 1 ? " data set" : " data sets") +
                  " to work on, " + std::to_string(finished) + " finished before");
    // Threads of this process that start one process each, and the other ranks.
    cluster::memory_transport inside(c.jobs);
    cluster::transport* others = inside.of_first.get();
#ifdef SIVID_HAS_MPI
    std::optional<cluster::joined_transport> joined;
    if (several) others = &joined.emplace(*inside.of_first, c.all->others());
#endif
    cluster::worker_pool helpers(*others, who);
    std::vector<std::thread> threads;
    auto const end_all = [&] {
        helpers.stop();
        helpers.end();
        for (auto& t : threads) t.join();
    };
    try {
        helpers.begin("", {{{"list of data sets", digest, "give all ranks the same command"}}});
        for (std::size_t k = 0; k < c.jobs; ++k) {
            threads.emplace_back(
                [&, k] { detail::work_on(list, digest, *inside.of_workers[k], who); });
        }
        std::vector<cluster::worker_pool::task> tasks;
        for (auto const k : open) tasks.push_back({[k](std::size_t) { return std::to_string(k); }});
        std::size_t count = 0;
        cluster::worker_pool::manner how;
        how.ahead = 1; // a second one would wait for a long first one
        how.patience = 120;
        how.arrived = [&](std::size_t task, cluster::worker_pool::answer const& a) {
            progress.note(std::to_string(++count) + " of " + std::to_string(open.size()) + ": " +
                          list[open[task]].name() + ": " + a.body);
        };
        (void)helpers.ask(
            tasks, [&] { return !interrupted() && progress.elapsed() < c.within; }, how);
    } catch (...) {
        end_all();
        throw;
    }
    end_all();
    progress.finish();
    return write_fleet_summary(list, c.out);
}

} // namespace sivid::app

#endif
