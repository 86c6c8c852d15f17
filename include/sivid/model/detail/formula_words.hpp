// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_DETAIL_FORMULA_WORDS_HPP
#define SIVID_MODEL_DETAIL_FORMULA_WORDS_HPP

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace sivid::model_detail {

/// A text as words, numbers and signs, taken one after the other.
class formula_words {
public:
    /// Throws: the position in the text, what is wrong there, what to do.
    using failure =
        std::function<void(std::size_t, std::string const& problem, std::string const& remedy)>;
    /// What depends on whose text it is.
    struct manner {
        failure fail;
        std::span<std::string_view const> kept = {}; ///< words that are no names
        std::size_t longest = 10'000;                ///< characters
        bool comments = false;                       ///< from # to the end of the line
    };

    /// @param begin  of what is read; positions count from the begin of the text
    formula_words(std::string_view text, manner how, std::size_t begin = 0)
        : text_(text), how_(std::move(how)), at_(begin) {
        if (text.size() - begin > how_.longest)
            fail_at(begin + how_.longest, "the text is too long",
                    "use at most " + std::to_string(how_.longest) + " characters");
        skip();
    }

    [[nodiscard]] std::size_t position() const { return at_; }
    /// What was read since a position, without spaces behind.
    [[nodiscard]] std::string text_from(std::size_t begin) const {
        auto end = at_;
        while (end > begin && is_space(text_[end - 1])) --end;
        return std::string(text_.substr(begin, end - begin));
    }
    /// Whether what comes next stands on the line of a position.
    [[nodiscard]] bool on_line_of(std::size_t begin) const {
        return text_.substr(begin, at_ - begin).find('\n') == std::string_view::npos;
    }
    [[nodiscard]] bool at_end() const { return at_ == text_.size(); }

    /// Whether the next word or sign is this one.
    [[nodiscard]] bool peek(std::string_view wanted) const {
        if (text_.substr(at_, wanted.size()) != wanted) return false;
        bool const word = is_letter(wanted.front());
        auto const after = at_ + wanted.size();
        return !word || after == text_.size() || !continues(text_[after]);
    }
    [[nodiscard]] bool take(std::string_view wanted) {
        if (!peek(wanted)) return false;
        at_ += wanted.size();
        skip();
        return true;
    }
    void need(std::string_view wanted, std::string const& remedy) {
        if (!take(wanted)) fail("'" + std::string(wanted) + "' is missing", remedy);
    }
    /// One of < <= > >=.
    [[nodiscard]] std::optional<std::string_view> take_relation() {
        if (peek("==") || peek("!=") || peek("="))
            fail("real numbers are not compared for equality",
                 "write a tolerance, such as abs(x - 2) < 0.01");
        for (std::string_view relation : {"<=", ">=", "<", ">"}) {
            if (take(relation)) return relation;
        }
        return std::nullopt;
    }
    /// Digits with point and exponent; no sign.
    [[nodiscard]] std::optional<std::string_view> take_number() {
        auto end = at_;
        auto const digits = [&] {
            auto const begin = end;
            while (end < text_.size() && is_digit(text_[end])) ++end;
            return end - begin;
        };
        auto count = digits();
        if (end < text_.size() && text_[end] == '.') {
            ++end;
            count += digits();
        }
        if (count == 0) return std::nullopt;
        if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
            auto const mantissa = end++;
            if (end < text_.size() && (text_[end] == '+' || text_[end] == '-')) ++end;
            if (digits() == 0) end = mantissa;
        }
        if (end < text_.size() && (continues(text_[end]) || text_[end] == '.'))
            fail("this is no number", "write a decimal such as 0.25 or 1e-3, and * for products");
        auto const number = text_.substr(at_, end - at_);
        at_ = end;
        skip();
        return number;
    }
    /// A name, which may have dots within, as those of effects.
    [[nodiscard]] std::optional<std::string> take_name() {
        if (at_end() || !is_letter(text_[at_])) return std::nullopt;
        auto end = at_;
        while (end < text_.size() && continues(text_[end])) ++end;
        std::string name(text_.substr(at_, end - at_));
        if (std::find(how_.kept.begin(), how_.kept.end(), name) != how_.kept.end())
            fail("'" + name + "' cannot stand here", "an expression is needed");
        at_ = end;
        skip();
        return name;
    }
    /// Everything up to a sign, which is taken, too; nothing where it is not on this line.
    [[nodiscard]] std::optional<std::string_view> take_up_to(char sign) {
        auto const end = text_.find_first_of(std::array{sign, '\n'}.data(), at_, 2);
        if (end == std::string_view::npos || text_[end] != sign) return std::nullopt;
        auto const taken = text_.substr(at_, end - at_);
        at_ = end + 1;
        skip();
        return taken;
    }

    [[noreturn]] void fail(std::string const& problem, std::string const& remedy) const {
        fail_at(at_, problem, remedy);
    }
    [[noreturn]] void fail_at(std::size_t position, std::string const& problem,
                              std::string const& remedy) const {
        how_.fail(position, problem, remedy);
        throw std::logic_error("formula_words: a failure that does not throw");
    }

private:
    static bool is_digit(char c) { return c >= '0' && c <= '9'; }
    static bool is_letter(char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    }
    static bool continues(char c) { return is_letter(c) || is_digit(c) || c == '.'; }
    static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
    void skip() {
        for (;;) {
            while (at_ < text_.size() && is_space(text_[at_])) ++at_;
            if (!how_.comments || at_ == text_.size() || text_[at_] != '#') return;
            at_ = std::min(text_.find('\n', at_), text_.size());
        }
    }

    std::string_view text_;
    manner how_;
    std::size_t at_ = 0;
};

} // namespace sivid::model_detail

#endif
