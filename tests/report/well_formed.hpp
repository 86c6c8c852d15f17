// SPDX-License-Identifier: MIT
#ifndef SIVID_TESTS_REPORT_WELL_FORMED_HPP
#define SIVID_TESTS_REPORT_WELL_FORMED_HPP

#include <sivid/report/detail/page_assets.hpp>

#include <cctype>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

/// A small strict checker for the XML that drawings and pages consist of.
namespace sivid_tests {

/// What is wrong with the markup; empty when nothing is: tags balanced, attributes quoted and not
/// repeated, entities among the five known ones, no control characters, ids unique, references
/// "url(#id)" defined, no "nan" or "inf" where a number stands.
inline std::string markup_error(std::string_view text) {
    static std::set<std::string> const words{
        "aria-label", "font-family", "class",       "lang",        "id",          "data-head",
        "data-sides", "data-rows",   "data-x-name", "data-x-unit", "data-y-name", "data-y-unit"};
    std::vector<std::string> open;
    std::set<std::string> ids;
    std::set<std::string> references;
    std::size_t i = 0;
    auto const where = [&] { return " at: " + std::string{text.substr(i, 60)}; };
    auto const bad_text = [&](std::string_view part) {
        for (std::size_t k = 0; k < part.size(); ++k) {
            auto const c = static_cast<unsigned char>(part[k]);
            if (c < 0x20 && c != '\n' && c != '\t') {
                return true;
            }
            if (c == '&') {
                std::string_view const rest = part.substr(k);
                bool known = false;
                for (std::string_view const e : {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"}) {
                    known = known || rest.starts_with(e);
                }
                if (!known) {
                    return true;
                }
            }
        }
        return false;
    };
    while (i < text.size()) {
        if (text[i] != '<') {
            std::size_t const end = std::min(text.find('<', i), text.size());
            std::string_view const part = text.substr(i, end - i);
            if (bad_text(part) || part.find('>') != std::string_view::npos) {
                return "bad character data" + where();
            }
            i = end;
            continue;
        }
        bool const closing = text.substr(i).starts_with("</");
        std::size_t k = i + (closing ? 2 : 1);
        std::string name;
        while (k < text.size() && (std::isalnum(static_cast<unsigned char>(text[k])) != 0)) {
            name += text[k++];
        }
        if (name.empty()) {
            return "bad tag" + where();
        }
        std::set<std::string> seen;
        while (k < text.size() && text[k] == ' ') {
            std::size_t const equals = text.find('=', k);
            if (equals == std::string_view::npos || equals + 1 >= text.size() ||
                text[equals + 1] != '"') {
                return "attribute without quotes" + where();
            }
            std::string const key{text.substr(k + 1, equals - k - 1)};
            std::size_t const end = text.find('"', equals + 2);
            if (end == std::string_view::npos || !seen.insert(key).second || key.empty()) {
                return "bad or repeated attribute " + key + where();
            }
            std::string const value{text.substr(equals + 2, end - equals - 2)};
            if (bad_text(value) || value.find('<') != std::string::npos) {
                return "bad attribute value" + where();
            }
            if (words.count(key) == 0 && (value.find("nan") != std::string::npos ||
                                          value.find("inf") != std::string::npos)) {
                return "not a finite number" + where();
            }
            if (key == "id" && !ids.insert(value).second) {
                return "id used twice: " + value;
            }
            if (value.starts_with("url(#")) {
                references.insert(value.substr(5, value.size() - 6));
            }
            k = end + 1;
        }
        bool const alone = text.substr(k).starts_with("/>");
        if (!alone && (k >= text.size() || text[k] != '>')) {
            return "tag does not end" + where();
        }
        if (closing) {
            if (open.empty() || open.back() != name) {
                return "closes what is not open" + where();
            }
            open.pop_back();
        } else if (!alone) {
            open.push_back(name);
        }
        i = k + (alone ? 2 : 1);
    }
    if (!open.empty()) {
        return "not closed: " + open.back();
    }
    for (std::string const& r : references) {
        if (ids.count(r) == 0) {
            return "reference to nothing: " + r;
        }
    }
    return "";
}

/// The body of a page, with its tags.
/// What makes a page depend on elsewhere, or run what is not its own; empty where nothing does.
inline std::string foreign_part(std::string_view page) {
    auto const count = [&](std::string_view what) {
        std::size_t n = 0;
        for (auto at = page.find(what); at != std::string_view::npos; at = page.find(what, at + 1))
            ++n;
        return n;
    };
    for (auto const* word : {"https:", " src=", "href=", "@import", "url(http", "javascript:"})
        if (count(word) > 0) return word;
    if (count("http:") != count("http://www.w3.org/2000/svg")) return "http:";
    auto const script = "<script>" + std::string{sivid::report::page_script} + "</script>";
    if (count("<script") != 1 || count(script) != 1) return "a script that is not the page's own";
    if (count("content=\"default-src 'none'; ") != 1) return "no policy against foreign content";
    return {};
}

inline std::string_view body_of(std::string_view page) {
    std::size_t const from = page.find("<body>");
    std::size_t const to = page.find("</body>");
    return from == std::string_view::npos || to == std::string_view::npos
               ? std::string_view{}
               : page.substr(from, to + 7 - from);
}

inline std::size_t occurrences(std::string_view text, std::string_view what) {
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string_view::npos;
         at = text.find(what, at + what.size())) {
        ++n;
    }
    return n;
}

} // namespace sivid_tests

#endif
