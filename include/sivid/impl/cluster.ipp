// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_CLUSTER_IPP
#define SIVID_IMPL_CLUSTER_IPP

#include <sivid/cluster/impl/mpi_job.ipp>

#endif
