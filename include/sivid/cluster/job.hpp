// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_JOB_HPP
#define SIVID_CLUSTER_JOB_HPP

#include <sivid/cluster/transport.hpp>
#include <sivid/cluster/worker_pool.hpp>
#include <sivid/diagnosis/diagnose.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identify.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sivid::cluster {

/// The ranks of one program, as the program sees them, whatever carries their messages.
class job {
public:
    job() = default;
    job(job const&) = delete;
    job& operator=(job const&) = delete;
    virtual ~job() = default;

    [[nodiscard]] virtual std::size_t rank() const = 0;
    [[nodiscard]] virtual std::size_t size() const = 0;
    /// For rank 0 all others, for these rank 0.
    [[nodiscard]] virtual transport& others() = 0;
    /// Ends all ranks.
    [[noreturn]] virtual void end_all(int code) = 0;

    /// `cluster::identify`, by all ranks for the same problem, options and `also`; nothing on those
    /// that help.
    [[nodiscard]] virtual std::optional<identification>
    identify(identification_problem const& problem, identify_options const& options,
             std::string const& also, traffic& spent) = 0;
    /// `cluster::diagnose`, likewise.
    [[nodiscard]] virtual std::optional<diagnosis_run>
    diagnose(identification_problem const& problem, std::vector<effect> const& catalogue,
             diagnosis_options const& options, std::string const& also) = 0;
};

/// Joins the job in which this process was started; nothing where it was started alone.
using job_start = std::unique_ptr<job> (*)(int& argc, char**& argv);

} // namespace sivid::cluster

#endif
