// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_CHECKPOINT_HPP
#define SIVID_IO_CHECKPOINT_HPP

#include <sivid/io/result/certificates_csv.hpp>
#include <sivid/io/text/durable_file.hpp>
#include <sivid/number/decimal_output.hpp>
#include <sivid/number/text/sha256.hpp>
#include <sivid/paving/identification_state.hpp>
#include <sivid/version.hpp>

#include <concepts>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace sivid {

namespace io_detail {

inline constexpr std::string_view checkpoint_format = "sivid-checkpoint-9";

/// One letter a verdict, in the order of box_verdict.
inline constexpr std::string_view verdict_letters = "ioup";

/// The size of a list whose elements follow on lines of their own; a reader gives it that size.
template <class List>
struct size_of {
    List& list;
};
template <class List>
size_of(List&) -> size_of<List>;

/// Text up to the end of a line: a line break in it becomes a space.
template <class Text>
struct whole_line {
    Text& text;
};
template <class Text>
whole_line(Text&) -> whole_line<Text>;

/// Writes lines of words; doubles as exact hexadecimal text.
class checkpoint_lines {
public:
    template <class... Values>
    void operator()(std::string_view word, Values const&... values) {
        text_ += word;
        rest(values...);
    }
    /// Begins a line with one of two words. @returns whether there is something
    bool begin(auto const& what, std::string_view there, std::string_view nothing) {
        text_ += what ? there : nothing;
        return what.has_value();
    }
    void begin(box_verdict v) { text_ += verdict_letters[static_cast<std::size_t>(v)]; }
    /// Goes on with the line.
    template <class... Values>
    void more(Values const&... values) {
        (put(values), ...);
    }
    template <class... Values>
    void rest(Values const&... values) {
        more(values...);
        text_ += '\n';
    }
    void certificates(exclusion_proof const& proof) {
        (*this)("proof", proof.size());
        (*this)(certificates_csv(proof));
    }
    [[nodiscard]] std::string const& text() const { return text_; }

private:
    void put(std::string_view word) {
        text_ += ' ';
        text_ += word;
    }
    void put(double x) { put(std::string_view{to_hex(x)}); }
    void put(std::integral auto x) { put(std::string_view{std::to_string(x)}); }
    void put(std::vector<double> const& list) {
        for (double const x : list) put(x);
    }
    void put(box const& x) {
        for (auto const& side : x) more(side.lower(), side.upper());
    }
    template <class List>
    void put(size_of<List> const& of) {
        put(of.list.size());
    }
    template <class Text>
    void put(whole_line<Text> const& line) {
        text_ += ' ';
        for (char const c : line.text) text_ += c == '\n' ? ' ' : c;
    }
    void put(contraction_record::outcome how) { put(static_cast<std::size_t>(how)); }

    std::string text_;
};

/// The lines of a state in their order, for who writes and who reads them.
template <class Lines, class State>
void list_state(Lines& line, State& state) {
    line("asked", state.problem);
    line("spent", state.seconds, state.work);
    if (line.begin(state.guess, "guess", "no_guess")) {
        auto& fit = *state.guess;
        line.rest(size_of{fit.starts}, fit.inflation, fit.squares);
        line("parameters", fit.parameters);
        for (auto& x : fit.starts) line("start", x);
        if constexpr (!std::is_const_v<State>) fit.residuals.resize(fit.starts.size());
        for (auto& r : fit.residuals) line("residuals", r);
    } else {
        line.rest();
    }
    if (line.begin(state.left, "left", "all_left")) {
        auto& left = *state.left;
        bool empty = is_empty(left.parameters);
        line.rest(size_of{left.starts}, empty);
        for (auto& x : left.starts) line("from", x);
        if (!empty) line("parameters", left.parameters);
    } else {
        line.rest();
    }
    line("journal", size_of{state.journal});
    for (auto& r : state.journal) {
        line("by", whole_line{r.by});
        line("why", whole_line{r.why});
        line("came_of_it", r.how, r.left, r.integrations, r.seconds, size_of{r.figures});
        for (auto& [name, value] : r.figures) line("figure", value, whole_line{name});
    }
    auto& s = state.search;
    line("prior", s.prior);
    line("whole", s.whole);
    line("last_hull", s.last_hull);
    line("counters", s.pushed, s.tested, s.cost, s.batches, s.accuracy_reached, s.measured_at,
         s.rested, s.next_look);
    line("numbers", s.waiting_volume, s.seconds, s.work);
    line("paved", size_of{s.paved});
    for (auto& b : s.paved) {
        line.begin(b.verdict);
        line.rest(b.set);
    }
    line("lessons", size_of{s.lessons});
    for (auto& boxes : s.lessons) {
        line("lesson", size_of{boxes});
        for (auto& x : boxes) line("about", x);
    }
    line("waiting", size_of{s.waiting});
    for (auto& w : s.waiting) {
        if (line.begin(w.known, "knows", "new"))
            line.more(w.known->lesson, w.known->place, w.known->bytes);
        line.rest(w.volume, w.number, w.set);
    }
    line.certificates(s.proof);
    line("end");
}

} // namespace io_detail

/// The state of an identification as text: format and digest of the rest in front, numbers exact.
/// @param problem  `problem_digest` of what is identified
/// @cost  linear in the boxes, about 50 bytes a side
[[nodiscard]] inline std::string checkpoint_text(identification_state const& state,
                                                 std::string const& problem) {
    io_detail::checkpoint_lines line;
    line("version", version);
    line("problem", problem);
    list_state(line, state);
    auto const& body = line.text();
    std::string text{io_detail::checkpoint_format};
    return text.append("\nsha256 ").append(sha256(body)).append(1, '\n').append(body);
}

/// Writes a checkpoint so that a kill at any moment, or a loss of power, leaves this one or the one
/// before.
/// @throws output_error
inline void write_checkpoint(std::filesystem::path const& file, identification_state const& state,
                             std::string const& problem) {
    write_durably(file, checkpoint_text(state, problem));
}

} // namespace sivid

#endif // SIVID_IO_CHECKPOINT_HPP
