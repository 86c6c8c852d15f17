// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_WORKING_COORDINATOR_HPP
#define SIVID_CLUSTER_WORKING_COORDINATOR_HPP

#include <sivid/cluster/frame.hpp>
#include <sivid/cluster/identity.hpp>
#include <sivid/cluster/transport.hpp>
#include <sivid/cluster/worker.hpp>
#include <sivid/cluster/worker_pool.hpp>

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace sivid::cluster {

/// The pool of others and of a thread of the coordinator's own, so that the processor of the one
/// who waits works, too. Begins the work when it is made, and ends it for all with its life.
class working_coordinator {
public:
    /// @param others  is referred to
    /// @param about   what the work is about, for all
    /// @param mine    what must be the same there
    /// @param answer  of the own thread; may ask the worker given whether its work is wanted
    working_coordinator(transport& others, std::string_view about, identity const& mine,
                        std::function<std::string(worker&, std::string_view)> answer)
        : all_(*inside_.of_first, others), who_(identity_of_program()), pool_(all_, who_) {
        pool_.begin(about, mine);
        thread_ = std::thread([this, mine, answer = std::move(answer)] {
            worker self(*inside_.of_workers[0], who_);
            self.serve({[&mine](std::string_view) { return mine; },
                        [&](std::string_view request) { return answer(self, request); }});
        });
    }
    working_coordinator(working_coordinator const&) = delete;
    working_coordinator& operator=(working_coordinator const&) = delete;
    ~working_coordinator() {
        pool_.stop();
        pool_.end();
        thread_.join();
    }

    [[nodiscard]] worker_pool& helpers() { return pool_; }

private:
    memory_transport inside_{1};
    joined_transport all_;
    identity who_;
    worker_pool pool_;
    std::thread thread_;
};

/// Lets go those who wait for work that never came.
inline void release(transport& others) {
    for (std::size_t m = 0; m < others.others(); ++m)
        others.send(m, to_bytes({frame::kind::end, 0, {}}));
}

/// Lets them go with the end of its life, whatever ends it, unless work has come meanwhile: then a
/// `working_coordinator` does.
class released_at_end {
public:
    /// @param others  is referred to
    explicit released_at_end(transport& others) : others_(&others) {}
    released_at_end(released_at_end const&) = delete;
    released_at_end& operator=(released_at_end const&) = delete;
    ~released_at_end() {
        if (others_ != nullptr) release(*others_);
    }
    void work_has_come() { others_ = nullptr; }

private:
    transport* others_;
};

} // namespace sivid::cluster

#endif
