// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_SCENARIO_DETAIL_OPEN_SCENARIO_HPP
#define SIVID_IMPORTING_SCENARIO_DETAIL_OPEN_SCENARIO_HPP

#include <sivid/importing/scenario/detail/quantity_import.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// A scenario whose proposed error bounds are still open.
struct open_scenario {
    std::string name;
    std::string stretch; ///< its notes carry this name; differs from `name` for a window
    scenario_mapping const* mapping = nullptr;
    scenario_role role = scenario_role::fit;
    bool after_break = false; ///< not of the first stretch of its log
    exact_decimal begin;      ///< on the time axis of the stretch; 0 unless it is a window
    exact_decimal duration;
    std::vector<imported_quantity> inputs, channels; ///< in the order of the mapping
    std::size_t first_line = 0, last_line = 0, rows = 0;

    /// Of the readings of a channel, every k-th is kept, as it is.
    [[nodiscard]] std::size_t kept(imported_quantity const& q) const {
        return (q.samples.size() + mapping->thin - 1) / mapping->thin;
    }
    [[nodiscard]] std::size_t measurement_count() const {
        std::size_t count = 0;
        for (auto const& q : channels) count += kept(q);
        return count;
    }
    /// Readings of all channels, before thinning.
    [[nodiscard]] std::size_t reading_count() const {
        std::size_t count = 0;
        for (auto const& q : channels) count += q.samples.size();
        return count;
    }
};

/// Adds to all times. Of samples that then coincide as doubles the last counts, since a held input
/// has stepped by then. Readings from before the step would stand beside the input after it: they
/// are dropped, too.
/// @throws input_error  beyond the range of double; where a linear input has two values at one time
inline void shift_times(open_scenario& s, exact_decimal const& offset, import_protocol& protocol) {
    bool const hold = s.mapping->between == interpolation::hold;
    auto const differ = [](imported_sample const& a, imported_sample const& b) {
        return !(a.reading.value == b.reading.value && a.reading.rounding == b.reading.rounding &&
                 a.error == b.error);
    };
    auto const steps_later = [&](imported_sample const& reading, double t) {
        return std::any_of(s.inputs.begin(), s.inputs.end(), [&](imported_quantity const& input) {
            auto const next = std::upper_bound(
                input.samples.begin(), input.samples.end(), reading.line,
                [](std::size_t line, imported_sample const& x) { return line < x.line; });
            return next != input.samples.end() && *nearest(next->time) == t;
        });
    };
    for (auto* list : {&s.inputs, &s.channels})
        for (auto& q : *list) {
            bool const input = list == &s.inputs;
            auto const drop = [&](std::size_t line, char const* why) {
                protocol.add(import_protocol::kind::dropped, s.stretch, q.mapping->name, why, line);
            };
            std::vector<imported_sample> kept;
            std::optional<double> last;
            for (auto& sample : q.samples) {
                sample.time = sample.time + offset;
                auto const t = nearest(sample.time);
                if (!t)
                    throw input_error{{.file = s.mapping->file.string(), .line = sample.line},
                                      "the time is beyond the range of double",
                                      "check the time's unit and offset"};
                if (!input && hold && steps_later(sample, *t)) {
                    drop(sample.line, "an input has a later sample at the same double");
                    continue;
                }
                if (last && !(*last < *t)) {
                    if (input && !hold && differ(kept.back(), sample))
                        throw input_error{
                            {.file = s.mapping->file.string(), .line = sample.line},
                            text_of("the input ", in_quotes(q.mapping->name),
                                    " has another value in line ", std::to_string(kept.back().line),
                                    ", and the times of both lines are the same double"),
                            "remove one of the lines, or state \"interpolation\": \"hold\", which "
                            "steps there"};
                    drop(kept.back().line, "its time is the same double as that of the next one");
                    kept.pop_back();
                }
                last = t;
                kept.push_back(std::move(sample));
            }
            q.samples = std::move(kept);
        }
}

} // namespace sivid

#endif // SIVID_IMPORTING_SCENARIO_DETAIL_OPEN_SCENARIO_HPP
