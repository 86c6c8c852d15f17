// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPL_ENCLOSING_IPP
#define SIVID_APP_IMPL_ENCLOSING_IPP

#include <sivid/app/enclosing.hpp>

#include <sivid/app/program.hpp>
#include <sivid/enclosure/enclose.hpp>
#include <sivid/enclosure/methods.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace sivid::app {

namespace detail {

inline std::string name_of(tableau const& method) {
    auto name = method.name;
    std::replace(name.begin(), name.end(), ' ', '-');
    return name;
}

inline carried_set set_of(enclosing const& how) {
    return how.set == "taylor-model" ? carried_set::taylor_model : carried_set::doubleton;
}

/// @throws bad_request  for a method with Taylor models
inline void require_pair(enclosing const& how) {
    if (how.method != "taylor" && how.set == "taylor-model")
        throw bad_request("Taylor models follow the Taylor series alone: give --set first-order "
                          "with --method " +
                          how.method);
}

} // namespace detail

SIVID_DECL std::vector<std::string> method_names() {
    std::vector<std::string> names{"taylor"};
    for (auto const& method : shipped_methods()) names.push_back(detail::name_of(method));
    return names;
}

SIVID_DECL std::optional<tableau> method_of(enclosing const& how) {
    if (how.method == "taylor") return std::nullopt;
    for (auto const& method : shipped_methods()) {
        if (detail::name_of(method) == how.method) return method;
    }
    throw bad_request("--method: there is no method '" + how.method + "'");
}

SIVID_DECL void apply(enclosing const& how, enclosure_options& options) {
    options.method = method_of(how);
    options = for_method(std::move(options));
}

SIVID_DECL void apply(enclosing const& how, run_options& run) {
    detail::require_pair(how);
    apply(how, static_cast<enclosure_options&>(run));
    run.set = detail::set_of(how);
}

SIVID_DECL enclosed_motion enclosed(enclosing const& how, std::shared_ptr<flow const> f,
                                    box const& start, double duration, enclosure_options options) {
    detail::require_pair(how);
    apply(how, options);
    return enclose(std::move(f), start, box{}, 0, duration, detail::set_of(how), options);
}

} // namespace sivid::app

#endif
