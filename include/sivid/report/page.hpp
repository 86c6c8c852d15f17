// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_HPP
#define SIVID_REPORT_PAGE_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/escape.hpp>
#include <sivid/report/legend.hpp>
#include <sivid/report/page_style.hpp>
#include <sivid/report/svg.hpp>
#include <sivid/report/table.hpp>

#include <cstddef>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid::report {

/// How a page's main statement stands.
enum class outcome { proved, undecided, refuted };

/// One key figure.
struct card {
    std::string name{};
    std::string value{};
    std::string note{};
};

struct page_head {
    std::string kind{}; ///< small line above the title, e.g. "Identification"
    std::string title{};
    std::string lead{}; ///< one sentence below the title
};

/// How the panels of a figure are laid out.
enum class panel_layout {
    grid, ///< as many as fit, at least 340 px each
    pair, ///< at least 400 px each
    wide  ///< one below the other over the full width; scrolls on a narrow screen
};

struct figure {
    std::vector<svg> panels{};
    std::vector<legend_entry> legend{};
    std::string title{}; ///< first words of the caption, set off
    std::string caption{};
    panel_layout layout = panel_layout::grid;
};

/// Builds one self-contained page from top to bottom. Every text is escaped; no script, no font and
/// no picture is loaded from elsewhere.
class page {
public:
    explicit page(page_head const& head);

    /// The verdict in one sentence; sign and words say it beside the colour.
    page& banner(outcome how, std::string_view headline, std::string_view sentence);
    page& section(std::string_view title) { return element("h2", title); }
    page& subsection(std::string_view title) { return element("h3", title); }
    page& prose(std::string_view text) { return text.empty() ? *this : element("p", text); }

    page& cards(std::vector<card> const& all);
    page& add(table const& t);
    page& add(figure const& f);
    page& bullets(std::vector<std::string> const& lines);
    /// "What was proved, in plain words."
    page& plain_words(std::vector<std::string> const& lines);
    /// What the proofs rest on.
    page& assumptions(std::vector<std::string> const& lines,
                      std::string_view title = "The proofs rest on these assumptions") {
        return boxed("box", title, lines);
    }
    page& warnings(std::vector<std::string> const& lines, std::string_view title = "To be noted") {
        return boxed("box warning", title, lines);
    }
    page& footer(std::vector<std::string> const& parts);

    [[nodiscard]] std::string str() const;
    friend std::ostream& operator<<(std::ostream& out, page const& p) { return out << p.str(); }

private:
    page& element(std::string const& name, std::string_view text);
    /// Escaped; lines may end behind an underscore, which names have instead of spaces.
    static std::string breakable(std::string_view text);
    static std::string list(std::vector<std::string> const& lines);
    page& boxed(std::string const& style, std::string_view title,
                std::vector<std::string> const& lines);
    std::string next_prefix() { return std::string{"f"} + std::to_string(++pictures_) + "-"; }

    std::string title_;
    std::string body_;
    std::string footer_;
    int figures_ = 0;
    int pictures_ = 0;
};

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_PAGE)
SIVID_ENTRY page::page(page_head const& head) : title_{head.title} {
    body_ = std::string{"<header><p class=\"kind\">"} + escape(head.kind) + "</p><h1>" +
            escape(head.title) + "</h1>";
    body_ +=
        head.lead.empty() ? "" : std::string{"<p class=\"lead\">"} + escape(head.lead) + "</p>";
    body_ += "</header>\n";
}

SIVID_ENTRY page& page::banner(outcome how, std::string_view headline, std::string_view sentence) {
    char const* const style = how == outcome::proved    ? "proved"
                              : how == outcome::refuted ? "refuted"
                                                        : "undecided";
    char const* const sign = how == outcome::proved    ? "\xE2\x9C\x93"
                             : how == outcome::refuted ? "\xE2\x9C\x95"
                                                       : "?";
    body_ += std::string{"<div class=\"banner "} + style +
             "\"><span class=\"sign\" aria-hidden=\"true\">" + sign + "</span><div><strong>" +
             escape(headline) + "</strong><p>" + escape(sentence) + "</p></div></div>\n";
    return *this;
}

SIVID_ENTRY std::string page::breakable(std::string_view text) {
    std::string result;
    for (char const c : escape(text)) {
        result += c;
        if (c == '_') result += "<wbr/>";
    }
    return result;
}

SIVID_ENTRY page& page::cards(std::vector<card> const& all) {
    body_ += "<div class=\"cards\">";
    for (card const& c : all) {
        body_ += std::string{"<div class=\"card\"><div class=\"name\">"} + escape(c.name) +
                 "</div><div class=\"value\">" + breakable(c.value) + "</div>";
        body_ += c.note.empty()
                     ? "</div>"
                     : std::string{"<div class=\"note\">"} + escape(c.note) + "</div></div>";
    }
    body_ += "</div>\n";
    return *this;
}

SIVID_ENTRY page& page::add(table const& t) {
    body_ += t.rows.empty() ? std::string{} : table_html(t);
    return *this;
}

SIVID_ENTRY page& page::add(figure const& f) {
    if (f.panels.empty()) {
        return *this;
    }
    body_ += "<figure>";
    if (!f.legend.empty()) {
        body_ += "<ul class=\"legend\">";
        for (legend_entry const& e : f.legend) {
            body_ += std::string{"<li>"} + symbol_picture(e.mark, e.label).str(next_prefix()) +
                     "<span>" + escape(e.label) + "</span></li>";
        }
        body_ += "</ul>\n";
    }
    body_ += f.layout == panel_layout::wide   ? "<div class=\"panels wide\">"
             : f.layout == panel_layout::pair ? "<div class=\"panels pair\">"
                                              : "<div class=\"panels\">";
    for (svg const& picture : f.panels) {
        body_ += picture.str(next_prefix());
    }
    body_ += "</div>";
    if (!f.title.empty() || !f.caption.empty()) {
        body_ += std::string{"<figcaption><b>Figure "} + std::to_string(++figures_) + ". " +
                 escape(f.title) + "</b> " + escape(f.caption) + "</figcaption>";
    }
    body_ += "</figure>\n";
    return *this;
}

SIVID_ENTRY page& page::bullets(std::vector<std::string> const& lines) {
    body_ += list(lines);
    return *this;
}

SIVID_ENTRY page& page::plain_words(std::vector<std::string> const& lines) {
    body_ += lines.empty() ? std::string{}
                           : std::string{"<div class=\"plain\">"} + list(lines) + "</div>\n";
    return *this;
}

SIVID_ENTRY page& page::footer(std::vector<std::string> const& parts) {
    footer_ = "<footer>";
    for (std::string const& p : parts) {
        footer_ += p.empty() ? std::string{} : std::string{"<span>"} + escape(p) + "</span>";
    }
    footer_ += "</footer>\n";
    return *this;
}

SIVID_ENTRY std::string page::str() const {
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
           escape(title_) + "</title>\n<style>" + std::string{page_style} +
           "</style>\n</head>\n<body>\n<main>\n" + body_ + footer_ + "</main>\n</body>\n</html>\n";
}

SIVID_ENTRY page& page::element(std::string const& name, std::string_view text) {
    body_ += std::string(1, '<') + name + '>' + escape(text) + "</" + name + ">\n";
    return *this;
}

SIVID_ENTRY std::string page::list(std::vector<std::string> const& lines) {
    std::string out = "<ul>";
    for (std::string const& line : lines) {
        out += std::string{"<li>"} + escape(line) + "</li>";
    }
    return lines.empty() ? std::string{} : out + "</ul>\n";
}

SIVID_ENTRY page& page::boxed(std::string const& style, std::string_view title,
                              std::vector<std::string> const& lines) {
    body_ += lines.empty() ? std::string{}
                           : "<div class=\"" + style + "\"><h3>" + escape(title) + "</h3>" +
                                 list(lines) + "</div>\n";
    return *this;
}
#endif

} // namespace sivid::report

#endif
