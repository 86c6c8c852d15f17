// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_HPP
#define SIVID_REPORT_PAGE_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/draw/axes.hpp>
#include <sivid/report/draw/svg.hpp>
#include <sivid/report/number_text.hpp>

#include <cstddef>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
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
[[nodiscard]] SIVID_DECL std::vector<column> columns(std::string_view heads);

/// A table of finished texts; short rows are filled with empty cells, long ones cut.
struct table {
    std::vector<column> columns{};
    std::vector<std::vector<std::string>> rows{};
    std::string caption{};
    std::optional<std::size_t> chosen_row{}; ///< set off from the others
};

/// The table as HTML. A column without any entry is left out.
[[nodiscard]] SIVID_DECL std::string table_html(table const& t);

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
    explicit page(page_head const& head);

    /// The verdict in one sentence; sign and words say it beside the colour.
    page& banner(outcome how, std::string_view headline, std::string_view sentence);
    /// A heading stands as soon as something is below it; without content it is left out.
    page& section(std::string_view title);
    page& subsection(std::string_view title);
    page& prose(std::string_view text) { return text.empty() ? *this : element("p", text); }

    page& cards(std::vector<card> const& all);
    page& add(table const& t);
    page& add(figure const& f);
    page& bullets(std::vector<std::string> const& lines) { return put(list(lines)); }
    /// Clauses with a full stop.
    page& sentences(std::vector<std::string> clauses);
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
    /// Content; the headings that wait for it come before.
    page& put(std::string const& html);
    page& element(std::string const& name, std::string_view text);
    /// Escaped; lines may end behind an underscore, which names have instead of spaces.
    static std::string breakable(std::string_view text);
    static std::string list(std::vector<std::string> const& lines);
    page& boxed(std::string const& style, std::string_view title,
                std::vector<std::string> const& lines);
    std::string next_prefix() { return "f" + std::to_string(++pictures_) + "-"; }

    std::string title_;
    std::string body_;
    std::string section_, subsection_; ///< that wait for content
    std::string footer_;
    int figures_ = 0;
    int pictures_ = 0;
};

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/page.ipp>
#endif

#endif
