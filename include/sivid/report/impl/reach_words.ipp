// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_REACH_WORDS_IPP
#define SIVID_REPORT_IMPL_REACH_WORDS_IPP

#include <sivid/report/detail/reach_words.hpp>

#include <sivid/compiled.hpp>
#include <sivid/paving/verdict.hpp>
#include <sivid/report/identification_words.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid::report {

namespace detail {

inline std::string brief(double x, rounding way = rounding::nearest) {
    return rounded_text(x, way, {.significant = 2});
}

inline std::string name_of(run_reach::cause const& c) {
    return c.start ? "the start of " + c.name : formula_text(c.name);
}

/// A time that was enclosed, rounded down; what was meant is the decimal close to it.
inline std::string at_least_brief(double time) { return brief(time * (1 + 1e-12), rounding::down); }

/// "62 % of it by D33/Iz, 20 % by the start of r"
inline std::string causes_text(run_reach const& r) {
    std::string all;
    for (std::size_t k = 0; k < std::min<std::size_t>(r.causes.size(), 3); ++k) {
        auto const& c = r.causes[k];
        all += (k == 0 ? "" : ", ") + brief(100 * c.share) + (k == 0 ? " % of it by " : " % by ") +
               name_of(c);
    }
    return all;
}

/// Where trajectories end, and why.
inline std::string end_text(run_reach const& r) {
    auto const carried = r.until - r.begin;
    auto words = carried > 0 ? "over all that is left, trajectories are enclosed for " +
                                   at_least_brief(carried) + " of " + brief(r.end - r.begin) + " " +
                                   r.time_unit + " only; there "
                             : std::string{"over all that is left, trajectories are enclosed "
                                           "nowhere; at the start "};
    words += r.state + " is " + brief(r.width) + unit_suffix(r.unit) + " wide";
    return words + (r.causes.empty() ? "" : " (" + causes_text(r) + ")");
}

inline std::string what_ends(run_reach const& r) {
    auto const carried = r.until - r.begin;
    auto words = end_text(r) + ". Scenarios shorter than " +
                 brief(carried > 0 ? carried : r.end - r.begin) + " " + r.time_unit;
    if (!r.causes.empty()) words += ", or a narrower range for " + name_of(r.causes.front()) + ",";
    return words + " may tell more";
}

/// What is left moves measurements less than their bounds are wide.
inline std::string what_hardly_moves(run_reach const& r) {
    auto words =
        "parameters and starts that are left move no measurement" +
        (r.instants < r.measured
             ? " (of " + count_text(r.instants) + " instants among " + count_text(r.measured) + ")"
             : std::string{}) +
        (r.complete() ? ""
                      : " of the first " + at_least_brief(r.until - r.begin) + " " + r.time_unit) +
        " by more than " + rounded_text(r.spread * (1 + 1e-9), rounding::up, {.significant = 2}) +
        " of its error bound: such data hardly tell them apart; smaller bounds, or "
        "motions that depend more on them, would";
    return words + (r.complete() ? "" : ". Beyond that, " + end_text(r));
}

/// Empty where nothing but the boxes' size is in the way.
inline std::string why_of(run_reach const& r, bool ended_by_itself) {
    if (!r.complete() && r.interrupted)
        return "no time was left to see how far trajectories are enclosed: a larger budget may "
               "tell";
    if (r.until > r.begin && r.spread < 1) return what_hardly_moves(r);
    if (!r.complete()) return what_ends(r);
    if (!(r.lost < 1))
        return "trajectories over all that is left blur by " +
               (std::isfinite(r.lost) ? brief(r.lost) : std::string{"any number of"}) +
               " error bounds: more time, or shorter scenarios, may tell more";
    if (ended_by_itself) return {};
    return "trajectories over all that is left are enclosed to the end, and parameters and starts "
           "move measurements by up to " +
           brief(r.moved) + " error bounds: a larger budget may tell more";
}

/// What the equations divide by, and that it is, or may be, zero.
inline std::string divisor_text(divisor const& d) {
    std::string words = d.equations.size() == 1 ? "The equation of " : "The equations of ";
    for (std::size_t k = 0; k < d.equations.size(); ++k) {
        words += (k == 0 ? "" : k + 1 == d.equations.size() ? " and " : ", ") + d.equations[k];
    }
    words += d.equations.size() == 1 ? " divides by " : " divide by ";
    words += d.formula.empty() ? "a long expression" : d.formula;
    words += d.zeros == zeros::some ? ", which is zero somewhere" : ", which may be zero";
    words += " within the prior and the limits of the states";
    for (std::size_t k = 0; k < d.near.size(); ++k) {
        words += (k == 0 ? " (near " : ", ") + d.near[k].first + " = " + brief(d.near[k].second);
    }
    if (!d.near.empty()) words += ")";
    return words +
           ": no trajectory is enclosed there. A prior, or limits, without it may tell more";
}

/// What no method could exclude; empty where that is not much.
inline std::string proved_inside_text(identification const& found) {
    double const inside = found.paving.inner_volume().lower();
    if (!(inside >= 0.05)) return {};
    return "At least " + at_least_percent(std::min(inside, 1.0)) +
           " of the prior's volume is proved to explain the data: nothing of it can be excluded "
           "by them. Smaller error bounds, further measurements, or motions that depend more on "
           "the parameters would";
}

} // namespace detail

SIVID_DECL std::vector<std::string> reach_words(std::vector<run_reach> const& reach,
                                                bool ended_by_itself) {
    constexpr std::size_t most = 6;
    std::vector<std::string> result;
    for (auto const& r : reach) {
        if (&r - reach.data() == most && reach.size() > most) {
            result.push_back(count_text(reach.size() - most) +
                             " further scenarios: see \xE2\x80\x9Creach\xE2\x80\x9D in the "
                             "result file");
            break;
        }
        auto const words = detail::why_of(r, ended_by_itself);
        if (!words.empty()) result.push_back(r.scenario + ": " + words);
    }
    return result;
}

SIVID_DECL std::vector<std::string> reach_words(identification_problem const& problem,
                                                identification const& found) {
    std::vector<std::string> result;
    if (!found.excludes_little()) return result;
    if (auto words = detail::proved_inside_text(found); !words.empty())
        result.push_back(std::move(words));
    if (found.reach.empty() && found.reason == stop_reason::time_budget &&
        !problem.model.has_memory())
        result.push_back("No time was left to see why: a larger budget may tell");
    for (auto const& d : found.divisors) result.push_back(detail::divisor_text(d));
    for (auto& words : reach_words(found.reach, is_complete(found.reason)))
        result.push_back(std::move(words));
    return result;
}

} // namespace sivid::report

#endif
