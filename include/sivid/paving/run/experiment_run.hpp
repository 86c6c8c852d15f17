// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_EXPERIMENT_RUN_HPP
#define SIVID_PAVING_RUN_EXPERIMENT_RUN_HPP

#include <sivid/compiled.hpp>
#include <sivid/paving/run/detail/experiment_run_class.hpp>

#include <memory>
#include <vector>

namespace sivid {

/// By Taylor models of the degree that suits the number of unknowns (`suggested_degree`), or by
/// sets of first order, as the options say.
/// @param initial, prior  what the boxes to come lie in
/// @throws std::invalid_argument  for sets of first order in a program that lacks them
///         (`complete.hpp`), for Taylor models with a method of one's own
[[nodiscard]] SIVID_DECL std::unique_ptr<experiment_run>
make_run(flow const& f, experiment const& e, record const& samples, box const& initial,
         box const& prior, run_options options);
[[nodiscard]] inline std::unique_ptr<experiment_run> make_run(flow const& f, experiment const& e,
                                                              record const& samples,
                                                              box const& prior,
                                                              run_options const& options) {
    return make_run(f, e, samples, e.initial, prior, options);
}

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/run/impl/experiment_run.ipp>
#endif

#endif
