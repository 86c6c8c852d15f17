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
[[nodiscard]] SIVID_DECL std::unique_ptr<experiment_run>
make_run(flow const& f, experiment const& e, record const& samples, box const& initial,
         box const& prior, run_options options);
[[nodiscard]] inline std::unique_ptr<experiment_run> make_run(flow const& f, experiment const& e,
                                                              record const& samples,
                                                              box const& prior,
                                                              run_options const& options) {
    return make_run(f, e, samples, e.initial, prior, options);
}

/// An experiment by Taylor models in scalars, one box at a time: for checks that shall share no
/// packs of numbers with the search.
/// @param initial, prior  what the boxes to come lie in
/// @guarantee, @cost  as of `make_run`, about eight times as long for eight boxes
[[nodiscard]] SIVID_DECL std::unique_ptr<experiment_run>
make_scalar_run(flow const& f, experiment const& e, record const& samples, box const& initial,
                box const& prior, run_options options);

/// Families of polynomials of the degree that `make_run` chooses for the same experiment, so that
/// what both say of one region has the same monomials.
/// @param prior  contains all boxes of parameters that will be begun with
/// @given  the flow outlives the result
[[nodiscard]] SIVID_DECL std::unique_ptr<continued_run>
make_continued_run(flow const& f, experiment const& e, box const& prior,
                   run_options const& options);

/// Parts of one record side by side, each from its own begin and box of starts, over one box of
/// parameters: by Taylor models in lanes.
/// @param f  under the inputs of the record, whatever the parts say
/// @param options  its smallest step is taken as it is: the caller knows the inputs
/// @returns  for each part what `experiment_run` returns
/// @cost  one integration in lanes for eight parts; a single part in scalars
[[nodiscard]] SIVID_DECL std::vector<std::shared_ptr<response const>>
run_parts(flow const& f, std::vector<experiment> const& parts, box const& parameters,
          run_options options);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/run/impl/experiment_run.ipp>
#endif

#endif
