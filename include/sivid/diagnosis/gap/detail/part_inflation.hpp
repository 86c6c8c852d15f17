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

inline std::size_t count_measurements(identification_problem const& p) {
    std::size_t count = 0;
    for (auto const& e : p.experiments) count += e.measurements.size();
    return count;
}

struct named_part {
    std::string name;
    identification_problem problem;
};

inline std::vector<named_estimate> inflation_of_parts(identification_problem const& p,
                                                      inflation_range const& whole,
                                                      std::vector<named_part> const& parts,
                                                      inflation_options const& each,
                                                      next_part const& next) {
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
        bool const all = count_measurements(part) == count_measurements(p);
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
    std::vector<diagnosis_detail::named_part> parts;
    for (std::size_t s = 0; s < p.experiments.size(); ++s) {
        auto part = restricted_to(p, [s](std::size_t e, measurement const&) { return e == s; });
        if (!part.experiments.empty()) parts.push_back({p.experiments[s].name, std::move(part)});
    }
    return diagnosis_detail::inflation_of_parts(p, whole, parts, each, next);
}

/// Certified inflation of every channel alone, over all experiments; channels that were not
/// measured are left out.
[[nodiscard]] inline std::vector<named_estimate>
inflation_of_channels(identification_problem const& p, inflation_range const& whole,
                      inflation_options const& each, next_part const& next) {
    std::vector<diagnosis_detail::named_part> parts;
    auto const& channels = p.model.about.channels;
    for (std::size_t y = 0; y < channels.size(); ++y) {
        auto part =
            restricted_to(p, [y](std::size_t, measurement const& m) { return m.channel == y; });
        if (!part.experiments.empty()) parts.push_back({channels[y].name, std::move(part)});
    }
    return diagnosis_detail::inflation_of_parts(p, whole, parts, each, next);
}

} // namespace sivid

#endif
