// SPDX-License-Identifier: MIT
// Faults of instruments by name: "lagging_uv" is a low-pass in the instrument of u and v.
#ifndef WITHHELD_INSTRUMENTS_HPP
#define WITHHELD_INSTRUMENTS_HPP

#include "craft.hpp"
#include "random.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace withheld {

/// The channels of a group: "uv", "xy", or one channel's name; none for an unknown one.
std::vector<std::size_t> channels_of(std::string_view group);

/// What stands behind the underscore of lagging_, late_, drift_, askew_, lever_, bounds_,
/// jitter_, growing_ or slow_; empty for other names.
std::string instrument_of(std::string_view name);
/// Of these the last three: noise that is larger than its bound.
bool is_noise(std::string_view name);

/// Kinds that are drawn: of the family askew, of the family instrument.
std::vector<std::string_view> const& askew_kinds();
std::vector<std::string_view> const& instrument_kinds();

/// @returns false for a name that is no fault of an instrument
/// @throws std::out_of_range where a value is missing
bool set_instrument(instrument_faults& all, std::string const& name,
                    std::vector<double> const& values);

/// Values of a normal size for a kind, as many as `set_instrument` wants.
std::vector<double> draw_instrument(std::string_view kind, random_source& random);

/// A fault that a diagnosis names, such as "sensor_lag(u:v)~0.5".
struct named_fault {
    std::string kind;                     // "sensor_lag"
    std::vector<std::string> in_brackets; // channels, then perhaps a state
    std::vector<std::string> parameters;  // full names

    std::vector<std::size_t> channels() const;
};

/// Nothing for other names, and for faults that do not act everywhere.
std::optional<named_fault> fault_in(std::string const& name);

/// What the fault is called where it is drawn: "lagging_uv". Other names as they are.
std::string drawn_name(std::string const& name);

/// The parameters of a fault, by their full names, for the values of one that is drawn under its
/// `drawn_name`.
std::map<std::string, double> fault_values(named_fault const& f, std::vector<double> const& drawn);

/// @param value  of a parameter by its full name
/// @returns  false for a kind that is not simulated, or where a value is missing
bool set_fault(instrument_faults& all, named_fault const& f,
               std::function<std::optional<double>(std::string const&)> const& value);

} // namespace withheld

#endif
