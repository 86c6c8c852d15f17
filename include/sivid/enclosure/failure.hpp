// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_FAILURE_HPP
#define SIVID_ENCLOSURE_FAILURE_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/graph/operation.hpp>
#include <sivid/number/decimal.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <cstddef>
#include <limits>
#include <optional>
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
    unsolved_stages,
    cancelled ///< it was told to stop: `enclosure_options::keep_going`
};

/// What is most likely to help.
enum class advice {
    smaller_box,
    higher_order,
    more_steps,
    shorter_steps,
    other_set,     ///< one that keeps more of the dependence on the unknowns
    higher_degree, ///< of Taylor models that were carried
    nothing
};

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
    case failure_reason::cancelled:
        return "it was told to stop";
    }
    return "";
}
[[nodiscard]] constexpr std::string_view to_string(advice a) {
    switch (a) {
    case advice::smaller_box:
        return "split the box of parameters and initial states";
    case advice::higher_order:
        return "use a higher order or a smaller tolerance";
    case advice::more_steps:
        return "allow more steps";
    case advice::shorter_steps:
        return "allow shorter steps or use an explicit method";
    case advice::other_set:
        return "use Taylor models";
    case advice::higher_degree:
        return "use Taylor models of a higher degree";
    case advice::nothing:
        return "nothing is known to help";
    }
    return "";
}

/// What is most likely to help, from what the state that stopped a set spans as a function of the
/// unknowns, and what it has lost besides to truncation, rounding and wrapping. A point cannot be
/// split; what is lost, another set may keep; what truly varies can only be split. Whoever carries
/// sets says what its caller can do: Taylor models `higher_degree` in place of `other_set`, and
/// `enclose`, which has no degree to be given, `smaller_box`.
/// @param wide  parameters or initial states have a width
[[nodiscard]] constexpr advice advise(failure_reason r, bool wide, double spread, double lost) {
    switch (r) {
    case failure_reason::step_limit:
        return advice::more_steps;
    case failure_reason::unsolved_stages:
        return advice::shorter_steps;
    case failure_reason::cancelled:
        return advice::nothing;
    case failure_reason::undefined:
        return wide ? advice::smaller_box : advice::nothing;
    case failure_reason::minimum_step:
    case failure_reason::too_wide:
    case failure_reason::not_finite:
        break;
    }
    if (!wide) return advice::higher_order;
    return lost <= spread ? advice::smaller_box : advice::other_set; // NaN counts as lost
}

/// A double in a message: six significant digits.
[[nodiscard]] inline std::string short_text(double x) { return nearest_text(x, 6); }

/// The same, never above x: what was proved up to x was proved up to that.
[[nodiscard]] SIVID_DECL std::string short_text_down(double x);

/// A function of a model that is not defined on all of its argument.
struct domain_edge {
    std::size_t state = 0;   ///< in whose rate it stands
    bool derivative = false; ///< the rate is defined, a derivative of it is not
    operation function = operation::div;
    double lower = 0, upper = 0; ///< the argument; of a quotient: the denominator
    std::string formula = {};    ///< of the argument, where it is short

    [[nodiscard]] std::string text() const;
};

/// A failure to enclose, as a value: what is proved up to `time` stays proved.
struct enclosure_failure {
    failure_reason reason = failure_reason::minimum_step;
    double time = 0;           ///< the enclosure reaches this time, in the model's unit of time
    std::size_t component = 0; ///< the state that stopped it, or in whose rate the reason lies
    advice help = advice::smaller_box;
    /// Where the last step that was tried was to end, in that unit; not after `time` if none was.
    double until = -std::numeric_limits<double>::infinity();
    /// Half-widths of the state at `time`: as a function of the unknowns, and what was lost
    /// besides.
    double spread = 0;
    double lost = 0;
    std::optional<domain_edge> edge = std::nullopt; ///< what is not defined, if that is the reason

    /// Notes an edge, and its state.
    void note(std::optional<domain_edge> const& found) {
        edge = found;
        if (edge) component = edge->state;
    }

    /// One sentence for a user.
    /// @param time_unit  the model's (`model_description::time_unit`); none: numbers alone
    [[nodiscard]] std::string message(std::string_view state,
                                      std::string_view time_unit = {}) const;
};

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/enclosure/impl/failure.ipp>
#endif

#endif
