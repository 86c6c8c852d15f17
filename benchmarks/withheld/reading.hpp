// SPDX-License-Identifier: MIT
// Reads what diagnoses say, whatever is left out.
#ifndef WITHHELD_READING_HPP
#define WITHHELD_READING_HPP

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <set>
#include <string>

namespace withheld {

using json = nlohmann::json;
using names = std::set<std::string>;

inline json member(json const& j, std::string const& key) {
    return j.is_object() && j.contains(key) ? j.at(key) : json{};
}

inline std::string text_of(json const& j) {
    return j.is_string() ? j.get<std::string>() : std::string{};
}

inline names names_in(json const& list) {
    names all;
    if (list.is_array())
        for (auto const& n : list) all.insert(n.get<std::string>());
    return all;
}

inline std::string joined(names const& all, std::string const& otherwise = "no effect") {
    std::string text;
    for (auto const& n : all) text += (text.empty() ? "" : "+") + n;
    return text.empty() ? otherwise : text;
}

inline bool includes(names const& all, names const& some) {
    return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

inline std::optional<double> number(json const& pair, std::size_t index) {
    if (!pair.is_array() || pair.size() != 2 || !pair[index].is_number()) return std::nullopt;
    return pair[index].get<double>();
}

/// [lower, upper] with null for no bound; nothing for what is no such pair.
struct bounds {
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
    bool contains(double x, double tolerance) const {
        return lower <= x + tolerance && x - tolerance <= upper;
    }
};

inline std::optional<bounds> bounds_in(json const& pair) {
    if (!pair.is_array() || pair.size() != 2) return std::nullopt;
    bounds b;
    b.lower = number(pair, 0).value_or(b.lower);
    b.upper = number(pair, 1).value_or(b.upper);
    return b;
}

/// A hull by itself, or the member of that name.
inline std::optional<bounds> hull_in(json const& j) {
    return bounds_in(j.is_object() ? member(j, "hull") : j);
}

/// A number, or the middle of an interval.
inline std::optional<double> value_in(json const& j) {
    if (j.is_number()) return j.get<double>();
    if (number(j, 0) && number(j, 1)) return (*number(j, 0) + *number(j, 1)) / 2;
    return std::nullopt;
}

/// A product of powers, {"factors": {"k": 1, "Iz": -1}}, or a sum, {"terms": {"m": 1, "dm": 1}}, at
/// some values; nothing where one of them is not known.
/// @param value_of  of a name: std::optional<double>
template <class Values>
std::optional<double> combination_in(json const& combination, Values const& value_of) {
    double product = 1, sum = 0;
    auto const factors = member(combination, "factors"), terms = member(combination, "terms");
    for (auto const& [name, exponent] : factors.items()) {
        std::optional<double> const value = value_of(name);
        if (!value) return std::nullopt;
        product *= std::pow(*value, exponent.template get<int>());
    }
    for (auto const& [name, sign] : terms.items()) {
        std::optional<double> const value = value_of(name);
        if (!value) return std::nullopt;
        sum += sign.template get<int>() * *value;
    }
    return terms.empty() ? product : sum;
}

inline std::string short_text(double x) {
    char text[40];
    std::snprintf(text, sizeof text, "%.5g", x);
    return text;
}

inline std::string text_of(bounds const& b) {
    return '[' + short_text(b.lower) + ", " + short_text(b.upper) + ']';
}

/// "yaw with r, psi"
inline std::string relation_text(json const& relation) {
    return text_of(member(relation, "equation")) + " with " +
           joined(names_in(member(relation, "sensors")));
}

/// "equation yaw, S4 from 1 to 2"
inline std::string place_text(json const& w) {
    std::string text = text_of(member(w, "kind")) + ' ' + text_of(member(w, "name"));
    if (member(w, "from").is_number() && member(w, "to").is_number())
        text += ", " + text_of(member(w, "scenario")) + " from " +
                short_text(w.at("from").get<double>()) + " to " +
                short_text(w.at("to").get<double>());
    return text;
}

} // namespace withheld

#endif
