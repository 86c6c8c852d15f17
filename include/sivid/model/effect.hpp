// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_EFFECT_HPP
#define SIVID_MODEL_EFFECT_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/expression.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

class effect_scope;

/// Whether an input counts how often readings have leapt back (`effect::wraps`): it belongs to the
/// times of the readings, late or not.
[[nodiscard]] inline bool counts_readings(std::string const& input) {
    return input.ends_with(".wraps");
}

namespace detail {
inline constexpr std::string_view wider = "_wider";
}

/// A parameter of an effect: its prior, and the value at which the effect vanishes.
struct effect_parameter {
    std::string name;
    std::string unit;
    decimal lower;
    decimal upper;
    decimal neutral;
    double widened = 1; ///< a power of 2: how far the ends that may move were moved
    /// The model's unit of time to this power stands behind `unit`: effects of any model do not
    /// know it.
    int time_power = 0;

    /// From `lower` to `upper`. An end at 0 or at the neutral value is what the effect is made for
    /// and stays; others lie `widened` times as far out, or so much closer to 0.
    [[nodiscard]] interval prior() const;
    /// The whole unit, in this model.
    [[nodiscard]] SIVID_DECL std::string unit_in(model_description const& about) const;
};

/// Something that a model leaves out, as an edit of its recording: inputs and constants may change
/// before the model sees them (`on_inputs`), its rates after they are formed (`on_rates`), and its
/// channels (`on_channels`). Any of the three may be empty.
///
/// Effects on one input are joined in the order of `order`, then of writing.
struct effect {
    using edit = std::function<void(effect_scope&)>;

    std::string name;
    std::vector<effect_parameter> parameters;
    edit on_inputs{};
    edit on_rates{};
    edit on_channels{};
    int order = 0;
    std::string about{}; ///< what it means, for reports
    /// Where the effect is a first-order lag and nothing else: its only parameter is the time
    /// constant.
    struct first_order_lag {
        std::string input;  ///< empty: of channels
        bool rests = false; ///< it begins at 0, else at the input
    };
    std::optional<first_order_lag> lags{};
    /// Where the effect is a dead band or a saturation of an input and nothing else: its only
    /// parameter is the size of the input from which on it moves, or stands.
    struct input_threshold {
        std::string input;
        bool stands = false; ///< beyond it (saturation), else within (dead band)
    };
    std::optional<input_threshold> threshold{};
    /// Where the effect shows a channel modulo its first parameter: an input, its name and
    /// ".wraps", counts how often readings of the channel in an experiment have leapt back, by at
    /// least `least`.
    struct wrapped_channel {
        std::string channel;
        double least = 0;
    };
    std::optional<wrapped_channel> wraps{};
    /// The experiments in which it acts, others do not see it; none: it acts in all. Such an effect
    /// has a switch, an input of its name that is 1 where it acts and else 0.
    std::vector<std::string> only_in{};
    /// When it begins in each of these, in the model's unit of time, from then on it acts; none: at
    /// their start. What it remembers (behind a delay, a play, a rate limit, or in a state of its
    /// own) goes on from start to end, and is seen while it acts; a channel is late at the times at
    /// which it acts.
    std::vector<double> since{};
    /// When it ends in each of these, in that unit, from then on it does not act; none: never.
    std::vector<double> until{};

    /// Whether it acts in an experiment, at least for some time.
    [[nodiscard]] bool acts_in(std::string const& experiment) const {
        return only_in.empty() ||
               std::find(only_in.begin(), only_in.end(), experiment) != only_in.end();
    }
    /// Whether it begins in some experiment later than that does.
    [[nodiscard]] bool begins_later() const {
        return std::any_of(since.begin(), since.end(), [](double t) { return t > from_start; });
    }
    /// Whether it ends in some experiment.
    [[nodiscard]] bool ends() const {
        return std::any_of(until.begin(), until.end(), [](double t) { return t < for_ever; });
    }
    /// Whether it begins or ends in the midst of an experiment.
    [[nodiscard]] bool changes_within() const { return begins_later() || ends(); }
    /// Whether it may change something where its parameters are neutral: a saturation does beyond
    /// its highest limit, and one without parameters always acts.
    [[nodiscard]] bool may_leave_traces() const {
        return parameters.empty() ||
               std::any_of(parameters.begin(), parameters.end(),
                           [](effect_parameter const& p) { return nearest(p.neutral) != 0; });
    }
    static constexpr double for_ever = std::numeric_limits<double>::infinity();
    static constexpr double from_start = -for_ever;
};

/// What an effect sees of a model under construction and may change. Names are the model's own;
/// an unknown one throws std::invalid_argument that lists what exists.
class effect_scope {
public:
    /// The time, as the model sees it.
    [[nodiscard]] expression& time() { return time_; }
    /// The effect's own k-th parameter.
    [[nodiscard]] expression const& parameter(std::size_t k = 0) const;
    [[nodiscard]] expression const& state(std::string const& name) const;
    /// The constant, as the model sees it.
    [[nodiscard]] expression& constant(std::string const& name);
    /// The input, as the model sees it.
    [[nodiscard]] expression& input(std::string const& name);
    /// How often the readings of the channel that the effect wraps have leapt back.
    [[nodiscard]] expression& wraps() { return input(effect_->name + ".wraps"); }
    /// A state, an input, a constant, or the time, t, as the model sees it.
    [[nodiscard]] expression const& named(std::string const& name) const;
    /// Time derivative of a state; of the model's own ones from `on_rates` on.
    [[nodiscard]] expression& rate(std::string const& state);
    /// Output of a channel, in `on_channels`.
    [[nodiscard]] expression& channel(std::string const& name);

    /// A further state, whose rate the effect sets.
    /// @param limit     own range
    /// @param at_begin  its initial value, in inputs (at the begin), constants, and states that
    ///                  effects added before; none: it is unknown, anywhere in its range, in each
    ///                  experiment
    expression add_state(std::string const& name, std::string const& unit, state_range limit,
                         std::optional<expression> const& at_begin);
    /// The model sees the input behind a memory whose size is the effect's k-th parameter: late, by
    /// a time or (`drift`: its clock runs slow) by a share of the time since the begin; behind a
    /// play of this half-width; behind a rate limit.
    void remember(std::string const& input, memory_kind kind, std::size_t k = 0);
    /// The channel shows the past, by the effect's k-th parameter: late by a time or, where its
    /// clock runs slow, by a share of the time since the begin.
    /// @param kind  `delay` or `drift`
    /// @throws std::invalid_argument  for another kind
    void show_late(std::string const& channel, memory_kind kind, std::size_t k = 0);
    /// The channel h follows by a first-order lag, whose time constant tau > 0 is the effect's k-th
    /// parameter, from its own value at the begin on: it shows h - w, w' = h' - w/tau, w = 0 there.
    /// @throws std::invalid_argument  for a channel that shows anything but a state as it is
    void lag_channel(std::string const& name, std::size_t k = 0);

private:
    friend recorded_model with(recorded_model const& base, std::vector<effect> effects);

    /// @param unseen  by effect: whether nothing sees it where its switch is 0; receives those that
    ///                have a switch and add states, which need that
    static recorded_model join(recorded_model const& base, std::vector<effect> const& effects,
                               std::vector<bool>& unseen);
    explicit effect_scope(recorded_model& model);
    [[nodiscard]] expression leaf(operation op, std::size_t index) const {
        return expression(model_->g, model_->g.leaf(op, index));
    }

    void switch_parameters(std::vector<effect> const& effects,
                           std::vector<std::size_t> const& first, std::vector<bool> const& unseen);
    /// One of its edits.
    void apply(effect const& e, effect::edit const& edit, std::size_t first_parameter,
               std::vector<bool>::reference unseen);
    void copy_model(recorded_model const& base);
    void require_memories(std::vector<expression> const& stated) const;
    void require_starts_and_copies(recorded_model const& base) const;
    void begin(effect const& e, std::size_t first_parameter);
    /// Writes down that an effect names an input.
    void note(std::size_t input) const;
    /// An input (by index) and its copies, which are behind the same memories.
    [[nodiscard]] std::vector<std::size_t> with_copies(std::size_t input) const;
    /// The switch of the effect, as an input; none: it acts in all experiments.
    [[nodiscard]] std::optional<std::size_t> switch_of_effect() const;
    /// What an edit has changed stays so where the switch is 1 and is as before where it is 0.
    void keep_where(expression const& on, effect_scope const& before);

    recorded_model* model_;
    expression time_;
    std::vector<expression> states_, constants_, inputs_, rates_, channels_;
    std::vector<effect const*> owners_; ///< of states; nullptr: the model itself
    std::size_t first_parameter_ = 0;
    effect const* effect_ = nullptr;                      ///< whose edit it is
    mutable std::map<std::size_t, std::string> named_by_; ///< inputs, by the first effect
};

/// Whether an effect that changes an input is the first to see it: no other one changes it before,
/// or lets anything else depend on it. Then the effect may as well act on the recorded input.
[[nodiscard]] SIVID_DECL bool finds_as_recorded(recorded_model const& base,
                                                std::vector<effect> const& effects,
                                                std::size_t which, std::string const& input);

/// The effect with priors four times as wide, under its name and "_wider".
[[nodiscard]] SIVID_DECL effect widened(effect e);

/// The effect in these experiments only, under its name and "@S4+S5"; "@S4>=1.5<4+S5" where it
/// begins in S4 at 1.5 s and ends there at 4 s.
/// @param since  for each of them, in the model's unit of time, or `effect::from_start`; none: all
///   from the start
/// @param until  for each of them, in that unit, or `effect::for_ever`; none: none ends
[[nodiscard]] SIVID_DECL effect only_within(effect e, std::vector<std::string> experiments,
                                            std::vector<double> since = {},
                                            std::vector<double> until = {});

/// Whether scenarios can stand in the name of an effect that acts in them only (`only_within`).
[[nodiscard]] inline bool can_stand_in_a_name(std::vector<std::string> const& scenarios) {
    constexpr std::size_t most = 8;
    return scenarios.size() <= most &&
           std::all_of(scenarios.begin(), scenarios.end(), [](std::string const& s) {
               return s.find_first_of("@+,<>") == std::string::npos;
           });
}

/// For effects that are known by their names: each has one of its own, which no input of the model
/// has, and begins and ends once in an experiment.
/// @throws std::invalid_argument  that names what does not fit
SIVID_DECL void require_distinct(model_description const& about,
                                 std::vector<effect> const& effects);

namespace model_detail {
/// An effect that changes nothing, and shows what the model sees behind the inputs' edits of
/// others: states of which the rates are the inputs, then the constants, then the time, in the
/// order of the model.
/// @param beside  those that it is joined with; its name is none of theirs
/// @param order   it sees those of this order, and below
[[nodiscard]] SIVID_DECL effect seen_effect(model_description const& about,
                                            std::vector<effect> const& beside, int order);
} // namespace model_detail

/// A model with effects. Their parameters become constants `<effect>.<parameter>`, nominal at the
/// neutral value; states that they add, and switches of those that act in some experiments only,
/// stand behind the model's own states and inputs.
///   Where its switch is 0 an effect leaves no trace: it sees its neutral values; delays, plays and
///   rate limits do not act (`acts_in`); states of its own go on, and nothing sees them. One that
///   begins or ends within an experiment has its delay, play or rate limit on a copy of the input,
///   which the model sees while it acts.
/// @throws std::invalid_argument  when an effect names what the model lacks, or changes a size of a
///         delay, play or rate limit; as `require_distinct`; and when the model has a copy of an
///         input, for an effect that was joined before, and an effect names that input but not the
///         copy
[[nodiscard]] SIVID_DECL recorded_model with(recorded_model const& base,
                                             std::vector<effect> effects);

/// `with(model{}, effect...)`: records the model and adds the effects.
template <dynamic_model M, std::same_as<effect>... Effects>
[[nodiscard]] recorded_model with(M const& model, Effects const&... effects) {
    return with(record_model(model), std::vector<effect>{effects...});
}

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/impl/effect.ipp>
#include <sivid/model/impl/effect_names.ipp>
#include <sivid/model/impl/effect_scope.ipp>
#endif

#endif
