// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_DETAIL_IDENTIFICATION_PARAMETERS_HPP
#define SIVID_REPORT_PAGE_DETAIL_IDENTIFICATION_PARAMETERS_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/draw/detail/interval_chart.hpp>
#include <sivid/report/identification_view.hpp>
#include <sivid/report/identification_words.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

/// The part of an identification's page about the parameters: hulls, combinations, pavings, the
/// witness.
namespace sivid::report::detail {

SIVID_DECL void add_parameters(page& out, identification_view const& v);

/// The projections, each with a closer look where one is worth it.
[[nodiscard]] SIVID_DECL figure paving_figure(std::vector<paving_projection> const& pavings,
                                              std::string title, std::string caption,
                                              paving_words const& words = {});

SIVID_DECL void add_pavings(page& out, identification_view const& v);

/// "The witness": its parameters and starts, exactly.
SIVID_DECL void add_witness(page& out, named_witness const& w);

} // namespace sivid::report::detail

#ifndef SIVID_COMPILED
#include <sivid/report/page/impl/identification_parameters.ipp>
#endif

#endif
