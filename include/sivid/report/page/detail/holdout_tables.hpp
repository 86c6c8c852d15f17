// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_DETAIL_HOLDOUT_TABLES_HPP
#define SIVID_REPORT_PAGE_DETAIL_HOLDOUT_TABLES_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/diagnosis_words.hpp>
#include <sivid/report/table.hpp>

#include <cmath>
#include <cstddef>
#include <string>

namespace sivid::report {

/// How well the hold-out data are met, before and after.
[[nodiscard]] SIVID_DECL table holdout_table(diagnosis_view const& v, holdout_figures const& h);

/// Candidates side by side on the hold-out data; only when there are several.
[[nodiscard]] SIVID_DECL table holdout_candidates_table(diagnosis_view const& v,
                                                        std::size_t most = 8);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/page/impl/holdout_tables.ipp>
#endif

#endif
