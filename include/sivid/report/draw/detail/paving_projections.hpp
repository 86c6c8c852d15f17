// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_DETAIL_PAVING_PROJECTIONS_HPP
#define SIVID_REPORT_DRAW_DETAIL_PAVING_PROJECTIONS_HPP

#include <sivid/compiled.hpp>
#include <sivid/paving/subpaving.hpp>
#include <sivid/report/draw/paving_plot.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid::report {

/// A paving with what its sides are called.
struct named_paving {
    subpaving const* paving = nullptr;
    std::vector<axis> sides{};     ///< bounds: the prior
    std::vector<range> hull{};     ///< per side: what the data leave of it
    std::vector<double> witness{}; ///< a verified point; may be empty
};

/// The projection of a paving on its sides a and b.
[[nodiscard]] SIVID_DECL paving_projection projection(named_paving const& p, std::size_t a,
                                                      std::size_t b);

/// The projections worth a picture: on all pairs of sides when these are few, else of the four that
/// the data narrow most.
/// @param first  sides whose pairs come first
/// @param most   so many projections
[[nodiscard]] SIVID_DECL std::vector<paving_projection>
projections(named_paving const& p, std::vector<std::size_t> const& first, std::size_t most);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/draw/impl/paving_projections.ipp>
#endif

#endif
