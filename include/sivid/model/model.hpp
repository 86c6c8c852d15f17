// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_MODEL_HPP
#define SIVID_MODEL_MODEL_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/expression.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/number/decimal.hpp>
#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace sivid {

/// A state's own range: `8` for \f$ |x| \le 8 \f$, `{0, 5}` for a quantity such as a concentration.
///   It says where an experiment may start that does not say so itself, and how large the state
///   is. It says nothing of motions: those of the model may leave it, and are followed there. Where
///   a proof needs more (`relations` of a diagnosis), what follows from it stands among the
///   assumptions in numbers.
struct state_range {
    double lower = 0, upper = 0;

    constexpr state_range() = default;
    constexpr state_range(double limit) : lower(-limit), upper(limit) {}
    constexpr state_range(double low, double high) : lower(low), upper(high) {}

    /// How large the state is, a scale.
    constexpr operator double() const { return std::max(-lower, upper); }
    [[nodiscard]] interval range() const { return interval_traits<interval>::bounds(lower, upper); }
};

/// A fixed-length tuple of scalars, the shape in which a model's functor receives and returns its
/// states, inputs and outputs: `auto const& [u, v, r] = x;`
template <class T, std::size_t N>
using vec = std::array<T, N>;

/// A named quantity with its unit: an input or an output channel of a model.
struct quantity {
    std::string_view name;
    std::string_view unit;
};

/// A state with its own range, `{"u", "m/s", 8}` or `{"c", "mol/l", {0, 5}}` (`state_range`).
struct state_quantity {
    std::string_view name;
    std::string_view unit;
    state_range limit;
    std::string_view equation = {}; ///< what its equation is called; its own name by default
};

/// A constant of a model with its nominal value, an exact decimal.
struct constant_quantity {
    std::string_view name;
    std::string_view unit;
    decimal nominal;
};

namespace model_detail {
template <class T, std::size_t... K>
constexpr std::array<T, sizeof...(K)> to_array(T const* items, std::index_sequence<K...>) {
    return {items[K]...};
}
} // namespace model_detail

/// `static constexpr auto states = sivid::states({{"u", "m/s", 8}, ...});`
template <std::size_t N>
constexpr auto states(state_quantity const (&list)[N]) {
    return model_detail::to_array(list, std::make_index_sequence<N>{});
}
/// `static constexpr auto inputs = sivid::inputs({{"W", "1/s"}, {"delta", "rad"}});`
template <std::size_t N>
constexpr auto inputs(quantity const (&list)[N]) {
    return model_detail::to_array(list, std::make_index_sequence<N>{});
}
/// A model without inputs: `static constexpr auto inputs = sivid::no_inputs;`
inline constexpr std::array<quantity, 0> no_inputs{};
/// `static constexpr auto channels = sivid::channels({{"u", "m/s"}, ...});`
template <std::size_t N>
constexpr auto channels(quantity const (&list)[N]) {
    return model_detail::to_array(list, std::make_index_sequence<N>{});
}
/// `static constexpr auto constants = sivid::constants({{"m", "kg", 1.297_dec}, ...});`
template <std::size_t N>
constexpr auto constants(constant_quantity const (&list)[N]) {
    return model_detail::to_array(list, std::make_index_sequence<N>{});
}

/// Unknowns of an implicit model beside the rates, forces of constraints for instance:
/// `static constexpr auto algebraic = sivid::algebraic({{"pull", "N"}});`
template <std::size_t N>
constexpr auto algebraic(quantity const (&list)[N]) {
    return model_detail::to_array(list, std::make_index_sequence<N>{});
}

template <class Model>
inline constexpr std::size_t state_count =
    std::tuple_size_v<std::remove_cvref_t<decltype(Model::states)>>;
template <class Model>
inline constexpr std::size_t input_count =
    std::tuple_size_v<std::remove_cvref_t<decltype(Model::inputs)>>;
template <class Model>
inline constexpr std::size_t channel_count =
    std::tuple_size_v<std::remove_cvref_t<decltype(Model::channels)>>;
template <class Model>
inline constexpr std::size_t constant_count =
    std::tuple_size_v<std::remove_cvref_t<decltype(Model::constants)>>;

/// The constants in the order of their declaration: `auto const& [r, K] = c;`
template <class Model, class T>
using constants_of = vec<T, constant_count<Model>>;
template <class Model, class T>
using states_of = vec<T, state_count<Model>>;
template <class Model, class T>
using inputs_of = vec<T, input_count<Model>>;
template <class Model, class T>
using channels_of = vec<T, channel_count<Model>>;

template <class Model>
inline constexpr std::size_t algebraic_count = [] {
    if constexpr (requires { Model::algebraic; }) {
        return std::tuple_size_v<std::remove_cvref_t<decltype(Model::algebraic)>>;
    } else {
        return std::size_t{0};
    }
}();
template <class Model, class T>
using algebraic_of = vec<T, algebraic_count<Model>>;
/// The right-hand side of an implicit model, and its matrix by rows.
template <class Model, class T>
using equations_of = vec<T, state_count<Model> + algebraic_count<Model>>;
template <class Model, class T>
using matrix_of = vec<equations_of<Model, T>, state_count<Model> + algebraic_count<Model>>;

/// One constant as a function of others: what `derived` of a model lists. @code
///     template <class T>
///     std::array<sivid::relation_of_constants<T>, 1> derived(constants_of<disc, T> const& c) const
///     {
///         auto const& [A, D] = c;
///         return {{{"A", atan(T(1)) * sqr(D)}}}; // pi D^2/4
///     } @endcode
/// The nominal value of such a constant is that of its formula, rounded. It stands while the data
/// state none of the constants in the formula; `parameter_choice` says when the formula takes over.
template <class T>
struct relation_of_constants {
    std::string_view constant;
    T value;
};

/// \f$ x' = f(t, x, c, u) \f$, by the member template `rate`.
template <class M>
concept explicit_model = requires(M const m, expression t, states_of<M, expression> x,
                                  constants_of<M, expression> c, inputs_of<M, expression> u) {
    { m.rate(t, x, c, u) } -> std::same_as<states_of<M, expression>>;
};

/// \f$ M(t, x, c, u) \, (x', z) = f(t, x, c, u) \f$, by the member templates `mass` and `force`:
/// equations of motion as textbooks have them, with constraints too. z are the unknowns that
/// `algebraic` lists, if any; they stand linearly, as Lagrange's multipliers do where constraints
/// are differentiated until accelerations stand in them (index 1). The equations are solved once,
/// when the model is recorded (`implicit_model.hpp`). @code
///     template <class T>
///     sivid::matrix_of<arm, T> mass(T const& t, states_of<arm, T> const& x, ...) const {
///         return {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, m11, m12}, {0, 0, m12, m22}}};
///     } @endcode
/// Where M may be singular nothing is enclosed and nothing is proved; `divisors_of` tells whether
/// it is within a prior.
template <class M>
concept implicit_model = requires(M const m, expression t, states_of<M, expression> x,
                                  constants_of<M, expression> c, inputs_of<M, expression> u) {
    { m.mass(t, x, c, u) } -> std::same_as<matrix_of<M, expression>>;
    { m.force(t, x, c, u) } -> std::same_as<equations_of<M, expression>>;
};

/// `observe`, the output \f$ y = g(t, x, c, u) \f$, or \f$ g(t, x, c, u, z) \f$.
template <class M>
concept observed_model = requires(M const m, expression t, states_of<M, expression> x,
                                  constants_of<M, expression> c, inputs_of<M, expression> u) {
    { m.observe(t, x, c, u) } -> std::same_as<channels_of<M, expression>>;
}
|| requires(M const m, expression t, states_of<M, expression> x, constants_of<M, expression> c,
            inputs_of<M, expression> u, algebraic_of<M, expression> z) {
    { m.observe(t, x, c, u, z) } -> std::same_as<channels_of<M, expression>>;
};

/// A dynamic model: its equations, explicit or implicit, and its outputs are member templates on
/// the scalar, free of side effects; `name`, `states`, `inputs`, `channels`, `constants` say what
/// the numbers mean. A further member template, `derived`, is optional: constants that are
/// functions of others. So is the unit of time, `time_unit = "ms"` for instance; else it is "s".
template <class M>
concept dynamic_model = requires {
    M::states;
    M::inputs;
    M::channels;
    M::constants;
    { M::name } -> std::convertible_to<std::string_view>;
}
&&(explicit_model<M> != implicit_model<M>)&&observed_model<M>;

/// Names and units of everything a model speaks of.
struct model_description {
    model_description();
    model_description(model_description const&);
    model_description(model_description&&) noexcept;
    model_description& operator=(model_description const&);
    model_description& operator=(model_description&&) noexcept;
    ~model_description();

    struct state {
        std::string name, unit;
        state_range limit{};    ///< own range
        std::string equation{}; ///< what its equation is called; empty: as the state
        [[nodiscard]] std::string const& equation_name() const {
            return equation.empty() ? name : equation;
        }
    };
    struct item {
        std::string name, unit;
    };
    struct constant {
        std::string name, unit;
        literal nominal;
        std::string formula{}; ///< of a derived one, in the others (`readable_formula`); else empty
    };
    std::string name;
    std::vector<state> states;
    std::vector<item> inputs;
    std::vector<item> channels;
    std::vector<constant> constants;
    std::string time_unit = "s"; ///< of t; texts of times and rates name it, data are converted
};

enum class memory_kind {
    delay, ///< by so much time, in the model's unit
    play,  ///< of this half-width, in the unit of the input (see measurement/played_signal.hpp)
    rate_limit, ///< of that, per the model's unit of time (see measurement/limited_signal.hpp)
    drift       ///< of the clock: a delay by this share of the time since the begin
};

/// Whether it moves a signal in time and changes nothing else.
[[nodiscard]] constexpr bool is_dead_time(memory_kind kind) {
    return kind == memory_kind::delay || kind == memory_kind::drift;
}

/// What depends on the past, which no graph in t, x, c, u can express: an input that acts late or
/// behind a play or a rate limit, or a channel that is seen late.
struct signal_memory {
    std::size_t index = 0;    ///< of the input or channel
    std::size_t constant = 0; ///< of its size among the model's constants, at least 0
    memory_kind kind = memory_kind::delay;
    /// A further input by which it acts in some experiments only: in those in which that is 1 (see
    /// `acts_in`); none: it acts in all. A channel is late at the times at which that is 1
    /// (`acts_at`).
    std::optional<std::size_t> only_if{};
};

/// An input that is another one once more, for a memory that acts only for a time: the model goes
/// over from one to the other.
struct input_copy {
    std::size_t copy = 0, of = 0; ///< by index among the inputs
};

/// A state that an effect brought along, with its value at the begin of an experiment.
struct added_state {
    std::size_t state = 0;
    node_id at_begin = 0; ///< a function of the inputs at the begin and the constants
};

/// A constant that the model gives as a function of others.
struct derived_constant {
    std::size_t constant = 0;
    node_id value = 0;   ///< of constants that stand in `derived` before it, or not at all
    bool always = false; ///< follows even where the data state none of those constants
};

/// The equations of an implicit model as it states them, \f$ M (x', z) = f \f$, beside the rates
/// that solve them: constants stand linearly in them that the rates have behind a determinant.
struct stated_equations {
    std::vector<std::vector<node_id>> mass; ///< by rows
    std::vector<node_id> force;
};

/// A model as data: its description and its recorded graph. From here on nothing depends on the
/// model's C++ type, so that constants, effects and variants are chosen at run time.
struct recorded_model {
    model_description about;
    graph g;
    std::vector<node_id> rate;    ///< one node a state
    std::vector<node_id> observe; ///< one node a channel
    /// The model sees input u(t - c) instead of u(t), and u at the begin before; or u behind a
    /// play. Delays of one input add up: its dead time at t is a sum of c and of c (t - begin).
    std::vector<signal_memory> input_memory;
    /// The channel at t shows its value at t - c, and the one at the begin before; likewise.
    std::vector<signal_memory> channel_delays;
    std::vector<added_state> added_states; ///< of effects (see effect.hpp)
    std::vector<input_copy> input_copies;  ///< likewise; experiments give both the same signal
    std::vector<derived_constant> derived;
    /// Of an implicit model; of no other, nor of one whose rates effects changed.
    std::optional<stated_equations> stated;

    [[nodiscard]] bool has_memory() const {
        return !input_memory.empty() || !channel_delays.empty();
    }
};

namespace model_detail {
/// What is known by its name has it alone.
/// @throws std::invalid_argument  naming two that have one
template <class Items, class Name>
void require_own_names(std::string const& whose, std::string const& what, Items const& items,
                       Name const& name_of) {
    std::set<std::string> names;
    for (auto const& i : items)
        if (!names.insert(name_of(i)).second)
            throw std::invalid_argument(whose + ": two " + what + " are called '" +
                                        std::string(name_of(i)) + "'; give each a name of its own");
}
/// The same among the states, among the inputs, the channels and the constants.
SIVID_DECL void require_own_names(model_description const& about);
/// The name, primed until it is not taken.
template <class Taken>
[[nodiscard]] std::string unused_name(std::string name, Taken const& taken) {
    while (taken(name)) name += "'";
    return name;
}
/// What a functor says of itself, as data.
/// @throws std::invalid_argument as `require_own_names`, and for a unit of time that is no unit
[[nodiscard]] SIVID_DECL model_description described(std::string_view name,
                                                     std::span<state_quantity const> states,
                                                     std::span<quantity const> inputs,
                                                     std::span<quantity const> channels,
                                                     std::span<constant_quantity const> constants,
                                                     std::string_view time_unit = "s");
/// Adds a relation between constants to a recorded model.
/// @throws std::invalid_argument when the constant is unknown, stands twice, or is no function of
///         constants before it, and when its nominal value is not what the formula gives to 0.1 %
SIVID_DECL void add_derived(recorded_model& model, std::string_view name, expression const& value);
} // namespace model_detail

namespace model_detail {
/// The leaves of a model's equations, in the graph of a recorded model.
template <class M>
struct leaves_of_model {
    expression t;
    states_of<M, expression> x;
    constants_of<M, expression> c;
    inputs_of<M, expression> u;

    explicit leaves_of_model(graph& g) {
        auto const enter = [&g]<std::size_t N>(operation op, std::array<expression, N>& out) {
            for (std::size_t i = 0; i < N; ++i) out[i] = expression(g, g.leaf(op, i));
        };
        enter(operation::state, x);
        enter(operation::constant, c);
        enter(operation::input, u);
        t = expression(g, g.leaf(operation::time, 0));
    }
};
/// A recorded model without equations.
template <class M>
[[nodiscard]] recorded_model unrecorded() {
    std::string_view time = "s";
    if constexpr (requires { M::time_unit; }) time = M::time_unit;
    recorded_model result;
    result.about =
        described(std::string_view(M::name), M::states, M::inputs, M::channels, M::constants, time);
    return result;
}
/// Adds what every model has beside its equations.
/// @param z  the algebraic unknowns
template <class M>
void record_outputs(M const& model, leaves_of_model<M> const& at,
                    algebraic_of<M, expression> const& z, recorded_model& result) {
    auto const outputs = [&] {
        if constexpr (requires { model.observe(at.t, at.x, at.c, at.u); }) {
            return model.observe(at.t, at.x, at.c, at.u);
        } else {
            return model.observe(at.t, at.x, at.c, at.u, z);
        }
    }();
    for (auto const& e : outputs) result.observe.push_back(e.in(result.g));
    if constexpr (requires { model.derived(at.c); }) {
        for (auto const& d : model.derived(at.c)) add_derived(result, d.constant, d.value);
    }
}
} // namespace model_detail

/// Runs the functor once on the recording scalar. Implicit models: implicit_model.hpp.
/// @throws std::invalid_argument  as `described`
/// @guarantee evaluating the graph with a sound interval type encloses the functor's real value.
template <dynamic_model M>
    requires explicit_model<M>
[[nodiscard]] recorded_model record_model(M const& model = {}) {
    auto result = model_detail::unrecorded<M>();
    model_detail::leaves_of_model<M> const at(result.g);
    for (auto const& e : model.rate(at.t, at.x, at.c, at.u)) result.rate.push_back(e.in(result.g));
    model_detail::record_outputs(model, at, {}, result);
    return result;
}

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/impl/model.ipp>
#endif

#endif
