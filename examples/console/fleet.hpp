// SPDX-License-Identifier: MIT
// Many data sets, each by a process of its own, and one summary.
#ifndef EXAMPLES_CONSOLE_FLEET_HPP
#define EXAMPLES_CONSOLE_FLEET_HPP

#include "console/fleet_summary.hpp"
#include "console/fleet_task.hpp"
#include "console/program.hpp"
#include "console/ranks.hpp"

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

namespace console {

struct fleet_command {
    std::vector<std::filesystem::path> folders; ///< data sets, or folders of data sets
    std::filesystem::path out;
    std::vector<std::string> command; ///< of the program, before the data set
    std::vector<std::string> options; ///< behind it
    std::size_t jobs = 1;             ///< processes at once, of each rank
    std::optional<std::pair<std::size_t, std::size_t>> task; ///< k of n: every n-th, from k on
    double within = std::numeric_limits<double>::infinity(); ///< seconds for all
    bool again = false;                                      ///< what is finished, too
    bool quiet = false;
    ranks const* all = nullptr;
};

namespace detail {

/// Works on tasks of the list for whoever coordinates, until the service is over.
inline void work_on(std::vector<fleet_task> const& list, std::string const& digest,
                    sivid::cluster::transport& coordinator, sivid::cluster::identity const& who) {
    namespace cluster = sivid::cluster;
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
    return sivid::sha256(text);
}

} // namespace detail

/// Runs the program on every data set that has no result of this command yet, and writes the
/// summary of all: fleet.csv and fleet.json.
/// @returns done where all have a result, undecided where some have none yet, else what the first
///          that failed ended with
/// @throws bad input as std::invalid_argument, sivid::input_error, sivid::output_error
inline int run_fleet(fleet_command const& c) {
    namespace cluster = sivid::cluster;
    auto const list = fleet_tasks(c.folders, c.out, c.command, c.options);
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

} // namespace console

#endif
