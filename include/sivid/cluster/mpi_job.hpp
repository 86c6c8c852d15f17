// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_MPI_JOB_HPP
#define SIVID_CLUSTER_MPI_JOB_HPP

#include <sivid/cluster/job.hpp>
#include <sivid/compiled.hpp>

#include <memory>

namespace sivid::cluster {

/// The job that mpirun has started this process in; nothing where it was started alone.
/// @throws boost::mpi::exception  when MPI cannot be had
[[nodiscard]] SIVID_DECL std::unique_ptr<job> mpi_job(int& argc, char**& argv);

} // namespace sivid::cluster

#ifndef SIVID_COMPILED
#include <sivid/cluster/impl/mpi_job.ipp>
#endif

#endif
