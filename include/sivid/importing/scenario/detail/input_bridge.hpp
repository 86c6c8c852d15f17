// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_SCENARIO_DETAIL_INPUT_BRIDGE_HPP
#define SIVID_IMPORTING_SCENARIO_DETAIL_INPUT_BRIDGE_HPP

#include <sivid/importing/scenario/detail/open_scenario.hpp>
#include <sivid/io/dataset_value.hpp>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// What an input lacks in all scenarios that one entry of the mapping makes.
struct missing_input {
    std::size_t samples = 0;
    exact_decimal longest; ///< from a sample to the next one [s]
    /// The samples before which others are missing: their scenario and line.
    std::vector<std::pair<open_scenario const*, std::size_t>> lines;

    missing_input(quantity_mapping const& mapping, std::vector<open_scenario> const& open) {
        for (auto const& o : open)
            for (auto const& q : o.inputs)
                if (q.mapping == &mapping) count(o, q);
    }

private:
    void count(open_scenario const& o, imported_quantity const& q) {
        for (std::size_t i = 1; i < q.samples.size(); ++i) {
            if (!o.lacks(q, i)) continue;
            samples += q.samples[i].missing;
            auto const gap = q.samples[i].time - q.samples[i - 1].time;
            if (longest < gap) longest = gap;
            lines.emplace_back(&o, q.samples[i].line);
        }
    }
};

inline void require_bridge(scenario_mapping const& s, quantity_mapping const& mapping,
                           std::vector<open_scenario> const& open, import_protocol& protocol) {
    missing_input const gaps{mapping, open};
    if (gaps.lines.empty()) return;
    std::string const stands =
        s.between == interpolation::hold ? "the reading before stands" : "a straight line stands";
    if (!mapping.bridge || *mapping.bridge < gaps.longest) {
        auto const enough = rounded_up(gaps.longest, 3).text();
        throw input_error{
            mapping.place,
            text_of(s.file.string(), ": ", std::to_string(gaps.samples),
                    gaps.samples == 1 ? " sample" : " samples", " of this input ",
                    gaps.samples == 1 ? "is" : "are", " missing, first before line ",
                    std::to_string(gaps.lines.front().second),
                    "; the longest time from a sample to the next is ", gaps.longest.text(), " s",
                    mapping.bridge ? ", longer than \"bridge\" allows" : ""),
            text_of("nobody knows what it did there: state \"bridge\": ", enough, " if ", stands,
                    " there, as all results will say, or \"bridge\": {\"longest\": ", enough,
                    ", \"error\": E} if it was within E of that")};
    }
    auto const words =
        text_of("where samples are missing ", stands, ", ",
                mapping.bridge_error
                    ? text_of("and the input is within ", mapping.bridge_error->text(), " of that")
                    : std::string{"though nobody knows what the input did"});
    for (auto const& [o, line] : gaps.lines)
        protocol.add(import_protocol::kind::assumed, s.clock ? s.name : o->stretch, mapping.name,
                     words, line);
}

/// Where samples of an input of a file are missing, nobody knows what it did there: the mapping has
/// to allow what stands there, and the protocol says so.
/// @throws input_error  where it does not
inline void require_bridges(scenario_mapping const& file, std::vector<open_scenario> const& open,
                            import_protocol& protocol) {
    for (auto const& q : file.inputs)
        if (!q.elsewhere) require_bridge(file, q, open, protocol);
}

/// Puts what stands where samples are missing into the input of a data set: with a bound as part of
/// its errors, otherwise as what is bridged.
inline void bridge(open_scenario const& s, imported_quantity const& q, dataset_input& input) {
    for (std::size_t i = 1; i < q.samples.size(); ++i) {
        if (!s.lacks(q, i)) continue;
        auto const& bound = q.mapping->bridge_error;
        if (!bound) {
            input.missing += q.samples[i].missing;
            input.bridged.emplace_back(*nearest(q.samples[i - 1].time),
                                       *nearest(q.samples[i].time));
            continue;
        }
        // Between two samples the bound runs straight from one's to the other's, or holds.
        auto const last = s.mapping->between == interpolation::hold ? i - 1 : i;
        for (auto k = i - 1; k <= last; ++k) {
            auto const there = *bound + q.samples[k].late;
            if (!(input.stated_error[k] < there)) continue;
            input.stated_error[k] = there;
            input.error[k] = upper(*enclose(there));
        }
    }
}

} // namespace sivid

#endif // SIVID_IMPORTING_SCENARIO_DETAIL_INPUT_BRIDGE_HPP
