// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_JOB_START_HPP
#define SIVID_CLUSTER_JOB_START_HPP

#include <memory>

namespace sivid::cluster {

class job; // <sivid/cluster/job.hpp>

/// Joins the job in which this process was started; nothing where it was started alone.
using job_start = std::unique_ptr<job> (*)(int& argc, char**& argv);

} // namespace sivid::cluster

#endif
