// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_TABLE_DETAIL_SERIAL_LOG_HPP
#define SIVID_IMPORTING_TABLE_DETAIL_SERIAL_LOG_HPP

#include <sivid/importing/table/detail/line_kinds.hpp>
#include <sivid/importing/table/detail/recorded_rows.hpp>
#include <sivid/importing/table/detail/recorded_text.hpp>
#include <sivid/importing/table/detail/time_text.hpp>
#include <sivid/importing/table/detail/turns.hpp>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

/// What stands before the check sum of "text*HHHH", four hexadecimal digits: CRC-16/CCITT (0x1021,
/// from 0xFFFF) of the bytes before the star. Every change of up to three bits of a line shorter
/// than 4000 bytes shows, and of random others all but one in 65536.
/// @returns nothing  when there is none, or it is wrong
[[nodiscard]] inline std::optional<std::string_view> without_check_sum(std::string_view line) {
    constexpr std::size_t tail = 5;
    if (line.size() < tail || line[line.size() - tail] != '*') return std::nullopt;
    unsigned stated = 0;
    auto const* end = line.data() + line.size();
    if (std::from_chars(end - 4, end, stated, 16).ptr != end) return std::nullopt;
    line.remove_suffix(tail);
    unsigned sum = 0xFFFF;
    for (char const c : line) {
        sum ^= static_cast<unsigned>(static_cast<unsigned char>(c)) << 8;
        for (int bit = 0; bit < 8; ++bit)
            sum = ((sum & 0x8000) != 0 ? (sum << 1) ^ 0x1021 : sum << 1) & 0xFFFF;
    }
    return sum == stated ? std::optional{line} : std::nullopt;
}

/// Cleans the log of a serial stream: lines of fields, the time a counter that may wrap or start
/// again. Users call read_serial_log.
///
/// A line counts when it has all its fields, each a number or missing, and when its time fits. With
/// a the time of the last line that counts, b of this one, c of the next one with another time, and
/// "y goes on from x" when y follows x by at most longest_gap, through the end of the counter or
/// not:
/// - b goes on from a: the line counts, unless c goes on from a and not from b. Then b is wrong, or
/// c
///   if the line after it goes on from b as well: both are dropped.
/// - else c goes on from b and not from a: the stream went on at b. b > a is a gap; b < a a
/// restart.
/// - else the line is dropped.
/// Different lines in one tick count if the first does. So a wrap is believed where it is a usual
/// step, and a restart otherwise; one garbled time never moves the others.
class serial_log_reader {
public:
    serial_log_reader(scenario_mapping const& s, import_protocol& protocol)
        : s_{s},
          protocol_{protocol},
          file_{s.file.string()},
          stamps_{s.time.counter_bits, s.form.longest_gap, s.time.to_seconds.factor_lower,
                  s.time.form == time_form::clock},
          read_stamp_{s.time, s.form.decimal} {}

    /// The stretches between restarts (and gaps, if the mapping splits there).
    /// @throws input_error  when no line counts, at a break that the mapping refuses, for lines of
    ///                      several kinds
    [[nodiscard]] std::vector<recorded_table> read(std::string_view text) {
        require_lines(text, file_);
        auto const& fields = s_.form.fields;
        time_field_ = find_column(s_.time.column, fields, file_);
        for (auto const& c : columns_of(s_)) columns_.push_back(find_column(c, fields, file_));
        for (auto const c : columns_) must_be_read(c);
        must_be_read(time_field_);
        auto read = columns_;
        read.push_back(time_field_);
        line_kinds kinds{fields.size(), read};
        line_filter filter{s_.form, fields, file_};
        kind_field_ = filter.column();
        bad_cells_.resize(fields.size());
        for (auto const& line : lines_of(text)) scan(line, filter, kinds);
        filter.require_any();
        require_numbers();
        if (!s_.form.lines) kinds.require_one(fields, file_);
        // For each line the next one with another time.
        std::vector<std::size_t> next(lines_.size(), lines_.size());
        for (auto i = lines_.size(); i-- > 1;)
            next[i - 1] = lines_[i].time == lines_[i - 1].time ? next[i] : i;
        next.push_back(lines_.size());
        for (std::size_t i = 0; i < lines_.size() && !ended_; ++i) place(i, next);
        if (stretches_.empty()) none_counts();
        return std::move(stretches_);
    }

private:
    using kind = import_protocol::kind;
    struct stamped_line {
        std::size_t number;
        std::string_view text;
        exact_decimal time;
        std::vector<std::optional<exact_decimal>> cells;
    };
    /// Cells of a field that are no numbers.
    struct bad_cell_count {
        std::size_t count = 0, line = 0; ///< line: of the first one
        std::string first;
    };

    void drop(std::size_t number, std::string const& why) {
        protocol_.add(kind::dropped, s_.name, "", why, number);
    }
    /// Drops what may have been a line of the stream.
    void lose(std::size_t number, std::string const& why) {
        lost_.insert(number);
        drop(number, why);
    }
    void must_be_read(std::size_t field) const {
        if (s_.form.fields[field] == "_")
            throw input_error{s_.place, "a field called _ is mapped", "give the field a name"};
    }

    /// Takes the line apart; what is no line of the stream is dropped here.
    void scan(recorded_line const& l, line_filter& filter, line_kinds& kinds) {
        constexpr std::size_t longest = 4096;
        auto plain = without_blanks(l.text, s_.form.separator);
        if (without_blanks(plain).empty() || plain.front() == '#')
            return drop(l.number, "blank or comment");
        if (l.text.size() > longest) return lose(l.number, "longer than 4096 characters");
        for (char const c : {'\0', '\r'})
            if (plain.find(c) != std::string_view::npos)
                return lose(l.number, "garbled: it holds " + hidden_in(std::string(1, c)));
        if (!l.ended) return drop(l.number, "the last line has no end: it may be cut");
        if (s_.form.check_sums) {
            auto const checked = without_check_sum(plain);
            if (!checked) return lose(l.number, "garbled or cut: no check sum, or a wrong one");
            plain = *checked;
        }
        auto const cells = split_cells(plain, s_.form.separator);
        if (!cells) return lose(l.number, "garbled: a quotation mark out of place");
        auto const& fields = s_.form.fields;
        if (*cells == fields) return drop(l.number, "heading");
        auto const other = filter.refusal(*cells);
        if (other && !other->empty()) return drop(l.number, *other);
        ++sizes_[cells->size()];
        if (cells->size() != fields.size())
            return lose(l.number, "garbled or cut: not as many cells as fields");
        if (numbers(l, *cells)) kinds.count(*cells, s_.form);
    }

    /// Reads the cells of a line that has all; false: it is dropped.
    bool numbers(recorded_line const& l, std::vector<std::string> const& cells) {
        auto const& fields = s_.form.fields;
        std::vector<std::optional<exact_decimal>> values(fields.size());
        for (std::size_t i = 0; i < fields.size(); ++i) {
            auto const& cell = cells[i];
            if (fields[i] == "_" || i == kind_field_ || s_.form.is_missing(cell)) continue;
            bool const time = i == time_field_;
            if (time) {
                if (auto const zone = read_stamp_.other_offset(cell))
                    throw input_error{place_of(l.number, i), zone->problem, zone->remedy};
            }
            values[i] = time ? read_stamp_(cell) : parse_reading(cell, s_.form.decimal);
            if (values[i]) continue;
            auto& bad = bad_cells_[i];
            if (bad.count++ == 0) bad.first = cell, bad.line = l.number;
            auto const hidden = hidden_in(cell);
            lose(l.number, hidden.empty() ? "garbled: a cell is not a number"
                                          : "garbled: a cell holds " + hidden);
            return false;
        }
        auto const time = values[time_field_];
        if (!time) {
            lose(l.number, "the time is missing");
            return false;
        }
        if (!stamps_.possible(*time)) {
            lose(l.number, "garbled: a counter of that many bits cannot show this time");
            return false;
        }
        stamped_line result{l.number, l.text, *time, {}};
        for (auto const c : columns_) result.cells.push_back(values[c]);
        lines_.push_back(std::move(result));
        return true;
    }

    /// A field that often holds no number is no number that was garbled now and then: of the others
    /// nobody knows what they mean (hexadecimal counts without letters look like decimal ones).
    void require_numbers() const {
        constexpr std::size_t least = 3,
                              share = 4; // a quarter; of hexadecimal digits 3 in 8 are letters
        auto const whole = sizes_.find(s_.form.fields.size());
        if (whole == sizes_.end()) return;
        for (std::size_t i = 0; i < bad_cells_.size(); ++i) {
            auto const& bad = bad_cells_[i];
            if (bad.count < least || share * bad.count < whole->second) continue;
            auto const known = i == time_field_ ? read_stamp_.about(bad.first)
                                                : std::optional<stamp_reader::complaint>{};
            throw input_error{
                place_of(bad.line, i),
                text_of(known ? known->problem : in_quotes(bad.first) + " is no number", ", and ",
                        std::to_string(bad.count), " of ", std::to_string(whole->second),
                        " lines have none there"),
                known ? known->remedy : remedy_of(i)};
        }
    }
    /// What to do about a field that holds no numbers.
    [[nodiscard]] std::string remedy_of(std::size_t field) const {
        bool const read = field == time_field_ ||
                          std::find(columns_.begin(), columns_.end(), field) != columns_.end();
        return (read ? "" : "call the field \"_\" if it is not looked at; or ") +
               number_remedy(bad_cells_[field].first, s_.form.decimal);
    }

    /// @throws input_error
    [[noreturn]] void none_counts() const {
        auto const& fields = s_.form.fields;
        auto const usual =
            std::max_element(sizes_.begin(), sizes_.end(),
                             [](auto const& a, auto const& b) { return a.second < b.second; });
        std::string problem = "no line counts as a line of the stream";
        std::string remedy =
            "check \"separator\", \"decimal\", \"fields\", the time's unit and \"longest_gap\"";
        if (usual != sizes_.end() && usual->first != fields.size()) {
            problem += text_of(": most have ", std::to_string(usual->first), " cells, and ",
                               std::to_string(fields.size()), " fields are named");
            remedy = "name each cell in \"fields\", \"_\" what is not looked at, or correct "
                     "\"separator\"";
        }
        for (std::size_t i = 0; i < bad_cells_.size(); ++i) {
            if (bad_cells_[i].count == 0 || !lines_.empty()) continue;
            auto const known = i == time_field_ ? read_stamp_.about(bad_cells_[i].first)
                                                : std::optional<stamp_reader::complaint>{};
            problem +=
                ": " + (known ? known->problem : in_quotes(bad_cells_[i].first) + " is no number");
            remedy = known ? known->remedy : remedy_of(i);
            throw input_error{place_of(bad_cells_[i].line, i), problem, remedy};
        }
        throw input_error{{.file = file_}, problem, remedy};
    }
    [[nodiscard]] input_place place_of(std::size_t line, std::size_t field) const {
        return {.file = file_,
                .line = line,
                .column = field + 1,
                .heading = s_.form.fields[field],
                .pointer = ""};
    }

    /// Decides about a line, given for each the next one with another time.
    void place(std::size_t i, std::vector<std::size_t> const& next) {
        auto const& b = lines_[i];
        if (i < doubtful_until_)
            return lose(b.number, "goes back behind the line before, and either time may be wrong");
        auto const time_at = [&](std::size_t k) {
            return k < lines_.size() ? &lines_[k].time : nullptr;
        };
        auto const *c = time_at(next[i]), *d = time_at(next[next[i]]);
        bool const c_from_b = c != nullptr && stamps_.goes_on(b.time, *c);
        if (stretches_.empty()) {
            if (!c_from_b) return drop(b.number, "no start: no next line goes on from its time");
            return begin(b);
        }
        auto const& a = *last_;
        if (b.time == a.time) { // which of the readings count is decided for each quantity
            if (b.text == a.text) return drop(b.number, "repeats the line before it");
            return append(b);
        }
        bool const c_from_a = c != nullptr && stamps_.goes_on(a.time, *c);
        if (stamps_.goes_on(a.time, b.time)) {
            if (c_from_a && !c_from_b) {
                bool const either = d != nullptr && stamps_.goes_on(b.time, *d);
                if (either) doubtful_until_ = next[next[i]];
                return lose(b.number,
                            either
                                ? "the next line goes back behind it, and either time may be wrong"
                                : "the next line goes on from the line before, not from this time");
            }
            if (b.time < a.time)
                protocol_.add(kind::decided, s_.name, "",
                              text_of("the ", stamps_.name(), " wraps from ", a.time.text(), " to ",
                                      b.time.text(),
                                      ", a usual step; a restart just there would "
                                      "look the same"),
                              b.number);
            return go_on(b);
        }
        if (c_from_a || !c_from_b)
            return lose(b.number,
                        "its time does not follow, and the next line does not go on from it alone");
        if (a.time < b.time)
            gap(a, b);
        else
            restart(a, b);
    }

    void gap(stamped_line const& a, stamped_line const& b) {
        auto const text =
            text_of("gap from ", a.time.text(), " to ", b.time.text(), " ", s_.time.unit);
        if (s_.form.gap == break_policy::refuse) fail(b, text, "gap", "keep or split");
        if (stamps_.wraps())
            protocol_.add(kind::decided, s_.name, "",
                          text_of(text, ": taken as it stands; whole turns of the ", stamps_.name(),
                                  " or a restart within it would look the same"),
                          b.number);
        if (s_.form.gap == break_policy::split) {
            protocol_.add(kind::changed, s_.name, "", text + ": a new scenario begins", b.number);
            return begin(b);
        }
        protocol_.add(kind::assumed, s_.name, "",
                      text + ": the inputs stand as interpolated across it", b.number);
        ++lost_in_gap_;
        go_on(b);
    }
    void restart(stamped_line const& a, stamped_line const& b) {
        auto text = text_of("restart: time goes from ", a.time.text(), " back to ", b.time.text(),
                            " ", s_.time.unit);
        if (s_.form.restart == break_policy::refuse)
            fail(b, text, "restart",
                 "drop, or split with the time's \"offset\": \"first\"" + counter_that_wraps(a, b));
        if (stamps_.wraps())
            protocol_.add(kind::decided, s_.name, "",
                          text_of(text, "; a gap of ", stamps_.forward(a.time, b.time)->text(), " ",
                                  s_.time.unit, " through the ", stamps_.name(),
                                  "'s end would look the same"),
                          b.number);
        if (s_.form.restart == break_policy::split) {
            protocol_.add(kind::changed, s_.name, "", text + ": a new scenario begins", b.number);
            return begin(b);
        }
        for (auto const& l : lines_)
            if (l.number >= b.number) drop(l.number, "after a restart");
        ended_ = true;
    }
    /// How to say so if the stamps are those of a counter that wrapped there.
    [[nodiscard]] std::string counter_that_wraps(stamped_line const& a,
                                                 stamped_line const& b) const {
        if (stamps_.wraps() || s_.time.form != time_form::number) return {};
        for (unsigned const bits : {8u, 10u, 12u, 16u, 20u, 24u, 32u, 40u, 48u}) {
            time_stamps const counter{bits, s_.form.longest_gap, s_.time.to_seconds.factor_lower};
            if (counter.possible(a.time) && counter.possible(b.time) &&
                counter.goes_on(a.time, b.time))
                return text_of("; or, if it is a counter that wraps there, the time's "
                               "\"counter_bits\": ",
                               std::to_string(bits));
        }
        return {};
    }
    [[noreturn]] void fail(stamped_line const& b, std::string const& text, char const* key,
                           std::string const& words) const {
        throw input_error{place_of(b.number, time_field_), text,
                          text_of("state \"", key, "\" in the mapping's source: ", words)};
    }

    void begin(stamped_line const& b) {
        stretches_.emplace_back();
        stretches_.back().first_line = b.number;
        elapsed_ = b.time;
        append(b);
    }
    void go_on(stamped_line const& b) {
        elapsed_ = elapsed_ + *stamps_.forward(last_->time, b.time);
        append(b);
    }
    void append(stamped_line const& b) {
        auto& now = stretches_.back();
        now.last_line = b.number;
        now.rows.push_back({b.number, elapsed_.times(s_.time.to_seconds.factor_lower), b.cells,
                            now.rows.empty() ? 0 : lost_before(b.number)});
        lost_in_gap_ = 0;
        last_ = &b;
    }
    /// Lines between the last one that counts and this, dropped though they may have counted; a gap
    /// is one.
    [[nodiscard]] std::size_t lost_before(std::size_t number) const {
        return lost_in_gap_ + static_cast<std::size_t>(std::distance(
                                  lost_.lower_bound(last_->number), lost_.lower_bound(number)));
    }

    scenario_mapping const& s_;
    import_protocol& protocol_;
    std::string file_;
    time_stamps stamps_;
    stamp_reader read_stamp_;
    std::size_t time_field_ = 0;
    std::optional<std::size_t> kind_field_; ///< tells lines of several kinds apart
    std::vector<std::size_t> columns_;
    std::vector<stamped_line> lines_;
    stamped_line const* last_ = nullptr;
    exact_decimal elapsed_; ///< time in ticks, followed beyond the counter's end
    std::vector<recorded_table> stretches_;
    std::size_t doubtful_until_ = 0;
    bool ended_ = false;
    std::vector<bad_cell_count> bad_cells_;    ///< one for each field
    std::map<std::size_t, std::size_t> sizes_; ///< lines of so many cells
    std::set<std::size_t> lost_;               ///< numbers of lines, see `lose`
    std::size_t lost_in_gap_ = 0;
};

/// The clean stretches of a log, at least one; every line is in one of them or has a note.
/// @throws input_error  when no line counts, at a break that the mapping refuses, for lines of
///                      several kinds, for a field that often holds no number
[[nodiscard]] inline std::vector<recorded_table>
read_serial_log(scenario_mapping const& s, std::string_view text, import_protocol& protocol) {
    return serial_log_reader{s, protocol}.read(text);
}

} // namespace sivid

#endif // SIVID_IMPORTING_TABLE_DETAIL_SERIAL_LOG_HPP
