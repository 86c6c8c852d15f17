// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_STORED_PAGE_HPP
#define SIVID_REPORT_STORED_PAGE_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/decision_page.hpp>
#include <sivid/report/diagnosis_view.hpp>
#include <sivid/report/identification_view.hpp>
#include <sivid/report/page.hpp>

#include <filesystem>

namespace sivid::report {

/// The pages of identification_page.hpp and diagnosis_page.hpp, with their data.
[[nodiscard]] SIVID_DECL stored_page stored(identification_view const& v);
[[nodiscard]] SIVID_DECL stored_page stored(diagnosis_view const& v);

/// Makes a page of its data anew. It says what the data say: nothing is proved.
/// @throws input_error  where the file is not there, or its data are none of a page
[[nodiscard]] SIVID_DECL stored_page read_page(std::filesystem::path const& file);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/stored_page.ipp>
#endif

#endif
