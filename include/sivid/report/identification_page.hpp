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
[[nodiscard]] SIVID_DECL page identification_page(identification_view const& v);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/identification_page.ipp>
#endif

#endif
