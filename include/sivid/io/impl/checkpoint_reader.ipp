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
        if (std::string stated; (*this)("sha256", stated), sha256(rest_) != stated) damaged();
    }
    void end() const {
        if (!rest_.empty()) damaged();
    }

    /// Goes to the next line, which must begin with this word, and reads all of it.
    template <class... Values>
    void operator()(std::string_view first, Values&&... values) {
        if (begin() != first) damaged();
        rest(values...);
    }
    template <class T>
    bool begin(std::optional<T>& what, std::string_view there, std::string_view nothing) {
        auto const kind = begin();
        if (kind == there) what = T{};
        if (kind != there && kind != nothing) damaged();
        return what.has_value();
    }
    void begin(box_verdict& v) {
        auto const kind = begin();
        auto const letter = verdict_letters.find(kind);
        if (kind.size() != 1 || letter == std::string_view::npos) damaged();
        v = static_cast<box_verdict>(letter);
    }
    template <class... Values>
    void more(Values&&... values) {
        (take(values), ...);
    }
    template <class... Values>
    void rest(Values&&... values) {
        more(values...);
        if (!line_text_.empty()) damaged();
    }
    /// So many rows of certificates, their heading and the empty line after them.
    void certificates(exclusion_proof& proof) {
        std::size_t rows = 0;
        (*this)("proof", rows);
        std::string text;
        for (std::size_t k = 0; k < rows + 2; ++k) {
            next();
            text.append(std::exchange(line_text_, {})).append(1, '\n');
        }
        try {
            proof = read_certificates(csv_table{file_, text});
            if (proof.size() == rows) return;
        } catch (input_error const&) { // its remedy is that of another file
        }
        damaged();
    }

private:
    /// The next line's first word.
    [[nodiscard]] std::string_view begin() {
        next();
        return word();
    }
    [[nodiscard]] std::string_view word() {
        auto const space = std::min(line_text_.find(' '), line_text_.size());
        auto const result = line_text_.substr(0, space);
        if (result.empty()) damaged();
        line_text_.remove_prefix(std::min(space + 1, line_text_.size()));
        return result;
    }
    void take(std::string& text) { text = word(); }
    void take(std::size_t& value) {
        auto const text = word();
        auto const end = text.data() + text.size();
        auto const read = std::from_chars(text.data(), end, value);
        if (read.ec != std::errc{} || read.ptr != end) damaged();
    }
    void take(bool& value) {
        std::size_t number = 0;
        take(number);
        value = number != 0;
    }
    void take(double& value) {
        auto const number = from_hex(word());
        if (!number) damaged();
        value = *number;
    }
    /// All that is left of the line.
    void take(std::vector<double>& list) {
        while (!line_text_.empty()) take(list.emplace_back());
    }
    void take(box& x) {
        std::vector<interval> sides;
        while (!line_text_.empty()) {
            double lo = 0, hi = 0;
            more(lo, hi);
            if (!(lo <= hi)) damaged();
            sides.push_back(interval_traits<interval>::bounds(lo, hi));
        }
        x = box(std::move(sides));
    }
    /// Never more lines than there is text for.
    template <class List>
    void take(size_of<List> const& of) {
        std::size_t size = 0;
        take(size);
        if (size > rest_.size()) damaged();
        of.list.resize(size);
    }

    template <class Text>
    void take(whole_line<Text> const& line) {
        line.text = std::exchange(line_text_, {});
    }
    void take(contraction_record::outcome& how) {
        std::size_t number = 0;
        take(number);
        how = static_cast<contraction_record::outcome>(number);
        if (to_string(how) == to_string(contraction_record::outcome::cut_short) &&
            how != contraction_record::outcome::cut_short)
            damaged();
    }

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

} // namespace io_detail

SIVID_DECL identification_state parse_checkpoint(std::string_view text, std::string const& file,
                                                 std::string const& problem) {
    io_detail::checkpoint_parser in{file, text};
    in.header();
    std::string writer, stated;
    in("version", writer);
    if (writer != version) {
        in.refuse(text_of("the checkpoint was written by sivid ", in_quotes(writer), ", this is ",
                          std::string{version}),
                  "resume it with that version, or remove it and begin anew");
    }
    in("problem", stated);
    if (stated != problem) {
        in.refuse("the checkpoint is of another problem: other data, another model or prior, or "
                  "other options",
                  "use what it was begun with, or remove it and begin anew");
    }
    identification_state state;
    list_state(in, state);
    in.end();
    auto const sides = state.search.prior.size();
    if (state.left && state.left->parameters.size() == 0) { // nothing was left
        state.left->parameters = empty_box(sides);
    }
    if (state.left && state.left->parameters.size() != sides) in.damaged();
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
