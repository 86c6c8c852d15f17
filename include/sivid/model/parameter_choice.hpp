// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_PARAMETER_CHOICE_HPP
#define SIVID_MODEL_PARAMETER_CHOICE_HPP

#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace sivid {

/// Index of `name` in a list of named things.
/// @throws std::invalid_argument that names what exists
template <class Items>
[[nodiscard]] std::size_t index_of(Items const& items, std::string const& wanted,
                                   std::string const& kind) {
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (items[i].name == wanted) return i;
    }
    throw std::invalid_argument("unknown " + kind + " '" + wanted +
                                "'; known: " + joined_names(items));
}

/// Which constants are unknown, and the values of those that differ from the model's nominal ones.
///   A derived constant (`recorded_model::derived`) that is neither follows its formula as soon as
///   one of the constants in it is unknown, fixed, or follows a formula itself; it is nominal while
///   all of them are. One that is unknown or fixed is what the choice says, whatever its formula.
struct parameter_choice {
    std::vector<std::string> unknown;      ///< names; their order is the order of the parameters
    std::map<std::string, interval> fixed; ///< overrides

    [[nodiscard]] bool states(std::string const& constant) const {
        return fixed.count(constant) > 0 ||
               std::find(unknown.begin(), unknown.end(), constant) != unknown.end();
    }
};

/// The derived constants that follow their formulas, of those in `model.derived`, in their order.
[[nodiscard]] inline std::vector<derived_constant> followed(recorded_model const& model,
                                                            parameter_choice const& choice) {
    auto const& constants = model.about.constants;
    std::vector<bool> moved(constants.size());
    for (std::size_t k = 0; k < moved.size(); ++k) moved[k] = choice.states(constants[k].name);
    std::vector<derived_constant> result;
    for (auto const& d : model.derived) {
        if (moved[d.constant]) continue;
        auto const of = leaves_of(model.g, {d.value}, operation::constant);
        if (!d.always && std::none_of(of.begin(), of.end(), [&](auto k) { return moved[k]; }))
            continue;
        moved[d.constant] = true;
        result.push_back(d);
    }
    return result;
}

/// A delay, a play or a rate limit may not follow from other constants: what remembers would not
/// know.
/// @throws std::invalid_argument that names it
inline void require_own_memory(recorded_model const& model, parameter_choice const& choice) {
    for (auto const& d : followed(model, choice))
        for (auto const* all : {&model.input_memory, &model.channel_delays})
            for (auto const& m : *all)
                if (m.constant == d.constant)
                    throw std::invalid_argument("'" + model.about.constants[d.constant].name +
                                                "' is a delay or a play: it cannot follow from "
                                                "other constants");
}

/// What a choice makes of the derived constants, in sentences; those that stay nominal need none.
[[nodiscard]] inline std::vector<std::string> derivation_words(recorded_model const& model,
                                                               parameter_choice const& choice) {
    auto const& constants = model.about.constants;
    std::vector<std::string> words;
    auto const in_force = followed(model, choice);
    for (auto const& d : model.derived) {
        auto const& c = constants[d.constant];
        if (choice.states(c.name)) {
            words.push_back(c.name + " is taken as it is stated, whatever the model's " + c.name +
                            " = " + c.formula + ".");
        } else if (std::any_of(in_force.begin(), in_force.end(), [&](derived_constant const& f) {
                       return f.constant == d.constant;
                   })) {
            words.push_back(c.name + " follows from the others: " + c.name + " = " + c.formula +
                            ".");
        }
    }
    return words;
}

/// Encloses every constant of the model, for all parameters in `prior`: derived ones by natural
/// interval evaluation.
/// @throws std::domain_error where a derived constant may be undefined
[[nodiscard]] inline std::vector<interval>
constant_ranges(recorded_model const& model, parameter_choice const& choice, box const& prior) {
    auto const& constants = model.about.constants;
    std::vector<interval> ranges;
    for (auto const& c : constants) ranges.push_back(c.nominal.enclosure);
    for (auto const& [name, value] : choice.fixed) {
        ranges[index_of(constants, name, "constant")] = value;
    }
    for (std::size_t j = 0; j < choice.unknown.size(); ++j) {
        ranges[index_of(constants, choice.unknown[j], "constant")] = prior[j];
    }
    for (auto const& d : followed(model, choice)) {
        graph g; // each leaf is an interval, so that the whole folds to a literal
        auto const value = copy_into(g, model.g, {d.value}, [&](node const& n, graph& to) {
            auto const& range = ranges[static_cast<std::size_t>(n.index)];
            return to.constant(literal{range, mid(range)});
        });
        if (!g.is_literal(value.front())) {
            throw std::domain_error("the constant '" + constants[d.constant].name + "' = " +
                                    constants[d.constant].formula + " is not defined everywhere");
        }
        ranges[d.constant] = g.value(g[value.front()]).enclosure;
    }
    return ranges;
}

} // namespace sivid

#endif
