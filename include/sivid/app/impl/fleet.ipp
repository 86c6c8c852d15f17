// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPL_FLEET_IPP
#define SIVID_APP_IMPL_FLEET_IPP

#include <sivid/app/commands.hpp>

#include <sivid/app/console.hpp>
#include <sivid/app/program.hpp>
#include <sivid/app/ranks.hpp>
#include <sivid/cluster/identity.hpp>
#include <sivid/cluster/transport.hpp>
#include <sivid/cluster/worker.hpp>
#include <sivid/cluster/worker_pool.hpp>
#include <sivid/io/dataset/dataset_digest.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/text/durable_file.hpp>
#include <sivid/io/text/json_document.hpp>
#include <sivid/io/text/json_writer.hpp>
#include <sivid/io/text/printable_text.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/number/text/sha256.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
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

/// What a data set's note says.
struct fleet_note {
    int code = 0;
    double seconds = 0;
};

class fleet_task {
public:
    fleet_task(std::filesystem::path dataset, std::filesystem::path const& out,
               std::vector<std::string> command, std::vector<std::string> options)
        : dataset_(std::move(dataset)),
          out_(out / name_of(dataset_)),
          command_(std::move(command)),
          options_(std::move(options)) {}

    [[nodiscard]] std::string name() const { return name_of(dataset_); }
    [[nodiscard]] std::filesystem::path const& dataset() const { return dataset_; }
    [[nodiscard]] std::filesystem::path const& out() const { return out_; }
    /// What ranks must agree on. The data are read by who works on them: a fleet has many.
    [[nodiscard]] std::string asked() const { return name() + words(); }

    /// How the program ended on these data, with this command; nothing where it has not.
    /// Reads the data, where they were not read here before.
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
        return n && is_result(*n);
    }
    [[nodiscard]] static bool is_result(fleet_note const& n) {
        return n.code != bad_input && n.code != internal_error && n.code < 126;
    }

    /// Runs it. @returns  how it ended, in words
    [[nodiscard]] std::string run(std::function<bool()> const& wanted) const {
        stopwatch const clock;
        auto const of = key();                // before the program reads them
        std::filesystem::remove(note_file()); // of before, whatever fails from here on
        prepare_folder(out_);
        auto words = command_;
        words.insert(words.end(), {dataset_.string(), "--out", out_.string(), "--quiet"});
        words.insert(words.end(), options_.begin(), options_.end());
        if (std::filesystem::exists(out_ / "checkpoint.txt")) words.emplace_back("--resume");
        bool stopped = false;
        int const code = run_self(std::move(words), out_ / "log.txt", [&] {
            stopped = stopped || !wanted();
            return !stopped;
        });
        double const took = clock.spent();
        if (code >= 1000) return "ended by signal " + std::to_string(code - 1000);
        if (stopped) return "stopped early";
        json_writer json;
        json.begin_object().members("format", format, "of", of, "code", code, "seconds", took);
        json.end_object();
        write_durably(note_file(), json.text());
        return "ended with " + std::to_string(code) + " after " + nearest_text(took, 3) + " s";
    }

private:
    static constexpr auto format = "sivid-fleet-1";

    [[nodiscard]] static std::string name_of(std::filesystem::path const& folder) {
        return (folder.filename().empty() ? folder.parent_path() : folder).filename().string();
    }
    [[nodiscard]] std::filesystem::path note_file() const { return out_ / "fleet.json"; }
    /// Data and command: what a result is of.
    [[nodiscard]] std::string key() const {
        if (digest_.empty()) {
            try {
                digest_ = dataset_digest(dataset_);
            } catch (input_error const&) {
                digest_ = "unreadable"; // the command says why
            }
        }
        return digest_ + words();
    }
    [[nodiscard]] std::string words() const {
        std::string text;
        for (auto const* list : {&command_, &options_}) {
            text += " |";
            for (auto const& w : *list) text += " " + w;
        }
        return text;
    }

    std::filesystem::path dataset_, out_;
    std::vector<std::string> command_, options_;
    mutable std::string digest_; ///< once it was asked for; one thread has a task at a time
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
        if (fs::exists(folder / "dataset.json")) {
            found.push_back(folder);
            continue;
        }
        if (!fs::is_directory(folder))
            throw bad_request(folder.string() + " is no folder: name folders that hold "
                                                "dataset.json, or folders of such");
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

/// One line of the summary.
struct fleet_row {
    std::string name;
    std::string state;               ///< result, failed, missing
    std::string found;               ///< in words
    std::string low = "", high = ""; ///< bounds of what `about` says, as the result has them
    std::string about = "";          ///< "not excluded", "inflation"
    fleet_note note = {};
};

/// A number as the file has it: bounds must not be rounded on the way.
inline std::string number_text(json_value const& j) {
    return j.type() == json_value::kind::number ? j.number().text() : std::string{};
}

inline void fill_identification(fleet_row& row, json_value const& j) {
    row.found = j.at("verdict").string() + " (" + j.at("stop_reason").string() + ")";
    row.about = "not excluded";
    row.low = number_text(j.at("volume").at("inner").elements().at(0));
    row.high = number_text(j.at("volume").at("outer").elements().at(1));
}
inline void fill_diagnosis(fleet_row& row, json_value const& j) {
    auto const& answer = j.at("answer").at("kind").string();
    row.found = "gap " + j.at("gap").at("verdict").string() + ", answer " + answer;
    auto const& causes = j.at("causes").elements();
    if (answer == "effects" && !causes.empty()) {
        std::string names;
        for (auto const& e : causes.front().at("effects").elements())
            names += (names.empty() ? ": " : " + ") + e.string();
        row.found += names + " (" + causes.front().at("verdict").string() + ")";
    }
    row.about = "inflation";
    auto const& bounds = j.at("gap").at("inflation");
    if (bounds.type() != json_value::kind::array) return;
    row.low = number_text(bounds.elements().at(0));
    row.high = number_text(bounds.elements().at(1));
}

inline fleet_row row_of(fleet_task const& task) {
    fleet_row row{task.name(), "missing", "no result yet"};
    auto const note = task.note();
    if (!note) return row;
    row.note = *note;
    row.state = task.is_result(*note) ? "result" : "failed";
    row.found =
        "ended with " + std::to_string(note->code) + ": see " + (task.out() / "log.txt").string();
    if (row.state == "failed") return row;
    try {
        if (std::filesystem::exists(task.out() / "diagnosis.json")) {
            fill_diagnosis(row, read_json(task.out() / "diagnosis.json"));
        } else {
            fill_identification(row, read_json(task.out() / "result.json"));
        }
    } catch (input_error const& e) {
        row.state = "failed";
        row.found = e.what();
    }
    return row;
}

inline std::string in_csv(std::string const& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (char const c : text) quoted += c == '"' ? std::string{"\"\""} : std::string{c};
    return quoted + '"';
}

/// Writes the summary of all data sets of the list, whoever worked on them, and prints it.
/// @returns an exit code
/// @throws output_error
inline int write_fleet_summary(std::vector<fleet_task> const& list,
                               std::filesystem::path const& out) {
    std::vector<fleet_row> rows;
    for (auto const& task : list) rows.push_back(row_of(task));
    std::string csv = "dataset,state,found,bounds_of,lower,upper,exit_code,seconds\n";
    json_writer json;
    json.begin_object().members("format", "sivid-fleet-summary-1").key("datasets").begin_array();
    std::map<std::string, std::size_t> counts;
    double seconds = 0;
    int code = done;
    for (auto const& r : rows) {
        bool const ran = r.state != "missing";
        csv += in_csv(r.name) + "," + r.state + "," + in_csv(r.found) + "," + r.about + "," +
               r.low + "," + r.high + "," + (ran ? std::to_string(r.note.code) : "") + "," +
               (ran ? nearest_text(r.note.seconds, 6) : "") + "\n";
        json.begin_object(json_writer::layout::one_line);
        json.members("dataset", r.name, "state", r.state, "found", r.found);
        if (ran) json.members("exit_code", r.note.code, "seconds", r.note.seconds);
        json.end_object();
        ++counts[r.state == "result" ? r.found : r.state];
        seconds += r.note.seconds;
        if (r.state == "failed" && code != internal_error && code != bad_input)
            code = r.note.code == bad_input ? bad_input : internal_error;
        if (r.state == "missing" && code == done) code = undecided;
    }
    json.end_array().named("counts", counts).members("seconds", seconds).end_object();
    file_set files(out);
    files.add("fleet.csv", csv);
    files.add("fleet.json", json.text());
    files.commit();
    std::size_t widest = 0;
    for (auto const& r : rows) widest = std::max(widest, r.name.size());
    for (auto const& r : rows) {
        auto name = printable_text(r.name, 200);
        name.resize(std::max(name.size(), widest), ' ');
        result_stream() << name << "  " << printable_text(r.found, 400);
        if (!r.high.empty())
            result_stream() << "; " << r.about << " [" << r.low << ", " << r.high << "]";
        result_stream() << "\n";
    }
    result_stream() << rows.size() << (rows.size() == 1 ? " data set" : " data sets");
    for (auto const& [what, count] : counts)
        result_stream() << "; " << count << " " << printable_text(what, 200);
    result_stream() << "\n"
                    << nearest_text(seconds, 3)
                    << " s of the programs; written: " << (out / "fleet.csv").string()
                    << " and fleet.json\n";
    return code;
}

/// Works on tasks of the list for whoever coordinates, until the service is over.
inline void work_on(std::vector<fleet_task> const& list, std::string const& digest,
                    cluster::transport& coordinator, cluster::identity const& who) {
    cluster::worker self(coordinator, who);
    self.serve({[&digest](std::string_view) {
                    return cluster::identity{
                        {{"list of data sets", digest, "give all ranks the same command"}}};
                },
                [&](std::string_view request) {
                    auto const k = std::stoul(std::string{request});
                    return list.at(k).run([&] { return self.wanted(); });
                }});
}

/// What must be the same on all ranks.
inline std::string digest_of(std::vector<fleet_task> const& list) {
    std::string text;
    for (auto const& t : list) text += t.asked() + "\n";
    return sha256(text);
}

/// Those of the list that the command is for and that have no result of it yet.
inline std::vector<std::size_t> open_tasks(std::vector<fleet_task> const& list,
                                           fleet_command const& c, progress_line& progress) {
    std::vector<std::size_t> open;
    std::size_t finished = 0;
    for (std::size_t k = 0; k < list.size(); ++k) {
        if (c.task && k % c.task->second != c.task->first - 1) continue;
        if (!c.again && list[k].is_finished()) {
            ++finished;
        } else {
            open.push_back(k);
        }
    }
    progress.note(std::to_string(open.size()) + (open.size() == 1 ? " data set" : " data sets") +
                  " to work on, " + std::to_string(finished) + " finished before");
    return open;
}

} // namespace detail

SIVID_DECL int run_fleet(fleet_command const& c) {
    auto const list = detail::fleet_tasks(c.folders, c.out, c.words, c.options);
    bool const several = c.job != nullptr && c.job->several(); // ranks
    if (c.job != nullptr) c.job->watch_interrupts();
    auto const digest = detail::digest_of(list);
    auto const who = cluster::identity_of_program();
    if (several && c.job->helps()) {
        detail::work_on(list, digest, c.job->all().others(), who);
        return done;
    }
    prepare_folder(c.out);
    progress_line progress(c.quiet);
    auto const open = detail::open_tasks(list, c, progress);
    // Threads of this process that start one process each, and the other ranks.
    cluster::memory_transport inside(c.jobs);
    cluster::transport* others = inside.of_first.get();
    std::optional<cluster::joined_transport> joined;
    if (several) others = &joined.emplace(*inside.of_first, c.job->all().others());
    cluster::worker_pool helpers(*others, who);
    std::vector<std::thread> threads;
    auto const end_all = [&] {
        helpers.stop();
        helpers.end();
        for (auto& t : threads) t.join();
    };
    try {
        helpers.begin("", {{{"list of data sets", digest, "give all ranks the same command"}}});
        for (std::size_t k = 0; k < c.jobs; ++k) {
            threads.emplace_back(
                [&, k] { detail::work_on(list, digest, *inside.of_workers[k], who); });
        }
        std::vector<cluster::worker_pool::task> tasks;
        for (auto const k : open) tasks.push_back({[k](std::size_t) { return std::to_string(k); }});
        std::size_t count = 0;
        cluster::worker_pool::manner how;
        how.ahead = 1; // a second one would wait for a long first one
        how.patience = 120;
        how.arrived = [&](std::size_t task, cluster::worker_pool::answer const& a) {
            progress.note(std::to_string(++count) + " of " + std::to_string(open.size()) + ": " +
                          list[open[task]].name() + ": " + a.body);
        };
        (void)helpers.ask(
            tasks, [&] { return !interrupted() && progress.elapsed() < c.within; }, how);
    } catch (...) {
        end_all();
        throw;
    }
    end_all();
    progress.finish();
    return detail::write_fleet_summary(list, c.out);
}

} // namespace sivid::app

#endif
