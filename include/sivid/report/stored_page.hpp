// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_STORED_PAGE_HPP
#define SIVID_REPORT_STORED_PAGE_HPP

#include <sivid/compiled.hpp>
#include <sivid/paving/subpaving.hpp>
#include <sivid/report/decision_page.hpp>
#include <sivid/report/diagnosis_view.hpp>
#include <sivid/report/draw/time_plot.hpp>
#include <sivid/report/identification_view.hpp>
#include <sivid/report/page.hpp>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sivid::report {

/// The pages of identification_page.hpp and diagnosis_page.hpp, with their data.
[[nodiscard]] SIVID_DECL stored_page stored(identification_view const& v);
[[nodiscard]] SIVID_DECL stored_page stored(diagnosis_view const& v);

/// A region with a stated probability.
/// @param probability  in words; @param reason  why the search ended
/// @param sides  the unknowns with their priors, of the paving
[[nodiscard]] SIVID_DECL stored_page
confidence_page(std::string const& title, std::string const& probability, std::string const& reason,
                bool const& complete, std::vector<axis> const& sides, subpaving const& paving,
                std::vector<std::string> const& assumptions,
                std::vector<std::string> const& remarks, std::vector<std::string> const& footer);

/// Sizes of equations (x) and of channels (y): lower and upper ends of points of the trade-off.
using size_curve = std::pair<std::vector<point>, std::vector<point>>;

/// A least disturbance.
/// @param words    what was found, a sentence each, the bounds first; @param found  a witness was
/// @param witness  what it is disturbed by, in each scenario; at most a dozen are drawn
[[nodiscard]] SIVID_DECL stored_page disturbance_page(
    std::string const& title, std::vector<std::string> const& words, bool const& found,
    std::vector<std::pair<std::string, channel_series>> const& witness, size_curve const& curve,
    std::vector<std::string> const& assumptions, std::vector<std::string> const& footer);

/// Makes a page of its data anew. It says what the data say: nothing is proved.
/// @throws input_error  where the file is not there, or its data are none of a page
[[nodiscard]] SIVID_DECL stored_page read_page(std::filesystem::path const& file);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/stored_page.ipp>
#endif

#endif
