// SPDX-License-Identifier: MIT
#ifndef SIVID_TEXT_DETAIL_TOML_SECTION_HPP
#define SIVID_TEXT_DETAIL_TOML_SECTION_HPP

#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/model/unit.hpp>
#include <sivid/text/detail/model_formula.hpp>
#include <sivid/text/detail/model_source.hpp>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <toml++/toml.h>

namespace sivid::text_detail {

/// Refuses what toml++ 3.3 takes for granted that it is not there: a table without a name, "[.]",
/// and brackets that do not match, "[}".
///   Up to the first fault of a file its strings, comments and brackets are those of TOML; behind
/// it toml++ reads nothing.
class toml_precheck {
public:
    explicit toml_precheck(model_source const& source) : source_(&source), text_(source.text()) {}

    void operator()() {
        line_ = behind(0, " \t\n");
        for (std::size_t at = line_; at < text_.size(); ++at) {
            char const c = text_[at];
            if (c == '#')
                at = std::min(text_.find('\n', at), text_.size()) - 1;
            else if (c == '"' || c == '\'')
                at = end_of_string(at);
            else if (c == '\n')
                line_ = behind(at, " \t\n");
            else if (c == '[' || c == '{')
                open(at);
            else if (c == ']' || c == '}')
                close(at);
        }
    }

private:
    [[nodiscard]] std::size_t behind(std::size_t at, std::string_view blank) const {
        return std::min(text_.find_first_not_of(blank, at), text_.size());
    }
    /// Of its last quotation mark.
    [[nodiscard]] std::size_t end_of_string(std::size_t at) const {
        char const c = text_[at];
        std::string const three(3, c);
        std::string const mark = text_.substr(at, 3) == three ? three : std::string(1, c);
        auto end = at + mark.size();
        while (end < text_.size() && text_.substr(end, mark.size()) != mark)
            end += c == '"' && text_[end] == '\\' ? 2 : 1;
        return end + mark.size() - 1;
    }
    void open(std::size_t at) {
        if (at == line_ && open_.empty() && text_[at] == '[') {
            auto const name = behind(at + (text_.substr(at, 2) == "[[" ? 2 : 1), " \t");
            static constexpr std::string_view may_begin =
                "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-\"']";
            if (name == text_.size() || may_begin.find(text_[name]) == std::string_view::npos)
                source_->fail(name, "the name of a table is needed here",
                              "write one as in [states]");
        }
        open_ += text_[at] == '[' ? ']' : '}';
    }
    void close(std::size_t at) {
        if (open_.empty() || open_.back() != text_[at])
            source_->fail(at, "this bracket closes what is not open", "correct the brackets");
        open_.pop_back();
    }

    model_source const* source_;
    std::string_view text_;
    std::size_t line_ = 0; ///< where the first word of the line begins
    std::string open_;     ///< the brackets that will close
};

/// The content of a string as it stands in the source.
struct source_slice {
    std::size_t begin = 0, end = 0;
};

/// "1.297 kg", "[0.5, 2] kg" or 0.6: a number, or bounds, as written.
struct stated_quantity {
    exact_decimal lower, upper;
    bool is_range = false;
    std::optional<unit> in{}; ///< nothing: none is stated
    std::string unit_text{};
    std::size_t position = 0;
};

/// A table of the file.
class toml_section {
public:
    /// One of its keys.
    struct entry {
        std::string name;
        std::size_t key = 0, value = 0; ///< where they stand
        toml::node const* node = nullptr;
    };

    /// @param where  for messages: "[states]"
    toml_section(model_source const& source, toml::table const& table, std::string where)
        : source_(&source), where_(std::move(where)) {
        for (auto const& [key, node] : table)
            entries_.push_back({std::string(key.str()), position_of(key.source().begin),
                                position_of(node.source().begin), &node});
        // In the order of the file.
        std::sort(entries_.begin(), entries_.end(),
                  [](entry const& a, entry const& b) { return a.key < b.key; });
    }

    [[nodiscard]] std::vector<entry> const& entries() const { return entries_; }
    [[nodiscard]] std::string const& where() const { return where_; }
    [[nodiscard]] entry const* find(std::string_view name) const {
        auto const found = std::find_if(entries_.begin(), entries_.end(),
                                        [&](entry const& e) { return e.name == name; });
        return found == entries_.end() ? nullptr : &*found;
    }
    /// Where the table begins.
    [[nodiscard]] std::size_t begin() const { return entries_.empty() ? 0 : entries_[0].key; }

    /// Refuses keys that are not among these.
    void allow(std::initializer_list<char const*> known) const {
        for (auto const& e : entries_)
            if (std::none_of(known.begin(), known.end(), [&](auto k) { return e.name == k; }))
                source_->fail(e.key,
                              "unknown key " + in_quotes(e.name) +
                                  (where_.empty() ? "" : " in " + where_),
                              name_hint(e.name, {known.begin(), known.end()}));
    }
    /// A table within; nothing where it is not.
    [[nodiscard]] std::optional<toml_section> section(std::string const& name) const {
        auto const* e = find(name);
        if (e == nullptr) return std::nullopt;
        return within(*e);
    }
    [[nodiscard]] toml_section within(entry const& e) const {
        auto const where = where_.empty()
                               ? "[" + e.name + "]"
                               : where_.substr(0, where_.size() - 1) + "." + e.name + "]";
        auto const* table = e.node->as_table();
        if (table == nullptr)
            source_->fail(e.value, "a table is needed here", "begin it by " + where);
        return {*source_, *table, printable_text(where, 100)};
    }

    /// What the string says; nothing where there is none.
    [[nodiscard]] std::optional<std::string> text(std::string_view name) const {
        auto const* e = find(name);
        if (e == nullptr) return std::nullopt;
        return std::string(string_of(*e));
    }
    [[nodiscard]] std::optional<bool> flag(std::string_view name) const {
        auto const* e = find(name);
        if (e == nullptr) return std::nullopt;
        if (!e->node->is_boolean()) source_->fail(e->value, "true or false is needed here", "");
        return e->node->as_boolean()->get();
    }
    [[nodiscard]] std::string_view string_of(entry const& e) const {
        auto const* s = e.node->as_string();
        if (s == nullptr)
            source_->fail(e.value, "a string is needed here", "put it in quotation marks");
        return s->get();
    }
    /// A string, or several.
    [[nodiscard]] std::vector<std::string> strings(entry const& e) const {
        auto const* list = e.node->as_array();
        if (list == nullptr) return {std::string(string_of(e))};
        std::vector<std::string> result;
        for (auto const& item : *list) {
            auto const* s = item.as_string();
            if (s == nullptr)
                source_->fail(position_of(item.source().begin), "a string is needed here",
                              "put it in quotation marks");
            result.push_back(s->get());
        }
        return result;
    }
    /// Where the content of a string stands in the source.
    [[nodiscard]] source_slice slice(entry const& e) const {
        auto const content = string_of(e);
        auto const all = source_->text();
        auto const open = all.substr(std::min(e.value, all.size()), 3);
        bool const is_long = open == "\"\"\"" || open == "'''";
        auto begin = e.value + (is_long ? 3 : 1);
        if (is_long && all.substr(begin, 1) == "\n") ++begin;
        if (all.substr(std::min(begin, all.size()), content.size()) != content)
            source_->fail(e.value, "a backslash has no place in a formula",
                          "write the text as it is");
        return {begin, begin + content.size()};
    }
    [[nodiscard]] formula formula_of(entry const& e) const {
        auto const s = slice(e);
        return formula_reader(*source_, s.begin, s.end).read();
    }
    /// The statements of an entry; none where it is not.
    [[nodiscard]] std::vector<statement> statements(std::string_view name) const {
        auto const* e = find(name);
        if (e == nullptr) return {};
        auto const s = slice(*e);
        return formula_reader(*source_, s.begin, s.end).read_statements();
    }

    /// A number, "1.2 kg", [0.5, 2] or "[0.5, 2] kg".
    [[nodiscard]] stated_quantity quantity(entry const& e) const {
        stated_quantity q;
        q.position = e.value;
        if (e.node->is_string()) {
            auto const s = slice(e);
            q.position = s.begin;
            read_quantity(s, q);
        } else if (auto const* list = e.node->as_array()) {
            if (list->size() != 2)
                source_->fail(e.value, "bounds are two numbers", "write [lower, upper]");
            q.is_range = true;
            q.lower = number(*list->get(0));
            q.upper = number(*list->get(1));
        } else {
            q.lower = q.upper = number(*e.node);
        }
        if (q.upper < q.lower)
            source_->fail(q.position, "the lower bound is above the upper one",
                          "write [lower, upper]");
        if (!enclose(q.lower) || !enclose(q.upper))
            source_->fail(q.position, "the number is beyond all doubles", "use smaller numbers");
        return q;
    }

private:
    [[nodiscard]] std::size_t position_of(toml::source_position const& p) const {
        return source_->position(static_cast<std::size_t>(p.line),
                                 static_cast<std::size_t>(p.column));
    }
    /// A number of TOML as it is written.
    [[nodiscard]] exact_decimal number(toml::node const& n) const {
        auto const at = position_of(n.source().begin);
        auto const all = source_->text().substr(at);
        std::string text(all.substr(0, all.find_first_of(" \t\n,]}#")));
        text.erase(std::remove(text.begin(), text.end(), '_'), text.end());
        auto const value = exact_decimal::parse(text);
        if (!n.is_number() || !value)
            source_->fail(at, "a decimal number is needed here",
                          "write 0.25, \"0.25 kg\" or \"[0.2, 0.3] kg\"");
        return *value;
    }
    void read_quantity(source_slice const& s, stated_quantity& q) const {
        model_detail::formula_words words(
            source_->text().substr(0, s.end),
            {.fail = source_->failing(), .longest = model_source::largest}, s.begin);
        auto const read = [&] {
            bool const negative = words.take("-");
            if (!negative) static_cast<void>(words.take("+"));
            auto const text = words.take_number();
            auto const value = text ? exact_decimal::parse(*text) : std::nullopt;
            if (!value)
                words.fail("a number is needed here", "write one as in \"1.297 kg\", or bounds as "
                                                      "in \"[0.5, 2] kg\"");
            return negative ? -*value : *value;
        };
        q.is_range = words.take("[");
        q.lower = q.upper = read();
        if (q.is_range) {
            words.need(",", "write bounds as in \"[0.5, 2] kg\"");
            q.upper = read();
            words.need("]", "write bounds as in \"[0.5, 2] kg\"");
        }
        if (words.at_end()) return;
        auto const at = words.position();
        q.unit_text = std::string(source_->text().substr(at, s.end - at));
        while (!q.unit_text.empty() && q.unit_text.back() == ' ') q.unit_text.pop_back();
        q.in = unit(q.unit_text);
        if (!q.in->fault().empty())
            source_->fail(at, "this is no unit: " + q.in->fault(), "write one as in \"kg m^2/s\"");
    }

    model_source const* source_;
    std::string where_;
    std::vector<entry> entries_;
};

} // namespace sivid::text_detail

#endif
