// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IDENTIFICATION_WORDS_HPP
#define SIVID_REPORT_IDENTIFICATION_WORDS_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/identification_view.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// The sentences of an identification's page. They say no more than the view's proven ranges do.
namespace sivid::report {

/// "Sv = 0.22 m^2, L = 0.3 m"
/// The values are exact: a witness can be checked again from the text.
[[nodiscard]] SIVID_DECL std::string values_text(std::vector<named_estimate> const& all);

/// A share of the prior rounded up, in percent.
[[nodiscard]] SIVID_DECL std::string at_most_percent(double share);
[[nodiscard]] SIVID_DECL std::string at_least_percent(double share);

/// A volume relative to the prior as an interval in percent, outward.
[[nodiscard]] SIVID_DECL std::string percent_interval(range const& share);

/// What is left of the prior's range, between the ends of the hull, too, as a share of its width;
/// rounded up; NaN when there is no such number.
[[nodiscard]] SIVID_DECL double share_of_prior(parameter_view const& p);

/// How much of a parameter's prior is excluded where its hull does not show it: between its ends,
/// or only together with other parameters. Empty where the hull shows it, "nothing excluded" only
/// where nothing is.
[[nodiscard]] SIVID_DECL std::string exclusion_note(identification_view const& v,
                                                    parameter_view const& p);

/// True when the proof left (nearly) all of the parameter's prior.
[[nodiscard]] SIVID_DECL bool is_unresolved(parameter_view const& p);

/// Formula text for a reader: a raised dot for '*', at which lines do not break.
[[nodiscard]] SIVID_DECL std::string formula_text(std::string const& formula);

[[nodiscard]] SIVID_DECL std::string headline(identification_view const& v);

[[nodiscard]] SIVID_DECL std::string verdict_sentence(identification_view const& v);

/// How many outliers the data need; both numbers are proved.
[[nodiscard]] SIVID_DECL std::string fewest_outliers_sentence(std::uint64_t least,
                                                              std::uint64_t most);

/// What was proved, sentence by sentence.
[[nodiscard]] SIVID_DECL std::vector<std::string> plain_statements(identification_view const& v);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/identification_words.ipp>
#endif

#endif
