// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_SCENARIO_DETAIL_SCENARIO_IMPORT_HPP
#define SIVID_IMPORTING_SCENARIO_DETAIL_SCENARIO_IMPORT_HPP

#include <sivid/importing/scenario/detail/clock_error.hpp>
#include <sivid/importing/scenario/detail/found_clock.hpp>
#include <sivid/importing/scenario/detail/window_cut.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Brings one recorded stretch onto the time axis of a scenario: units, offset, duration; and cuts
/// it into windows, no measurement in two of them. Samples outside are dropped, none is invented.
class scenario_import {
public:
    /// @param only  the stretch is the whole record: a defect is bad input, and a stated duration
    /// is
    ///              required in full; otherwise the stretch may be shorter
    scenario_import(scenario_mapping const& s, std::string name, bool only,
                    import_protocol& protocol)
        : s_{s}, name_{std::move(name)}, only_{only}, protocol_{protocol} {}

    /// @param further  what the further files of the scenario hold
    /// @throws input_error  when the stretch makes no scenario
    [[nodiscard]] std::vector<open_scenario>
    read(recorded_table const& table, std::vector<recorded_table const*> const& further = {}) {
        auto own = taken(table);
        auto& whole = own.content;
        note_clock();
        if (!own.offset.is_zero())
            protocol_.add(kind::changed, name_, "",
                          text_of("time shifted by ", own.offset.text(), " s"));
        std::vector<open_scenario> parts;
        for (std::size_t k = 0; k < further.size(); ++k)
            parts.push_back(
                scenario_import{s_.further[k], s_.further[k].name, true, protocol_}.beside(
                    *further[k], own));
        shift_times(whole, own.offset, protocol_);
        for (auto& part : parts)
            for (auto list : {&open_scenario::inputs, &open_scenario::channels})
                std::ranges::move(part.*list, std::back_inserter(whole.*list));
        add_errors_of_clocks(whole);
        for (auto& q : whole.inputs) mark_missing(q);
        whole.duration = duration(whole);
        if (s_.thin > 1)
            protocol_.add(kind::changed, name_, "",
                          text_of("thinned: one of ", std::to_string(s_.thin),
                                  " readings of a channel is kept, beginning with the first"));
        std::vector<open_scenario> result;
        if (s_.windows)
            result =
                window_cut{whole, table, stretches(table, own.offset, whole.duration), protocol_}
                    .windows();
        else
            result.push_back(std::move(whole));
        for (auto& s : result) close(s);
        return result;
    }

private:
    using kind = import_protocol::kind;
    using ends = std::pair<exact_decimal, exact_decimal>;
    /// What a file holds, by its own clock.
    struct own_part {
        open_scenario content;
        std::vector<imported_quantity> watched;
        exact_decimal offset; ///< of its times
    };

    [[nodiscard]] own_part taken(recorded_table const& table) {
        own_part result;
        auto& whole = result.content;
        whole.name = whole.stretch = name_;
        whole.mapping = &s_;
        whole.role = s_.role;
        whole.first_line = table.first_line;
        whole.last_line = table.last_line;
        whole.rows = table.rows.size();
        std::size_t cell = 0;
        auto const add = [&](std::vector<quantity_mapping> const& from,
                             std::vector<imported_quantity>& to) {
            for (auto const& q : from)
                if (!q.elsewhere)
                    to.push_back(quantity_import{s_, q, name_, protocol_}.read(table, cell));
        };
        add(s_.inputs, whole.inputs);
        add(s_.channels, whole.channels);
        add(s_.watched, result.watched);
        if (table.rows.empty()) fail(0, "the file has no data line", "check the file");
        if (s_.time.sample_time)
            protocol_.add(kind::assumed, name_, "",
                          text_of("rows follow each other by ", s_.time.sample_time->text(), " ",
                                  s_.time.unit, " exactly, and none is missing"));
        result.offset = s_.time.from_first ? -start(table, whole) : s_.time.offset;
        return result;
    }

    /// What a further file holds, on the time axis of the scenario.
    [[nodiscard]] open_scenario beside(recorded_table const& table, own_part const& of_first) {
        auto own = taken(table);
        auto const& c = *s_.clock;
        static auto const half = *exact_decimal::parse("0.5");
        auto const begin = table.rows.front().time + own.offset,
                   end = table.rows.back().time + own.offset;
        auto const middle = (begin + end).times(half), ahead = (end - begin).times(half);
        auto const [first, last] = c.here ? found(own, of_first, middle, ahead) : stated(ahead);
        auto const centre = [](ends const& x) { return (x.first + x.second).times(half); };
        auto const at_first = centre(first), at_last = centre(last);
        auto const o = exact_decimal::rounded(*nearest((at_first + at_last).times(half)), 12);
        auto const d = ahead.is_zero()
                           ? exact_decimal{}
                           : exact_decimal::rounded(
                                 *nearest((at_last - at_first).times(half)) / *nearest(ahead), 12);
        auto const apart = [](ends const& x, exact_decimal const& from) {
            return std::max(magnitude(x.first - from), magnitude(x.second - from));
        };
        auto const within =
            std::max(apart(first, o - d.times(ahead)), apart(last, o + d.times(ahead)));
        auto const error = within.is_zero() ? within : rounded_up(within, 3);
        if (!enclose(error))
            throw input_error{c.place, "times of the file are beyond the range of double",
                              "correct \"offset\" and \"drift\""};
        for (auto list : {&open_scenario::inputs, &open_scenario::channels})
            for (auto& q : own.content.*list) {
                q.clock = error;
                for (auto& sample : q.samples) {
                    auto const t = sample.time + own.offset;
                    sample.time = t + o + d.times(t - middle);
                }
            }
        shift_times(own.content, of_first.offset, protocol_);
        tell_clock(o, d, error);
        return std::move(own.content);
    }
    /// What is added to the first and to the last time of a file that extends by so much to both
    /// sides of its middle, as stated.
    [[nodiscard]] std::pair<ends, ends> stated(exact_decimal const& ahead) const {
        auto const &offset = s_.clock->offset, &drift = s_.clock->drift;
        auto const low = drift.first.times(ahead), high = drift.second.times(ahead);
        return {{offset.first - high, offset.second - low},
                {offset.first + low, offset.second + high}};
    }
    /// The same, as the signal that both files recorded leaves it.
    [[nodiscard]] std::pair<ends, ends> found(own_part const& own, own_part const& of_first,
                                              exact_decimal const& middle,
                                              exact_decimal const& ahead) const {
        auto const& c = *s_.clock;
        auto const prior = [](ends const& x) {
            return hull(*enclose(x.first), *enclose(x.second));
        };
        auto const left = search(shared(own.watched.front(), own.offset - middle),
                                 shared(of_first.watched[c.there], -middle),
                                 {prior(c.offset), prior(c.drift), prior({ahead, ahead})});
        auto const of = [](interval const& x) {
            return ends{exact_decimal::of(x.lower()), exact_decimal::of(x.upper())};
        };
        return {of(left.first), of(left.last)};
    }
    void tell_clock(exact_decimal const& offset, exact_decimal const& drift,
                    exact_decimal const& within) {
        auto const& c = *s_.clock;
        protocol_.add(kind::changed, name_, "",
                      text_of("its clock: ", offset.text(),
                              " s are added in the middle of the "
                              "file, and ",
                              drift.text(), " for each second from there"));
        if (!within.is_zero())
            protocol_.add(kind::assumed, name_, "",
                          text_of("the times of the file are off by ", within.text(),
                                  " s at most, after that: what this may add is in the bounds"));
        protocol_.add(
            kind::assumed, name_, "",
            text_of("offset and drift of its clock are within what is stated",
                    !c.here  ? ""
                    : c.rate ? ", and both files recorded one signal, within its errors, "
                               "which changes by " +
                                   c.rate->text() + " a second at most"
                             : ", and both files recorded one signal, within its errors, "
                               "which stays on its side of " +
                                   c.level.text() +
                                   " between two readings on that side that follow each other"));
    }

    [[nodiscard]] std::vector<shared_reading> shared(imported_quantity const& q,
                                                     exact_decimal const& move) const {
        std::vector<shared_reading> result;
        for (auto const& sample : q.samples) {
            auto const error = q.stated(sample) + sample.reading.rounding;
            auto const value = enclose(sample.reading.value - error, sample.reading.value + error);
            auto const time = enclose(sample.time + move);
            if (!value || !time)
                fail(sample.line, "time or value is beyond the range of double",
                     "check the units, factors and offsets");
            result.push_back({*time, *value});
        }
        return result;
    }
    [[nodiscard]] clock_range search(std::vector<shared_reading> const& here,
                                     std::vector<shared_reading> const& there,
                                     clock_prior const& prior) const {
        auto const& c = *s_.clock;
        auto const found = (c.rate ? clock_search(here, there, prior, enclose(*c.rate)->upper())
                                   : clock_search(here, there, *nearest(c.level)))(prior);
        if (!found)
            throw input_error{c.place,
                              text_of("with no offset and drift as stated do ", s_.file.string(),
                                      " and the first file tell the same of ",
                                      in_quotes(c.here->name)),
                              "correct \"offset\" and \"drift\", the errors of \"same\", or its "
                              "\"rate\" or \"level\""};
        return *found;
    }

    void add_errors_of_clocks(open_scenario& s) {
        auto const refuse_clock = [](imported_quantity const& q, std::string const& why,
                                     char const* remedy) {
            if (!why.empty())
                throw input_error{
                    {.file = q.from->file.string(),
                     .line = q.samples.empty() ? 0 : q.samples.back().line},
                    text_of("the error of the time of ", in_quotes(q.mapping->name), ": ", why),
                    remedy};
        };
        for (auto& q : s.channels)
            refuse_clock(q, add_clock_errors(q), "state or correct its \"time_error\"");
        for (auto& q : s.inputs)
            refuse_clock(q, add_clock_errors_of_input(q, s_.between),
                         "state an error, or import the file that holds it as the first one");
    }

    /// Where the rows are those that windows are cut of, a row without a reading as the one before;
    /// else all of it.
    [[nodiscard]] std::vector<window_cut::span> stretches(recorded_table const& table,
                                                          exact_decimal const& offset,
                                                          exact_decimal const& duration) {
        if (!s_.windows->rows) return {{exact_decimal{}, duration}};
        auto const& within = s_.windows->rows->within;
        std::vector<window_cut::span> result;
        bool is = false, going = false;
        for (auto const& row : table.rows) {
            auto const time = row.time + offset;
            if (auto const& cell = row.cells.back(); !cell)
                protocol_.add(kind::assumed, name_, "",
                              "\"while\" holds where it did in the row before: no reading",
                              row.line);
            else
                is = !(*cell < within.first) && !(within.second < *cell);
            bool const here = is && !time.is_negative();
            if (here && !going) result.emplace_back(time, time);
            if (here) result.back().second = time;
            going = here;
        }
        protocol_.add(kind::changed, name_, "",
                      text_of("windows lie where \"while\" holds: in ",
                              std::to_string(result.size()), " stretches of rows"));
        return result;
    }

    [[noreturn]] void fail(std::size_t line, std::string problem, std::string remedy) const {
        throw input_error{
            {.file = s_.file.string(), .line = line}, std::move(problem), std::move(remedy)};
    }

    void note_clock() {
        bool exact = s_.channels.empty();
        for (auto const& q : s_.channels) {
            exact = exact || q.clock.is_zero();
            if (!q.clock.is_zero())
                protocol_.add(kind::assumed, name_, q.name,
                              text_of("each reading was taken within ", q.clock.text(),
                                      " s of its time, while what it shows changes ",
                                      q.curved ? "its rate by " : "by ", q.slope.text(),
                                      " a second at most: what that may add is in the bounds"));
            if (!q.model_error.is_zero())
                protocol_.add(
                    kind::assumed, name_, q.name,
                    text_of("the model may be off by ", q.model_error.text(),
                            " beside the error of a reading; starts have no share of it"));
        }
        protocol_.add(kind::assumed, name_, "",
                      text_of("the times are exact", exact ? "" : " where no time_error is stated",
                              ": no bound allows for jitter, delay or the step of a clock"));
    }

    /// The first row in which every input (without inputs: any channel) has a reading.
    [[nodiscard]] exact_decimal start(recorded_table const& table,
                                      open_scenario const& result) const {
        std::vector<std::size_t> at(result.inputs.size(), 0);
        auto const here = [](imported_quantity const& q, std::size_t& k, std::size_t line) {
            while (k < q.samples.size() && q.samples[k].line < line) ++k;
            return k < q.samples.size() && q.samples[k].line == line;
        };
        for (auto const& row : table.rows) {
            bool all = true;
            for (std::size_t i = 0; i < result.inputs.size(); ++i)
                all = here(result.inputs[i], at[i], row.line) && all;
            if (all && !result.inputs.empty()) return row.time;
            for (auto const& q : result.channels)
                if (result.inputs.empty() && !q.samples.empty() &&
                    q.samples.front().line == row.line)
                    return row.time;
        }
        fail(table.last_line, "no row has a reading of every input", "check the inputs' columns");
    }

    /// Leaves what lies within the duration, and the inputs' knots next to it.
    void close(open_scenario& s) {
        for (auto& q : s.inputs) trim_input(q, s.duration);
        double const end = *nearest(s.duration);
        for (auto& q : s.channels)
            keep(q, [&](exact_decimal const& t) { return *nearest(t) >= 0 && *nearest(t) <= end; });
        if (s.measurement_count() == 0)
            fail(s.last_line, "no measurement lies within the duration",
                 "check the channels' columns and the time's offset");
    }

    [[nodiscard]] exact_decimal duration(open_scenario const& result) const {
        std::optional<exact_decimal> available;
        for (auto const& q : result.inputs) {
            if (q.samples.empty())
                fail(result.last_line,
                     text_of("the input ", in_quotes(q.mapping->name), " has no reading"),
                     "check its column");
            auto const& first = q.samples.front();
            if (*nearest(first.time + q.clock) > 0)
                fail(first.line,
                     text_of("the input ", in_quotes(q.mapping->name), " starts after t = 0, at ",
                             exact_decimal::shortest(*nearest(first.time)).text(), " s"),
                     "state the time's offset such that t = 0 comes later, or \"first\"");
            auto const last = q.samples.back().time - q.clock;
            if (!available || last < *available) available = last;
        }
        if (!available) // no inputs: as long as something is measured
            for (auto const& q : result.channels)
                if (!q.samples.empty() && (!available || *available < q.samples.back().time))
                    available = q.samples.back().time;
        if (!available) fail(result.last_line, "no channel has a reading", "check the columns");
        bool const stated = s_.duration.has_value() &&
                            (result.inputs.empty() || only_ || *s_.duration < *available);
        auto const t = stated ? *s_.duration : *available;
        if (stated && !result.inputs.empty() && *nearest(*available) < *nearest(t))
            fail(result.last_line,
                 text_of("the inputs end at ", exact_decimal::shortest(*nearest(*available)).text(),
                         " s, before the duration"),
                 "state a shorter duration, or none");
        if (!(*nearest(t) > 0))
            fail(result.last_line, "nothing is left after t = 0", "check the time's offset");
        if (!stated && !s_.windows)
            protocol_.add(kind::decided, name_, "",
                          result.inputs.empty() ? "duration: to the last measurement"
                                                : "duration: as long as all inputs have readings");
        return t;
    }

    /// Drops the samples for which the predicate on the time fails.
    template <class Wanted>
    void keep(imported_quantity& q, Wanted const& wanted) {
        std::vector<imported_sample> kept;
        for (auto& sample : q.samples) {
            if (wanted(sample.time))
                kept.push_back(std::move(sample));
            else if (!s_.windows) // of windows that is said of all lines outside
                protocol_.add(kind::dropped, q.noted_as(name_), q.mapping->name,
                              "outside [0, duration]", sample.line);
        }
        q.samples = std::move(kept);
    }

    /// Keeps one knot at or before 0 and one at or after the duration.
    void trim_input(imported_quantity& q, exact_decimal const& duration) {
        double first = *nearest(q.samples.front().time), last = *nearest(q.samples.back().time);
        for (auto const& sample : q.samples) {
            double const t = *nearest(sample.time);
            if (t <= 0) first = t;
            if (t >= *nearest(duration)) last = std::min(last, t);
        }
        keep(q,
             [&](exact_decimal const& t) { return *nearest(t) >= first && *nearest(t) <= last; });
    }

    /// Counts what an input lacks: as its times tell, or its rows, or where neither is regular the
    /// lines that were lost. What cannot be told so, but is long, is noted.
    void mark_missing(imported_quantity& q) {
        auto& all = q.samples;
        std::vector<double> steps;
        for (std::size_t i = 1; i < all.size(); ++i)
            steps.push_back(*nearest(all[i].time) - *nearest(all[i - 1].time));
        bool regular = false;
        auto const missing = missing_by_steps(steps, 0.25, regular);
        auto sorted = steps;
        std::sort(sorted.begin(), sorted.end());
        for (std::size_t i = 0; i < steps.size(); ++i) {
            auto& sample = all[i + 1];
            sample.missing = std::max({sample.missing, missing[i], regular ? 0 : sample.lost});
            if (sample.missing == 0 && steps[i] > 5 * sorted[sorted.size() / 2])
                protocol_.add(kind::assumed, q.noted_as(name_), q.mapping->name,
                              "more than five usual steps without a reading before this line: the "
                              "input stands as interpolated",
                              sample.line);
        }
    }

    scenario_mapping const& s_;
    std::string name_;
    bool only_;
    import_protocol& protocol_;
};

} // namespace sivid

#endif // SIVID_IMPORTING_SCENARIO_DETAIL_SCENARIO_IMPORT_HPP
