// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPL_EFFECTS_IPP
#define SIVID_MODEL_IMPL_EFFECTS_IPP

#include <sivid/model/effects.hpp>

#include <stdexcept>

namespace sivid::effects {

namespace detail {

SIVID_DECL effect one(std::string name, std::string parameter, std::string unit, range const& prior,
                      std::string about, int order, decimal neutral) {
    effect e;
    e.name = std::move(name);
    e.parameters = {{std::move(parameter), std::move(unit), prior.lower, prior.upper, neutral}};
    e.order = order;
    e.about = std::move(about);
    return e;
}

/// The same, for a parameter whose unit is the model's unit of time to a power.
inline effect time(std::string name, std::string parameter, int power, range const& prior,
                   std::string about, int order = 0) {
    auto e = one(std::move(name), std::move(parameter), "1", prior, std::move(about), order);
    e.parameters.front().time_power = power;
    return e;
}

inline void need_two(std::vector<std::string> const& channels, char const* what,
                     std::string const& name) {
    if (channels.size() != 2)
        throw std::invalid_argument(std::string(what) + " '" + name + "': needs two channels");
}
inline std::string all_of(std::vector<std::string> const& channels) {
    auto text = channels.at(0);
    for (std::size_t k = 1; k < channels.size(); ++k) {
        text += (k + 1 < channels.size() ? ", " : " and ") + channels[k];
    }
    return text;
}

} // namespace detail

SIVID_DECL effect input_delay(std::string const& name, std::string const& input, range const& tau) {
    auto e = detail::time(name, "tau", 1, tau, "pure delay of the input " + input, 0);
    e.on_inputs = [input](effect_scope& m) { m.remember(input, memory_kind::delay); };
    return e;
}

SIVID_DECL effect input_clock_drift(std::string const& name, std::string const& input,
                                    range const& r) {
    auto e = detail::one(name, "r", "1", r, "clock of the input " + input + " that runs slow", 0);
    e.on_inputs = [input](effect_scope& m) { m.remember(input, memory_kind::drift); };
    return e;
}

SIVID_DECL effect input_dead_band(std::string const& name, std::string const& input,
                                  std::string const& unit, range const& b) {
    auto e = detail::one(name, "b", unit, b, "dead band of the input " + input, 1);
    e.on_inputs = [input](effect_scope& m) {
        m.input(input) = deadband(m.input(input), m.parameter());
    };
    e.threshold = {input, false};
    return e;
}

SIVID_DECL effect input_backlash(std::string const& name, std::string const& input,
                                 std::string const& unit, range const& b) {
    auto e = detail::one(name, "b", unit, b, "backlash behind the input " + input, 0);
    e.on_inputs = [input](effect_scope& m) { m.remember(input, memory_kind::play); };
    return e;
}

SIVID_DECL effect input_rate_limit(std::string const& name, std::string const& input,
                                   std::string const& unit, range const& R) {
    if (!(nearest(R.lower) > 0))
        throw std::invalid_argument("input_rate_limit '" + name + "': the prior of R is above 0");
    auto e = detail::one(name, "R", unit, R, "rate limit of the input " + input, 0, R.upper);
    e.on_inputs = [input](effect_scope& m) { m.remember(input, memory_kind::rate_limit); };
    return e;
}

SIVID_DECL effect input_lag(std::string const& name, std::string const& input,
                            std::string const& unit, range const& tau, double limit, bool rests) {
    auto e = detail::time(name, "tau", 1, tau, "first-order lag of the input " + input, 2);
    e.on_inputs = [input, unit, limit, rests, name](effect_scope& m) {
        auto& u = m.input(input);
        auto const d = m.add_state(name + "." + input, unit, limit, rests ? expression(0) : u);
        m.rate(name + "." + input) = (u - d) / m.parameter();
        u = d;
    };
    e.lags = effect::first_order_lag{input, rests};
    return e;
}

SIVID_DECL effect input_saturation(std::string const& name, std::string const& input,
                                   std::string const& unit, range const& lim) {
    auto e = detail::one(name, "lim", unit, lim, "saturation of the input " + input, 3, lim.upper);
    e.on_inputs = [input](effect_scope& m) {
        m.input(input) = saturate(m.input(input), -m.parameter(), m.parameter());
    };
    e.threshold = {input, true};
    return e;
}

SIVID_DECL effect input_trim(std::string const& name, std::string const& input,
                             std::string const& unit, range const& d0) {
    auto e = detail::one(name, "d0", unit, d0, "constant offset of the input " + input, 4);
    e.on_inputs = [input](effect_scope& m) { m.input(input) += m.parameter(); };
    return e;
}

SIVID_DECL effect input_gain(std::string const& name, std::string const& input, range const& k) {
    auto e = detail::one(name, "k", "1", k, "wrong gain of the input " + input, 4);
    e.on_inputs = [input](effect_scope& m) { m.input(input) *= 1 + m.parameter(); };
    return e;
}

SIVID_DECL effect constant_rate(std::string const& name, std::string const& state,
                                std::string const& unit, range const& a) {
    auto e = detail::one(name, "a", unit, a, "constant in the equation of " + state);
    e.on_rates = [state](effect_scope& m) { m.rate(state) += m.parameter(); };
    return e;
}

SIVID_DECL effect linear_damping(std::string const& name, std::string const& state,
                                 range const& k) {
    auto e = detail::time(name, "k", -1, k, "linear damping in the equation of " + state);
    e.on_rates = [state](effect_scope& m) { m.rate(state) -= m.parameter() * m.state(state); };
    return e;
}

SIVID_DECL effect quadratic_damping(std::string const& name, std::string const& state,
                                    std::string const& unit, range const& k) {
    auto e = detail::one(name, "k", unit, k, "quadratic damping in the equation of " + state);
    e.on_rates = [state](effect_scope& m) {
        auto const& x = m.state(state);
        m.rate(state) -= m.parameter() * abs(x) * x;
    };
    return e;
}

SIVID_DECL effect dry_friction(std::string const& name, std::string const& state,
                               std::string const& unit, range const& k, decimal smooth_below) {
    auto e = detail::one(name, "k", unit, k, "dry friction in the equation of " + state);
    e.on_rates = [state, smooth_below](effect_scope& m) {
        auto const& x = m.state(state);
        auto const direction =
            nearest(smooth_below) == 0 ? sign(x) : x / sqrt(sqr(x) + sqr(expression(smooth_below)));
        m.rate(state) -= m.parameter() * direction;
    };
    return e;
}

SIVID_DECL effect end_stop(std::string const& name, std::string const& position,
                           std::string const& velocity, std::string const& unit, range const& k,
                           decimal stop, stop_side side) {
    auto e = detail::one(name, "k", unit, k, "contact of " + position + " with an end stop");
    e.on_rates = [position, velocity, stop, side](effect_scope& m) {
        auto const above = m.state(position) - expression(stop);
        expression const none = 0_dec;
        if (side == stop_side::lower) {
            m.rate(velocity) += m.parameter() * max(-above, none);
        } else {
            m.rate(velocity) -= m.parameter() * max(above, none);
        }
    };
    return e;
}

SIVID_DECL effect stribeck_friction(std::string const& name, std::string const& state,
                                    std::string const& unit, range const& k, range const& s,
                                    decimal fades_above, decimal smooth_below) {
    auto e = detail::one(name, "k", unit, k, "Stribeck friction in the equation of " + state);
    e.parameters.push_back({"s", unit, s.lower, s.upper, {}});
    e.on_rates = [state, fades_above, smooth_below](effect_scope& m) {
        auto const& x = m.state(state);
        auto const friction =
            m.parameter(0) + m.parameter(1) * exp(-sqr(x / expression(fades_above)));
        m.rate(state) -= friction * x / sqrt(sqr(x) + sqr(expression(smooth_below)));
    };
    return e;
}

SIVID_DECL effect lugre_friction(std::string const& name, std::string const& state,
                                 std::string const& unit, range const& k, range const& r,
                                 decimal fades_above, decimal bends, decimal damping) {
    auto e = detail::one(name, "k", unit, k, "LuGre friction in the equation of " + state);
    e.parameters.push_back({"r", "1", r.lower, r.upper, {}});
    auto const bristles = name + ".z";
    e.on_inputs = [bristles, most = 1 + nearest(r.upper)](effect_scope& m) {
        m.add_state(bristles, "1", most, expression(0));
    };
    e.on_rates = [state, bristles, fades_above, bends, damping](effect_scope& m) {
        auto const x = m.state(state), z = m.state(bristles);
        auto const g = 1 + m.parameter(1) * exp(-sqr(x / expression(fades_above)));
        m.rate(bristles) = (x - abs(x) * z / g) / expression(bends);
        m.rate(state) -= m.parameter(0) * (z + expression(damping) * m.rate(bristles));
    };
    return e;
}

SIVID_DECL effect drift(std::string const& name, std::string const& constant, range const& k) {
    auto e = detail::time(name, "k", -1, k, "slow drift of the constant " + constant);
    e.on_inputs = [constant](effect_scope& m) {
        m.constant(constant) *= 1 + m.parameter() * m.time();
    };
    return e;
}

SIVID_DECL effect sensor_bias(std::string const& name, std::string const& channel,
                              std::string const& unit, range const& b) {
    auto e = detail::one(name, "b", unit, b, "bias of the sensor " + channel);
    e.on_channels = [channel](effect_scope& m) { m.channel(channel) += m.parameter(); };
    return e;
}

SIVID_DECL effect sensor_drift(std::string const& name, std::string const& channel,
                               std::string const& unit, range const& d) {
    auto e = detail::one(name, "d", unit, d, "drift of the sensor " + channel);
    e.on_channels = [channel](effect_scope& m) { m.channel(channel) += m.parameter() * m.time(); };
    return e;
}

SIVID_DECL effect sensor_saturation(std::string const& name, std::string const& channel,
                                    std::string const& unit, range const& lim) {
    auto e =
        detail::one(name, "lim", unit, lim, "saturation of the sensor " + channel, 1, lim.upper);
    e.on_channels = [channel](effect_scope& m) {
        m.channel(channel) = saturate(m.channel(channel), -m.parameter(), m.parameter());
    };
    return e;
}

SIVID_DECL effect sensor_wrap(std::string const& name, std::string const& channel,
                              std::string const& unit, range const& T, double least) {
    auto e = detail::one(name, "T", unit, T, "wrapping of the sensor " + channel, 2);
    e.on_channels = [channel](effect_scope& m) { m.channel(channel) -= m.parameter() * m.wraps(); };
    e.wraps = {channel, least};
    return e;
}

SIVID_DECL effect sensor_rotation(std::string const& name, std::vector<std::string> const& channels,
                                  range const& a) {
    detail::need_two(channels, "sensor_rotation", name);
    auto e = detail::one(name, "a", "rad", a,
                         "rotation of the instrument of " + detail::all_of(channels));
    e.on_channels = [channels](effect_scope& m) {
        auto const y = m.channel(channels[0]), z = m.channel(channels[1]);
        auto const c = cos(m.parameter()), s = sin(m.parameter());
        m.channel(channels[0]) = c * y - s * z;
        m.channel(channels[1]) = s * y + c * z;
    };
    return e;
}

SIVID_DECL effect sensor_lever_arm(std::string const& name,
                                   std::vector<std::string> const& channels,
                                   std::string const& heading, std::string const& unit,
                                   range const& arm) {
    detail::need_two(channels, "sensor_lever_arm", name);
    auto e = detail::one(name, "a", unit, arm,
                         "lever arm of the instrument of " + detail::all_of(channels));
    e.parameters.push_back({"b", unit, arm.lower, arm.upper, {}});
    e.on_channels = [channels, heading](effect_scope& m) {
        auto const c = cos(m.state(heading)), s = sin(m.state(heading));
        m.channel(channels[0]) += c * m.parameter(0) - s * m.parameter(1);
        m.channel(channels[1]) += s * m.parameter(0) + c * m.parameter(1);
    };
    return e;
}

SIVID_DECL effect sensor_velocity_arm(std::string const& name,
                                      std::vector<std::string> const& channels,
                                      std::string const& turning, std::string const& unit,
                                      range const& arm) {
    detail::need_two(channels, "sensor_velocity_arm", name);
    auto e = detail::one(name, "a", unit, arm,
                         "lever arm of the instrument of " + detail::all_of(channels));
    e.parameters.push_back({"b", unit, arm.lower, arm.upper, {}});
    e.on_channels = [channels, turning](effect_scope& m) {
        m.channel(channels[0]) -= m.parameter(1) * m.state(turning);
        m.channel(channels[1]) += m.parameter(0) * m.state(turning);
    };
    return e;
}

SIVID_DECL effect sensor_swap(std::string const& name, std::vector<std::string> const& channels,
                              range const& k) {
    detail::need_two(channels, "sensor_swap", name);
    auto e = detail::one(name, "k", "1", k, detail::all_of(channels) + " are mixed");
    e.on_channels = [channels](effect_scope& m) {
        auto const more = m.parameter() * (m.channel(channels[1]) - m.channel(channels[0]));
        m.channel(channels[0]) += more;
        m.channel(channels[1]) -= more;
    };
    return e;
}

SIVID_DECL effect sensor_scale(std::string const& name, std::vector<std::string> const& channels,
                               range const& k) {
    auto e =
        detail::one(name, "k", "1", k, "wrong scale of the sensor " + detail::all_of(channels));
    e.on_channels = [channels](effect_scope& m) {
        for (auto const& y : channels) m.channel(y) *= 1 + m.parameter();
    };
    return e;
}

SIVID_DECL effect sensor_latency(std::string const& name, std::vector<std::string> const& channels,
                                 range const& tau) {
    auto e = detail::time(name, "tau", 1, tau, "latency of the sensor " + detail::all_of(channels));
    e.on_channels = [channels](effect_scope& m) {
        for (auto const& y : channels) m.show_late(y, memory_kind::delay);
    };
    return e;
}

SIVID_DECL effect sensor_clock_drift(std::string const& name,
                                     std::vector<std::string> const& channels, range const& r) {
    auto e = detail::one(name, "r", "1", r,
                         "clock of the sensor " + detail::all_of(channels) + " that runs slow");
    e.on_channels = [channels](effect_scope& m) {
        for (auto const& y : channels) m.show_late(y, memory_kind::drift);
    };
    return e;
}

SIVID_DECL effect sensor_lag(std::string const& name, std::vector<std::string> const& channels,
                             range const& tau) {
    auto e = detail::time(name, "tau", 1, tau, "lag of the sensor " + detail::all_of(channels), -1);
    e.on_channels = [channels](effect_scope& m) {
        for (auto const& y : channels) m.lag_channel(y);
    };
    e.lags = effect::first_order_lag{};
    return e;
}

} // namespace sivid::effects

#endif
