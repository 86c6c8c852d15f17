// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_TEXT_JSON_WRITER_HPP
#define SIVID_IO_TEXT_JSON_WRITER_HPP

#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/number/decimal_output.hpp>
#include <sivid/number/interval.hpp>

#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sivid {

/// Writes JSON text in which bounds stay bounds: a lower bound is printed as a decimal that is not
/// above it, an upper bound as one that is not below it. What is not finite becomes null ("no
/// bound").
///   json_writer json;
///   json.begin_object().key("hull").bounds(x).key("unit").string("m^2").end_object();
///   write_atomically(path, json.text());
class json_writer {
public:
    /// How the members of an object or a list are laid out.
    enum class layout { lines, one_line };

    json_writer& begin_object(layout l = layout::lines) { return open('{', '}', l); }
    json_writer& begin_array(layout l = layout::lines) { return open('[', ']', l); }
    json_writer& end_object() { return close('}'); }
    json_writer& end_array() { return close(']'); }

    json_writer& key(std::string_view name) {
        if (open_.empty() || open_.back().end != '}' || after_key_)
            misuse("a key outside an object");
        separate();
        append_quoted(name);
        text_ += ": ";
        after_key_ = true;
        return *this;
    }

    json_writer& string(std::string_view value) {
        before_value();
        append_quoted(value);
        return *this;
    }
    json_writer& boolean(bool value) { return raw(value ? "true" : "false"); }
    json_writer& null() { return raw("null"); }
    json_writer& integer(std::integral auto value) { return raw(std::to_string(value)); }

    /// A decimal that is not above the value.
    json_writer& lower_bound(double value) {
        return std::isfinite(value) ? raw(to_decimal_lower(value)) : null();
    }
    /// A decimal that is not below the value.
    json_writer& upper_bound(double value) {
        return std::isfinite(value) ? raw(to_decimal_upper(value)) : null();
    }
    /// The shortest decimal that reads back as the value: for what is no bound.
    json_writer& nearest(double value) {
        if (!std::isfinite(value)) return null();
        char buffer[64];
        auto const end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
        return raw({buffer, static_cast<std::size_t>(end - buffer)});
    }
    json_writer& decimal(exact_decimal const& value) { return raw(value.text()); }

    /// [lower, upper], outward; null when empty.
    json_writer& bounds(interval const& x) {
        if (is_empty(x)) return null();
        return begin_array(layout::one_line)
            .lower_bound(lower(x))
            .upper_bound(upper(x))
            .end_array();
    }

    /// The document, with a line end.
    /// @throws std::logic_error when something is still open
    [[nodiscard]] std::string text() const {
        if (!open_.empty()) misuse("unfinished document");
        return text_ + "\n";
    }

private:
    struct level {
        char end;
        layout shape;
        bool first = true;
    };

    [[noreturn]] static void misuse(char const* what) {
        throw std::logic_error{std::string{"json_writer: "} + what};
    }

    json_writer& open(char begin, char end, layout l) {
        before_value();
        text_ += begin;
        bool const in_line = !open_.empty() && open_.back().shape == layout::one_line;
        open_.push_back({end, in_line ? layout::one_line : l});
        return *this;
    }
    json_writer& close(char end) {
        if (open_.empty() || open_.back().end != end || after_key_) misuse("wrong nesting");
        auto const was = open_.back();
        open_.pop_back();
        if (!was.first && was.shape == layout::lines) new_line();
        text_ += end;
        return *this;
    }
    json_writer& raw(std::string_view value) {
        before_value();
        text_ += value;
        return *this;
    }
    void before_value() {
        if (after_key_) {
            after_key_ = false;
            return;
        }
        if (open_.empty() ? !text_.empty() : open_.back().end == '}')
            misuse("a value without a key");
        if (!open_.empty()) separate();
    }
    void separate() {
        auto& top = open_.back();
        if (!top.first) text_ += top.shape == layout::lines ? "," : ", ";
        if (top.shape == layout::lines) new_line();
        top.first = false;
    }
    void new_line() {
        text_ += '\n';
        text_.append(2 * open_.size(), ' ');
    }
    void append_quoted(std::string_view value) {
        text_ += '"';
        for (char c : value) {
            auto const byte = static_cast<unsigned char>(c);
            if (c == '"' || c == '\\') {
                text_ += '\\';
                text_ += c;
            } else if (byte < 0x20) {
                constexpr char hex[] = "0123456789abcdef";
                text_ += "\\u00";
                text_ += hex[byte >> 4];
                text_ += hex[byte & 15];
            } else {
                text_ += c;
            }
        }
        text_ += '"';
    }

    std::string text_;
    std::vector<level> open_;
    bool after_key_ = false;
};

} // namespace sivid

#endif // SIVID_IO_TEXT_JSON_WRITER_HPP
