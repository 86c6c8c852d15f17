// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_DETAIL_SCALAR_RUN_HPP
#define SIVID_PAVING_RUN_DETAIL_SCALAR_RUN_HPP

#include <sivid/compiled.hpp>
#include <sivid/paving/run/detail/experiment_run_class.hpp>

#include <memory>

namespace sivid {

/// An experiment by Taylor models in scalars, one box at a time: for checks that shall share no
/// packs of numbers with the search.
/// @param initial, prior  what the boxes to come lie in
/// @guarantee, @cost  as of `make_run`, about eight times as long for eight boxes
[[nodiscard]] SIVID_DECL std::unique_ptr<experiment_run>
make_scalar_run(flow const& f, experiment const& e, record const& samples, box const& initial,
                box const& prior, run_options options);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/run/impl/scalar_run.ipp>
#endif

#endif
