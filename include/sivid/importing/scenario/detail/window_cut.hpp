// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_SCENARIO_DETAIL_WINDOW_CUT_HPP
#define SIVID_IMPORTING_SCENARIO_DETAIL_WINDOW_CUT_HPP

#include <sivid/importing/scenario/detail/open_scenario.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Cuts a stretch into the windows that its mapping asks for.
/// @guarantee  no measurement is in two windows. Each has its inputs with the knots next to it, so
///             that their course is the one of the record
class window_cut {
public:
    static constexpr std::size_t most = 10'000, most_before = 1000;

    using span = std::pair<exact_decimal, exact_decimal>;

    /// @param whole      with its final times
    /// @param stretches  of time that windows lie in
    /// @given  whole.mapping->windows (trusted)
    window_cut(open_scenario const& whole, recorded_table const& table, std::vector<span> stretches,
               import_protocol& protocol)
        : whole_{whole},
          s_{*whole.mapping},
          w_{*s_.windows},
          table_{table},
          stretches_{std::move(stretches)},
          protocol_{protocol} {}

    /// @throws input_error  when none fits, or too many
    [[nodiscard]] std::vector<open_scenario> windows() {
        auto const found = places();
        protocol_.add(
            kind::changed, whole_.stretch, "",
            "cut into windows, each from its own t = 0: readings outside are left out, and "
            "one that ends a window and begins the next counts for the next alone");
        std::vector<open_scenario> result;
        for (std::size_t i = 0; i < found.size(); ++i) {
            auto part =
                window(found[i], i + 1 < found.size() ? *nearest(found[i + 1].from)
                                                      : std::numeric_limits<double>::infinity());
            if (part.reading_count() > 0)
                result.push_back(std::move(part));
            else
                note(found[i].number, "no measurement");
        }
        if (result.empty())
            throw input_error{w_.place,
                              text_of("no window of ", w_.length.text(), " s fits into ",
                                      s_.file.string(), ", which lasts ", end_.text(),
                                      " s from t = 0", w_.rows ? ", where \"while\" holds" : ""),
                              "state a shorter \"length\", or another \"first\""};
        return result;
    }

private:
    using kind = import_protocol::kind;
    struct place {
        std::size_t number;
        exact_decimal from, to;
    };

    void note(std::size_t number, std::string const& why) {
        protocol_.add(kind::dropped, whole_.stretch, "",
                      text_of("window ", std::to_string(number), ": ", why));
    }

    [[nodiscard]] std::vector<place> places() {
        end_ = whole_.duration;
        for (auto const& q : whole_.inputs) end_ = std::min(end_, q.samples.back().time - q.clock);
        std::vector<place> result;
        std::size_t number = 1;
        for (auto const& [begin, end] : stretches_)
            number = add_places(result, number, begin + w_.first, end < end_ ? end : end_);
        for (auto const held : w_.holdout)
            if (held >= number)
                throw input_error{w_.place,
                                  text_of("window ", std::to_string(held),
                                          " is to be held out, and there are ",
                                          std::to_string(number - 1)),
                                  "correct \"holdout\""};
        return result;
    }

    /// Those of a stretch. @returns the number that comes next
    std::size_t add_places(std::vector<place>& result, std::size_t number, exact_decimal from,
                           exact_decimal const& end) {
        for (; w_.most == 0 || number <= w_.most; ++number) {
            if (end < from + w_.length) {
                if (from < end)
                    note(number, text_of("does not fit: it would end at ",
                                         (from + w_.length).text(), " s, what is recorded at ",
                                         exact_decimal::shortest(*nearest(end)).text(), " s"));
                break;
            }
            if (number > most)
                throw input_error{w_.place, "more than 10000 windows",
                                  "state a longer \"every\", or a \"count\""};
            auto const next = from + w_.every;
            auto const at = begin_of(from, next);
            if (!at)
                note(number, "no reading to begin with before the time of the next one");
            else if (!(end < *at + w_.length))
                result.push_back({number, *at, *at + w_.length});
            else
                note(number, "does not fit behind its first reading");
            from = next;
        }
        return number;
    }

    /// The first common reading, from a time on, of the channels that a window's start rests on;
    /// the time itself if it rests on none. Nothing: there is none before the limit.
    [[nodiscard]] std::optional<exact_decimal> begin_of(exact_decimal from,
                                                        exact_decimal const& limit) const {
        for (bool moved = true; moved;) {
            moved = false;
            for (auto const& q : whole_.channels) {
                if (!begins_window(q.mapping->name)) continue;
                auto const at = first_at(q, *nearest(from));
                if (at == q.samples.size() || !(q.samples[at].time < limit)) return std::nullopt;
                if (*nearest(from) < *nearest(q.samples[at].time)) {
                    from = q.samples[at].time;
                    moved = true;
                }
            }
        }
        return from;
    }
    [[nodiscard]] bool begins_window(std::string const& channel) const {
        auto const& own = w_.initial;
        auto const rests = [&](mapped_start const& m) {
            return m.from == mapped_start::kind::value && !m.bounded && m.channel == channel;
        };
        auto const is_own = [&](mapped_start const& m) {
            return std::any_of(own.begin(), own.end(),
                               [&](auto const& other) { return other.name == m.name; });
        };
        return std::any_of(own.begin(), own.end(), rests) ||
               std::any_of(s_.initial.begin(), s_.initial.end(),
                           [&](auto const& m) { return rests(m) && !is_own(m); });
    }
    /// The first sample at or after t.
    [[nodiscard]] static std::size_t first_at(imported_quantity const& q, double t) {
        auto const found =
            std::partition_point(q.samples.begin(), q.samples.end(),
                                 [&](auto const& x) { return *nearest(x.time) < t; });
        return static_cast<std::size_t>(found - q.samples.begin());
    }

    /// @param next  where the next window begins
    [[nodiscard]] open_scenario window(place const& p, double next) {
        open_scenario part;
        part.name = whole_.name + "-w" + std::to_string(p.number);
        part.stretch = whole_.stretch;
        part.mapping = &s_;
        part.role = w_.is_holdout(p.number) ? scenario_role::holdout : s_.role;
        part.begin = p.from;
        part.duration = w_.length;
        double const from = *nearest(p.from), to = *nearest(p.to);
        for (auto const& q : whole_.inputs) { // more knots than needed: `trim_input` cuts
            auto const first = first_at(q, from);
            part.inputs.push_back(piece(q, first > 0 ? first - 1 : 0, first_at(q, to) + 2));
        }
        for (auto const& q : whole_.channels) {
            auto last = first_at(q, to);
            if (last < q.samples.size() && *nearest(q.samples[last].time) <= to) ++last;
            part.channels.push_back(piece(q, first_at(q, from), std::min(last, first_at(q, next))));
            if (q.from != &s_) continue; // lines of another file
            for (auto const& sample : part.channels.back().samples) {
                part.last_line = std::max(part.last_line, sample.line);
                if (part.first_line == 0 || sample.line < part.first_line)
                    part.first_line = sample.line;
            }
        }
        auto const row_at = [&](std::size_t line) {
            return std::partition_point(table_.rows.begin(), table_.rows.end(),
                                        [&](auto const& row) { return row.line < line; });
        };
        part.rows = static_cast<std::size_t>(row_at(part.last_line + 1) - row_at(part.first_line));
        shift_times(part, -p.from, protocol_);
        for (std::size_t i = 0; i < part.channels.size(); ++i) {
            auto const& q = whole_.channels[i];
            auto const last = first_at(q, from);
            auto& before = part.channels[i].before;
            before = piece(q, last - std::min<std::size_t>(last, most_before), last).samples;
            for (auto& sample : before) sample.time = sample.time - p.from;
        }
        return part;
    }
    static imported_quantity piece(imported_quantity const& q, std::size_t from, std::size_t to) {
        imported_quantity result;
        result.mapping = q.mapping;
        result.from = q.from;
        to = std::min(to, q.samples.size());
        auto const at = [&](std::size_t i) {
            return q.samples.begin() + static_cast<std::ptrdiff_t>(i);
        };
        if (from < to) result.samples.assign(at(from), at(to));
        return result;
    }

    open_scenario const& whole_;
    scenario_mapping const& s_;
    window_mapping const& w_;
    recorded_table const& table_;
    std::vector<span> stretches_;
    import_protocol& protocol_;
    exact_decimal end_; ///< of what all inputs carry
};

} // namespace sivid

#endif // SIVID_IMPORTING_SCENARIO_DETAIL_WINDOW_CUT_HPP
