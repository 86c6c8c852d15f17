// SPDX-License-Identifier: MIT
// A pool whose workers are threads of the test.
#ifndef SIVID_TESTS_CLUSTER_THREADS_HPP
#define SIVID_TESTS_CLUSTER_THREADS_HPP

#include <sivid/cluster/identity.hpp>
#include <sivid/cluster/transport.hpp>
#include <sivid/cluster/worker.hpp>
#include <sivid/cluster/worker_pool.hpp>

#include <cstddef>
#include <exception>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

namespace cluster_test {

using namespace sivid::cluster;

class workers_in_threads {
public:
    workers_in_threads(
        std::size_t workers, std::function<void(std::size_t, worker&)> const& work,
        std::function<identity(std::size_t)> const& who =
            [](std::size_t) { return identity_of_program(); })
        : office(workers), helpers(*office.of_first, identity_of_program()) {
        for (std::size_t k = 0; k < workers; ++k) {
            threads_.emplace_back([this, k, work, mine = who(k)] {
                try {
                    worker m(*office.of_workers[k], mine);
                    work(k, m);
                } catch (std::exception const&) { // what it says was tested elsewhere
                }
            });
        }
    }
    workers_in_threads(workers_in_threads const&) = delete;
    workers_in_threads& operator=(workers_in_threads const&) = delete;
    ~workers_in_threads() {
        helpers.stop();
        helpers.end();
        for (auto& t : threads_) t.join();
    }
    /// Until something is thrown, ten seconds at most.
    void ask_for_ever(std::vector<worker_pool::task> const& tasks) {
        auto const end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        while (std::chrono::steady_clock::now() < end)
            (void)helpers.ask(tasks, [] { return true; });
    }

    memory_transport office;
    worker_pool helpers;

private:
    std::vector<std::thread> threads_;
};

} // namespace cluster_test

#endif
