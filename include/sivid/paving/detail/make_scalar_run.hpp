// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_DETAIL_MAKE_SCALAR_RUN_HPP
#define SIVID_PAVING_DETAIL_MAKE_SCALAR_RUN_HPP

#include <sivid/compiled.hpp>
#include <sivid/paving/detail/doubleton_run.hpp>
#include <sivid/paving/detail/taylor_run.hpp>
#include <sivid/paving/scalar_run.hpp>

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

SIVID_ENTRY std::unique_ptr<experiment_run> make_scalar_run(flow const& f, experiment const& e,
                                                            record const& samples,
                                                            box const& initial, box const& prior,
                                                            run_options options) {
    using namespace paving_detail;
    options.enclosure.minimum_step = minimum_step_for(e, options.enclosure.minimum_step);
    if (f.uncertain()) options.hopeless = 1e300;
    auto const unknowns = unknown_count(initial, prior);
#define SIVID_KERNEL(N, D)                                                                         \
    if (unknowns <= N) return make_scalar_taylor_run<N, D>(f, e, samples, options);
    SIVID_SCALAR_KERNELS(SIVID_KERNEL)
#undef SIVID_KERNEL
    return std::make_unique<doubleton_run>(f, e, samples, options);
}

} // namespace sivid

#endif
