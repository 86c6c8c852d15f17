// SPDX-License-Identifier: MIT
// MPI itself is tried by tests/ranks, with programs that mpirun starts.
#include <sivid/cluster/mpi_world.hpp>

#include "support/catch.hpp"

#include <cstdlib>

TEST_CASE("a program that nobody started as one of several ranks needs no MPI") {
    for (auto const* const name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_SIZE"})
        ::unsetenv(name);
    CHECK_FALSE(sivid::cluster::mpi_world::started());
    ::setenv("PMIX_RANK", "1", 1);
    CHECK(sivid::cluster::mpi_world::started());
    ::unsetenv("PMIX_RANK");
}
