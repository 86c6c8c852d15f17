// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_GAP_DETAIL_PART_INFLATION_HPP
#define SIVID_DIAGNOSIS_GAP_DETAIL_PART_INFLATION_HPP

#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/paving/inflation.hpp>

#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Called before each part with its name, by one thread at a time; false ends the list there.
using next_part = std::function<bool(std::string const&)>;

namespace diagnosis_detail {

/// @param names    one for each part
/// @param belongs  (part, experiment, measurement): whether it is one of the part's. Parts without
///                 any are left out.
template <class Names, class Belongs>
[[nodiscard]] std::vector<named_estimate>
inflation_of_parts(identification_problem const& p, inflation_range const& whole,
                   Names const& names, Belongs const& belongs, inflation_options const& each,
                   next_part const& next) {
    std::vector<std::pair<std::string, identification_problem>> parts;
    for (std::size_t k = 0; k < names.size(); ++k) {
        auto part =
            restricted_to(p, [&](std::size_t e, measurement const& m) { return belongs(k, e, m); });
        if (!part.experiments.empty()) parts.emplace_back(names[k].name, std::move(part));
    }
    std::vector<std::optional<named_estimate>> found(parts.size());
    std::mutex asking;
    bool stopped = false;
    each.test.workers(parts.size(), [&](std::size_t k) {
        auto const& [name, part] = parts[k];
        {
            std::lock_guard const alone(asking);
            stopped = stopped || !next(name);
            if (stopped) return;
        }
        bool const all = measurement_count(part) == measurement_count(p);
        auto const proved = all ? whole : bound_inflation(part, nullptr, each).value;
        found[k] = named_estimate{name, "1", proved.upper(), proved};
    });
    std::vector<named_estimate> result;
    for (auto& f : found) {
        if (!f) break;
        result.push_back(std::move(*f));
    }
    return result;
}

} // namespace diagnosis_detail

/// Certified inflation of every experiment alone; no part is worse than the whole.
/// @param whole  what is proved about all of them: it holds for a part that has every measurement
[[nodiscard]] inline std::vector<named_estimate>
inflation_of_experiments(identification_problem const& p, inflation_range const& whole,
                         inflation_options const& each, next_part const& next) {
    return diagnosis_detail::inflation_of_parts(
        p, whole, p.experiments,
        [](std::size_t k, std::size_t e, measurement const&) { return e == k; }, each, next);
}

/// Certified inflation of every channel alone, over all experiments; channels that were not
/// measured are left out.
[[nodiscard]] inline std::vector<named_estimate>
inflation_of_channels(identification_problem const& p, inflation_range const& whole,
                      inflation_options const& each, next_part const& next) {
    return diagnosis_detail::inflation_of_parts(
        p, whole, p.model.about.channels,
        [](std::size_t k, std::size_t, measurement const& m) { return m.channel == k; }, each,
        next);
}

} // namespace sivid

#endif
