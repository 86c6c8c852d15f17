// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_HPP
#define SIVID_REPORT_PAGE_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/report/draw/axes.hpp>
#include <sivid/report/draw/svg.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid::report {

enum class column_kind {
    text,
    symbol, ///< a name that stands out
    number, ///< right-aligned, digits of equal width
    note    ///< quiet text
};

struct column {
    std::string head{};
    column_kind kind = column_kind::text;
};

/// Columns by their heads, with '|' between them. A sign in front says which kind: * a name, # a
/// number, ~ a note.
[[nodiscard]] inline std::vector<column> columns(std::string_view heads) {
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

/// A table of finished texts; short rows are filled with empty cells, long ones cut.
struct table {
    std::vector<column> columns{};
    std::vector<std::vector<std::string>> rows{};
    std::string caption{};
    std::optional<std::size_t> chosen_row{}; ///< set off from the others
};

/// The table as HTML. A column without any entry is left out.
[[nodiscard]] inline std::string table_html(table const& t) {
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
    pair, ///< at least 360 px each
    wide  ///< one below the other over the full width; scrolls on a narrow screen
};

struct figure {
    std::vector<svg> panels{};
    std::vector<legend_entry> legend{};
    std::string title{}; ///< first words of the caption, set off
    std::string caption{};
    panel_layout layout = panel_layout::grid;
    std::vector<attribute_text> data{}; ///< for the page's script
};

/// Builds one self-contained page from top to bottom. Every text is escaped; nothing is loaded
/// from elsewhere, and the page's own policy forbids it to the browser. It reads whole without its
/// script, which shows values under the pointer and links the places of a box.
class page {
public:
    explicit page(page_head const& head) : title_{head.title.empty() ? head.kind : head.title} {
        body_ = "<header>";
        if (!head.title.empty()) body_ += "<p class=\"kind\">" + escape(head.kind) + "</p>";
        body_ += "<h1>" + escape(title_) + "</h1>";
        body_ += head.lead.empty() ? "" : "<p class=\"lead\">" + escape(head.lead) + "</p>";
        body_ += "</header>\n";
    }

    /// The verdict in one sentence; sign and words say it beside the colour.
    page& banner(outcome how, std::string_view headline, std::string_view sentence) {
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
    /// A heading stands as soon as something is below it; without content it is left out.
    page& section(std::string_view title) {
        section_ = "<h2>" + escape(title) + "</h2>\n";
        subsection_.clear();
        return *this;
    }
    page& subsection(std::string_view title) {
        subsection_ = "<h3>" + escape(title) + "</h3>\n";
        return *this;
    }
    page& prose(std::string_view text) {
        return put(text.empty() ? std::string{} : "<p>" + escape(text) + "</p>\n");
    }

    page& cards(std::vector<card> const& all) {
        std::string html = "<div class=\"cards\">";
        for (card const& c : all) {
            html += "<div class=\"card\"><div class=\"name\">" + escape(c.name) +
                    "</div><div class=\"value\">" + breakable(c.value) + "</div>";
            html += c.note.empty() ? "</div>"
                                   : "<div class=\"note\">" + escape(c.note) + "</div></div>";
        }
        return put(html + "</div>\n");
    }
    page& add(table const& t) { return put(t.rows.empty() ? std::string{} : table_html(t)); }
    page& add(figure const& f) {
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
    page& bullets(std::vector<std::string> const& lines) { return put(list(lines)); }
    /// Clauses with a full stop.
    page& sentences(std::vector<std::string> clauses) {
        for (auto& c : clauses) c += c.empty() || c.back() == '.' ? "" : ".";
        return bullets(clauses);
    }
    /// "What was proved, in plain words."
    page& plain_words(std::vector<std::string> const& lines) {
        return put(lines.empty() ? "" : "<div class=\"plain\">" + list(lines) + "</div>\n");
    }
    /// What the proofs rest on.
    page& assumptions(std::vector<std::string> const& lines,
                      std::string_view title = "The proofs rest on these assumptions") {
        return boxed("box", title, lines);
    }
    page& warnings(std::vector<std::string> const& lines, std::string_view title = "To be noted") {
        return boxed("box warning", title, lines);
    }
    page& footer(std::vector<std::string> const& parts) {
        footer_ = "<footer>";
        for (std::string const& p : parts) {
            footer_ += p.empty() ? std::string{} : "<span>" + escape(p) + "</span>";
        }
        footer_ += "</footer>\n";
        return *this;
    }

    [[nodiscard]] std::string str() const;
    friend std::ostream& operator<<(std::ostream& out, page const& p) { return out << p.str(); }

private:
    /// Content; the headings that wait for it come before.
    page& put(std::string const& html) {
        if (html.empty()) return *this;
        body_ += std::exchange(section_, "") + std::exchange(subsection_, "") + html;
        return *this;
    }
    /// Escaped; lines may end behind an underscore, which names have instead of spaces.
    static std::string breakable(std::string_view text) {
        std::string result;
        for (char const c : escape(text)) {
            result += c;
            if (c == '_') result += "<wbr/>";
        }
        return result;
    }
    static std::string list(std::vector<std::string> const& lines) {
        std::string out = "<ul>";
        for (std::string const& line : lines) out += "<li>" + escape(line) + "</li>";
        return lines.empty() ? std::string{} : out + "</ul>\n";
    }
    page& boxed(std::string const& style, std::string_view title,
                std::vector<std::string> const& lines) {
        return put(lines.empty() ? ""
                                 : "<div class=\"" + style + "\"><h2>" + escape(title) + "</h2>" +
                                       list(lines) + "</div>\n");
    }
    std::string next_prefix() { return "f" + std::to_string(++pictures_) + "-"; }

    std::string title_;
    std::string body_;
    std::string section_, subsection_; ///< that wait for content
    std::string footer_;
    int figures_ = 0;
    int pictures_ = 0;
};

/// A page of a command, and what it was made of: numbers, names and points of its lines, from
/// which the same version of the library makes the same page, byte for byte (`read_page`).
struct stored_page {
    std::string name; ///< of its file: "report.html"
    std::string html;
    std::string data; ///< JSON (sivid-page-1): a number for each number, to the last bit

    /// "report.page.json"
    [[nodiscard]] std::string data_name() const {
        return name.substr(0, name.rfind('.')) + ".page.json";
    }
    void add_to(file_set& files) const {
        files.add(name, html);
        files.add(data_name(), data);
    }
};

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/page.ipp>
#endif

#endif
