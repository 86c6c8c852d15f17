// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_TEXT_JSON_WRITER_HPP
#define SIVID_IO_TEXT_JSON_WRITER_HPP

#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/number/decimal_output.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <cmath>
#include <concepts>
#include <cstddef>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace sivid {

/// Writes JSON text in which bounds stay bounds: a lower bound is printed as a decimal that is not
/// above it, an upper bound as one that is not below it. What is not finite becomes null ("no
/// bound").
///   json_writer json;
///   json.begin_object().members("hull", x, "unit", "m^2").end_object();
///   write_durably(path, json.text());
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

    json_writer& null() { return raw("null"); }

    /// A value by its type: a truth value, a whole number, text; a double by the shortest decimal
    /// that reads back as it (for what is no bound); a decimal with its digits; an interval as
    /// `bounds`; an optional as its value, or null; any list of these on one line.
    template <class T>
    json_writer& value(T const& x) {
        if constexpr (std::same_as<T, bool>) {
            return raw(x ? "true" : "false");
        } else if constexpr (std::integral<T>) {
            return raw(std::to_string(x));
        } else if constexpr (std::same_as<T, double>) {
            return std::isfinite(x) ? raw(nearest_text(x)) : null();
        } else if constexpr (std::same_as<T, exact_decimal>) {
            return raw(x.text());
        } else if constexpr (std::same_as<T, interval>) {
            return bounds(x);
        } else if constexpr (std::convertible_to<T const&, std::string_view>) {
            before_value();
            append_quoted(x);
            return *this;
        } else if constexpr (requires { x.has_value(); }) {
            return x ? value(*x) : null();
        } else {
            begin_array(layout::one_line);
            for (auto const& element : x) value(element);
            return end_array();
        }
    }

    /// A decimal that is not above the value.
    json_writer& lower_bound(double value) {
        return std::isfinite(value) ? raw(to_decimal_lower(value)) : null();
    }
    /// A decimal that is not below the value.
    json_writer& upper_bound(double value) {
        return std::isfinite(value) ? raw(to_decimal_upper(value)) : null();
    }
    /// [lower, upper], outward.
    json_writer& bounds(double lower, double upper) {
        begin_array(layout::one_line);
        return lower_bound(lower).upper_bound(upper).end_array();
    }
    /// The same; null when empty.
    json_writer& bounds(interval const& x) {
        return is_empty(x) ? null() : bounds(lower(x), upper(x));
    }

    /// Members of the open object: key, value, key, value, ...
    template <class T, class... Rest>
    json_writer& members(std::string_view name, T const& x, Rest const&... rest) {
        key(name).value(x);
        if constexpr (sizeof...(rest) > 0) members(rest...);
        return *this;
    }
    /// An object of these members, on one line.
    json_writer& object(auto const&... keys_and_values) {
        return begin_object(layout::one_line).members(keys_and_values...).end_object();
    }

    /// The member `name`: a list of what `of` returns for each of `all`, or writes itself.
    template <class Of>
    json_writer& list(std::string_view name, auto const& all, Of const& of) {
        key(name).begin_array(layout_of<Of>(all));
        for (auto const& x : all) value_of(of, x);
        return end_array();
    }
    /// The member `name`: an object with a member for each of `all`, called as its `name` (of a
    /// pair: as its first; a text: as it is). Its value: what `of` returns for it, or writes
    /// itself; where `of` is a list, the element at the same place, as long as there is one.
    template <class Of>
    json_writer& named(std::string_view name, auto const& all, Of const& of) {
        if constexpr (requires { of.size(); }) {
            key(name).begin_object(layout::one_line);
            for (std::size_t i = 0; i < all.size() && i < of.size(); ++i)
                key(name_of(all[i])).value(of[i]);
        } else {
            key(name).begin_object(layout_of<Of>(all));
            for (auto const& x : all) key(name_of(x)).value_of(of, x);
        }
        return end_object();
    }
    /// The same of pairs of a name and a value.
    json_writer& named(std::string_view name, auto const& pairs) {
        return named(name, pairs, [](auto const& pair) { return pair.second; });
    }
    /// The member `name`: null where `x` (optional or pointer) holds nothing, else what `of`
    /// returns for what it holds, or writes itself.
    json_writer& maybe(std::string_view name, auto const& x, auto const& of) {
        key(name);
        if (!x) return null();
        return value_of(of, *x);
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
    /// What `of` makes of an element: a value, or the text that it writes itself.
    template <class Of, class T>
    static constexpr bool writes_itself = std::is_void_v<std::invoke_result_t<Of const&, T const&>>;

    json_writer& value_of(auto const& of, auto const& x) {
        if constexpr (writes_itself<decltype(of), decltype(x)>) {
            std::invoke(of, x);
        } else {
            value(std::invoke(of, x));
        }
        return *this;
    }
    template <class Of>
    static constexpr layout layout_of(auto const& all) {
        using element = decltype(*std::begin(all));
        return writes_itself<Of, element> ? layout::lines : layout::one_line;
    }
    static std::string_view name_of(auto const& x) {
        if constexpr (requires { x.name; }) {
            return x.name;
        } else if constexpr (requires { x.first; }) {
            return x.first;
        } else {
            return x;
        }
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
