// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_ALLOWED_DISTURBANCES_HPP
#define SIVID_IO_ALLOWED_DISTURBANCES_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/model/problem.hpp>

#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Unknown functions of time that answers allow for, by name and as they were told: whoever reads
/// an answer poses the same problem with them.
struct allowed_disturbances {
    using bounds = std::vector<std::pair<std::string, exact_decimal>>;
    bounds equations; ///< at most so much of the state's unit per time
    bounds channels;  ///< so much further off than bounds of readings say, in the channel's unit

    [[nodiscard]] bool empty() const { return equations.empty() && channels.empty(); }
};

/// The problem in which they act: `with_disturbance` of size 1.
/// @throws std::invalid_argument  as that does, and for a bound that is no finite double
[[nodiscard]] SIVID_DECL identification_problem
with_disturbance(identification_problem problem, allowed_disturbances const& allowed);

/// "v up to 0.8 m/s^2, readings of y up to 0.1 m"
/// @param model  of the problem, with them or without
[[nodiscard]] SIVID_DECL std::string in_words(allowed_disturbances const& allowed,
                                              recorded_model const& model);

/// What an answer with them rests on, a sentence each.
/// @param model  of the problem in which they act
[[nodiscard]] SIVID_DECL std::vector<std::string>
assumptions_of(allowed_disturbances const& allowed, recorded_model const& model);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/impl/allowed_disturbances.ipp>
#endif

#endif
