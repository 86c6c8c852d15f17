// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_PART_INFLATION_HPP
#define SIVID_DIAGNOSIS_PART_INFLATION_HPP

#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/paving/inflation.hpp>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace sivid {

/// Called before each part with its name; false ends the list there.
using next_part = std::function<bool(std::string const&)>;

namespace diagnosis_detail {

inline std::size_t count_measurements(identification_problem const& p) {
    std::size_t count = 0;
    for (auto const& e : p.experiments) count += e.measurements.size();
    return count;
}

template <class Keep>
void add_part(identification_problem const& p, inflation_range const& whole,
              std::string const& name, Keep const& keep, inflation_options const& each,
              std::vector<named_estimate>& to) {
    auto const part = restricted_to(p, keep);
    if (part.experiments.empty()) return;
    bool const all = count_measurements(part) == count_measurements(p);
    auto const proved = all ? whole : bound_inflation(part, nullptr, each).value;
    to.push_back({name, "1", proved.upper(), proved});
}

} // namespace diagnosis_detail

/// Certified inflation of every experiment alone; no part is worse than the whole.
/// @param whole  what is proved about all of them: it holds for a part that has every measurement
[[nodiscard]] inline std::vector<named_estimate>
inflation_of_experiments(identification_problem const& p, inflation_range const& whole,
                         inflation_options const& each, next_part const& next) {
    std::vector<named_estimate> result;
    for (std::size_t s = 0; s < p.experiments.size() && next(p.experiments[s].name); ++s) {
        diagnosis_detail::add_part(
            p, whole, p.experiments[s].name,
            [s](std::size_t e, measurement const&) { return e == s; }, each, result);
    }
    return result;
}

/// Certified inflation of every channel alone, over all experiments; channels that were not
/// measured are left out.
[[nodiscard]] inline std::vector<named_estimate>
inflation_of_channels(identification_problem const& p, inflation_range const& whole,
                      inflation_options const& each, next_part const& next) {
    std::vector<named_estimate> result;
    auto const& channels = p.model.about.channels;
    for (std::size_t y = 0; y < channels.size() && next(channels[y].name); ++y) {
        diagnosis_detail::add_part(
            p, whole, channels[y].name,
            [y](std::size_t, measurement const& m) { return m.channel == y; }, each, result);
    }
    return result;
}

} // namespace sivid

#endif
