// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_TABLE_DETAIL_SERIAL_LOG_HPP
#define SIVID_IMPORTING_TABLE_DETAIL_SERIAL_LOG_HPP

#include <sivid/importing/table/detail/recorded_table.hpp>
#include <sivid/importing/table/detail/wrapping_counter.hpp>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
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
          stamps_{s.time.counter_bits, s.form.longest_gap, s.time.to_seconds.factor_lower} {}

    /// The stretches between restarts (and gaps, if the mapping splits there).
    [[nodiscard]] std::vector<recorded_table> read(std::string_view text) {
        time_field_ = find_column(s_.time.column, s_.form.fields, s_.file.string());
        for (auto const& c : columns_of(s_))
            columns_.push_back(find_column(c, s_.form.fields, s_.file.string()));
        for (auto const c : columns_) must_be_read(c);
        must_be_read(time_field_);
        for (auto const& line : lines_of(text)) scan(line);
        // For each line the next one with another time.
        std::vector<std::size_t> next(lines_.size(), lines_.size());
        for (auto i = lines_.size(); i-- > 1;)
            next[i - 1] = lines_[i].time == lines_[i - 1].time ? next[i] : i;
        next.push_back(lines_.size());
        for (std::size_t i = 0; i < lines_.size() && !ended_; ++i) place(i, next);
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

    void drop(std::size_t number, char const* why) {
        protocol_.add(kind::dropped, s_.name, "", why, number);
    }
    void must_be_read(std::size_t field) const {
        if (s_.form.fields[field] == "_")
            throw input_error{s_.place, "a field called _ is mapped", "give the field a name"};
    }

    /// Takes the line apart; what is no line of the stream is dropped here.
    void scan(recorded_line const& l) {
        constexpr std::size_t longest = 4096;
        auto plain = without_blanks(l.text);
        if (plain.empty() || plain.front() == '#') return drop(l.number, "blank or comment");
        if (!l.ended) return drop(l.number, "the last line has no end: it may be cut");
        if (l.text.size() > longest) return drop(l.number, "longer than 4096 characters");
        if (s_.form.check_sums) {
            auto const checked = without_check_sum(plain);
            if (!checked) return drop(l.number, "garbled or cut: no check sum, or a wrong one");
            plain = *checked;
        }
        auto const cells = split_cells(plain, s_.form.separator);
        auto const& fields = s_.form.fields;
        if (!cells) return drop(l.number, "garbled: a quotation mark out of place");
        if (cells->size() != fields.size())
            return drop(l.number, "garbled or cut: not as many cells as fields");
        if (*cells == fields) return drop(l.number, "heading");
        std::vector<std::optional<exact_decimal>> values(fields.size());
        for (std::size_t i = 0; i < fields.size(); ++i) {
            auto const& cell = (*cells)[i];
            if (fields[i] == "_" || s_.form.is_missing(cell)) continue;
            values[i] = parse_reading(cell, s_.form.decimal);
            if (!values[i]) return drop(l.number, "garbled: a cell is not a number");
        }
        auto const time = values[time_field_];
        if (!time) return drop(l.number, "the time is missing");
        if (!stamps_.possible(*time))
            return drop(l.number, "garbled: a counter of that many bits cannot show this time");
        stamped_line result{l.number, l.text, *time, {}};
        for (auto const c : columns_) result.cells.push_back(values[c]);
        lines_.push_back(std::move(result));
    }

    /// Decides about a line, given for each the next one with another time.
    void place(std::size_t i, std::vector<std::size_t> const& next) {
        auto const& b = lines_[i];
        if (i < doubtful_until_)
            return drop(b.number, "goes back behind the line before, and either time may be wrong");
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
                return drop(b.number,
                            either
                                ? "the next line goes back behind it, and either time may be wrong"
                                : "the next line goes on from the line before, not from this time");
            }
            if (b.time < a.time)
                protocol_.add(kind::decided, s_.name, "",
                              text_of("the counter wraps from ", a.time.text(), " to ",
                                      b.time.text(),
                                      ", a usual step; a restart just there would "
                                      "look the same"),
                              b.number);
            return go_on(b);
        }
        if (c_from_a || !c_from_b)
            return drop(b.number,
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
                          text + ": taken as it stands; whole turns of the counter or a restart "
                                 "within it would look the same",
                          b.number);
        if (s_.form.gap == break_policy::split) {
            protocol_.add(kind::changed, s_.name, "", text + ": a new scenario begins", b.number);
            return begin(b);
        }
        protocol_.add(kind::assumed, s_.name, "",
                      text + ": the inputs stand as interpolated across it", b.number);
        go_on(b);
    }
    void restart(stamped_line const& a, stamped_line const& b) {
        auto text = text_of("restart: time goes from ", a.time.text(), " back to ", b.time.text(),
                            " ", s_.time.unit);
        if (s_.form.restart == break_policy::refuse) fail(b, text, "restart", "drop or split");
        if (stamps_.wraps())
            protocol_.add(kind::decided, s_.name, "",
                          text_of(text, "; a gap of ", stamps_.forward(a.time, b.time)->text(), " ",
                                  s_.time.unit, " through the counter's end would look the same"),
                          b.number);
        if (s_.form.restart == break_policy::split) {
            protocol_.add(kind::changed, s_.name, "", text + ": a new scenario begins", b.number);
            return begin(b);
        }
        for (auto const& l : lines_)
            if (l.number >= b.number) drop(l.number, "after a restart");
        ended_ = true;
    }
    [[noreturn]] void fail(stamped_line const& b, std::string const& text, char const* key,
                           char const* words) const {
        throw input_error{{.file = s_.file.string(),
                           .line = b.number,
                           .column = time_field_ + 1,
                           .heading = s_.form.fields[time_field_],
                           .pointer = ""},
                          text,
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
        now.rows.push_back({b.number, elapsed_.times(s_.time.to_seconds.factor_lower), b.cells});
        last_ = &b;
    }

    scenario_mapping const& s_;
    import_protocol& protocol_;
    time_stamps stamps_;
    std::size_t time_field_ = 0;
    std::vector<std::size_t> columns_;
    std::vector<stamped_line> lines_;
    stamped_line const* last_ = nullptr;
    exact_decimal elapsed_; ///< time in ticks, followed beyond the counter's end
    std::vector<recorded_table> stretches_;
    std::size_t doubtful_until_ = 0;
    bool ended_ = false;
};

/// The clean stretches of a log, at least one; every line is in one of them or has a note.
/// @throws input_error  when no line counts, or at a break that the mapping refuses
[[nodiscard]] inline std::vector<recorded_table>
read_serial_log(scenario_mapping const& s, std::string_view text, import_protocol& protocol) {
    auto result = serial_log_reader{s, protocol}.read(text);
    if (result.empty())
        throw input_error{
            {.file = s.file.string()},
            "no line counts as a line of the stream",
            "check \"separator\", \"decimal\", \"fields\", the time's unit and \"longest_gap\""};
    return result;
}

} // namespace sivid

#endif // SIVID_IMPORTING_TABLE_DETAIL_SERIAL_LOG_HPP
