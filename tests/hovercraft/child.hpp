// SPDX-License-Identifier: MIT
// The program of the hovercraft as a child process.
#ifndef SIVID_TESTS_HOVERCRAFT_CHILD_HPP
#define SIVID_TESTS_HOVERCRAFT_CHILD_HPP

#include "io/support.hpp"

#include <nlohmann/json.hpp>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hovercraft_test {

namespace fs = std::filesystem;

/// A running program whose outputs go to files.
class child {
public:
    child(std::vector<std::string> arguments, fs::path const& folder)
        : out_{folder / "stdout.txt"}, err_{folder / "stderr.txt"} {
        arguments.insert(arguments.begin(), HOVERCRAFT_PROGRAM);
        id_ = ::fork();
        if (id_ == 0) {
            redirect(out_, STDOUT_FILENO);
            redirect(err_, STDERR_FILENO);
            std::vector<char*> argv;
            for (auto& a : arguments) argv.push_back(a.data());
            argv.push_back(nullptr);
            ::execv(HOVERCRAFT_PROGRAM, argv.data());
            ::_exit(127);
        }
    }
    void signal(int number) const { ::kill(id_, number); }
    /// The exit code, or 1000 + the signal that ended it.
    int wait() const {
        int status = 0;
        ::waitpid(id_, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    }
    std::string out() const { return text(out_); }
    std::string err() const { return text(err_); }

private:
    static void redirect(fs::path const& file, int to) {
        int const handle = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        ::dup2(handle, to);
        ::close(handle);
    }
    static std::string text(fs::path const& file) {
        std::ifstream in{file, std::ios::binary};
        return {std::istreambuf_iterator<char>{in}, {}};
    }
    fs::path out_, err_;
    ::pid_t id_ = 0;
};

struct finished {
    int code;
    std::string out, err;
};

inline finished run(std::vector<std::string> const& arguments) {
    io_support::temporary_folder const folder;
    child const c(arguments, folder.path());
    int const code = c.wait();
    return {code, c.out(), c.err()};
}

inline nlohmann::json json_of(fs::path const& file) {
    std::ifstream in{file};
    return nlohmann::json::parse(in);
}

} // namespace hovercraft_test

#endif
