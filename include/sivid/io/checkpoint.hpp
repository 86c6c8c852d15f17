// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_CHECKPOINT_HPP
#define SIVID_IO_CHECKPOINT_HPP

#include <sivid/compiled.hpp>
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
#include <vector>

namespace sivid {

namespace io_detail {

inline constexpr std::string_view checkpoint_format = "sivid-checkpoint-6";

/// One letter a verdict, in the order of box_verdict.
inline constexpr std::string_view verdict_letters = "ioup";

/// Lines of words; doubles as exact hexadecimal text.
class checkpoint_lines {
public:
    template <class... Values>
    void operator()(std::string_view word, Values const&... values) {
        text_.append(word);
        (put(values), ...);
        text_ += '\n';
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
        for (auto const& side : x) {
            put(side.lower());
            put(side.upper());
        }
    }

    std::string text_;
};

inline void put(checkpoint_lines& line, approximate_fit const& fit) {
    line("guess", fit.starts.size(), fit.inflation, fit.squares);
    line("parameters", fit.parameters);
    for (auto const& x : fit.starts) line("start", x);
    for (auto const& r : fit.residuals) line("residuals", r);
}

inline void put(checkpoint_lines& line, window_contraction const& w) {
    line("windows", w.starts.size(), w.empty() ? 1 : 0, w.rounds, w.windows, w.longest, w.seconds);
    line("slower_inputs", w.input_period, w.integrations);
    for (auto const& x : w.starts) line("from", x);
    if (!w.empty()) line("rest", w.rest);
}

inline void put(checkpoint_lines& line, search_state const& s) {
    line("prior", s.prior);
    line("whole", s.whole);
    line("last_hull", s.last_hull);
    line("counters", s.pushed, s.tested, s.cost, s.batches, s.accuracy_reached ? 1 : 0,
         s.measured_at, s.rested ? 1 : 0, s.next_look);
    line("numbers", s.waiting_volume, s.seconds);
    line("paved", s.paved.size());
    for (auto const& b : s.paved) {
        line(verdict_letters.substr(static_cast<std::size_t>(b.verdict), 1), b.set);
    }
    line("lessons", s.lessons.size());
    for (auto const& boxes : s.lessons) {
        line("lesson", boxes.size());
        for (auto const& x : boxes) line("about", x);
    }
    line("waiting", s.waiting.size());
    for (auto const& w : s.waiting) {
        if (w.known) {
            line("knows", w.known->lesson, w.known->place, w.known->bytes, w.volume, w.number,
                 w.set);
        } else {
            line("new", w.volume, w.number, w.set);
        }
    }
    line("proof", s.proof.size());
    line(certificates_csv(s.proof));
}

} // namespace io_detail

/// The state of an identification as text: format and digest of the rest in front, numbers exact.
/// @param problem  `problem_digest` of what is identified
/// @cost  linear in the boxes, about 50 bytes a side
[[nodiscard]] inline std::string checkpoint_text(identification_state const& state,
                                                 std::string const& problem) {
    io_detail::checkpoint_lines line;
    line("version", version);
    line("problem", std::string_view{problem});
    line("asked", std::string_view{state.problem});
    line("spent", state.seconds);
    if (state.guess) {
        put(line, *state.guess);
    } else {
        line("no_guess");
    }
    if (state.windows) {
        put(line, *state.windows);
    } else {
        line("no_windows");
    }
    put(line, state.search);
    line("end");
    auto const& body = line.text();
    std::string text{io_detail::checkpoint_format};
    return text.append("\nsha256 ").append(sha256(body)).append(1, '\n').append(body);
}

/// Writes a checkpoint so that a kill at any moment, or a loss of power, leaves this one or the one
/// before.
/// @throws output_error
SIVID_DECL void write_checkpoint(std::filesystem::path const& file,
                                 identification_state const& state, std::string const& problem);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/impl/checkpoint.ipp>
#endif

#endif // SIVID_IO_CHECKPOINT_HPP
