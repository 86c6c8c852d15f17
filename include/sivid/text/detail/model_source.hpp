// SPDX-License-Identifier: MIT
#ifndef SIVID_TEXT_DETAIL_MODEL_SOURCE_HPP
#define SIVID_TEXT_DETAIL_MODEL_SOURCE_HPP

#include <sivid/io/text/printable_text.hpp>
#include <sivid/model/detail/formula_words.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/number/text/nearest_name.hpp>
#include <sivid/text/model_text_error.hpp>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid::text_detail {

/// The text of a model's file, UTF-8 with line feeds alone at the ends of lines, and the places in
/// it: positions are bytes from the begin.
class model_source {
public:
    static constexpr std::size_t largest = 200'000;     ///< [byte]
    static constexpr std::size_t longest_line = 10'000; ///< likewise

    /// @throws model_text_error  for what is no such text
    model_source(std::string name, std::string text)
        : name_(std::move(name)), text_(std::move(text)) {
        if (text_.size() > largest)
            fail_whole("larger than 200 kB", "a model of a robot is shorter: check the path");
        require_utf8();
        std::string plain;
        plain.reserve(text_.size());
        for (std::size_t i = 0; i < text_.size(); ++i)
            if (text_[i] != '\r' || text_.substr(i, 2) != "\r\n") plain += text_[i];
        text_ = std::move(plain);
        for (std::size_t at = 0; at <= text_.size();) {
            lines_.push_back(at);
            auto const end = std::min(text_.find('\n', at), text_.size());
            if (end - at > longest_line)
                fail(end, "a line of more than 10000 bytes", "begin new lines");
            at = end + 1;
        }
    }

    [[nodiscard]] std::string const& name() const { return name_; }
    [[nodiscard]] std::string_view text() const { return text_; }

    [[noreturn]] void fail(std::size_t position, std::string const& problem,
                           std::string const& remedy) const {
        position = std::min(position, text_.size());
        auto const before = std::string_view(text_).substr(0, position);
        auto const begin = before.rfind('\n') + 1; // 0 where there is none
        input_place place{.file = name_};
        place.line = 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
        place.column = 1;
        for (auto rest = before.substr(begin); !rest.empty(); ++place.column)
            rest.remove_prefix(io_detail::first_code_point(rest).size);
        auto const end = std::min(text_.find('\n', position), text_.size());
        throw model_text_error(place, problem, remedy,
                               std::string_view(text_).substr(begin, end - begin));
    }
    [[noreturn]] void fail_whole(std::string const& problem, std::string const& remedy) const {
        throw model_text_error({.file = name_}, problem, remedy);
    }
    [[nodiscard]] model_detail::formula_words::failure failing() const {
        return [this](std::size_t position, std::string const& problem, std::string const& remedy) {
            fail(position, problem, remedy);
        };
    }

    /// The position of a line and of a column in code points, both from 1.
    [[nodiscard]] std::size_t position(std::size_t line, std::size_t column) const {
        auto at = line == 0 || line > lines_.size() ? text_.size() : lines_[line - 1];
        for (; column > 1 && at < text_.size(); --column)
            at += io_detail::first_code_point(std::string_view(text_).substr(at)).size;
        return std::min(at, text_.size());
    }

private:
    void require_utf8() {
        auto const begin = std::string_view(text_).substr(0, 2);
        bool const half_zero = begin.size() == 2 && (begin[0] == '\0') != (begin[1] == '\0');
        if (begin == "\xFF\xFE" || begin == "\xFE\xFF" || half_zero)
            fail_whole("the file is in UTF-16 or UTF-32", "save it as UTF-8");
        if (begin.size() == 2 && text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
        std::string_view const all = text_;
        for (std::size_t at = 0; at < all.size();) {
            auto const c = io_detail::first_code_point(all.substr(at));
            if (c.value == io_detail::code_point::bad)
                fail(at, "a byte that is not UTF-8", "save the file as UTF-8");
            if (c.value == 0) fail(at, "a NUL character", "save the file as plain text in UTF-8");
            at += c.size;
        }
    }

    std::string name_, text_;
    std::vector<std::size_t> lines_; ///< where they begin
};

/// "did you mean 'kt'?", or the whole list where nothing is like the name.
[[nodiscard]] inline std::string name_hint(std::string const& name,
                                           std::vector<std::string> const& known) {
    auto const nearest = nearest_name(name, known);
    if (!nearest.empty()) return "did you mean '" + nearest + "'?";
    return "known: " + (known.empty() ? "nothing" : joined(known));
}

} // namespace sivid::text_detail

#endif
