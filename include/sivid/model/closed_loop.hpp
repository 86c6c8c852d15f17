// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_CLOSED_LOOP_HPP
#define SIVID_MODEL_CLOSED_LOOP_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/expression.hpp>
#include <sivid/model/model.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace sivid {

/// A model under a control law: a model like any other, whose inputs are those that the law leaves
/// open, then the law's own.
struct closed_model {
    recorded_model model; ///< what the law commands are channels of the inputs' names, if free
    /// The inputs of the open model that are still to be given.
    std::vector<std::size_t> kept_inputs;
    std::vector<signal> own_inputs; ///< what the law adds: switches in time, errors of sensors
    std::size_t own_states = 0;     ///< integrals, behind the model's states; they begin at 0
    /// States that effects added, such as lags of an actuator: their values at the begin, in the
    /// time, states, inputs and constants.
    std::vector<added_state> starts;
    /// What has to hold for a sampled law, or nothing is said of it: the channel's value, the rate
    /// at which a law changes its command, is always below the limit in absolute value.
    struct slew {
        std::string channel; ///< "W.slew", or "W.slew.slew" where the model has a channel W.slew
        double limit = 0;    ///< [unit/s]
    };
    std::vector<slew> slews;

    /// A requirement, provided that what has to hold for a sampled law does.
    [[nodiscard]] std::string with_slews(std::string const& requirement) const;

    /// @param open  the signals of all inputs of the open model; those of commanded ones are unused
    [[nodiscard]] std::vector<signal> inputs(std::vector<signal> const& open) const;
    /// A box that holds the starts of all motions.
    /// @param open       starts of the open model
    /// @param constants  enclosures of all constants of `model`
    /// @throws std::domain_error  where the start of an added state is not bounded for all of them
    [[nodiscard]] box initial(box const& open, std::vector<signal> const& inputs,
                              std::vector<interval> const& constants) const;
};

/// Writes a control law for a model: commands for its inputs, as expressions of the time, states,
/// constants, what sensors show, and gains that are still to be chosen. @code
///     closed_loop law(record_model<hovercraft>());
///     law.command("W", saturate(law.gain("K", "1/m") * (2 - law.state("u")), 0, 250));
///     auto const closed = law.finish(); // a model with the constant K and the channel W @endcode
/// A functor that is templated on the scalar is called with the expressions, as models are.
class closed_loop {
public:
    explicit closed_loop(recorded_model open);
    closed_loop(closed_loop const&) = delete;
    closed_loop& operator=(closed_loop const&) = delete;
    ~closed_loop();

    [[nodiscard]] expression time();
    /// The state itself. @throws std::invalid_argument for a name that the model lacks
    [[nodiscard]] expression state(std::string_view name);
    /// A constant of the model, or a gain.
    [[nodiscard]] expression constant(std::string_view name);
    /// An input that is not commanded.
    [[nodiscard]] expression input(std::string_view name);
    /// What a sensor shows: the channel, off by any error within the bound that `sensor` stated.
    [[nodiscard]] expression measured(std::string_view channel);
    /// Whether somebody asked for what the sensor shows: else its error is of no matter.
    [[nodiscard]] bool reads(std::string_view channel) const;

    /// From here on the channel is measured with an error of at most `bound`, which may change at
    /// will from one instant to the next.
    void sensor(std::string_view channel, double bound);
    /// A further constant, for the law.
    /// @param nominal  where nobody says its value
    expression gain(std::string const& name, std::string const& unit, decimal nominal = {});
    /// The integral of x from the begin on: a further state.
    /// @param limit  its own range
    expression integral(expression const& x, std::string const& name, std::string const& unit,
                        double limit);
    /// 1 in [from, to), else 0; exact, and no kink for an integrator.
    expression during(double from, double to);

    /// The law is computed from samples that are at most `period` apart, each of which acts at most
    /// `delay` after it was taken, and is held until the next one does; before the first the
    /// command is what the law says at the begin. Both in the model's unit of time.
    ///   With |d/dt law(x(t))| <= s along the motion what acts differs from what the law says at
    ///   the
    /// same instant by at most (period + delay) s: an error of the input, of which the closed model
    /// has all. That its motions keep the limit s is to be proved with what is wanted of them
    /// (`with_slews`): then the sampled loop, whose error is 0 at each sample that acts at once and
    /// grows continuously from there, never gets beyond it, and moves as one of them.
    void sampled(double period, double delay);
    /// The limit s of an input's command, for a sampled law [unit/s].
    void slew(std::string_view input, double limit);

    /// What the input is, at every instant.
    /// @throws std::invalid_argument where it is commanded already
    void command(std::string_view input, expression const& value);

    /// The open model with what the law has added until now: for those who read expressions.
    [[nodiscard]] recorded_model& open() { return open_; }

    /// @throws std::invalid_argument  when nothing is commanded; when a command depends on a
    ///         commanded input, itself or by a channel that shows it (an algebraic loop); for
    ///         models with delays; for sampled laws with switches in time, integrals, jumps, other
    ///         inputs, or without a limit of their slew
    [[nodiscard]] closed_model finish() const;

private:
    expression leaf(operation op, std::size_t index) { return {open_.g, open_.g.leaf(op, index)}; }
    expression add_input(std::string name, std::string unit, signal u);
    /// Whether what is commanded changes. @throws where it cannot be sampled
    [[nodiscard]] bool needs_hold(std::size_t input, node_id command) const;
    [[nodiscard]] std::vector<std::size_t> keep_inputs(closed_model& result) const;
    [[nodiscard]] node_id held(std::size_t input, node_id law, closed_model& result) const;
    void show_slews(std::map<std::size_t, node_id> const& laws,
                    std::vector<std::size_t> const& place, closed_model& result) const;

    recorded_model open_;
    std::size_t states_, inputs_; ///< of the open model
    std::vector<signal> own_inputs_;
    std::map<std::size_t, node_id> commands_; ///< by input
    std::map<std::size_t, double> bounds_;    ///< of sensors, by channel
    std::map<std::size_t, double> slews_;     ///< limits, by input
    double age_ = 0;                          ///< of a sample that acts, at most; time
    std::map<std::size_t, expression> shown_; ///< by channel
};

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/impl/closed_loop.ipp>
#endif

#endif
