// SPDX-License-Identifier: MIT
// A crew whose members are threads of the test.
#ifndef SIVID_TESTS_CLUSTER_THREADS_HPP
#define SIVID_TESTS_CLUSTER_THREADS_HPP

#include <sivid/cluster/crew.hpp>
#include <sivid/cluster/identity.hpp>
#include <sivid/cluster/member.hpp>
#include <sivid/cluster/post.hpp>

#include <cstddef>
#include <exception>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

namespace cluster_test {

using namespace sivid::cluster;

class crew_in_threads {
public:
    crew_in_threads(
        std::size_t members, std::function<void(std::size_t, member&)> const& work,
        std::function<identity(std::size_t)> const& who =
            [](std::size_t) { return identity_of_program(); })
        : office(members), helpers(*office.of_first, identity_of_program()) {
        for (std::size_t k = 0; k < members; ++k) {
            threads_.emplace_back([this, k, work, mine = who(k)] {
                try {
                    member m(*office.of_members[k], mine);
                    work(k, m);
                } catch (std::exception const&) { // what it says was tested elsewhere
                }
            });
        }
    }
    crew_in_threads(crew_in_threads const&) = delete;
    crew_in_threads& operator=(crew_in_threads const&) = delete;
    ~crew_in_threads() {
        helpers.stop();
        helpers.end();
        for (auto& t : threads_) t.join();
    }
    /// Until something is thrown, ten seconds at most.
    void ask_for_ever(std::vector<crew::task> const& tasks) {
        auto const end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        while (std::chrono::steady_clock::now() < end)
            (void)helpers.ask(tasks, [] { return true; });
    }

    memory_post office;
    crew helpers;

private:
    std::vector<std::thread> threads_;
};

} // namespace cluster_test

#endif
