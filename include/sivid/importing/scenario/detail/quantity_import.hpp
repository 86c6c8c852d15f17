// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_SCENARIO_DETAIL_QUANTITY_IMPORT_HPP
#define SIVID_IMPORTING_SCENARIO_DETAIL_QUANTITY_IMPORT_HPP

#include <sivid/importing/detail/import_mapping.hpp>
#include <sivid/importing/detail/import_protocol.hpp>
#include <sivid/importing/scenario/detail/missing_samples.hpp>
#include <sivid/importing/table/detail/recorded_rows.hpp>
#include <sivid/importing/table/detail/turns.hpp>
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
    exact_decimal late;  ///< what an error of its time adds
    double raw = 0;      ///< as recorded, nearly
    /// Of an input: samples before it that the record lacks, as its rows tell.
    std::size_t missing = 0;
    std::size_t lost = 0; ///< and lines above it that may have held one
};

/// The readings of one input or channel.
struct imported_quantity {
    quantity_mapping const* mapping = nullptr;
    scenario_mapping const* from = nullptr; ///< the file that it stands in
    exact_decimal clock;                    ///< [s] how far off that file's times may be
    std::vector<imported_sample> samples;
    std::vector<imported_sample> before; ///< of a window: those of the record, for its start

    /// What notes on its lines name: the stretch, or the further file that they are of.
    [[nodiscard]] std::string const& noted_as(std::string const& stretch) const {
        return from != nullptr && from->clock ? from->name : stretch;
    }
    /// The stated bound of the sensor's error; of a proposed one nothing.
    [[nodiscard]] exact_decimal const& stated(imported_sample const& sample) const {
        return mapping->error.from == bound_source::kind::number ? mapping->error.number
                                                                 : sample.error;
    }
};

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
        imported_quantity result;
        result.mapping = &q_;
        result.from = &s_;
        if (q_.counter_bits) counter_.emplace(*q_.counter_bits);
        if (q_.period) turns_.emplace(q_.period->first, q_.period->second);
        auto const smeared = smeared_rows(table, cell);
        sample_rows rows;
        for (std::size_t k = 0; k < table.rows.size(); ++k) {
            auto const& row = table.rows[k];
            auto sample = read_row(row, cell, smeared[k]);
            rows.add(row.lost, reading(row, cell).has_value(), sample.has_value());
            if (sample) result.samples.push_back(std::move(*sample));
        }
        for (std::size_t i = 0; i < result.samples.size(); ++i) {
            result.samples[i].missing = rows.missing_before(i);
            result.samples[i].lost = rows.lost_before(i);
        }
        cell += q_.columns.size() + (has_error() ? 1 : 0);
        report(result);
        return result;
    }

private:
    using kind = import_protocol::kind;

    [[nodiscard]] bool has_error() const { return q_.error.from == bound_source::kind::column; }
    [[nodiscard]] bool has_all(recorded_table::row const& row, std::size_t cell) const {
        for (std::size_t k = 0; k < q_.columns.size(); ++k)
            if (!row.cells[cell + k]) return false;
        return true;
    }
    /// What the cells of a row say; nothing: one of them is missing, or they say nothing together.
    [[nodiscard]] std::optional<formula_reading> reading(recorded_table::row const& row,
                                                         std::size_t cell) const {
        if (!has_all(row, cell)) return std::nullopt;
        if (!q_.formula) return with_sign({*row.cells[cell], *row.cells[cell]});
        std::vector<exact_decimal> readings;
        for (std::size_t k = 0; k < q_.columns.size(); ++k)
            readings.push_back(*row.cells[cell + k]);
        auto const result = (*q_.formula)(readings);
        return result ? with_sign(*result) : result;
    }
    /// Of a register with a sign.
    [[nodiscard]] formula_reading with_sign(formula_reading const& x) const {
        if (!q_.signed_bits || !x.is_exact()) return x;
        auto const two_to = [](unsigned bits) {
            return *exact_decimal::parse(std::to_string(std::size_t{1} << bits));
        };
        auto const half = two_to(*q_.signed_bits - 1), whole = two_to(*q_.signed_bits);
        if (x.lower < half || !(x.lower < whole)) return x;
        return {x.lower - whole, x.lower - whole};
    }
    /// Whether a reading can be of a register with a sign.
    [[nodiscard]] bool in_register(formula_reading const& raw) const {
        if (!q_.signed_bits) return true;
        auto const size = magnitude(raw.lower).whole();
        auto const half = std::size_t{1} << (*q_.signed_bits - 1);
        return size && raw.is_exact() &&
               (*size < half || (*size == half && raw.lower.is_negative()));
    }
    [[nodiscard]] bool in_range(exact_decimal const& raw) const {
        return !q_.range || !(raw < q_.range->first || q_.range->second < raw);
    }

    /// Rows whose reading is an average over a leap from one end of the range to the other.
    [[nodiscard]] std::vector<bool> smeared_rows(recorded_table const& table,
                                                 std::size_t cell) const {
        std::vector<bool> result(table.rows.size(), false);
        if (!counter_ && !turns_) return result;
        std::vector<std::size_t> rows;
        std::vector<double> readings;
        for (std::size_t k = 0; k < table.rows.size(); ++k) {
            auto const raw = reading(table.rows[k], cell);
            if (!raw || !in_range(raw->lower) || !nearest(raw->lower)) continue;
            rows.push_back(k);
            readings.push_back(*nearest(raw->lower));
        }
        auto const found = smeared_leaps(readings, period());
        for (std::size_t i = 0; i < rows.size(); ++i) result[rows[i]] = found[i];
        return result;
    }
    /// The period of readings that wrap.
    [[nodiscard]] double period() const {
        if (counter_) return std::ldexp(1.0, static_cast<int>(*q_.counter_bits));
        return (*nearest(q_.period->first) + *nearest(q_.period->second)) / 2;
    }

    /// The sample of a row; nothing: there is none, which is noted.
    [[nodiscard]] std::optional<imported_sample> read_row(recorded_table::row const& row,
                                                          std::size_t cell, bool smeared) {
        auto const read = reading(row, cell);
        std::string why;
        if (!read)
            why = has_all(row, cell) ? "its formula has no value" : "no reading";
        else if (!in_register(*read))
            why = text_of("no register of ", std::to_string(*q_.signed_bits), " bits");
        else if (!in_range(read->lower) || !in_range(read->upper))
            why = text_of("not in the possible range [", q_.range->first.text(), ", ",
                          q_.range->second.text(), "]");
        else if (smeared)
            why = "between the ends of its range while those around it go through them: the "
                  "recorder has averaged over the leap";
        if (!why.empty()) return drop(row.line, why), std::nullopt;
        auto const recorded = nearest(read->lower).value_or(0);
        auto bounds = std::pair{read->lower, read->lower};
        if (counter_) {
            auto const count = followed(*counter_, read->lower, row.line);
            if (!count) return std::nullopt;
            bounds = {*count, *count};
        }
        if (turns_ && !followed(*turns_, bounds, row.line)) return std::nullopt;
        bounds.second = bounds.second + (read->upper - read->lower);
        imported_sample sample;
        sample.line = row.line;
        sample.time = row.time;
        if (has_error()) {
            auto const& error = row.cells[cell + q_.columns.size()];
            if (!error || !error->is_positive())
                return drop(row.line, error ? "its error bound is not above 0"
                                            : "its error bound is missing"),
                       std::nullopt;
            sample.error = q_.conversion.bound(*error);
        }
        auto const converted = q_.conversion(bounds.first, bounds.second);
        if (!converted || !enclose(sample.error))
            throw input_error{
                {.file = s_.file.string(), .line = row.line},
                text_of("the reading of ", in_quotes(q_.name), " is beyond the range of double"),
                "check its factor"};
        sample.reading = *converted;
        sample.raw = counter_ || turns_ ? nearest(bounds.first).value_or(0) : recorded;
        return sample;
    }

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

    /// An angle or a counter that wraps, though nobody said so, would be a gap that only a
    /// diagnosis names.
    void suspect_period(imported_quantity const& result) {
        std::vector<double> readings;
        for (auto const& s : result.samples) readings.push_back(s.raw);
        auto const found = suspected_period(readings);
        if (!found) return;
        protocol_.add(kind::decided, scenario_, q_.name,
                      text_of("the reading jumps by nearly ", found->words,
                              ": if it wraps there, state ", found->entry),
                      result.samples[found->at].line);
    }

    /// Where a gap is so long that the quantity may have gone half a period and more.
    void doubt_turns(imported_quantity const& result) {
        std::vector<double> times, readings;
        for (auto const& s : result.samples) {
            times.push_back(nearest(s.time).value_or(0));
            readings.push_back(s.raw);
        }
        for (auto const k : doubtful_turns(times, readings, period()))
            protocol_.add(
                kind::assumed, scenario_, q_.name,
                "whole turns may be lost where readings are missing: at the largest rate seen "
                "that time is enough for half a turn",
                result.samples[k].line);
    }

    void report(imported_quantity const& result) {
        if (q_.period || q_.counter_bits)
            doubt_turns(result);
        else
            suspect_period(result);
        if (q_.formula)
            protocol_.add(kind::changed, scenario_, q_.name,
                          "the reading is " + q_.formula->text());
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
    std::optional<wrapping_counter> counter_;
    std::optional<wrapped_reading> turns_;
};

} // namespace sivid

#endif // SIVID_IMPORTING_SCENARIO_DETAIL_QUANTITY_IMPORT_HPP
