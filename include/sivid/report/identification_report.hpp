// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IDENTIFICATION_REPORT_HPP
#define SIVID_REPORT_IDENTIFICATION_REPORT_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/explaining_motion.hpp>
#include <sivid/io/identification_json.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identifiability.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/run/run_reach.hpp>
#include <sivid/report/identification_view.hpp>
#include <sivid/report/number_text.hpp>

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sivid::report {

/// Which channels are a position in the plane; `heading` may be empty.
struct plane_channels {
    std::string x = "x";
    std::string y = "y";
    std::string heading{};
};

// What data can tell about their unknowns, in sentences that keep what is proved apart from what
// is computed in floating point.

/// One sentence a line: the ranks, what is free, what acts through which combinations, and the
/// directions that the data notice least.
[[nodiscard]] SIVID_DECL std::vector<std::string>
identifiability_words(identifiability const& found);

/// Why runs over all that is left tell little, and what to change: a sentence for each of the first
/// experiments that say something, from what they measured.
/// @param ended_by_itself  the search did: more time would find the same
[[nodiscard]] SIVID_DECL std::vector<std::string> reach_words(std::vector<run_reach> const& reach,
                                                              bool ended_by_itself = false);

/// Why an identification excluded little: first that what was proved inside stays, then what its
/// runs tell. Empty where much was excluded.
[[nodiscard]] SIVID_DECL std::vector<std::string> reach_words(identification_problem const& problem,
                                                              identification const& found);

struct identification_report_options {
    std::string dataset{};
    std::map<std::string, std::string> meanings{}; ///< of parameters, by name
    std::vector<std::string> further_assumptions{};
    std::optional<plane_channels> plane{};
    std::string date{}, machine{}, command{};
    /// False leaves out what is still to be simulated or evaluated for the pictures; may be empty.
    std::function<bool()> keep_going{};
};

/// What the page of an identification shows; `identification_page` makes the page.
/// @param motion  the tubes to draw, or null
/// @guarantee  every range that the page calls proved is the identification's own, or a tube's
[[nodiscard]] SIVID_DECL identification_view view_of(identification_problem const& problem,
                                                     identification const& found,
                                                     explaining_motion const* motion,
                                                     identification_report_options const& options);

/// A row for the table that compares ways to solve one problem.
[[nodiscard]] SIVID_DECL comparison_row comparison_of(std::string name, identification const& found,
                                                      bool chosen, std::string note = {});

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/identification_report.ipp>
#endif

#endif
