// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_CANDIDATE_IMPL_WRAPPED_CHANNELS_IPP
#define SIVID_APPROXIMATE_CANDIDATE_IMPL_WRAPPED_CHANNELS_IPP

#include <sivid/approximate/candidate/detail/wrapped_channels.hpp>

#include <sivid/compiled.hpp>
#include <sivid/measurement/wrapped_readings.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/model/named_effects.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace approximate_detail {

/// Two digits, no less than x > 0.
inline std::string two_digits_above(double x) {
    int const last = static_cast<int>(std::floor(std::log10(x))) - 1;
    double const unit = std::pow(10.0, last);
    std::array<char, 400> text{};
    auto const end =
        std::to_chars(text.data(), text.data() + text.size(), std::ceil(x / unit) * unit,
                      std::chars_format::fixed, std::max(0, -last));
    return {text.data(), end.ptr};
}

} // namespace approximate_detail

SIVID_DECL std::vector<effect> with_wrapped_channels(identification_problem const& problem,
                                                     std::vector<effect> catalogue) {
    std::vector<record> records;
    for (auto const& e : problem.experiments) records.push_back(e.measurements);
    auto const& about = problem.model.about;
    for (std::size_t y = 0; y < about.channels.size(); ++y) {
        auto const& channel = about.channels[y];
        double const range = wrapping_range(records, y, full_turn(channel.unit));
        bool const known = std::any_of(catalogue.begin(), catalogue.end(), [&](effect const& e) {
            return e.wraps && e.wraps->channel == channel.name;
        });
        if (!(range > 0) || known) continue;
        auto const size = approximate_detail::two_digits_above(2 * range);
        try {
            auto fault = sensor_fault("sensor_wrap(" + channel.name + ")~" + size, &about);
            (void)affected(problem, {fault});
            catalogue.push_back(std::move(fault));
        } catch (std::logic_error const&) {
            // Its name cannot stand in one of a fault, or its turns cannot be counted.
        }
    }
    return catalogue;
}

} // namespace sivid

#endif
