// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_WORKING_CREW_HPP
#define SIVID_CLUSTER_WORKING_CREW_HPP

#include <sivid/cluster/crew.hpp>
#include <sivid/cluster/frame.hpp>
#include <sivid/cluster/identity.hpp>
#include <sivid/cluster/member.hpp>
#include <sivid/cluster/post.hpp>

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace sivid::cluster {

/// The crew of others and of a thread of the coordinator's own, so that the processor of the one
/// who waits works, too. Begins the work when it is made, and ends it for all with its life.
class working_crew {
public:
    /// @param others  is referred to
    /// @param about   what the work is about, for all
    /// @param mine    what must be the same there
    /// @param answer  of the own thread; may ask the member given whether its work is wanted
    working_crew(post& others, std::string_view about, identity const& mine,
                 std::function<std::string(member&, std::string_view)> answer)
        : all_(*inside_.of_first, others), who_(identity_of_program()), crew_(all_, who_) {
        crew_.begin(about, mine);
        thread_ = std::thread([this, mine, answer = std::move(answer)] {
            member self(*inside_.of_members[0], who_);
            self.serve({[&mine](std::string_view) { return mine; },
                        [&](std::string_view request) { return answer(self, request); }});
        });
    }
    working_crew(working_crew const&) = delete;
    working_crew& operator=(working_crew const&) = delete;
    ~working_crew() {
        crew_.stop();
        crew_.end();
        thread_.join();
    }

    [[nodiscard]] crew& helpers() { return crew_; }

private:
    memory_post inside_{1};
    joined_post all_;
    identity who_;
    crew crew_;
    std::thread thread_;
};

/// Lets go those who wait for work that never came.
inline void release(post& others) {
    for (std::size_t m = 0; m < others.others(); ++m)
        others.send(m, to_bytes({frame::kind::end, 0, {}}));
}

} // namespace sivid::cluster

#endif
