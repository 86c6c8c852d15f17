// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_IMPL_MPI_JOB_IPP
#define SIVID_CLUSTER_IMPL_MPI_JOB_IPP

#include <sivid/cluster/mpi_job.hpp>

#include <sivid/cluster/mpi_world.hpp>

#include <memory>

namespace sivid::cluster {

SIVID_DECL std::unique_ptr<job> mpi_job(int& argc, char**& argv) {
    if (!mpi_world::started()) return nullptr;
    return std::make_unique<mpi_world>(argc, argv);
}

} // namespace sivid::cluster

#endif
