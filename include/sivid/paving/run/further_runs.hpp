// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_FURTHER_RUNS_HPP
#define SIVID_PAVING_RUN_FURTHER_RUNS_HPP

#include <sivid/compiled.hpp>
#include <sivid/paving/run/experiment_run.hpp>

#include <cstddef>
#include <memory>

namespace sivid {

/// An experiment by Taylor models in scalars, one box at a time: for checks that shall share no
/// packs of numbers with the search.
/// @param initial, prior  what the boxes to come lie in
/// @guarantee, @cost  as of `make_run`, about eight times as long for eight boxes
[[nodiscard]] SIVID_DECL std::unique_ptr<experiment_run>
make_scalar_run(flow const& f, experiment const& e, record const& samples, box const& initial,
                box const& prior, run_options options);

namespace paving_detail {

/// For `make_run`, with the options that it has made of its own.
[[nodiscard]] SIVID_DECL std::unique_ptr<experiment_run>
run_single(flow const& f, experiment const& e, record const& samples, run_options const& options,
           std::size_t unknowns, std::size_t degree);
[[nodiscard]] SIVID_DECL std::unique_ptr<experiment_run>
run_first_order(flow const& f, experiment const& e, record const& samples,
                run_options const& options);

} // namespace paving_detail

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/run/impl/further_runs.ipp>
#endif

#endif
