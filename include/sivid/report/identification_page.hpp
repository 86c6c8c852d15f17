// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IDENTIFICATION_PAGE_HPP
#define SIVID_REPORT_IDENTIFICATION_PAGE_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/draw/paving_plot.hpp>
#include <sivid/report/identification_view.hpp>
#include <sivid/report/page.hpp>

#include <string>
#include <vector>

namespace sivid::report {

namespace detail {

/// The projections, each with a closer look where one is worth it.
[[nodiscard]] SIVID_DECL figure paving_figure(std::vector<paving_projection> const& pavings,
                                              std::string title, std::string caption,
                                              paving_words const& words = {});

/// "The witness": its parameters and starts, exactly.
SIVID_DECL void add_witness(page& out, named_witness const& w);

} // namespace detail

/// The whole page of an identification. Sections without content are left out.
[[nodiscard]] SIVID_DECL page identification_page(identification_view const& v);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/identification_page.ipp>
#endif

#endif
