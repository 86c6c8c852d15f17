// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_IMPL_FAILURE_IPP
#define SIVID_ENCLOSURE_IMPL_FAILURE_IPP

#include <sivid/enclosure/failure.hpp>

namespace sivid {

SIVID_DECL std::string short_text_down(double x) {
    for (int digits = 6;; ++digits) {
        auto text = nearest_text(x, digits);
        if (!(parse_nearest(text).value_or(x) > x) || digits >= 17) return text;
    }
}

SIVID_DECL std::string domain_edge::text() const {
    std::string const of =
        function == operation::div ? "division by" : std::string(name(function)) + " of";
    return of + " a value in [" + short_text(lower) + ", " + short_text(upper) + "]" +
           (derivative ? ", in a derivative" : "") + (formula.empty() ? "" : ": " + formula);
}

namespace enclosure_detail {
/// What stands behind a time: a blank and its unit, or nothing.
[[nodiscard]] inline std::string behind_time(std::string_view unit) {
    return unit.empty() ? std::string{} : " " + std::string(unit);
}
} // namespace enclosure_detail

SIVID_DECL std::string enclosure_failure::message(std::string_view state,
                                                  std::string_view time_unit) const {
    auto const unit = enclosure_detail::behind_time(time_unit);
    return "enclosure stopped at t = " + short_text_down(time) + unit + " (state " +
           std::string(state) +
           (until > time ? ", last step tried of " + short_text(until - time) + unit : "") +
           "): " + std::string(to_string(reason)) + (edge ? " (" + edge->text() + ")" : "") + "; " +
           std::string(to_string(help));
}

} // namespace sivid

#endif
