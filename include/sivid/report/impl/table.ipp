// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_TABLE_IPP
#define SIVID_REPORT_IMPL_TABLE_IPP

#include <sivid/report/table.hpp>

namespace sivid::report {

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

} // namespace sivid::report

#endif
