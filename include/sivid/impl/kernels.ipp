// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_KERNELS_IPP
#define SIVID_IMPL_KERNELS_IPP

/// @file
/// The integrators of `taylor_kernels.hpp` and `scalar_taylor_run.hpp`, and tubes of doubles.

#include <sivid/paving/continued_run.hpp>
#include <sivid/paving/experiment_run.hpp>

#include <sivid/enclosure/tube.hpp>
#include <sivid/paving/detail/scalar_taylor_run.hpp>
#include <sivid/paving/detail/taylor_continuation.hpp>
#include <sivid/paving/detail/taylor_run.hpp>

#include <memory>

namespace sivid {

template tube<interval> integrate(std::shared_ptr<flow const>, box const&, box const&, double,
                                  double, enclosure_options const&);

namespace paving_detail {

#define SIVID_KERNEL(N, D)                                                                         \
    template std::unique_ptr<experiment_run> make_taylor_run<N, D>(                                \
        flow const&, experiment const&, record const&, run_options const&);                        \
    template std::unique_ptr<continued_run> make_taylor_continuation<N, D>(                        \
        flow const&, double, enclosure_options const&);
SIVID_TAYLOR_KERNELS(SIVID_KERNEL)
#undef SIVID_KERNEL

#define SIVID_KERNEL(N, D)                                                                         \
    template std::unique_ptr<experiment_run> make_scalar_taylor_run<N, D>(                         \
        flow const&, experiment const&, record const&, run_options const&);
SIVID_SCALAR_KERNELS(SIVID_KERNEL)
#undef SIVID_KERNEL

} // namespace paving_detail

} // namespace sivid

#endif
