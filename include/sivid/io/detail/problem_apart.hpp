// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DETAIL_PROBLEM_APART_HPP
#define SIVID_IO_DETAIL_PROBLEM_APART_HPP

#include <sivid/io/input_error.hpp>

#include <array>
#include <cerrno>
#include <functional>
#include <optional>
#include <string>

#ifdef __unix__
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace sivid {

/// Tries to read an input in a process of its own, where a foreign library may crash on it.
/// @param read  throws `input_error` for what cannot be read
/// @returns  the problem, if there is one: that of the error, or that the process did not end by
///           itself within a minute; nothing where no process can be made
/// @cost  that of `read`, and of a copy of the pages that it writes
[[nodiscard]] inline std::optional<std::string> problem_apart(std::function<void()> const& read) {
#ifdef __unix__
    constexpr unsigned most = 60; // s; a gigabyte takes some
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) return std::nullopt;
    auto const child = fork();
    if (child == 0) {
        alarm(most);
        close(STDOUT_FILENO);
        close(STDERR_FILENO);
        try {
            read();
        } catch (input_error const& e) {
            auto const text = e.problem().substr(0, 1000); // a pipe holds more
            bool const said = write(ends[1], text.data(), text.size()) >= 0;
            _exit(said ? 1 : 2);
        } catch (...) {
            _exit(2);
        }
        _exit(0);
    }
    close(ends[1]);
    std::string problem(1000, ' ');
    ssize_t size = 0; // nothing, where the other end closes without a word
    while (child > 0 && (size = ::read(ends[0], problem.data(), problem.size())) < 0 &&
           errno == EINTR) {
    }
    close(ends[0]);
    int status = 0;
    while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (child < 0 || (WIFEXITED(status) && WEXITSTATUS(status) == 0)) return std::nullopt;
    problem.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return problem.empty() ? "it is damaged: the library that reads it does not survive it"
                           : problem;
#else
    (void)read;
    return std::nullopt;
#endif
}

} // namespace sivid

#endif
