// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_CONTINUED_RUN_HPP
#define SIVID_PAVING_RUN_CONTINUED_RUN_HPP

#include <sivid/compiled.hpp>
#include <sivid/enclosure/flow.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/run/detail/continued_run_class.hpp>
#include <sivid/paving/run_options.hpp>
#include <sivid/space/box.hpp>

#include <memory>

namespace sivid {

/// Families of polynomials of the degree that `make_run` chooses for the same experiment, so that
/// what both say of one region has the same monomials.
/// @param prior  contains all boxes of parameters that will be begun with
/// @given  the flow outlives the result
[[nodiscard]] SIVID_DECL std::unique_ptr<continued_run>
make_continued_run(flow const& f, experiment const& e, box const& prior,
                   run_options const& options);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/run/impl/continued_run.ipp>
#endif

#endif
