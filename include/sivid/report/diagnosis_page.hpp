// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DIAGNOSIS_PAGE_HPP
#define SIVID_REPORT_DIAGNOSIS_PAGE_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/diagnosis_view.hpp>
#include <sivid/report/page.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid::report {

/// The whole page of a diagnosis. Sections without content are left out.
/// @throws nothing of its own
/// @guarantee  it proves nothing and reads no data: numbers are those of the view, bounds rounded
///   outward
/// @cost  text and pictures of the size of the view: milliseconds
[[nodiscard]] SIVID_DECL page diagnosis_page(diagnosis_view const& v);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/diagnosis_page.ipp>
#endif

#endif
