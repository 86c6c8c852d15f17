// SPDX-License-Identifier: MIT
// The hovercraft program started by mpirun, on this machine, without a network, as root or not.
#ifndef SIVID_TESTS_RANKS_JOB_HPP
#define SIVID_TESTS_RANKS_JOB_HPP

#include "support/child_program.hpp"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

namespace ranks_test {

namespace fs = std::filesystem;
using words = std::vector<std::string>;

inline words operator+(words a, words const& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// mpirun with what it needs here: more ranks than cores, shared memory without ptrace, nothing to
/// start on other machines.
/// @param grace  seconds from a signal, or the loss of a rank, until the others are killed
inline words mpirun(std::size_t ranks, int grace = 1) {
    ::setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 1);
    ::setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
    ::setenv("OMPI_MCA_hwloc_base_binding_policy", "none", 1);
    ::setenv("OMPI_MCA_btl", "self,vader", 1);
    ::setenv("OMPI_MCA_plm", "isolated", 1);
    ::setenv("OMPI_MCA_oob", "tcp", 1);
    ::setenv("OMPI_MCA_oob_tcp_if_include", "lo", 1);
    ::setenv("OMPI_MCA_odls_base_sigkill_timeout", std::to_string(grace).c_str(), 1);
    if (::geteuid() == 0) {
        ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
        ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    }
    return {"-n", std::to_string(ranks)};
}

/// A job that runs.
class job : public support::child_program {
public:
    job(std::size_t ranks, words const& arguments, fs::path const& folder, int grace = 1)
        : child_program(MPIRUN_PROGRAM,
                        mpirun(ranks, grace) + words{HOVERCRAFT_PROGRAM} + arguments, folder) {}
};

inline support::finished_program run_job(std::size_t ranks, words const& arguments) {
    io_support::temporary_folder const folder;
    job const j(ranks, arguments, folder.path());
    int const code = j.wait_at_most(120);
    return {code, j.out(), j.err()};
}
inline support::finished_program run_alone(words const& arguments) {
    return support::run_program(HOVERCRAFT_PROGRAM, arguments);
}

/// The processes of the program that work for this folder, by their ranks.
inline std::vector<::pid_t> processes_of(fs::path const& out, std::size_t ranks) {
    std::vector<::pid_t> found(ranks, 0);
    for (auto const& entry : fs::directory_iterator{"/proc"}) {
        auto const name = entry.path().filename().string();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        auto const command = support::text_of(entry.path() / "cmdline");
        if (command.rfind(HOVERCRAFT_PROGRAM, 0) != 0) continue;
        if (command.find(out.string() + '\0') == std::string::npos) continue;
        std::string const key = "OMPI_COMM_WORLD_RANK=";
        auto const environment = '\0' + support::text_of(entry.path() / "environ");
        auto const at = environment.find('\0' + key);
        if (at == std::string::npos) continue;
        auto const rank = std::stoul(environment.substr(at + 1 + key.size()));
        if (rank < ranks) found[rank] = static_cast<::pid_t>(std::stol(name));
    }
    return found;
}

/// All that a result says but for how long it took and what it was called.
struct outcome {
    nlohmann::json result;
    std::string boxes, outputs;

    explicit outcome(fs::path const& out)
        : boxes(support::text_of(out / "boxes.csv")),
          outputs(support::text_of(out / "outputs.csv")) {
        std::ifstream in{out / "result.json"};
        result = nlohmann::json::parse(in);
        result.erase("seconds");
        for (auto const* time : {"seconds", "most_seconds"}) result["search"].erase(time);
        for (auto& tried : result["journal"]) tried.erase("seconds");
        result.erase("source");
    }
    bool operator==(outcome const& other) const {
        return result == other.result && boxes == other.boxes && outputs == other.outputs;
    }
};

} // namespace ranks_test

#endif
