// SPDX-License-Identifier: MIT
#ifndef SIVID_TEXT_MODEL_TEXT_ERROR_HPP
#define SIVID_TEXT_MODEL_TEXT_ERROR_HPP

#include <sivid/io/input_error.hpp>
#include <sivid/io/text/printable_text.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace sivid {

/// What is wrong with the text of a model, where, and what to do. Below the message stands the line
/// with a caret under the character: @code
///     robot.toml: line 12, column 8: unknown name 'kf'; did you mean 'kt'?
///         w' = (kf*i - b*w)/J
///               ^ @endcode
class model_text_error : public input_error {
public:
    /// @param line  the text of the line, where there is one
    model_text_error(input_place place, std::string problem, std::string remedy,
                     std::string_view line = {})
        : input_error(place, std::move(problem), std::move(remedy)), whole_(input_error::what()) {
        if (place.line == 0 || place.column == 0) return;
        // What is left of the character, in code points, and as much as can be read.
        std::string shown(line);
        std::replace(shown.begin(), shown.end(), '\t', ' ');
        constexpr std::size_t most = 70;
        std::string_view rest = shown;
        auto column = place.column - 1;
        for (; column > most; --column) drop_first(rest);
        whole_ +=
            "\n    " + printable_text(rest, most + 30) + "\n    " + std::string(column, ' ') + "^";
    }
    [[nodiscard]] char const* what() const noexcept override { return whole_.c_str(); }

private:
    static void drop_first(std::string_view& text) {
        if (!text.empty()) text.remove_prefix(io_detail::first_code_point(text).size);
    }

    std::string whole_;
};

} // namespace sivid

#endif
