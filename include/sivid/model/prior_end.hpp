// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_PRIOR_END_HPP
#define SIVID_MODEL_PRIOR_END_HPP

#include <sivid/space/box.hpp>

#include <cstddef>
#include <string_view>
#include <vector>

namespace sivid {

/// The end of its prior that a value sits on.
enum class prior_end { none, lower, upper };
[[nodiscard]] constexpr std::string_view to_string(prior_end e) {
    return e == prior_end::none ? "none" : e == prior_end::lower ? "lower" : "upper";
}

/// Which end of its prior a value lies at, within a thousandth of the prior's width. An end of 0 is
/// none: there a quantity that is positive by its nature, or an effect, vanishes.
[[nodiscard]] inline prior_end end_of_prior(double value, interval const& prior) {
    double const near = 1e-3 * (prior.upper() - prior.lower());
    if (!(near > 0)) return prior_end::none;
    if (prior.lower() != 0 && value - prior.lower() <= near) return prior_end::lower;
    if (prior.upper() != 0 && prior.upper() - value <= near) return prior_end::upper;
    return prior_end::none;
}

/// The parameters, those at the end of their prior moved to its middle.
[[nodiscard]] inline std::vector<double> away_from_ends(box const& prior,
                                                        std::vector<double> parameters) {
    for (std::size_t j = 0; j < parameters.size(); ++j)
        if (end_of_prior(parameters[j], prior[j]) != prior_end::none) parameters[j] = mid(prior[j]);
    return parameters;
}

} // namespace sivid

#endif
