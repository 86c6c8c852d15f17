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

SIVID_DECL std::string advised_failure::message(std::string_view state,
                                                std::string_view time_unit) const {
    std::string text = failure.message(state, time_unit);
    auto const unit = enclosure_detail::behind_time(time_unit);
    std::string tried;
    auto const to = [&](double t) {
        return t >= end ? std::string("the end") : "t = " + short_text_down(t) + unit;
    };
    auto const add = [&tried](std::string const& what) {
        tried += (tried.empty() ? "" : "; ") + what;
    };
    for (std::size_t k = 0; k < members.size(); ++k) {
        add((k == 0 ? "a single trajectory from the middle gets to " : "from a corner to ") +
            to(members[k]));
    }
    for (auto const& t : trials) add(what(t, unit) + " to " + to(t.reached));
    return tried.empty() ? text : text + ". Tried: " + tried;
}

SIVID_DECL std::string advised_failure::what(remedy_trial const& t, std::string const& unit) {
    auto const& o = t.options;
    switch (t.remedy) {
    case advice::higher_order:
        return (o.method ? o.method->name : "order " + std::to_string(o.order)) +
               " with tolerance " + short_text(o.tolerance) + " and steps down to " +
               short_text(o.shortest_step()) + unit;
    case advice::shorter_steps:
        return "steps down to " + short_text(o.shortest_step()) + unit;
    case advice::more_steps:
        return std::to_string(o.maximum_steps) + " steps";
    case advice::other_method:
        return o.method->name;
    case advice::other_set:
    case advice::higher_degree:
        return "the other set";
    default:
        return "parts 1/" + short_text(1 / t.share) + " as wide";
    }
}

} // namespace sivid

#endif
