// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_DIVISORS_HPP
#define SIVID_PAVING_DIVISORS_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Whether something is zero somewhere.
enum class zeros {
    none, ///< proved
    some, ///< proved: both signs occur, and it is continuous
    unknown
};

/// What the equations of a model divide by: a mass, a length, the determinant of a mass matrix.
struct divisor {
    std::string formula;                ///< empty where it would be too long to read
    std::vector<std::string> equations; ///< that divide by it: "w1", "output q1"
    sivid::zeros zeros = sivid::zeros::unknown;
    /// Unless there are none: a point close to a zero, by the names of what it depends on.
    std::vector<std::pair<std::string, double>> near{};
};

struct divisor_options {
    std::size_t boxes = 2000; ///< for each
    std::function<bool()> keep_going{};
};

/// Examines everything that a problem's equations divide by: over the parameters of the prior, the
/// states within their own limits, times and inputs within the range of the records. A trajectory
/// on which a divisor vanishes ends there, and over boxes of parameters and states in which one
/// does no trajectory is enclosed; for an implicit model, those are where its matrix is singular.
/// @returns  those that depend on anything and were looked at before `keep_going` ended it; nothing
///           for models with delays, plays or rate limits
/// @throws std::invalid_argument  for a problem that is not one
/// @guarantee  `none` and `some` are proved; `unknown` and `near` are no claims
/// @cost  at most `options.boxes` evaluations for each divisor: microseconds a box
[[nodiscard]] SIVID_DECL std::vector<divisor> divisors_of(identification_problem const& problem,
                                                          divisor_options const& options = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/impl/divisors.ipp>
#endif

#endif
