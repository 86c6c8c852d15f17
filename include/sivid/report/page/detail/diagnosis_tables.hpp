// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_DETAIL_DIAGNOSIS_TABLES_HPP
#define SIVID_REPORT_PAGE_DETAIL_DIAGNOSIS_TABLES_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/diagnosis_words.hpp>
#include <sivid/report/page.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// The key figures and tables of a diagnosis's page.
namespace sivid::report {

[[nodiscard]] SIVID_DECL std::vector<card> diagnosis_cards(diagnosis_view const& v);

/// The answer point by point, for the reader in a hurry.
[[nodiscard]] SIVID_DECL table summary_table(diagnosis_view const& v);

[[nodiscard]] SIVID_DECL table places_table(diagnosis_view const& v, std::size_t most = 20);

[[nodiscard]] SIVID_DECL table gap_shares_table(diagnosis_view const& v);

/// The text with spaces that do not break.
[[nodiscard]] SIVID_DECL std::string kept_together(std::string const& text);

/// Parameters of the foremost candidates.
[[nodiscard]] SIVID_DECL table causes_table(diagnosis_view const& v, std::size_t most = 12);

/// What marks the values of constants mean.
inline constexpr std::string_view value_note =
    "\xE2\x9C\x93: of the witness, one point that is verified to explain the data; "
    "\xE2\x89\x88: of the best fit, an estimate. The proved range contains every value that "
    "explains the data; not narrowed: it is the prior itself.";

/// A value with its mark.
/// @param verified  as for `estimate_words`
[[nodiscard]] SIVID_DECL std::string value_text(named_estimate const& e, bool verified);

/// Every constant of the model of the answer, its own and those of the effects.
[[nodiscard]] SIVID_DECL table constants_table(diagnosis_view const& v);

/// How well the hold-out data are met, before and after.
[[nodiscard]] SIVID_DECL table holdout_table(diagnosis_view const& v, holdout_figures const& h);

/// Candidates side by side on the hold-out data; only when there are several.
[[nodiscard]] SIVID_DECL table holdout_candidates_table(diagnosis_view const& v,
                                                        std::size_t most = 8);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/page/impl/diagnosis_tables.ipp>
#endif

#endif
