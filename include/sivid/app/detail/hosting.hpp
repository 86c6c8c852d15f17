// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_DETAIL_HOSTING_HPP
#define SIVID_APP_DETAIL_HOSTING_HPP

#include <sivid/app/console.hpp>

#include <mutex>

/// How another program, Python for instance, runs a command within itself.
namespace sivid::app::detail {

/// For as long as it lives, a command has a host; one at a time.
class hosting {
public:
    explicit hosting(host const& h) : alone_{one_at_a_time()} { host_of_command = &h; }
    ~hosting() { host_of_command = nullptr; }
    hosting(hosting const&) = delete;
    hosting& operator=(hosting const&) = delete;

private:
    static std::mutex& one_at_a_time() {
        static std::mutex one;
        return one;
    }
    std::lock_guard<std::mutex> alone_;
};

} // namespace sivid::app::detail

#endif
