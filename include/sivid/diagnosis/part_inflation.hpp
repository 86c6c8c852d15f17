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

template <class Keep>
void add_part(identification_problem const& p, std::string const& name, Keep const& keep,
              inflation_options const& each, std::vector<named_estimate>& to) {
    auto const part = restricted_to(p, keep);
    if (part.experiments.empty()) return;
    auto const proved = bound_inflation(part, nullptr, each);
    to.push_back({name, "1", proved.value.upper(), proved.value});
}

} // namespace diagnosis_detail

/// Certified inflation of every experiment alone; no part is worse than the whole.
[[nodiscard]] inline std::vector<named_estimate>
inflation_of_experiments(identification_problem const& p, inflation_options const& each,
                         next_part const& next) {
    std::vector<named_estimate> result;
    for (std::size_t s = 0; s < p.experiments.size() && next(p.experiments[s].name); ++s) {
        diagnosis_detail::add_part(
            p, p.experiments[s].name, [s](std::size_t e, measurement const&) { return e == s; },
            each, result);
    }
    return result;
}

/// Certified inflation of every channel alone, over all experiments; channels that were not
/// measured are left out.
[[nodiscard]] inline std::vector<named_estimate>
inflation_of_channels(identification_problem const& p, inflation_options const& each,
                      next_part const& next) {
    std::vector<named_estimate> result;
    auto const& channels = p.model.about.channels;
    for (std::size_t y = 0; y < channels.size() && next(channels[y].name); ++y) {
        diagnosis_detail::add_part(
            p, channels[y].name, [y](std::size_t, measurement const& m) { return m.channel == y; },
            each, result);
    }
    return result;
}

} // namespace sivid

#endif
