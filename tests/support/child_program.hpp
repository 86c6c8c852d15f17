// SPDX-License-Identifier: MIT
// A program as a user runs it: exit code, outputs, signals.
#ifndef SIVID_TESTS_SUPPORT_CHILD_PROGRAM_HPP
#define SIVID_TESTS_SUPPORT_CHILD_PROGRAM_HPP

#include "io/support.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace support {

inline std::string text_of(std::filesystem::path const& file) {
    std::ifstream in{file, std::ios::binary};
    return {std::istreambuf_iterator<char>{in}, {}};
}

/// A running program whose outputs go to files of a folder.
class child_program {
public:
    /// @param largest_file  writing beyond so many bytes fails, as on a full disk; 0: nothing does
    child_program(std::string program, std::vector<std::string> arguments,
                  std::filesystem::path const& folder, ::rlim_t largest_file = 0)
        : out_{folder / "stdout.txt"}, err_{folder / "stderr.txt"} {
        arguments.insert(arguments.begin(), program);
        id_ = ::fork();
        if (id_ == 0) {
            redirect(out_, STDOUT_FILENO);
            redirect(err_, STDERR_FILENO);
            if (largest_file > 0) {
                ::rlimit const limit{largest_file, largest_file};
                ::setrlimit(RLIMIT_FSIZE, &limit);
                ::signal(SIGXFSZ, SIG_IGN); // so that writing fails instead
            }
            std::vector<char*> argv;
            for (auto& a : arguments) argv.push_back(a.data());
            argv.push_back(nullptr);
            ::execv(program.c_str(), argv.data());
            ::_exit(127);
        }
    }
    void signal(int number) const { ::kill(id_, number); }
    /// The exit code, or 1000 + the signal that ended it.
    [[nodiscard]] int wait() const {
        int status = 0;
        ::waitpid(id_, &status, 0);
        return ending(status);
    }
    /// Kills it after so many seconds.
    /// @returns  as `wait`; 1000 + SIGKILL: it had to be killed
    [[nodiscard]] int wait_at_most(double seconds) const {
        auto const begin = std::chrono::steady_clock::now();
        for (;;) {
            int status = 0;
            if (::waitpid(id_, &status, WNOHANG) == id_) return ending(status);
            if (std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() >
                seconds) {
                ::kill(id_, SIGKILL);
                seconds = 1e9;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    }
    [[nodiscard]] std::string out() const { return text_of(out_); }
    [[nodiscard]] std::string err() const { return text_of(err_); }

private:
    static int ending(int status) {
        return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    }
    static void redirect(std::filesystem::path const& file, int to) {
        int const handle = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        ::dup2(handle, to);
        ::close(handle);
    }
    std::filesystem::path out_, err_;
    ::pid_t id_ = 0;
};

struct finished_program {
    int code;
    std::string out, err;
};

inline finished_program run_program(std::string const& program,
                                    std::vector<std::string> const& arguments) {
    io_support::temporary_folder const folder;
    child_program const c(program, arguments, folder.path());
    int const code = c.wait();
    return {code, c.out(), c.err()};
}

} // namespace support

#endif
