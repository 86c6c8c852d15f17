// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_GAP_DETAIL_COARSE_STEPS_HPP
#define SIVID_DIAGNOSIS_GAP_DETAIL_COARSE_STEPS_HPP

#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/diagnosis/gap/detail/confined_gap.hpp>
#include <sivid/measurement/quantisation.hpp>
#include <sivid/model/problem.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace sivid {

/// The steps that all readings of a channel come in, where none of the bounds of a part of it grows
/// by more than half a step, or a whole one. Of fewer than ten readings, or four values, any step
/// is chance.
/// @param grown  the problem with larger bounds of the part
/// @given  the part is of one channel
/// @guarantee  with bounds that are so much wider, at least what `grown` allows is allowed
[[nodiscard]] inline std::optional<reading_steps>
coarse_steps(identification_problem const& p, data_part const& part,
             identification_problem const& grown) {
    constexpr std::size_t least = 10, different = 4;
    std::vector<double> readings;
    for (auto const& e : p.experiments)
        for (auto const& m : e.measurements)
            if (m.channel == *part.channel) readings.push_back(mid(m.bound));
    if (readings.size() < least || distinct_count(readings, different) < different)
        return std::nullopt;
    double const step = quantisation_step(readings);
    for (bool const cut_off : {false, true}) {
        double const more = cut_off ? step : step / 2;
        auto const by = bound_growth::of(p, part, [more](auto, auto) { return more; });
        if (more > 0 && by.between(p, grown) <= 1)
            return reading_steps{step, p.model.about.channels[*part.channel].unit, cut_off};
    }
    return std::nullopt;
}

} // namespace sivid

#endif
