// SPDX-License-Identifier: MIT
#include "enclosing.hpp"
#include "generate.hpp"

#include <sivid/enclosure/enclose.hpp>
#include <sivid/enclosure/methods.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace hovercraft_example {

namespace {

std::string name_of(sivid::tableau const& method) {
    auto name = method.name;
    std::replace(name.begin(), name.end(), ' ', '-');
    return name;
}

sivid::carried_set set_of(enclosing const& how) {
    return how.set == "taylor-model" ? sivid::carried_set::taylor_model
                                     : sivid::carried_set::doubleton;
}

/// @throws bad_request  for a method with Taylor models
void require_pair(enclosing const& how) {
    if (how.method != "taylor" && how.set == "taylor-model")
        throw bad_request("Taylor models follow the Taylor series alone: give --set first-order "
                          "with --method " +
                          how.method);
}

} // namespace

std::vector<std::string> method_names() {
    std::vector<std::string> names{"taylor"};
    for (auto const& method : sivid::shipped_methods()) names.push_back(name_of(method));
    return names;
}

std::optional<sivid::tableau> method_of(enclosing const& how) {
    if (how.method == "taylor") return std::nullopt;
    for (auto const& method : sivid::shipped_methods()) {
        if (name_of(method) == how.method) return method;
    }
    throw bad_request("--method: there is no method '" + how.method + "'");
}

void apply(enclosing const& how, sivid::enclosure_options& options) {
    options.method = method_of(how);
    options = for_method(std::move(options));
}

void apply(enclosing const& how, sivid::run_options& run) {
    require_pair(how);
    apply(how, static_cast<sivid::enclosure_options&>(run));
    run.set = set_of(how);
}

sivid::enclosed_motion enclosed(enclosing const& how, std::shared_ptr<sivid::flow const> f,
                                sivid::box const& start, double duration,
                                sivid::enclosure_options options) {
    require_pair(how);
    apply(how, options);
    return sivid::enclose(std::move(f), start, sivid::box{}, 0, duration, set_of(how), options);
}

} // namespace hovercraft_example
