// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IDENTIFICATION_REPORT_HPP
#define SIVID_REPORT_IDENTIFICATION_REPORT_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/explaining_motion.hpp>
#include <sivid/io/identification_json.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/report/fill/plane_channels.hpp>
#include <sivid/report/identification_view.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid::report {

struct identification_report_options {
    std::string dataset{};
    std::map<std::string, std::string> meanings{}; ///< of parameters, by name
    std::vector<std::string> further_assumptions{};
    std::optional<plane_channels> plane{};
    std::string date{}, machine{}, command{};
    /// False leaves out what is still to be simulated or evaluated for the pictures; may be empty.
    std::function<bool()> keep_going{};
};

namespace detail {

/// A share of the prior, widened a little where its bounds agree to many digits, so that it reads
/// well; still an enclosure.
SIVID_DECL range shown_share(interval const& volume);

} // namespace detail

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
