// SPDX-License-Identifier: MIT
#include "known.hpp"
#include "catalogue.hpp"
#include "reading.hpp"

#include <algorithm>

namespace withheld {

known_fits::known_fits(label const& l, json const& baseline) {
    for (auto const* column : {"fit_base", "fit_base_best"})
        if (auto const x = l.number(column)) all_.push_back({{}, *x, {}});
    if (auto const held_by = l.held_by()) {
        known_fit at{{held_by->begin(), held_by->end()},
                     l.number("fit_true").value_or(1.0),
                     l.constants_true};
        for (std::size_t e = 0; e < held_by->size(); ++e) {
            auto const& name = (*held_by)[e];
            auto const& values = l.effects[e].second;
            auto const& parameters = effect_named(name)->parameters;
            for (std::size_t i = 0; i < values.size() && i < parameters.size(); ++i)
                at.values[name + '.' + std::string{parameters[i].name}] = values[i];
        }
        all_.push_back(at);
    }
    if (auto const base = number(member(member(baseline, "gap"), "inflation"), 1))
        all_.push_back({{}, *base, {}});
    for (auto const& c : member(baseline, "causes")) {
        auto const inflation = number(member(c, "inflation"), 1);
        if (!inflation) continue;
        known_fit found{names_in(member(c, "effects")), *inflation, {}};
        auto const parameters = member(member(c, "witness"), "parameters");
        for (auto const& [name, value] : parameters.items())
            if (value.is_number()) found.values[name] = value.get<double>();
        all_.push_back(std::move(found));
    }
}

std::optional<double> known_fits::least(names const& effects) const {
    std::optional<double> best;
    for (auto const& f : all_)
        if (includes(effects, f.effects)) best = std::min(best.value_or(f.inflation), f.inflation);
    return best;
}

} // namespace withheld
