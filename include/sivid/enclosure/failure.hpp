// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_FAILURE_HPP
#define SIVID_ENCLOSURE_FAILURE_HPP

#include <cstddef>
#include <string>
#include <string_view>

namespace sivid {

/// Why an enclosure could not be carried on.
enum class failure_reason {
    minimum_step, ///< no step longer than the smallest allowed one could be proved
    undefined,    ///< a function of the model is not defined on the whole enclosure
    too_wide,     ///< the enclosure grew beyond the widest useful one
    step_limit,   ///< the allowed number of steps is used up
    not_finite,   ///< the enclosure became unbounded
    /// the stages of an implicit method could not be proved, however short the step
    unsolved_stages
};

/// What is most likely to help.
enum class advice { smaller_box, higher_order, more_steps, check_model, shorter_steps };

[[nodiscard]] constexpr std::string_view to_string(failure_reason r) {
    switch (r) {
    case failure_reason::minimum_step:
        return "no step could be proved";
    case failure_reason::undefined:
        return "the model is not defined on the whole enclosure";
    case failure_reason::too_wide:
        return "the enclosure grew too wide";
    case failure_reason::step_limit:
        return "the number of steps is used up";
    case failure_reason::not_finite:
        return "the enclosure became unbounded";
    case failure_reason::unsolved_stages:
        return "the stages of the implicit method have no proven solution";
    }
    return "";
}
[[nodiscard]] constexpr std::string_view to_string(advice a) {
    switch (a) {
    case advice::smaller_box:
        return "split the box of parameters and initial states";
    case advice::higher_order:
        return "use a higher order or a larger tolerance";
    case advice::more_steps:
        return "allow more steps";
    case advice::check_model:
        return "check the model's domain there";
    case advice::shorter_steps:
        return "allow shorter steps or use an explicit method";
    }
    return "";
}

/// A failure to enclose, as a value: what is proved up to `time` stays proved.
struct enclosure_failure {
    failure_reason reason = failure_reason::minimum_step;
    double time = 0;           ///< the enclosure reaches this time [s]
    std::size_t component = 0; ///< the state that stopped it
    advice help = advice::smaller_box;

    /// One sentence for a user.
    [[nodiscard]] std::string message(std::string_view state) const {
        return "enclosure stopped at t = " + std::to_string(time) + " s (state " +
               std::string(state) + "): " + std::string(to_string(reason)) + "; " +
               std::string(to_string(help));
    }
};

} // namespace sivid

#endif
