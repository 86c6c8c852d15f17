// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_PAGE_IPP
#define SIVID_REPORT_IMPL_PAGE_IPP

#include <sivid/report/page.hpp>

#include <sivid/report/detail/page_assets.hpp>

#include <algorithm>

namespace sivid::report {

SIVID_DECL std::vector<column> columns(std::string_view heads) {
    std::vector<column> result;
    while (true) {
        auto const end = std::min(heads.find('|'), heads.size());
        auto const sign = end > 0 ? heads.front() : ' ';
        auto const kind = sign == '*'   ? column_kind::symbol
                          : sign == '#' ? column_kind::number
                          : sign == '~' ? column_kind::note
                                        : column_kind::text;
        bool const marked = kind != column_kind::text;
        result.push_back({std::string{heads.substr(marked, end - marked)}, kind});
        if (end == heads.size()) return result;
        heads.remove_prefix(end + 1);
    }
}

SIVID_DECL std::string table_html(table const& t) {
    auto const name = [](column_kind k) {
        return k == column_kind::number   ? "number"
               : k == column_kind::symbol ? "symbol"
               : k == column_kind::note   ? "note"
                                          : "text";
    };
    std::vector<std::size_t> shown;
    for (std::size_t c = 0; c < t.columns.size(); ++c) {
        if (std::any_of(t.rows.begin(), t.rows.end(),
                        [&](auto const& row) { return c < row.size() && !row[c].empty(); })) {
            shown.push_back(c);
        }
    }
    bool const narrow = std::none_of(shown.begin(), shown.end(), [&](std::size_t c) {
        return t.columns[c].kind == column_kind::note;
    });
    std::string out = narrow && shown.size() < 5 ? "<div class=\"scroll\"><table class=\"narrow\">"
                                                 : "<div class=\"scroll\"><table>";
    // On a narrow screen each cell stands on a line of its own, behind the head of its column.
    out += "<thead><tr>";
    for (std::size_t const c : shown) {
        out += std::string{"<th scope=\"col\""} +
               (t.columns[c].kind == column_kind::number ? " class=\"number\">" : ">") +
               escape(t.columns[c].head) + "</th>";
    }
    out += "</tr></thead><tbody>";
    for (std::size_t r = 0; r < t.rows.size(); ++r) {
        out += t.chosen_row == r ? "<tr class=\"chosen\">" : "<tr>";
        for (std::size_t const c : shown) {
            out += std::string{"<td class=\""} + name(t.columns[c].kind) + "\" data-head=\"" +
                   escape(t.columns[c].head) + "\">" +
                   (c < t.rows[r].size() ? escape(t.rows[r][c]) : "") + "</td>";
        }
        out += "</tr>";
    }
    out += "</tbody></table></div>\n";
    // Below the scrolling frame, so that it stays readable on a narrow screen.
    return t.caption.empty() ? out : out + "<p class=\"caption\">" + escape(t.caption) + "</p>\n";
}

SIVID_DECL page::page(page_head const& head) : title_{head.title.empty() ? head.kind : head.title} {
    body_ = "<header>";
    if (!head.title.empty()) body_ += "<p class=\"kind\">" + escape(head.kind) + "</p>";
    body_ += "<h1>" + escape(title_) + "</h1>";
    body_ += head.lead.empty() ? "" : "<p class=\"lead\">" + escape(head.lead) + "</p>";
    body_ += "</header>\n";
}

SIVID_DECL page& page::section(std::string_view title) {
    section_ = "<h2>" + escape(title) + "</h2>\n";
    subsection_.clear();
    return *this;
}

SIVID_DECL page& page::subsection(std::string_view title) {
    subsection_ = "<h3>" + escape(title) + "</h3>\n";
    return *this;
}

SIVID_DECL page& page::put(std::string const& html) {
    if (html.empty()) return *this;
    body_ += std::exchange(section_, "") + std::exchange(subsection_, "") + html;
    return *this;
}

SIVID_DECL page& page::sentences(std::vector<std::string> clauses) {
    for (auto& c : clauses) c += c.empty() || c.back() == '.' ? "" : ".";
    return bullets(clauses);
}

SIVID_DECL page& page::banner(outcome how, std::string_view headline, std::string_view sentence) {
    char const* const style = how == outcome::proved    ? "proved"
                              : how == outcome::refuted ? "refuted"
                                                        : "undecided";
    char const* const sign = how == outcome::proved    ? "\xE2\x9C\x93"
                             : how == outcome::refuted ? "\xE2\x9C\x95"
                                                       : "?";
    return put(std::string{"<div class=\"banner "} + style +
               "\"><span class=\"sign\" aria-hidden=\"true\">" + sign + "</span><div><strong>" +
               escape(headline) + "</strong><p>" + escape(sentence) + "</p></div></div>\n");
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
    std::string html = "<div class=\"cards\">";
    for (card const& c : all) {
        html += "<div class=\"card\"><div class=\"name\">" + escape(c.name) +
                "</div><div class=\"value\">" + breakable(c.value) + "</div>";
        html +=
            c.note.empty() ? "</div>" : "<div class=\"note\">" + escape(c.note) + "</div></div>";
    }
    return put(html + "</div>\n");
}

SIVID_DECL page& page::add(table const& t) {
    return put(t.rows.empty() ? std::string{} : table_html(t));
}

SIVID_DECL page& page::add(figure const& f) {
    if (f.panels.empty()) return *this;
    std::string html = "<figure";
    for (attribute_text const& a : f.data) {
        html += " data-" + a.name + "=\"" + escape(a.value) + '"';
    }
    html += '>';
    if (!f.legend.empty()) {
        html += "<ul class=\"legend\">";
        for (legend_entry const& e : f.legend) {
            html += std::string{"<li>"} + symbol_picture(e.mark, e.label).str(next_prefix()) +
                    "<span>" + escape(e.label) + "</span></li>";
        }
        html += "</ul>\n";
    }
    html += f.layout == panel_layout::wide   ? "<div class=\"panels wide\">"
            : f.layout == panel_layout::pair ? "<div class=\"panels pair\">"
                                             : "<div class=\"panels\">";
    for (svg const& picture : f.panels) html += picture.str(next_prefix());
    html += "</div>";
    if (!f.title.empty() || !f.caption.empty()) {
        html += "<figcaption><b>Figure " + std::to_string(++figures_) + ". " + escape(f.title) +
                "</b> " + escape(f.caption) + "</figcaption>";
    }
    return put(html + "</figure>\n");
}

SIVID_DECL page& page::plain_words(std::vector<std::string> const& lines) {
    return put(lines.empty() ? "" : "<div class=\"plain\">" + list(lines) + "</div>\n");
}

SIVID_DECL page& page::footer(std::vector<std::string> const& parts) {
    footer_ = "<footer>";
    for (std::string const& p : parts) {
        footer_ += p.empty() ? std::string{} : "<span>" + escape(p) + "</span>";
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
    return put("<" + name + ">" + escape(text) + "</" + name + ">\n");
}

SIVID_DECL std::string page::list(std::vector<std::string> const& lines) {
    std::string out = "<ul>";
    for (std::string const& line : lines) out += "<li>" + escape(line) + "</li>";
    return lines.empty() ? std::string{} : out + "</ul>\n";
}

SIVID_DECL page& page::boxed(std::string const& style, std::string_view title,
                             std::vector<std::string> const& lines) {
    return put(lines.empty() ? ""
                             : "<div class=\"" + style + "\"><h2>" + escape(title) + "</h2>" +
                                   list(lines) + "</div>\n");
}

} // namespace sivid::report

#endif
