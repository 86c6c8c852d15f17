// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_SCENARIO_DETAIL_QUANTITY_IMPORT_HPP
#define SIVID_IMPORTING_SCENARIO_DETAIL_QUANTITY_IMPORT_HPP

#include <sivid/importing/detail/import_mapping.hpp>
#include <sivid/importing/detail/import_protocol.hpp>
#include <sivid/importing/table/detail/recorded_table.hpp>
#include <sivid/importing/table/detail/wrapping_counter.hpp>
#include <sivid/measurement/error_bound.hpp>

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

/// Takes one quantity out of a recorded table: possible readings, counts followed beyond their
/// range, units, error bounds of a column.
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
            auto const converted = q_.conversion(*raw);
            if (!converted || !enclose(sample.error))
                throw input_error{{.file = s_.file.string(), .line = row.line},
                                  text_of("the reading of ", in_quotes(q_.name),
                                          " is beyond the range of double"),
                                  "check its factor"};
            sample.reading = *converted;
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
        if (step.wrapped)
            protocol_.add(kind::changed, scenario_, q_.name,
                          "the count goes through the end of its range and is followed beyond it",
                          line);
        if (step.doubtful)
            protocol_.add(
                kind::decided, scenario_, q_.name,
                "the count moves by more than a quarter of its range at once: the shorter "
                "way is taken",
                line);
        return exact_decimal::parse(std::to_string(step.count));
    }

    void report(imported_quantity const& result) {
        if (auto const text = q_.conversion.text(); !text.empty())
            protocol_.add(kind::changed, scenario_, q_.name,
                          text + (q_.unit.empty() ? "" : " [" + q_.unit + "]"));
        if (q_.counter_bits)
            protocol_.add(
                kind::assumed, scenario_, q_.name,
                "from one reading to the next the count moves by less than half its range");
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
