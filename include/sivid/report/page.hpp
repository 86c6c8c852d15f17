// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_HPP
#define SIVID_REPORT_PAGE_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/draw/legend.hpp>
#include <sivid/report/draw/svg.hpp>
#include <sivid/report/page/detail/page_script.hpp>
#include <sivid/report/page/detail/page_style.hpp>
#include <sivid/report/table.hpp>
#include <sivid/report/text/escape.hpp>

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

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/page.ipp>
#endif

#endif
