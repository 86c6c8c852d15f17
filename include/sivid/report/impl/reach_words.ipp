// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_REACH_WORDS_IPP
#define SIVID_REPORT_IMPL_REACH_WORDS_IPP

#include <sivid/report/reach_words.hpp>

#include <sivid/compiled.hpp>
#include <sivid/report/identification_words.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace sivid::report {

namespace detail {

inline std::string brief(double x) {
    return rounded_text(x, rounding::nearest, {.significant = 2});
}

inline std::string name_of(run_reach::cause const& c) {
    return c.start ? "the start of " + c.name : formula_text(c.name);
}

/// "D33/Iz (62 %), the start of r (20 %)"
inline std::string causes_text(run_reach const& r) {
    std::string all;
    for (std::size_t k = 0; k < std::min<std::size_t>(r.causes.size(), 3); ++k) {
        auto const& c = r.causes[k];
        all += (k == 0 ? "" : ", ") + name_of(c) + " (" + brief(100 * c.share) + " %)";
    }
    return all;
}

inline std::string what_ends(run_reach const& r) {
    auto const carried = r.until - r.begin;
    auto words = carried > 0 ? "over what is left, trajectories are carried for " + brief(carried) +
                                   " of " + brief(r.end - r.begin) + " s"
                             : std::string{"over what is left, no trajectory is carried anywhere"};
    words += ": there " + r.state + " is " + brief(r.width) + " " + unit_text(r.unit) + " wide" +
             (r.causes.empty() ? "" : ", by " + causes_text(r));
    words += carried > 0 ? ". Windows of less than " + brief(carried) + " s" : ". Shorter windows";
    if (!r.causes.empty()) words += ", or " + name_of(r.causes.front()) + " in a narrower range,";
    return words + " would tell more";
}

} // namespace detail

SIVID_DECL std::vector<std::string> reach_words(std::vector<run_reach> const& reach) {
    std::vector<std::string> result;
    for (auto const& r : reach) {
        auto const name = r.scenario + ": ";
        if (!r.complete()) {
            result.push_back(name + detail::what_ends(r));
        } else if (r.moved < 1) {
            result.push_back(name + "parameters and starts move no measurement by more than " +
                             detail::brief(r.moved) +
                             " of its error bound: such data cannot tell more; smaller bounds, or "
                             "motions that depend more on them, would");
        } else if (!(r.lost < 1)) {
            result.push_back(name + "trajectories over what is left blur by " +
                             (std::isfinite(r.lost) ? detail::brief(r.lost) : "any number of") +
                             " error bounds: more time, or shorter windows, would tell more");
        }
    }
    return result;
}

} // namespace sivid::report

#endif
