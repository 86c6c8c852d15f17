// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_PAGE_IPP
#define SIVID_REPORT_IMPL_PAGE_IPP

#include <sivid/report/page.hpp>

namespace sivid::report {

SIVID_DECL page::page(page_head const& head) : title_{head.title.empty() ? head.kind : head.title} {
    body_ = "<header>";
    if (!head.title.empty()) body_ += "<p class=\"kind\">" + escape(head.kind) + "</p>";
    body_ += "<h1>" + escape(title_) + "</h1>";
    body_ +=
        head.lead.empty() ? "" : std::string{"<p class=\"lead\">"} + escape(head.lead) + "</p>";
    body_ += "</header>\n";
}

SIVID_DECL page& page::banner(outcome how, std::string_view headline, std::string_view sentence) {
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

SIVID_DECL std::string page::breakable(std::string_view text) {
    std::string result;
    for (char const c : escape(text)) {
        result += c;
        if (c == '_') result += "<wbr/>";
    }
    return result;
}

SIVID_DECL page& page::cards(std::vector<card> const& all) {
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

SIVID_DECL page& page::add(table const& t) {
    body_ += t.rows.empty() ? std::string{} : table_html(t);
    return *this;
}

SIVID_DECL page& page::add(figure const& f) {
    if (f.panels.empty()) return *this;
    body_ += "<figure";
    for (attribute_text const& a : f.data) {
        body_ += " data-" + a.name + "=\"" + escape(a.value) + '"';
    }
    body_ += '>';
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
    for (svg const& picture : f.panels) body_ += picture.str(next_prefix());
    body_ += "</div>";
    if (!f.title.empty() || !f.caption.empty()) {
        body_ += std::string{"<figcaption><b>Figure "} + std::to_string(++figures_) + ". " +
                 escape(f.title) + "</b> " + escape(f.caption) + "</figcaption>";
    }
    body_ += "</figure>\n";
    return *this;
}

SIVID_DECL page& page::bullets(std::vector<std::string> const& lines) {
    body_ += list(lines);
    return *this;
}

SIVID_DECL page& page::plain_words(std::vector<std::string> const& lines) {
    body_ += lines.empty() ? std::string{}
                           : std::string{"<div class=\"plain\">"} + list(lines) + "</div>\n";
    return *this;
}

SIVID_DECL page& page::footer(std::vector<std::string> const& parts) {
    footer_ = "<footer>";
    for (std::string const& p : parts) {
        footer_ += p.empty() ? std::string{} : std::string{"<span>"} + escape(p) + "</span>";
    }
    footer_ += "</footer>\n";
    return *this;
}

SIVID_DECL std::string page::str() const {
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
           escape(title_) + "</title>\n" +
           "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
           "'unsafe-inline'; script-src 'unsafe-inline'\">\n<style>" +
           std::string{page_style} + "</style>\n<script>" + std::string{page_script} +
           "</script>\n</head>\n<body>\n<main>\n" + body_ + footer_ + "</main>\n</body>\n</html>\n";
}

SIVID_DECL page& page::element(std::string const& name, std::string_view text) {
    body_ += std::string(1, '<') + name + '>' + escape(text) + "</" + name + ">\n";
    return *this;
}

SIVID_DECL std::string page::list(std::vector<std::string> const& lines) {
    std::string out = "<ul>";
    for (std::string const& line : lines) out += std::string{"<li>"} + escape(line) + "</li>";
    return lines.empty() ? std::string{} : out + "</ul>\n";
}

SIVID_DECL page& page::boxed(std::string const& style, std::string_view title,
                             std::vector<std::string> const& lines) {
    body_ += lines.empty() ? std::string{}
                           : "<div class=\"" + style + "\"><h2>" + escape(title) + "</h2>" +
                                 list(lines) + "</div>\n";
    return *this;
}

} // namespace sivid::report

#endif
