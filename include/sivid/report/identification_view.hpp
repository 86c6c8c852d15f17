// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IDENTIFICATION_VIEW_HPP
#define SIVID_REPORT_IDENTIFICATION_VIEW_HPP

#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/paving/strategy/contractor.hpp>
#include <sivid/report/draw/paving_plot.hpp>
#include <sivid/report/draw/time_plot.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/page.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// What the page of an identification shows: strings, numbers and plain vectors only, so that any
/// result can be described. Whoever fills it answers for the proofs; ranges named hull, volume or
/// enclosure are taken as proven and printed outward.
namespace sivid::report {

struct parameter_view {
    std::string name{};
    std::string unit{};
    range prior{};
    range hull{}; ///< contains every feasible value; empty when there is none
    std::string meaning{};
    /// At least this share of the prior's range lies between the ends of the hull, and is excluded.
    double excluded_between = 0;
};

/// A function of the parameters that the data fix.
struct combination_view {
    std::string formula{};
    std::string unit{};
    range hull{};
    range prior{};      ///< its range over the prior, when known
    std::string note{}; ///< e.g. what the data cannot tell apart
};

struct scenario_view {
    std::string name{};
    std::size_t measurements = 0;
    std::size_t outlier_budget = 0;
    std::vector<channel_series> channels{};
    std::optional<plane_series> plane{};
};

struct statistics_view {
    double seconds = 0;
    std::uint64_t boxes = 0;
    std::uint64_t integrations = 0;
    std::string stop_reason{};
    std::vector<std::string> why{}; ///< why little is excluded, and what to change
};

/// One way to solve the same problem, for comparison.
struct comparison_row {
    std::string name{};
    std::optional<double> seconds{};
    std::optional<std::uint64_t> boxes{};
    std::optional<std::uint64_t> integrations{};
    range inner_volume{}; ///< share of the prior; empty: not known
    range outer_volume{};
    std::string note{};
    bool chosen = false; ///< the row of this page's result
};

struct identification_view {
    std::string dataset{};
    std::string model{};
    std::string time_unit = "s";          ///< the model's
    outcome verdict = outcome::undecided; ///< proved: consistent, refuted: inconsistent
    std::string sentence{};               ///< one sentence for the banner; empty: a standard one
    std::vector<parameter_view> parameters{};
    std::vector<combination_view> combinations{};
    range volume_inner{}; ///< share of the prior, as proven intervals; empty: not known
    range volume_outer{};
    double excluded = 0; ///< at least this share of the prior's volume is excluded
    /// The largest box that is proved to explain the data, in words: "S_v in [0.2, 0.3] m^2, ...".
    std::string inside_box{};
    std::optional<named_witness> witness{};
    std::vector<std::string> proved{}; ///< further statements in plain words
    /// What such data can tell about the unknowns at all, in sentences, and where.
    std::vector<std::string> identifiability{};
    std::string identifiability_at{};
    std::vector<std::string> assumptions{};
    std::vector<std::string> warnings{};
    statistics_view statistics{};
    contraction_journal tried{}; ///< before the search
    std::vector<scenario_view> scenarios{};
    std::string tube_meaning{};      ///< what the drawn enclosures enclose
    std::string reference_meaning{}; ///< what the reference line is
    std::vector<paving_projection> pavings{};
    /// Of the paving in products of the parameters, when the search ran there.
    std::vector<paving_projection> product_pavings{};
    std::vector<comparison_row> comparison{};
    std::string comparison_note{};
    std::vector<std::string> footer{}; ///< version, date, machine, command
};

} // namespace sivid::report

#endif
