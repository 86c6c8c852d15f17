// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_CHECKPOINT_READER_IPP
#define SIVID_IO_IMPL_CHECKPOINT_READER_IPP

#include <sivid/io/checkpoint_reader.hpp>

namespace sivid {

namespace io_detail {

/// Reads a checkpoint line by line, word by word.
class checkpoint_parser {
public:
    checkpoint_parser(std::string file, std::string_view text)
        : file_{std::move(file)}, rest_{text} {}

    [[noreturn]] void refuse(std::string problem, std::string remedy) const {
        throw input_error{{.file = file_}, std::move(problem), std::move(remedy)};
    }
    [[noreturn]] void damaged() const {
        throw input_error{{.file = file_, .line = line_},
                          "the checkpoint is damaged",
                          "restore it from a copy, or remove it and begin anew"};
    }

    /// The first line: format, then digest; what is left must have that digest.
    void header() {
        next();
        if (line_text_ != checkpoint_format) {
            refuse("it is no checkpoint, or one that another version of sivid wrote",
                   "name the right file, resume it with that version, or remove it and begin anew");
        }
        auto const stated = open("sha256").word();
        close();
        if (sha256(rest_) != stated) damaged();
    }
    /// Goes to the next line, which must begin with this word.
    checkpoint_parser& open(std::string_view first) {
        next();
        if (word() != first) damaged();
        return *this;
    }
    /// The next line's first word.
    [[nodiscard]] std::string_view open() {
        next();
        return word();
    }
    /// The line must be at its end.
    void close() const {
        if (!line_text_.empty()) damaged();
    }
    void end() {
        open("end").close();
        if (!rest_.empty()) damaged();
    }

    [[nodiscard]] std::string_view word() {
        auto const space = std::min(line_text_.find(' '), line_text_.size());
        auto const result = line_text_.substr(0, space);
        if (result.empty()) damaged();
        line_text_.remove_prefix(std::min(space + 1, line_text_.size()));
        return result;
    }
    [[nodiscard]] std::size_t count() {
        auto const text = word();
        std::size_t value = 0;
        auto const end = text.data() + text.size();
        auto const read = std::from_chars(text.data(), end, value);
        if (read.ec != std::errc{} || read.ptr != end) damaged();
        return value;
    }
    /// How many lines follow: never more than there is text for.
    [[nodiscard]] std::size_t lines() {
        auto const value = count();
        close();
        if (value > rest_.size()) damaged();
        return value;
    }
    [[nodiscard]] double number() {
        auto const value = from_hex(word());
        if (!value) damaged();
        return *value;
    }
    [[nodiscard]] std::vector<double> numbers() {
        std::vector<double> result;
        while (!line_text_.empty()) result.push_back(number());
        return result;
    }
    /// So many rows of certificates, their heading and the empty line after them.
    [[nodiscard]] exclusion_proof certificates(std::size_t rows) {
        std::string text;
        for (std::size_t k = 0; k < rows + 2; ++k) {
            next();
            text.append(std::exchange(line_text_, {})).append(1, '\n');
        }
        try {
            auto proof = read_certificates(csv_table{file_, text});
            if (proof.size() == rows) return proof;
        } catch (input_error const&) { // its remedy is that of another file
        }
        damaged();
    }
    /// All that is left of the line.
    [[nodiscard]] box sides() {
        std::vector<interval> result;
        while (!line_text_.empty()) {
            double const lo = number(), hi = number();
            if (!(lo <= hi)) damaged();
            result.push_back(interval_traits<interval>::bounds(lo, hi));
        }
        return box(std::move(result));
    }

private:
    void next() {
        auto const end = rest_.find('\n');
        if (end == std::string_view::npos) {
            line_ = 0;
            damaged();
        }
        ++line_;
        line_text_ = rest_.substr(0, end);
        rest_.remove_prefix(end + 1);
    }

    std::string file_;
    std::string_view rest_, line_text_;
    std::size_t line_ = 0;
};

inline approximate_fit take_guess(checkpoint_parser& in) {
    approximate_fit fit;
    auto const experiments = in.count();
    fit.inflation = in.number();
    fit.squares = in.number();
    in.close();
    fit.parameters = in.open("parameters").numbers();
    for (std::size_t e = 0; e < experiments; ++e) {
        fit.starts.push_back(in.open("start").numbers());
    }
    for (std::size_t e = 0; e < experiments; ++e) {
        fit.residuals.push_back(in.open("residuals").numbers());
    }
    return fit;
}

inline window_contraction take_windows(checkpoint_parser& in) {
    window_contraction w;
    auto const experiments = in.count();
    bool const empty = in.count() != 0;
    w.rounds = in.count();
    w.windows = in.count();
    w.longest = in.number();
    w.seconds = in.number();
    in.close();
    in.open("slower_inputs");
    w.input_period = in.number();
    w.integrations = in.count();
    in.close();
    for (std::size_t e = 0; e < experiments; ++e) w.starts.push_back(in.open("from").sides());
    if (!empty) w.rest = in.open("rest").sides();
    return w;
}

inline search_state take_search(checkpoint_parser& in) {
    search_state s;
    s.prior = in.open("prior").sides();
    s.whole = in.open("whole").sides();
    s.last_hull = in.open("last_hull").sides();
    in.open("counters");
    s.pushed = in.count();
    s.tested = in.count();
    s.cost = in.count();
    s.batches = in.count();
    s.accuracy_reached = in.count() != 0;
    s.measured_at = in.count();
    s.rested = in.count() != 0;
    s.next_look = in.count();
    in.close();
    in.open("numbers");
    s.waiting_volume = in.number();
    s.seconds = in.number();
    in.close();
    for (auto k = in.open("paved").lines(); k > 0; --k) {
        auto const kind = in.open();
        auto const letter = verdict_letters.find(kind);
        if (kind.size() != 1 || letter == std::string_view::npos) in.damaged();
        s.paved.push_back({in.sides(), static_cast<box_verdict>(letter)});
    }
    for (auto k = in.open("lessons").lines(); k > 0; --k) {
        auto& boxes = s.lessons.emplace_back();
        for (auto n = in.open("lesson").lines(); n > 0; --n) {
            boxes.push_back(in.open("about").sides());
        }
    }
    for (auto k = in.open("waiting").lines(); k > 0; --k) {
        auto& w = s.waiting.emplace_back();
        auto const kind = in.open();
        if (kind == "knows") {
            w.known = search_state::origin{};
            w.known->lesson = in.count();
            w.known->place = in.count();
            w.known->bytes = in.count();
        } else if (kind != "new") {
            in.damaged();
        }
        w.volume = in.number();
        w.number = in.count();
        w.set = in.sides();
    }
    s.proof = in.certificates(in.open("proof").lines());
    return s;
}

} // namespace io_detail

SIVID_DECL identification_state parse_checkpoint(std::string_view text, std::string const& file,
                                                 std::string const& problem) {
    io_detail::checkpoint_parser in{file, text};
    in.header();
    std::string const writer{in.open("version").word()};
    in.close();
    if (writer != version) {
        in.refuse(text_of("the checkpoint was written by sivid ", in_quotes(writer), ", this is ",
                          std::string{version}),
                  "resume it with that version, or remove it and begin anew");
    }
    auto const stated = in.open("problem").word();
    in.close();
    if (stated != problem) {
        in.refuse("the checkpoint is of another problem: other data, another model or prior, or "
                  "other options",
                  "use what it was begun with, or remove it and begin anew");
    }
    identification_state state;
    state.problem = in.open("asked").word();
    in.close();
    state.seconds = in.open("spent").number();
    in.close();
    auto const guess = in.open();
    if (guess == "guess") {
        state.guess = io_detail::take_guess(in);
    } else if (guess != "no_guess") {
        in.damaged();
    }
    auto const windows = in.open();
    if (windows == "windows") {
        state.windows = io_detail::take_windows(in);
    } else if (windows != "no_windows") {
        in.damaged();
    }
    state.search = io_detail::take_search(in);
    in.end();
    auto const sides = state.search.prior.size();
    if (state.windows && state.windows->rest.size() == 0) { // nothing was left
        state.windows->rest = empty_box(sides);
    }
    if (state.windows && state.windows->rest.size() != sides) in.damaged();
    try {
        state.search.require_valid();
    } catch (std::invalid_argument const&) {
        in.damaged();
    }
    return state;
}

SIVID_DECL identification_state read_checkpoint(std::filesystem::path const& file,
                                                std::string const& problem) {
    return parse_checkpoint(read_text(file), file.string(), problem);
}

} // namespace sivid

#endif
