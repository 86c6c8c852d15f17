// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_CONSOLE_HPP
#define SIVID_APP_CONSOLE_HPP

#include <sivid/app/outputs.hpp>
#include <sivid/version.hpp>

#include <chrono>
#include <csignal>
#include <ctime>
#include <functional>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include <unistd.h>

/// @file
/// What all commands share at the terminal: progress, Ctrl-C, and who computed when.
namespace sivid::app {

/// What a command has in place of a terminal where another program runs it (`run_within`).
struct host {
    std::function<void(std::string const&)> progress; ///< a line on what goes on; may be empty
    std::function<bool()> interrupted; ///< whether the result so far is asked for; of any thread
};

namespace detail {
inline host const* host_of_command = nullptr; ///< nothing: a program of its own
inline volatile std::sig_atomic_t interruption = 0;
extern "C" inline void sivid_app_interrupt(int) {
    interruption = 1;
    std::signal(SIGINT, SIG_DFL);
}
/// Batch systems and mpirun may say it more than once.
extern "C" inline void sivid_app_interrupt_of_job(int) { interruption = 1; }
} // namespace detail

/// From now on the first Ctrl-C asks for the result so far, the second one ends the program. Within
/// another program that one looks after Ctrl-C.
inline void watch_interrupts() {
    if (detail::host_of_command != nullptr) return;
    detail::interruption = 0;
    std::signal(SIGINT, detail::sivid_app_interrupt);
}
inline bool interrupted() {
    if (detail::host_of_command != nullptr) return detail::host_of_command->interrupted();
    return detail::interruption != 0;
}
/// What work asks whether to go on.
inline bool wanted() { return !interrupted(); }

/// Progress on stderr: one line that is rewritten on a terminal, else a new one each second. Within
/// another program that one gets the lines.
class progress_line {
public:
    explicit progress_line(bool quiet)
        : host_{detail::host_of_command},
          quiet_{quiet || (host_ != nullptr && !host_->progress)},
          terminal_{host_ == nullptr && ::isatty(STDERR_FILENO) != 0},
          begin_{clock::now()} {}

    /// A line that stays.
    void note(std::string const& text) {
        if (quiet_) return;
        finish();
        print(text, "", "\n");
    }
    /// What goes on now; shown when the last was some time ago.
    void show(std::string const& text) {
        auto const now = clock::now();
        double const pause = terminal_ || host_ != nullptr ? 0.1 : 1.0;
        if (quiet_ || (shown_ && std::chrono::duration<double>(now - last_).count() < pause)) {
            return;
        }
        last_ = now;
        shown_ = true;
        print(text, terminal_ ? "\r\x1b[K" : "", terminal_ ? "" : "\n");
    }
    void finish() {
        if (shown_ && terminal_) notice_stream() << '\n';
        shown_ = false;
    }
    [[nodiscard]] double elapsed() const {
        return std::chrono::duration<double>(clock::now() - begin_).count();
    }

private:
    void print(std::string const& text, char const* before, char const* behind) const {
        std::ostringstream line;
        line << std::fixed << std::setprecision(1) << std::setw(7) << elapsed() << " s  " << text;
        if (host_ != nullptr) return host_->progress(line.str());
        notice_stream() << before + line.str() + behind << std::flush;
    }

    using clock = std::chrono::steady_clock;
    host const* host_;
    bool quiet_, terminal_, shown_ = false;
    clock::time_point begin_, last_;
};

/// One line about the state of a paving.
template <class PavingProgress>
std::string paving_words(PavingProgress const& p) {
    std::ostringstream line;
    line << std::setprecision(3) << std::setw(8) << p.tested << " boxes  " << std::setw(6)
         << p.pending << " waiting  inside " << std::setw(9) << 100 * p.inner << " %  not excluded "
         << std::setw(9) << 100 * p.outer << " % of the prior";
    return line.str();
}

/// Today, as 2024-11-20.
inline std::string today() {
    auto const now = std::time(nullptr);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%d", std::localtime(&now));
    return text;
}
/// Compiler and number of threads used.
inline std::string machine_text() {
#if defined(__clang__)
    std::string const compiler = std::string{"clang "} + __clang_version__;
#else
    std::string const compiler = std::string{"g++ "} + __VERSION__;
#endif
    return std::string{"one thread, "} + compiler.substr(0, compiler.find(" ("));
}

/// The last lines of a page.
inline std::vector<std::string> page_footer(std::string const& command) {
    return {"sivid " + std::string{version}, today(), machine_text(), command};
}

} // namespace sivid::app

#endif
