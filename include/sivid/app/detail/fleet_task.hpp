// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_DETAIL_FLEET_TASK_HPP
#define SIVID_APP_DETAIL_FLEET_TASK_HPP

#include <sivid/app/program.hpp>
#include <sivid/io/dataset/dataset_digest.hpp>
#include <sivid/io/text/durable_file.hpp>
#include <sivid/io/text/json_document.hpp>
#include <sivid/io/text/json_writer.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sivid::app {

namespace detail {

/// Runs this program with other arguments, its output in a file; Ctrl-C for it once `wanted` is
/// false, and its end half a minute later. It does not outlive this process.
/// @returns  its exit code, or 1000 and the signal that ended it
inline int run_self(std::vector<std::string> words, std::filesystem::path const& log,
                    std::function<bool()> const& wanted) {
    std::string const self = "/proc/self/exe";
    words.insert(words.begin(), self);
    std::vector<char*> arguments, environment;
    for (auto& w : words) arguments.push_back(w.data());
    arguments.push_back(nullptr);
    for (char** e = ::environ; *e != nullptr; ++e) { // it is no rank of ours
        auto const starts = [e](char const* with) {
            return std::strncmp(*e, with, std::strlen(with)) == 0;
        };
        if (!starts("OMPI_") && !starts("PMIX_") && !starts("PMI_")) environment.push_back(*e);
    }
    environment.push_back(nullptr);
    auto const parent = ::getpid();
    auto const child = ::fork();
    if (child < 0) throw std::runtime_error("no further process can be started");
    if (child == 0) { // nothing here but calls of the system
        ::setpgid(0, 0);
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != parent) ::_exit(127);
        for (int const s : {SIGINT, SIGTERM, SIGUSR1}) ::signal(s, SIG_DFL);
        int const file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
        ::dup2(file, STDOUT_FILENO);
        ::dup2(file, STDERR_FILENO);
        ::execve(self.c_str(), arguments.data(), environment.data());
        ::_exit(127);
    }
    std::optional<std::chrono::steady_clock::time_point> asked;
    for (;;) {
        int status = 0;
        if (::waitpid(child, &status, WNOHANG) == child)
            return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
        auto const now = std::chrono::steady_clock::now();
        if (!asked && !wanted()) {
            asked = now;
            ::kill(child, SIGINT);
        } else if (asked && now > *asked + std::chrono::seconds(30)) {
            ::kill(child, SIGKILL);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

} // namespace detail

/// What a data set's note says.
struct fleet_note {
    int code = 0;
    double seconds = 0;
};

class fleet_task {
public:
    /// @throws input_error  for what is no data set
    fleet_task(std::filesystem::path dataset, std::filesystem::path const& out,
               std::vector<std::string> command, std::vector<std::string> options)
        : dataset_(std::move(dataset)),
          out_(out / name_of(dataset_)),
          command_(std::move(command)),
          options_(std::move(options)),
          digest_(dataset_digest(dataset_)) {}

    [[nodiscard]] std::string name() const { return name_of(dataset_); }
    [[nodiscard]] std::filesystem::path const& dataset() const { return dataset_; }
    [[nodiscard]] std::filesystem::path const& out() const { return out_; }
    /// Data and command: what a result is of.
    [[nodiscard]] std::string key() const {
        std::string text = digest_;
        for (auto const* list : {&command_, &options_}) {
            text += " |";
            for (auto const& w : *list) text += " " + w;
        }
        return text;
    }

    /// How the program ended on these data, with this command; nothing where it has not.
    [[nodiscard]] std::optional<fleet_note> note() const {
        std::error_code fault;
        if (!std::filesystem::exists(note_file(), fault)) return std::nullopt;
        try {
            auto const j = read_json(note_file());
            if (j.at("format").string() != format || j.at("of").raw_string() != key())
                return std::nullopt;
            return fleet_note{static_cast<int>(*nearest(j.at("code").number())),
                              *nearest(j.at("seconds").number())};
        } catch (input_error const&) {
            return std::nullopt; // damaged: as if it was not there
        }
    }
    /// Failures are tried again.
    [[nodiscard]] bool is_finished() const {
        auto const n = note();
        return n && n->code != bad_input && n->code != internal_error && n->code < 126;
    }

    /// Runs it. @returns  how it ended, in words
    [[nodiscard]] std::string run(std::function<bool()> const& wanted) const {
        stopwatch const clock;
        prepare_folder(out_);
        std::filesystem::remove(note_file());
        auto words = command_;
        words.insert(words.end(), {dataset_.string(), "--out", out_.string(), "--quiet"});
        words.insert(words.end(), options_.begin(), options_.end());
        if (std::filesystem::exists(out_ / "checkpoint.txt")) words.emplace_back("--resume");
        bool stopped = false;
        int const code = detail::run_self(std::move(words), out_ / "log.txt", [&] {
            stopped = stopped || !wanted();
            return !stopped;
        });
        double const took = clock.spent();
        if (code >= 1000) return "ended by signal " + std::to_string(code - 1000);
        if (stopped) return "stopped early";
        json_writer json;
        json.begin_object().members("format", format, "of", key(), "code", code, "seconds", took);
        json.end_object();
        write_durably(note_file(), json.text());
        return "ended with " + std::to_string(code) + " after " + text_of("%.3g s", took);
    }

private:
    static constexpr auto format = "sivid-fleet-1";

    [[nodiscard]] static std::string name_of(std::filesystem::path const& folder) {
        return (folder.filename().empty() ? folder.parent_path() : folder).filename().string();
    }
    [[nodiscard]] std::filesystem::path note_file() const { return out_ / "fleet.json"; }

    std::filesystem::path dataset_, out_;
    std::vector<std::string> command_, options_;
    std::string digest_;
};

/// The data sets in these folders, by their names; a folder without dataset.json stands for those
/// in it.
/// @throws bad_request  where there is none, or two have one name
inline std::vector<fleet_task> fleet_tasks(std::vector<std::filesystem::path> const& folders,
                                           std::filesystem::path const& out,
                                           std::vector<std::string> const& command,
                                           std::vector<std::string> const& options) {
    namespace fs = std::filesystem;
    std::vector<fs::path> found;
    for (auto const& folder : folders) {
        if (fs::exists(folder / "dataset.json") || !fs::is_directory(folder)) {
            found.push_back(folder);
            continue;
        }
        for (auto const& entry : fs::directory_iterator{folder}) {
            if (fs::exists(entry.path() / "dataset.json")) found.push_back(entry.path());
        }
    }
    if (found.empty()) {
        throw bad_request(
            "no data set in the folders given: name folders that hold dataset.json, or folders "
            "of such");
    }
    std::vector<fleet_task> list;
    for (auto const& dataset : found) list.emplace_back(dataset, out, command, options);
    std::sort(list.begin(), list.end(),
              [](auto const& a, auto const& b) { return a.name() < b.name(); });
    for (std::size_t k = 1; k < list.size(); ++k) {
        if (list[k].name() != list[k - 1].name()) continue;
        throw bad_request("two data sets are called " + list[k].name() + ": " +
                          list[k - 1].dataset().string() + " and " + list[k].dataset().string() +
                          "; rename one of the folders");
    }
    return list;
}

} // namespace sivid::app

#endif
