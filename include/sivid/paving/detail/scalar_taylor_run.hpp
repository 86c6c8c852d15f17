// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_DETAIL_SCALAR_TAYLOR_RUN_HPP
#define SIVID_PAVING_DETAIL_SCALAR_TAYLOR_RUN_HPP

#include <sivid/paving/detail/taylor_run.hpp>

#include <cstddef>
#include <memory>

namespace sivid {

namespace paving_detail {

/// Fewer kernels than the search has: what runs one by one may carry monomials that it does not
/// use.
#define SIVID_SCALAR_KERNELS(X) X(3, 4) X(6, 2) X(12, 2)

/// Not inline, as `make_taylor_run`.
template <std::size_t N, std::size_t D>
std::unique_ptr<experiment_run> make_scalar_taylor_run(flow const& f, experiment const& e,
                                                       record const& samples,
                                                       run_options const& options) {
    return std::make_unique<taylor_run<N, D, double>>(f, e, samples, options);
}

#ifdef SIVID_COMPILED
#define SIVID_KERNEL(N, D)                                                                         \
    extern template std::unique_ptr<experiment_run> make_scalar_taylor_run<N, D>(                  \
        flow const&, experiment const&, record const&, run_options const&);
SIVID_SCALAR_KERNELS(SIVID_KERNEL)
#undef SIVID_KERNEL
#endif

} // namespace paving_detail

} // namespace sivid

#endif
