// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_DETAIL_JOINED_EFFECTS_HPP
#define SIVID_APP_DETAIL_JOINED_EFFECTS_HPP

#include <sivid/app/detail/parameter_ranges.hpp>
#include <sivid/app/names.hpp>
#include <sivid/app/program.hpp>
#include <sivid/model/change/added_start.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/named_effects.hpp>
#include <sivid/model/parameter_choice.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace sivid::app {

/// The effects of these names. @throws bad_request  for a name that there is not
inline std::vector<effect> known_effects(std::vector<effect> const& catalogue,
                                         std::vector<std::string> const& names,
                                         model_description const& about) {
    try {
        return effects_named(catalogue, names, &about);
    } catch (std::invalid_argument const& e) {
        auto const known = names_in(catalogue);
        for (auto const& name : names) {
            if (std::find(known.begin(), known.end(), name) == known.end())
                throw bad_request(e.what() + suggestion(name, known));
        }
        throw bad_request(e.what());
    }
}

/// A model with effects that act in a scenario, and the values or ranges of their parameters there.
struct joined_effects {
    recorded_model model;
    std::map<std::string, interval> set;
};

/// Joins effects to a model as the command line tells them: "wind" with all that its prior allows,
/// or "wind=0.2" and "wind=0.1:0.3" of an effect that has one parameter.
/// @throws bad_request
inline joined_effects join_effects(recorded_model const& base, std::vector<effect> const& catalogue,
                                   std::vector<std::string> const& list) {
    joined_effects result;
    std::vector<std::string> names;
    for (auto const& text : list) names.push_back(text.substr(0, text.find('=')));
    auto const effects = known_effects(catalogue, names, base.about);
    for (std::size_t k = 0; k < effects.size(); ++k) {
        auto const& e = effects[k];
        auto const& parameters = e.parameters;
        if (!e.only_in.empty() || e.wraps)
            throw bad_request("--with " + e.name +
                              ": effects of a scenario act from its begin to its end, and wrap no "
                              "sensor");
        for (auto const& p : parameters) result.set[e.name + "." + p.name] = p.prior();
        if (names[k] == list[k]) continue;
        if (parameters.size() != 1)
            throw bad_request("--with " + e.name + ": the effect has " +
                              std::to_string(parameters.size()) +
                              " parameters; give each by --set, such as " + e.name + "." +
                              (parameters.empty() ? "k" : parameters.front().name) + "=1");
        result.set[e.name + "." + parameters.front().name] =
            ranges_from({list[k]}, "--with").begin()->second;
    }
    result.model = with(base, effects);
    return result;
}

} // namespace sivid::app

#endif
