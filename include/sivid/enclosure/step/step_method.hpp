// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_STEP_STEP_METHOD_HPP
#define SIVID_ENCLOSURE_STEP_STEP_METHOD_HPP

#include <sivid/enclosure/options.hpp>
#include <sivid/enclosure/set/doubleton.hpp>
#include <sivid/enclosure/step/detail/tube_step.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

namespace sivid {

class flow;

/// The two numbers that a Runge-Kutta method of order p adds to a step: its value
/// \f$ \phi(h) \f$, and \f$ \phi^{[p+1]} \f$ over all s in [0, h].
template <class T>
struct runge_kutta_formula {
    std::vector<T> value;
    std::vector<T> next;
};

/// What a Runge-Kutta method adds to steps of sets of first order: a formula for their centre, and,
/// if it is implicit, steps that are long against the problem's time constants.
template <class I>
class step_method {
public:
    virtual ~step_method() = default;

    virtual void set_ensemble(ensemble<I> const& e) = 0;
    /// Whether a smooth step is refused where there is no `formula`.
    [[nodiscard]] virtual bool is_implicit() const = 0;
    /// What the method says of a step of length s from the point m.
    /// @returns nothing where a stage is not defined, not smooth, or not proved
    [[nodiscard]] virtual std::optional<runge_kutta_formula<I>>
    formula(double from, std::vector<double> const& m, I const& s) = 0;

    /// Proves a long step from `set` that ends at `limit` or before, if there is one.
    /// @param margin  of each state, what a step may lose
    /// @param admit   a last condition
    [[nodiscard]] virtual std::optional<tube_step<I>>
    prove_long(doubleton<I> const& set, double limit, std::vector<double> const& margin,
               std::function<bool(tube_step<I>&)> const& admit) = 0;
    /// Where a long step leads at a time within.
    /// @returns nothing when that is not proved
    [[nodiscard]] virtual std::optional<step_map<I>> map_long(tube_step<I> const& step,
                                                              double to) = 0;
};

/// What `tableau::steps` points to, for one type of intervals.
template <class I>
struct step_method_maker : any_step_method_maker {
    [[nodiscard]] virtual std::unique_ptr<step_method<I>>
    make(flow const& f, enclosure_options const& options) const = 0;
};

/// @returns null without a method
/// @throws std::invalid_argument  for a method that cannot make steps in I
template <class I>
[[nodiscard]] std::unique_ptr<step_method<I>> make_step_method(flow const& f,
                                                               enclosure_options const& options) {
    if (!options.method) return nullptr;
    auto const* const maker = dynamic_cast<step_method_maker<I> const*>(options.method->steps);
    if (maker == nullptr)
        throw std::invalid_argument(
            "tableau '" + options.method->name +
            "': it says nothing of steps in this type of intervals; give "
            "the options `for_steps<I>` of it (sivid/enclosure/methods.hpp)");
    return maker->make(f, options);
}

} // namespace sivid

#endif
