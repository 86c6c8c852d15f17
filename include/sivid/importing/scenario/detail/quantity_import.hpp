// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_SCENARIO_DETAIL_QUANTITY_IMPORT_HPP
#define SIVID_IMPORTING_SCENARIO_DETAIL_QUANTITY_IMPORT_HPP

#include <sivid/importing/detail/import_mapping.hpp>
#include <sivid/importing/detail/import_protocol.hpp>
#include <sivid/importing/table/detail/recorded_table.hpp>
#include <sivid/importing/table/detail/wrapped_reading.hpp>
#include <sivid/importing/table/detail/wrapping_counter.hpp>
#include <sivid/measurement/error_bound.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// A reading in the model's unit.
struct imported_sample {
    std::size_t line = 0;
    exact_decimal time; ///< [s]
    converted_reading reading;
    exact_decimal error; ///< as the column states it, in the model's unit; 0: stated elsewhere
    double raw = 0;      ///< as recorded, nearly
};

/// The readings of one input or channel.
struct imported_quantity {
    quantity_mapping const* mapping = nullptr;
    std::vector<imported_sample> samples;
};

/// What the readings say about their own error bound.
[[nodiscard]] inline error_bound_proposal proposal_for(imported_quantity const& q) {
    std::vector<double> times, values;
    for (auto const& sample : q.samples) {
        times.push_back(*nearest(sample.time));
        values.push_back(*nearest(sample.reading.value));
    }
    return propose_error_bound(times, values);
}

/// Takes one quantity out of a recorded table: possible readings, counts and angles followed beyond
/// their range, units, error bounds of a column.
class quantity_import {
public:
    quantity_import(scenario_mapping const& s, quantity_mapping const& q,
                    std::string const& scenario, import_protocol& protocol)
        : s_{s}, q_{q}, scenario_{scenario}, protocol_{protocol} {}

    /// @param cell  index of the quantity's first cell; moved on to the next quantity's
    /// @throws input_error  for a reading beyond the range of double
    [[nodiscard]] imported_quantity read(recorded_table const& table, std::size_t& cell) {
        bool const has_error = q_.error.from == bound_source::kind::column;
        imported_quantity result;
        result.mapping = &q_;
        std::optional<wrapping_counter> counter;
        if (q_.counter_bits) counter.emplace(*q_.counter_bits);
        std::optional<wrapped_reading> turns;
        if (q_.period) turns.emplace(q_.period->first, q_.period->second);
        for (auto const& row : table.rows) {
            auto raw = row.cells[cell];
            if (!raw) {
                drop(row.line, "no reading");
                continue;
            }
            if (q_.range && (*raw < q_.range->first || q_.range->second < *raw)) {
                drop(row.line, text_of("not in the possible range [", q_.range->first.text(), ", ",
                                       q_.range->second.text(), "]"));
                continue;
            }
            if (counter && !(raw = followed(*counter, *raw, row.line))) continue;
            auto bounds = std::pair{*raw, *raw};
            if (turns && !followed(*turns, bounds, row.line)) continue;
            imported_sample sample;
            sample.line = row.line;
            sample.time = row.time;
            if (has_error) {
                auto const& error = row.cells[cell + 1];
                if (!error || !error->is_positive()) {
                    drop(row.line,
                         error ? "its error bound is not above 0" : "its error bound is missing");
                    continue;
                }
                sample.error = q_.conversion.bound(*error);
            }
            auto const converted = q_.conversion(bounds.first, bounds.second);
            if (!converted || !enclose(sample.error))
                throw input_error{{.file = s_.file.string(), .line = row.line},
                                  text_of("the reading of ", in_quotes(q_.name),
                                          " is beyond the range of double"),
                                  "check its factor"};
            sample.reading = *converted;
            sample.raw = nearest(*raw).value_or(0);
            result.samples.push_back(std::move(sample));
        }
        cell += has_error ? 2 : 1;
        report(result);
        return result;
    }

private:
    using kind = import_protocol::kind;

    void drop(std::size_t line, std::string const& why) {
        protocol_.add(kind::dropped, scenario_, q_.name, why, line);
    }

    std::optional<exact_decimal> followed(wrapping_counter& counter, exact_decimal const& raw,
                                          std::size_t line) {
        auto const whole = whole_number(raw);
        auto const step = whole ? counter(*whole) : wrapping_counter::step{};
        if (!step.possible) {
            drop(line, "no count of this counter, or exactly half its range from the one before");
            return std::nullopt;
        }
        say(step, "count", line);
        return exact_decimal::parse(std::to_string(step.count));
    }
    /// @param reading  what it is for certain, then with its turns
    bool followed(wrapped_reading& turns, std::pair<exact_decimal, exact_decimal>& reading,
                  std::size_t line) {
        auto const step = nearest(reading.first) ? turns(reading.first) : wrapped_reading::step{};
        if (step.possible) {
            say(step, "reading", line);
            reading = {step.lower, step.upper};
        } else {
            drop(line, "half a period from the one before, either way, or a million periods long");
        }
        return step.possible;
    }
    template <class Step>
    void say(Step const& step, std::string const& what, std::size_t line) {
        if (step.wrapped)
            protocol_.add(kind::changed, scenario_, q_.name,
                          "the " + what +
                              " goes through the end of its range and is followed beyond it",
                          line);
        if (step.doubtful)
            protocol_.add(kind::decided, scenario_, q_.name,
                          "the " + what +
                              " moves by more than a quarter of its range at once: the shorter "
                              "way is taken",
                          line);
    }

    /// An angle that wraps, though nobody said so, would be a gap that only a diagnosis names.
    void suspect_period(imported_quantity const& result) {
        for (auto const& [period, entry] :
             {std::pair{360.0, "360"},
              {6.283185307179586, "[6.283185307179586, 6.283185307179587]"}}) {
            std::size_t jumps = 0, others = 0, line = 0;
            double low = HUGE_VAL, high = -HUGE_VAL, last = 0;
            for (auto const& s : result.samples) {
                double const now = s.raw, by = low > high ? 0 : std::abs(now - last);
                if (by > 0.9 * period && by <= period) ++jumps, line = jumps == 1 ? s.line : line;
                if (by > 0.25 * period) ++others;
                low = std::min(low, now);
                high = std::max(high, now);
                last = now;
            }
            if (jumps == 0 || others > jumps || high - low > period) continue;
            protocol_.add(kind::decided, scenario_, q_.name,
                          text_of("the reading jumps by nearly ", period > 7 ? "360" : "2 pi",
                                  ": if it is an angle that wraps, state \"period\": ", entry),
                          line);
            return;
        }
    }

    void report(imported_quantity const& result) {
        if (!q_.period && !q_.counter_bits) suspect_period(result);
        if (auto const text = q_.conversion.text(); !text.empty())
            protocol_.add(kind::changed, scenario_, q_.name,
                          text + (q_.unit.empty() ? "" : " [" + q_.unit + "]"));
        if (q_.counter_bits)
            protocol_.add(
                kind::assumed, scenario_, q_.name,
                "from one reading to the next the count moves by less than half its range");
        if (q_.period)
            protocol_.add(kind::assumed, scenario_, q_.name,
                          "from one reading to the next it moves by less than half a period");
        for (auto const& sample : result.samples)
            if (!sample.reading.rounding.is_zero()) {
                protocol_.add(
                    kind::changed, scenario_, q_.name,
                    q_.error.from == bound_source::kind::none
                        ? "converted values have no finite decimal and are rounded"
                        : "the converted value is an interval: its half width is added to "
                          "the error bound");
                break;
            }
        if (q_.error.from == bound_source::kind::none)
            protocol_.add(kind::assumed, scenario_, q_.name,
                          "the input is exact: the nearest doubles of its readings");
    }

    scenario_mapping const& s_;
    quantity_mapping const& q_;
    std::string const& scenario_;
    import_protocol& protocol_;
};

} // namespace sivid

#endif // SIVID_IMPORTING_SCENARIO_DETAIL_QUANTITY_IMPORT_HPP
