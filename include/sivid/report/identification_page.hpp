// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IDENTIFICATION_PAGE_HPP
#define SIVID_REPORT_IDENTIFICATION_PAGE_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/identification_view.hpp>
#include <sivid/report/page.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace sivid::report {

/// The whole page of an identification. Sections without content are left out.
[[nodiscard]] SIVID_ENTRY page identification_page(identification_view const& v);

} // namespace sivid::report

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_IDENTIFICATION_PAGE)
#include <sivid/report/detail/identification_page_sections.hpp>
#endif

#endif
