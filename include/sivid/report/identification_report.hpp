// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IDENTIFICATION_REPORT_HPP
#define SIVID_REPORT_IDENTIFICATION_REPORT_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/explaining_motion.hpp>
#include <sivid/io/identification_json.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/report/detail/plane_channels.hpp>
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
    std::size_t most_pavings = 6; ///< projections on pairs of parameters
    /// False leaves out what is still to be simulated or evaluated for the pictures; may be empty.
    std::function<bool()> keep_going{};
};

namespace detail {

/// A share of the prior, widened a little where its bounds agree to many digits, so that it reads
/// well; still an enclosure.
SIVID_ENTRY range shown_share(interval const& volume);

SIVID_ENTRY std::string joined(std::vector<std::string> const& all);

} // namespace detail

/// What the page of an identification shows; `identification_page` makes the page.
/// @param motion  the tubes to draw, or null
/// @guarantee  every range that the page calls proved is the identification's own, or a tube's
[[nodiscard]] SIVID_ENTRY identification_view view_of(identification_problem const& problem,
                                                      identification const& found,
                                                      explaining_motion const* motion,
                                                      identification_report_options const& options);

/// A row for the table that compares ways to solve one problem.
[[nodiscard]] SIVID_ENTRY comparison_row comparison_of(std::string name,
                                                       identification const& found, bool chosen,
                                                       std::string note = {});

} // namespace sivid::report

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_VIEW_OF_IDENTIFICATION)
namespace sivid::report {

namespace detail {

SIVID_ENTRY range shown_share(interval const& volume) {
    range const r = shown(share_of_whole(volume));
    double const more = 5e-4 * r.hi;
    return r.lo == r.hi || r.hi - r.lo > more
               ? r
               : range{std::max(0.0, r.lo - more), std::min(1.0, r.hi + more)};
}

SIVID_ENTRY std::string joined(std::vector<std::string> const& all) {
    std::string text;
    for (std::size_t i = 0; i < all.size(); ++i) {
        text += (i == 0 ? "" : i + 1 == all.size() ? " and " : ", ") + all[i];
    }
    return text;
}

} // namespace detail

SIVID_ENTRY comparison_row comparison_of(std::string name, identification const& found, bool chosen,
                                         std::string note) {
    return {std::move(name),
            found.seconds,
            found.boxes,
            found.integrations,
            detail::shown_share(found.paving.inner_volume()),
            detail::shown_share(found.paving.outer_volume()),
            std::move(note),
            chosen};
}

} // namespace sivid::report

#include <sivid/report/detail/report_filler.hpp>
#endif

#endif
