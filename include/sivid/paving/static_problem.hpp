// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_PROBLEM_HPP
#define SIVID_PAVING_STATIC_PROBLEM_HPP

#include <sivid/measurement/record.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/model.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sivid {

/// A model without states: its outputs are functions of time and constants, \f$ y = g(t, c) \f$.
/// @code
///     struct decay {
///         static constexpr auto name = "decay";
///         static constexpr auto channels = sivid::channels({{"y", "1"}});
///         static constexpr auto constants = sivid::constants({{"a", "1", 1_dec}, ...});
///         template <class T>
///         sivid::channels_of<decay, T> observe(T const& t, sivid::constants_of<decay, T> const& c)
///             const;
///     }; @endcode
template <class M>
concept static_model = requires {
    M::channels;
    M::constants;
}
&&requires(M const m, expression t, constants_of<M, expression> c) {
    { M::name } -> std::convertible_to<std::string_view>;
    { m.observe(t, c) } -> std::same_as<channels_of<M, expression>>;
};

/// Runs the functor once on the recording scalar.
/// @guarantee  evaluating the graph with a sound interval type encloses the functor's real value
/// @throws std::invalid_argument  where two channels or constants have one name
template <static_model M>
[[nodiscard]] recorded_model record_static_model(M const& model = {}) {
    recorded_model result;
    result.about =
        model_detail::described(std::string_view(M::name), {}, {}, M::channels, M::constants);
    auto& g = result.g;
    constants_of<M, expression> c;
    for (std::size_t i = 0; i < c.size(); ++i) c[i] = expression(g, g.leaf(operation::constant, i));
    expression const t(g, g.leaf(operation::time, 0));
    for (auto const& e : model.observe(t, c)) result.observe.push_back(e.in(g));
    if constexpr (requires { model.derived(c); }) {
        for (auto const& d : model.derived(c))
            model_detail::add_derived(result, d.constant, d.value);
    }
    return result;
}

/// Which parameters in `prior` satisfy all measurements but `outliers` of them?
///   p is feasible when \f$ g_k(t_k, p) \in [y_k] \f$ holds for at least n - `outliers` of the n
///   measurements; where \f$ g_k \f$ is not defined, the measurement is violated.
struct static_problem {
    recorded_model model;    ///< without states and inputs
    parameter_choice choice; ///< `choice.unknown` names the sides of `prior`
    box prior;
    record measurements;
    std::size_t outliers = 0;

    /// @throws std::invalid_argument that names what does not fit
    void require_valid() const {
        auto const fail = [](std::string const& what) {
            throw std::invalid_argument("static problem: " + what);
        };
        if (!model.about.states.empty() || !model.about.inputs.empty()) {
            fail("the model has states or inputs");
        }
        model_detail::require_prior(choice, prior, fail);
        if (measurements.empty()) fail("no measurement");
        for (auto const& m : measurements) model_detail::require_reading(m, model, fail);
    }
};

} // namespace sivid

#endif
