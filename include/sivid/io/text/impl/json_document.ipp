// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_TEXT_IMPL_JSON_DOCUMENT_IPP
#define SIVID_IO_TEXT_IMPL_JSON_DOCUMENT_IPP

// Included at the end of io/text/json_document.hpp.

#include <sivid/io/text/json_document.hpp>

#include <sivid/number/text/joined.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

SIVID_DECL void json_value::fail(std::string problem, std::string remedy) const {
    throw input_error{place(), std::move(problem), std::move(remedy)};
}

SIVID_DECL std::string const& json_value::string() const {
    expect(kind::string, "a text in quotes");
    constexpr std::size_t longest = 1000; // what is printed
    if (text_.empty()) fail("the text is empty", "give a name");
    auto const& text = any_string();
    if (text.size() > longest)
        fail(text_of("the text ", in_quotes(text_), " has ", std::to_string(text.size()), " bytes"),
             "at most " + std::to_string(longest));
    return text;
}

SIVID_DECL std::string const& json_value::raw_string() const {
    expect(kind::string, "a text in quotes");
    return text_;
}

SIVID_DECL std::string const& json_value::any_string() const {
    expect(kind::string, "a text in quotes");
    if (auto const what = unprintable_in(text_); !what.empty())
        fail(text_of("the text ", in_quotes(text_), " holds a control character: ", what),
             "remove it");
    return text_;
}

SIVID_DECL exact_decimal json_value::number() const {
    expect(kind::number, "a number");
    auto const value = exact_decimal::parse(text_);
    if (!value || !enclose(*value))
        fail(in_quotes(text_) + " is beyond the range of double", "give a smaller number");
    return *value;
}

SIVID_DECL json_value const* json_value::find(std::string_view name) const {
    for (std::size_t i = 0; i < members().size(); ++i)
        if (names_[i] == name) return &children_[i];
    return nullptr;
}

SIVID_DECL json_value const& json_value::at(std::string_view name) const {
    auto const* found = find(name);
    if (found == nullptr) fail(text_of("the key '", std::string{name}, "' is missing"), "add it");
    return *found;
}

SIVID_DECL void json_value::allow_only(std::initializer_list<std::string_view> keys) const {
    for (std::size_t i = 0; i < members().size(); ++i) {
        if (std::find(keys.begin(), keys.end(), names_[i]) != keys.end()) continue;
        children_[i].fail(text_of("unknown key ", in_quotes(names_[i])),
                          "known here: " + joined(keys));
    }
}

SIVID_DECL void json_value::expect(kind wanted, char const* words) const {
    if (kind_ != wanted)
        fail(std::string{"found "} + describe(kind_) + " instead of " + words, "correct it");
}

SIVID_DECL char const* json_value::describe(kind k) {
    switch (k) {
    case kind::null:
        return "null";
    case kind::boolean:
        return "true or false";
    case kind::number:
        return "a number";
    case kind::string:
        return "a text";
    case kind::array:
        return "a list";
    case kind::object:
        return "an object";
    }
    return "something else";
}

/// Receives the events of nlohmann's parser.
class json_builder {
public:
    explicit json_builder(std::string file) : file_{std::move(file)} {}

    [[nodiscard]] json_value parse(std::string const& text) {
        text_ = text;
        nlohmann::json::sax_parse(text, this);
        return std::move(root_);
    }

    bool null() { return add(json_value::kind::null, ""); }
    bool boolean(bool value) { return add(json_value::kind::boolean, value ? "true" : "false"); }
    bool number_integer(std::int64_t value) {
        return add(json_value::kind::number, std::to_string(value));
    }
    bool number_unsigned(std::uint64_t value) {
        return add(json_value::kind::number, std::to_string(value));
    }
    bool number_float(double, std::string const& text) {
        return add(json_value::kind::number, text);
    }
    bool string(std::string const& text) { return add(json_value::kind::string, text); }
    template <class Binary>
    bool binary(Binary const&) {
        return false; // not part of JSON text
    }
    bool start_object(std::size_t) { return open(json_value::kind::object); }
    bool start_array(std::size_t) { return open(json_value::kind::array); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }
    bool key(std::string const& name) {
        auto& object = *path_.back();
        if (!names_.back().insert(name).second)
            object.fail(text_of("the key ", in_quotes(name), " appears twice"), "keep one of them");
        object.names_.push_back(name);
        return true;
    }
    template <class Exception>
    bool parse_error(std::size_t position, std::string const& token, Exception const& fault) {
        constexpr int number_overflow = 406;
        position_ = position;
        if (fault.id == number_overflow)
            throw input_error{{.file = file_, .pointer = next_pointer(), .is_json = true},
                              in_quotes(token) + " is beyond the range of double",
                              "give a smaller number"};
        throw_malformed(token, fault.what());
    }

private:
    [[noreturn]] void throw_malformed(std::string const& token, std::string what) const {
        if (auto const tail = what.rfind("; last read: "); tail != std::string::npos)
            what.resize(tail);
        if (auto const head = what.rfind(": "); head != std::string::npos) what.erase(0, head + 2);
        auto const before = text_.substr(0, position_ > 0 ? position_ - 1 : 0);
        auto const line_start = before.rfind('\n');
        input_place const place{
            .file = file_,
            .line = 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')),
            .column =
                1 + before.size() - (line_start == std::string_view::npos ? 0 : line_start + 1),
            .heading = "",
            .pointer = next_pointer(),
            .is_json = true};
        bool const empty = text_.find_first_not_of(" \t\r\n") == std::string_view::npos;
        throw input_error{place,
                          empty ? "the file is empty"
                                : text_of("malformed JSON near ", in_quotes(token), ": ", what),
                          empty ? "write a JSON document" : "correct the syntax"};
    }

    static constexpr std::size_t deepest = 64; // far deeper than any format here; bounds recursion

    /// Where the next value will stand: under the last key of an object, at the end of a list.
    [[nodiscard]] std::string next_pointer() const {
        if (path_.empty()) return {};
        auto const& parent = *path_.back();
        if (parent.kind_ == json_value::kind::array)
            return parent.pointer_ + "/" + std::to_string(parent.children_.size());
        bool const in_member = parent.names_.size() > parent.children_.size();
        return in_member ? parent.pointer_ + "/" + escaped(parent.names_.back()) : parent.pointer_;
    }

    json_value& place_new(json_value::kind kind) {
        json_value value;
        value.kind_ = kind;
        value.file_ = file_;
        value.pointer_ = next_pointer();
        if (path_.empty()) {
            root_ = std::move(value);
            return root_;
        }
        auto& parent = *path_.back();
        parent.children_.push_back(std::move(value));
        return parent.children_.back();
    }
    bool add(json_value::kind kind, std::string text) {
        place_new(kind).text_ = std::move(text);
        return true;
    }
    bool open(json_value::kind kind) {
        // Stable while open: a parent gets no further child before this one is closed.
        auto& value = place_new(kind);
        if (path_.size() >= deepest)
            value.fail("nested too deeply", "see the description of the format");
        path_.push_back(&value);
        names_.emplace_back();
        return true;
    }
    bool close() {
        path_.pop_back();
        names_.pop_back();
        return true;
    }
    static std::string escaped(std::string const& name) {
        std::string result;
        for (char c : name) {
            if (c == '~')
                result += "~0";
            else if (c == '/')
                result += "~1";
            else
                result += c;
        }
        return result;
    }

    std::string file_;
    std::string_view text_;
    std::size_t position_ = 0;
    json_value root_;
    std::vector<json_value*> path_;
    std::vector<std::set<std::string>> names_; ///< of each on the path
};

SIVID_DECL json_value parse_json(std::string file, std::string const& text) {
    return json_builder{std::move(file)}.parse(text);
}

SIVID_DECL json_value read_json(std::filesystem::path const& file) {
    return parse_json(file.string(), read_text(file));
}

} // namespace sivid

#endif
