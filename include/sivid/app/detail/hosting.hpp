// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_DETAIL_HOSTING_HPP
#define SIVID_APP_DETAIL_HOSTING_HPP

#include <sivid/app/console.hpp>

#include <iostream>
#include <mutex>
#include <sstream>
#include <string>

/// How another program, Python for instance, runs a command within itself.
namespace sivid::app::detail {

/// For as long as it lives, keeps what a stream is given.
class kept_stream {
public:
    explicit kept_stream(std::ostream& s) : stream_{s}, own_{s.rdbuf(kept_.rdbuf())} {}
    ~kept_stream() { stream_.rdbuf(own_); }
    kept_stream(kept_stream const&) = delete;
    kept_stream& operator=(kept_stream const&) = delete;
    [[nodiscard]] std::string text() const { return kept_.str(); }

private:
    std::ostringstream kept_;
    std::ostream& stream_;
    std::streambuf* own_;
};

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
