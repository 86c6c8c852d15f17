// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_INPUT_ERROR_HPP
#define SIVID_IO_INPUT_ERROR_HPP

#include <sivid/io/text/printable_text.hpp>

#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace sivid {

/// One text from its parts. (A literal + a temporary string draws a false alarm, -Wrestrict, from
/// g++ 12.)
template <std::convertible_to<std::string_view>... Parts>
[[nodiscard]] std::string text_of(Parts const&... parts) {
    std::string text;
    (text.append(std::string_view{parts}), ...);
    return text;
}

/// Where in the input something is wrong. A table has line and column, a JSON file has a pointer.
struct input_place {
    std::string file;
    std::size_t line = 0;   ///< physical line from 1; 0 = not known
    std::size_t column = 0; ///< cell of the line from 1 (tables), character from 1 (malformed JSON)
    std::string heading = {}; ///< the heading of that cell, if it has one
    std::string pointer = {}; ///< RFC 6901, "" = the whole document
    bool is_json = false;
};

/// What is wrong with an input, where, and what to do: one message for one defect, nothing is read
/// further.
///   "S1.inputs.csv: line 12, column 3 (delta): '0,1x' is not a number; write a decimal such as
///   0.25 or 1e-3"
/// The message is printable, whatever the input holds, and of a length that can be read; place,
/// problem and remedy are what was given.
class input_error : public std::runtime_error {
public:
    input_error(input_place place, std::string problem, std::string remedy)
        : std::runtime_error(message(place, problem, remedy)),
          place_(std::move(place)),
          problem_(std::move(problem)),
          remedy_(std::move(remedy)) {}

    [[nodiscard]] input_place const& place() const { return place_; }
    [[nodiscard]] std::string const& problem() const { return problem_; }
    [[nodiscard]] std::string const& remedy() const { return remedy_; }

private:
    static std::string message(input_place const& place, std::string const& problem,
                               std::string const& remedy);

    input_place place_;
    std::string problem_, remedy_;
};

/// "'text'" for messages: shortened, and with control characters made visible.
[[nodiscard]] inline std::string in_quotes(std::string_view text) {
    return "'" + printable_text(text, 40) + "'";
}

inline std::string input_error::message(input_place const& place, std::string const& problem,
                                        std::string const& remedy) {
    std::string text = printable_path(place.file);
    if (place.is_json) {
        text += text_of(": ", place.pointer.empty() ? std::string{"(document)"}
                                                    : printable_text(place.pointer, 120));
    }
    if (place.line > 0) text += text_of(": line ", std::to_string(place.line));
    if (place.column > 0) text += text_of(", column ", std::to_string(place.column));
    if (!place.heading.empty()) text += " (" + printable_text(place.heading, 60) + ")";
    text += ": " + printable_text(problem, 1000);
    if (!remedy.empty()) text += "; " + printable_text(remedy, 1000);
    return text;
}

} // namespace sivid

#endif // SIVID_IO_INPUT_ERROR_HPP
