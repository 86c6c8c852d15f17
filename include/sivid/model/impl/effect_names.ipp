// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPL_EFFECT_NAMES_IPP
#define SIVID_MODEL_IMPL_EFFECT_NAMES_IPP

#include <sivid/model/effect.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace detail {
/// A time as people write it, which reads back as the same double.
inline std::string time_text(double t) {
    std::array<char, 400> text{};
    auto const end =
        std::to_chars(text.data(), text.data() + text.size(), t, std::chars_format::fixed);
    return {text.data(), end.ptr};
}

/// @throws std::invalid_argument  where an effect begins or ends twice in one experiment
inline void require_one_episode(effect const& e) {
    auto const& in = e.only_in;
    for (auto x = in.begin(); x != in.end() && e.changes_within(); ++x)
        if (std::find(in.begin(), x, *x) != x)
            throw std::invalid_argument("effect '" + e.name + "': the experiment '" + *x +
                                        "' stands twice; one that acts in it twice is two effects");
}
} // namespace detail

SIVID_DECL effect widened(effect e) {
    e.name += detail::wider;
    if (!e.about.empty()) e.about += ", beyond the prior that was stated";
    for (auto& p : e.parameters) p.widened *= 4;
    return e;
}

SIVID_DECL effect only_within(effect e, std::vector<std::string> experiments,
                              std::vector<double> since, std::vector<double> until) {
    std::string names;
    for (std::size_t k = 0; k < experiments.size(); ++k) {
        names += (names.empty() ? "@" : "+") + experiments[k];
        if (k < since.size() && since[k] > effect::from_start)
            names += ">=" + detail::time_text(since[k]);
        if (k < until.size() && until[k] < effect::for_ever)
            names += "<" + detail::time_text(until[k]);
    }
    e.name += names;
    e.only_in = std::move(experiments);
    e.since = std::move(since);
    e.until = std::move(until);
    detail::require_one_episode(e);
    return e;
}

SIVID_DECL void require_distinct(model_description const& about,
                                 std::vector<effect> const& effects) {
    model_detail::require_own_names("model '" + about.name + "'", "effects", effects,
                                    [](effect const& e) { return e.name; });
    for (auto const& e : effects) {
        detail::require_one_episode(e);
        for (auto const& u : about.inputs)
            for (auto const& own : {e.name, e.name + ".wraps"})
                if (u.name == own)
                    throw std::invalid_argument("two inputs are called '" + own +
                                                "': one of the model, and one of the effect '" +
                                                e.name + "'; give the effect a name of its own");
    }
}

} // namespace sivid

#endif
