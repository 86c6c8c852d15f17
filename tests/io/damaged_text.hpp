// SPDX-License-Identifier: MIT
// Random damage to a text, for the fuzz tests of the readers.
#ifndef SIVID_TESTS_IO_DAMAGED_TEXT_HPP
#define SIVID_TESTS_IO_DAMAGED_TEXT_HPP

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <string>
#include <string_view>

namespace io_support {

/// The text after 1 to `most` cuts, insertions, replacements and repetitions.
inline std::string damaged(std::string text, std::mt19937_64& random, std::size_t most) {
    auto const below = [&](std::size_t n) {
        return n == 0 ? 0 : static_cast<std::size_t>(random() % n);
    };
    static constexpr std::array<std::string_view, 55> tokens{"\x1b[31m",
                                                             "\\u001b]0;",
                                                             "\\u202e",
                                                             "\xe2\x80\xae",
                                                             "\xc2\x9b",
                                                             "\\u2028",
                                                             "-1e308",
                                                             "{",
                                                             "}",
                                                             "[",
                                                             "]",
                                                             ",",
                                                             ":",
                                                             "\"",
                                                             "\\",
                                                             "\n",
                                                             "\r",
                                                             "#",
                                                             "null",
                                                             "true",
                                                             "1e999",
                                                             "-1e-999",
                                                             "nan",
                                                             "-",
                                                             ".",
                                                             "e",
                                                             "_err",
                                                             "0.1,0.2",
                                                             ",,",
                                                             "\xff",
                                                             "\xEF\xBB\xBF",
                                                             "..",
                                                             "/",
                                                             "t",
                                                             "u",
                                                             "99999999999999999999999",
                                                             "-0",
                                                             "1e",
                                                             "\\u0000",
                                                             "\\ud800",
                                                             " ",
                                                             "\r\n",
                                                             "inf",
                                                             "t_ms",
                                                             "0",
                                                             ";",
                                                             "99999999999999999999",
                                                             "65535",
                                                             "32768",
                                                             "1e308",
                                                             "-1",
                                                             "\t",
                                                             "1e-5000",
                                                             "4294967295",
                                                             "0.1"};
    for (auto times = 1 + below(most); times > 0; --times) {
        auto const at = below(text.size() + 1);
        auto const length = below(std::min<std::size_t>(text.size() - at, 12) + 1);
        switch (below(8)) {
        case 0:
            text.erase(at, length);
            break;
        case 1:
            text.insert(at, tokens[below(tokens.size())]);
            break;
        case 2:
            text.replace(at, length, tokens[below(tokens.size())]);
            break;
        case 3:
            if (at < text.size()) text[at] = static_cast<char>(below(256));
            break;
        case 4:
            text.insert(at, text.substr(below(text.size() + 1), below(60)));
            break;
        case 5:
            if (below(4) == 0) text.resize(at);
            break;
        case 6: // a line again, or none
        {
            auto const line = text.find('\n', at);
            if (line == std::string::npos) break;
            auto const end = std::min(text.find('\n', line + 1), text.size() - 1);
            if (below(2) == 0)
                text.erase(line, end - line);
            else
                text.insert(line, text.substr(line, end - line));
            break;
        }
        case 7:
            text.insert(at,
                        std::string(below(20) == 0 ? 5000 : below(9), "0123456789k"[below(11)]));
            break;
        }
    }
    return text;
}

} // namespace io_support

#endif
