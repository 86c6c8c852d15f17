// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_SCENARIO_DETAIL_OPEN_SCENARIO_HPP
#define SIVID_IMPORTING_SCENARIO_DETAIL_OPEN_SCENARIO_HPP

#include <sivid/importing/scenario/detail/quantity_import.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
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

    /// Whether samples of an input are missing before its i-th one, within the duration.
    [[nodiscard]] bool lacks(imported_quantity const& q, std::size_t i) const {
        return q.samples[i].missing > 0 && *nearest(q.samples[i].time) > 0 &&
               *nearest(q.samples[i - 1].time) < *nearest(duration);
    }
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

/// Adds to all times, and decides about samples that then coincide as doubles; users call
/// shift_times.
class time_shift {
public:
    time_shift(open_scenario& s, import_protocol& protocol)
        : s_{s},
          protocol_{protocol},
          doubled_{s.mapping->form.doubled},
          hold_{s.mapping->between == interpolation::hold} {}

    void by(exact_decimal const& offset) {
        if (hold_ && doubled_ != same_time::first) find_steps(offset);
        for (auto& q : s_.inputs) shift(q, offset, true);
        for (auto& q : s_.channels) shift(q, offset, false);
    }

private:
    static bool differ(imported_sample const& a, imported_sample const& b) {
        return !(a.reading.value == b.reading.value && a.reading.rounding == b.reading.rounding &&
                 a.error == b.error);
    }
    void drop(imported_quantity const& q, std::size_t line, char const* why) {
        protocol_.add(import_protocol::kind::dropped, q.noted_as(s_.stretch), q.mapping->name, why,
                      line);
    }
    /// The last lines in which held inputs step at a time.
    void find_steps(exact_decimal const& offset) {
        for (auto const& q : s_.inputs) {
            for (std::size_t i = 0; i < q.samples.size(); ++i) {
                if (i > 0 && !differ(q.samples[i - 1], q.samples[i])) continue;
                if (auto const t = nearest(q.samples[i].time + offset)) {
                    auto& line = steps_[{q.from, *t}];
                    line = std::max(line, q.samples[i].line);
                }
            }
        }
    }
    [[nodiscard]] bool steps_later(imported_quantity const& q, imported_sample const& reading,
                                   double t) const {
        auto const step = steps_.find({q.from, t});
        return step != steps_.end() && reading.line < step->second;
    }

    void shift(imported_quantity& q, exact_decimal const& offset, bool input) {
        std::vector<imported_sample> kept;
        std::optional<double> last;
        for (auto& sample : q.samples) {
            sample.time = sample.time + offset;
            auto const t = nearest(sample.time);
            if (!t)
                throw input_error{{.file = q.from->file.string(), .line = sample.line},
                                  "the time is beyond the range of double",
                                  "check the time's unit and offset"};
            if (!input && steps_later(q, sample, *t)) {
                drop(q, sample.line, "an input has a later sample at the same double");
                continue;
            }
            if (last && !(*last < *t)) {
                bool const other = differ(kept.back(), sample);
                if (other && doubled_ == same_time::first) {
                    drop(q, sample.line,
                         "its time is the same double as that of the one before, which counts as "
                         "the "
                         "mapping says");
                    continue;
                }
                if (other && doubled_ == same_time::refuse && !(input && hold_))
                    refuse(q, kept.back(), sample, input);
                drop(q, kept.back().line,
                     !other ? "its time is the same double as that of the next one, and so "
                              "is its reading"
                     : input && hold_
                         ? "its time is the same double as that of the next one, to "
                           "which the held input steps there"
                         : "its time is the same double as that of the next one, which "
                           "counts as the mapping says");
                sample.missing += kept.back().missing;
                sample.lost += kept.back().lost;
                kept.pop_back();
            }
            last = t;
            kept.push_back(std::move(sample));
        }
        q.samples = std::move(kept);
    }

    [[noreturn]] void refuse(imported_quantity const& q, imported_sample const& first,
                             imported_sample const& second, bool input) const {
        throw input_error{
            {.file = q.from->file.string(), .line = second.line},
            text_of(input ? "the input " : "the channel ", in_quotes(q.mapping->name),
                    " has another value in line ", std::to_string(first.line),
                    ", and the times of both lines are the same double"),
            text_of("state in the mapping's source \"lines\" if they are of two kinds, or "
                    "\"same_time\": "
                    "\"first\" or \"last\" for which of them counts",
                    input ? ", or \"interpolation\": \"hold\", which steps there" : "")};
    }

    open_scenario& s_;
    import_protocol& protocol_;
    same_time doubled_;
    bool hold_;
    std::map<std::pair<scenario_mapping const*, double>, std::size_t> steps_;
};

/// Adds to all times. Samples that then coincide as doubles are one if they say the same. Of others
/// the last counts for a held input, since it has stepped by then; readings from before the step
/// would stand beside the input after it: they are dropped, too. Else the mapping says which
/// counts.
/// @throws input_error  beyond the range of double; where it says nothing
inline void shift_times(open_scenario& s, exact_decimal const& offset, import_protocol& protocol) {
    time_shift{s, protocol}.by(offset);
}

} // namespace sivid

#endif // SIVID_IMPORTING_SCENARIO_DETAIL_OPEN_SCENARIO_HPP
