// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_TEXT_JSON_DOCUMENT_HPP
#define SIVID_IO_TEXT_JSON_DOCUMENT_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/io/text/text_file.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sivid {

/// A value of a JSON file that remembers its place and keeps numbers as the text that the file
/// holds (a parser's double would be a rounded one). Every accessor either gives what was asked for
/// or throws input_error.
class json_value {
public:
    enum class kind { null, boolean, number, string, array, object };

    [[nodiscard]] kind type() const { return kind_; }
    [[nodiscard]] input_place place() const {
        return {.file = file_, .pointer = pointer_, .is_json = true};
    }

    [[noreturn]] void fail(std::string problem, std::string remedy) const;

    /// A non-empty text of at most 1000 bytes without control characters and marks that hide or
    /// turn text: it may be printed (`printable_text.hpp`).
    [[nodiscard]] std::string const& string() const;

    /// The same, but it may be empty.
    [[nodiscard]] std::string const& any_string() const;

    /// The text as it is, whatever its characters: not to be printed.
    [[nodiscard]] std::string const& raw_string() const;

    /// Whether the text is the second of two words.
    [[nodiscard]] bool is_second_of(char const* first, char const* second) const {
        auto const& text = string();
        if (text == second) return true;
        if (text == first) return false;
        fail(text_of("found ", in_quotes(text)), std::string{"write "} + first + " or " + second);
    }

    [[nodiscard]] bool boolean() const {
        expect(kind::boolean, "true or false");
        return text_ == "true";
    }

    /// A number as written. That its double is finite is checked here.
    [[nodiscard]] exact_decimal number() const;

    [[nodiscard]] std::vector<json_value> const& elements() const {
        expect(kind::array, "a list in [ ]");
        return children_;
    }

    /// The members, in the order of the file; name_of(i) belongs to members()[i].
    [[nodiscard]] std::vector<json_value> const& members() const {
        expect(kind::object, "an object in { }");
        return children_;
    }
    [[nodiscard]] std::string const& name_of(std::size_t i) const { return names_[i]; }

    /// The member of this name, or nullptr.
    [[nodiscard]] json_value const* find(std::string_view name) const;
    [[nodiscard]] json_value const& at(std::string_view name) const;

    /// @throws input_error at the first member whose key is not in the list
    void allow_only(std::initializer_list<std::string_view> keys) const;

private:
    friend class json_builder;

    void expect(kind wanted, char const* words) const;
    static char const* describe(kind k);

    kind kind_ = kind::null;
    std::string file_, pointer_, text_;
    std::vector<std::string> names_;
    std::vector<json_value> children_;
};

/// Reads a JSON text; `file` is its name in messages. As `read_json`.
[[nodiscard]] SIVID_DECL json_value parse_json(std::string file, std::string const& text);

/// Reads one JSON file; a key given twice, text after the end and numbers beyond double are errors.
/// @throws input_error
[[nodiscard]] SIVID_DECL json_value read_json(std::filesystem::path const& file);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/text/impl/json_document.ipp>
#endif

#endif // SIVID_IO_TEXT_JSON_DOCUMENT_HPP
