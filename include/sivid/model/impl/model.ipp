// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPL_MODEL_IPP
#define SIVID_MODEL_IMPL_MODEL_IPP

#include <sivid/model/graph/detail/formula_text.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>
#include <sivid/model/unit.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace sivid {

SIVID_DECL model_description::model_description() = default;
SIVID_DECL model_description::model_description(model_description const&) = default;
SIVID_DECL model_description::model_description(model_description&&) noexcept = default;
SIVID_DECL model_description& model_description::operator=(model_description const&) = default;
SIVID_DECL model_description& model_description::operator=(model_description&&) noexcept = default;
SIVID_DECL model_description::~model_description() = default;

SIVID_DECL void model_detail::require_own_names(model_description const& about) {
    auto const whose = "model '" + about.name + "'";
    auto const name_of = [](auto const& item) { return item.name; };
    require_own_names(whose, "states", about.states, name_of);
    require_own_names(whose, "inputs", about.inputs, name_of);
    require_own_names(whose, "channels", about.channels, name_of);
    require_own_names(whose, "constants", about.constants, name_of);
}

SIVID_DECL model_description model_detail::described(std::string_view name,
                                                     std::span<state_quantity const> states,
                                                     std::span<quantity const> inputs,
                                                     std::span<quantity const> channels,
                                                     std::span<constant_quantity const> constants,
                                                     std::string_view time_unit) {
    model_description about;
    about.name = std::string(name);
    about.time_unit = std::string(time_unit);
    auto fault = unit(time_unit).fault();
    if (fault.empty() && unit(time_unit) == unit()) fault = "times need one";
    if (!fault.empty())
        throw std::invalid_argument("model '" + about.name + "': '" + about.time_unit +
                                    "' is no unit of time: " + fault +
                                    "; write \"s\", \"ms\" or \"h\", for instance");
    for (auto const& s : states) {
        if (!(s.limit.lower <= s.limit.upper))
            throw std::invalid_argument("model '" + about.name + "': the range of the state '" +
                                        std::string(s.name) + "', from " +
                                        nearest_text(s.limit.lower) + " to " +
                                        nearest_text(s.limit.upper) + ", is empty");
        about.states.push_back(
            {std::string(s.name), std::string(s.unit), s.limit, std::string(s.equation)});
    }
    for (auto const& i : inputs) {
        about.inputs.push_back({std::string(i.name), std::string(i.unit)});
    }
    for (auto const& y : channels) {
        about.channels.push_back({std::string(y.name), std::string(y.unit)});
    }
    for (auto const& c : constants) {
        about.constants.push_back({std::string(c.name), std::string(c.unit),
                                   literal{enclose(c.nominal), nearest(c.nominal)}});
    }
    require_own_names(about);
    return about;
}

SIVID_DECL void model_detail::add_derived(recorded_model& model, std::string_view name,
                                          expression const& value) {
    auto& constants = model.about.constants;
    auto const fail = [&](std::string const& what) {
        throw std::invalid_argument("model '" + model.about.name + "': the derived constant '" +
                                    std::string(name) + "' " + what);
    };
    derived_constant d;
    while (d.constant < constants.size() && constants[d.constant].name != name) ++d.constant;
    if (d.constant == constants.size()) fail("is none of its constants");
    d.value = value.in(model.g);
    if ((model.g.depends(d.value) & ~on_constant) != 0) fail("depends on more than constants");
    for (auto const& other : model.derived) {
        if (other.constant == d.constant) fail("stands twice");
        auto const earlier = leaves_of(model.g, {other.value}, operation::constant);
        if (std::find(earlier.begin(), earlier.end(), d.constant) != earlier.end()) {
            fail("stands in the formula of '" + constants[other.constant].name +
                 "', which comes before it");
        }
    }
    std::vector<std::string> names;
    for (auto const& c : constants) names.push_back(c.name);
    graph at_nominal;
    auto const result = copy_into(at_nominal, model.g, {d.value}, [&](node const& n, graph& to) {
        auto const k = static_cast<std::size_t>(n.index);
        if (k == d.constant) fail("is a function of itself");
        return to.constant(constants[k].nominal);
    });
    constexpr double most = 1000; // parts, in which shared ones are repeated
    constants[d.constant].formula = readable_formula(model.g, d.value, {names}, most);
    double const stated = constants[d.constant].nominal.nearest;
    bool const defined = at_nominal.is_literal(result.front());
    double const given = defined ? at_nominal.value(at_nominal[result.front()]).nearest : 0;
    if (!defined || !(std::abs(given - stated) <= 1e-3 * std::abs(given))) {
        fail("is nominally " + nearest_text(stated) + ", but " + constants[d.constant].formula +
             " gives " + (defined ? nearest_text(given) : std::string{"no value"}));
    }
    model.derived.push_back(d);
}

} // namespace sivid

#endif
