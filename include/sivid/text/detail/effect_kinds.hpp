// SPDX-License-Identifier: MIT
#ifndef SIVID_TEXT_DETAIL_EFFECT_KINDS_HPP
#define SIVID_TEXT_DETAIL_EFFECT_KINDS_HPP

#include <sivid/model/effects.hpp>
#include <sivid/model/model.hpp>
#include <sivid/model/unit.hpp>

#include <array>
#include <string>
#include <vector>

namespace sivid::text_detail {

/// What a ready-made effect (`model/effects.hpp`) needs.
struct effect_request {
    std::string name;
    std::vector<std::string> of; ///< inputs, states, constants or channels
    std::string unit;            ///< of its size
    effects::range prior{};
    double limit = 0;       ///< of lags
    bool rests = false;     ///< likewise
    decimal smooth_below{}; ///< of dry friction
};

/// A ready-made effect by its name.
struct effect_kind {
    enum class target { input, state, constant, output };
    /// The unit of its size, x that of what it acts on.
    enum class size { as_x, rate_of_x, none, time, per_time, per_x_time, radian };
    char const* name;
    target on;
    size in;
    effect (*make)(effect_request const&);
    std::size_t outputs = 1;    ///< so many it acts on; 0: any number
    char const* more = nullptr; ///< a further key that it needs
};

namespace kinds {

namespace any = effects;
using r = effect_request const&;
using on = effect_kind::target;
using in = effect_kind::size;

inline constexpr std::array<effect_kind, 23> all{{
    {"input_delay", on::input, in::time,
     [](r e) { return any::input_delay(e.name, e.of[0], e.prior); }},
    {"input_clock_drift", on::input, in::none,
     [](r e) { return any::input_clock_drift(e.name, e.of[0], e.prior); }},
    {"input_dead_band", on::input, in::as_x,
     [](r e) { return any::input_dead_band(e.name, e.of[0], e.unit, e.prior); }},
    {"input_backlash", on::input, in::as_x,
     [](r e) { return any::input_backlash(e.name, e.of[0], e.unit, e.prior); }},
    {"input_rate_limit", on::input, in::rate_of_x,
     [](r e) { return any::input_rate_limit(e.name, e.of[0], e.unit, e.prior); }},
    {"input_lag", on::input, in::time,
     [](r e) { return any::input_lag(e.name, e.of[0], e.unit, e.prior, e.limit, e.rests); }, 1,
     "limit"},
    {"input_saturation", on::input, in::as_x,
     [](r e) { return any::input_saturation(e.name, e.of[0], e.unit, e.prior); }},
    {"input_trim", on::input, in::as_x,
     [](r e) { return any::input_trim(e.name, e.of[0], e.unit, e.prior); }},
    {"input_gain", on::input, in::none,
     [](r e) { return any::input_gain(e.name, e.of[0], e.prior); }},
    {"constant_rate", on::state, in::rate_of_x,
     [](r e) { return any::constant_rate(e.name, e.of[0], e.unit, e.prior); }},
    {"linear_damping", on::state, in::per_time,
     [](r e) { return any::linear_damping(e.name, e.of[0], e.prior); }},
    {"quadratic_damping", on::state, in::per_x_time,
     [](r e) { return any::quadratic_damping(e.name, e.of[0], e.unit, e.prior); }},
    {"dry_friction", on::state, in::rate_of_x,
     [](r e) { return any::dry_friction(e.name, e.of[0], e.unit, e.prior, e.smooth_below); }, 1,
     "smooth_below"},
    {"drift", on::constant, in::per_time, [](r e) { return any::drift(e.name, e.of[0], e.prior); }},
    {"sensor_bias", on::output, in::as_x,
     [](r e) { return any::sensor_bias(e.name, e.of[0], e.unit, e.prior); }},
    {"sensor_drift", on::output, in::rate_of_x,
     [](r e) { return any::sensor_drift(e.name, e.of[0], e.unit, e.prior); }},
    {"sensor_saturation", on::output, in::as_x,
     [](r e) { return any::sensor_saturation(e.name, e.of[0], e.unit, e.prior); }},
    {"sensor_rotation", on::output, in::radian,
     [](r e) { return any::sensor_rotation(e.name, e.of, e.prior); }, 2},
    {"sensor_swap", on::output, in::none,
     [](r e) { return any::sensor_swap(e.name, e.of, e.prior); }, 2},
    {"sensor_scale", on::output, in::none,
     [](r e) { return any::sensor_scale(e.name, e.of, e.prior); }, 0},
    {"sensor_latency", on::output, in::time,
     [](r e) { return any::sensor_latency(e.name, e.of, e.prior); }, 0},
    {"sensor_clock_drift", on::output, in::none,
     [](r e) { return any::sensor_clock_drift(e.name, e.of, e.prior); }, 0},
    {"sensor_lag", on::output, in::time, [](r e) { return any::sensor_lag(e.name, e.of, e.prior); },
     0},
}};

} // namespace kinds

/// The unit of its size, for what has the unit x in a model with this unit of time.
[[nodiscard]] inline std::string unit_of_size(effect_kind::size size, std::string const& x,
                                              std::string const& time) {
    switch (size) {
    case effect_kind::size::as_x:
        return x;
    case effect_kind::size::rate_of_x:
        return rate_unit(x, time);
    case effect_kind::size::time:
        return time;
    case effect_kind::size::per_time:
        return unit().times(unit(time), -1).text();
    case effect_kind::size::per_x_time:
        return unit().times(unit(x), -1).times(unit(time), -1).text();
    case effect_kind::size::radian:
        return "rad";
    default:
        return "1";
    }
}

} // namespace sivid::text_detail

#endif
