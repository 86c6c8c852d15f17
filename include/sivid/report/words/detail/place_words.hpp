// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_WORDS_DETAIL_PLACE_WORDS_HPP
#define SIVID_REPORT_WORDS_DETAIL_PLACE_WORDS_HPP

#include <sivid/compiled.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/report/diagnosis_view.hpp>
#include <sivid/report/draw/candidate_chart.hpp>
#include <sivid/report/identification_words.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Places, relations and data that stand alone in the words of a diagnosis's page. What is proved
/// is called so; all else is called an estimate.
namespace sivid::report {

// A sign stays with its word where lines end.
inline constexpr std::string_view proved_mark = "\xE2\x9C\x93\xC2\xA0proved";
inline constexpr std::string_view estimate_mark = "\xE2\x89\x88\xC2\xA0"
                                                  "estimate";

[[nodiscard]] SIVID_DECL std::string capitalised(std::string text);

/// "S4, 1.2 to 2 s", with the model's unit of time
[[nodiscard]] SIVID_DECL std::string window_text(time_window const& w,
                                                 std::string const& time_unit);

/// "yaw equation", "sensor r", "input delta"
[[nodiscard]] SIVID_DECL std::string place_name(suspected_place const& p);

/// "-0.42 to -0.18 rad/s^2, proved"
[[nodiscard]] SIVID_DECL std::string missing_text(suspected_place const& p);

/// The formula of a law for a reader.
[[nodiscard]] SIVID_DECL std::string law_text(std::string const& law);

/// Where and how: "the yaw equation in S4, 1.2 to 2 s, lacks -0.42 to -0.18 rad/s^2 (proved)".
[[nodiscard]] SIVID_DECL std::string place_clause(suspected_place const& p,
                                                  std::string const& time_unit);

/// One broken relation in plain words.
[[nodiscard]] SIVID_DECL std::string relation_words(broken_relation_report const& r,
                                                    std::string const& time_unit);

/// "v in S3": the measurements of a part.
[[nodiscard]] SIVID_DECL std::string part_words(confined_gap const& c);

/// "one parameter explains all data but those of v, whose bounds must grow by a factor of 1.61 to
/// 1.66 (proved)"
[[nodiscard]] SIVID_DECL std::string confined_clause(confined_gap const& c);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/words/impl/place_words.ipp>
#endif

#endif
