// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_SVG_HPP
#define SIVID_REPORT_DRAW_SVG_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/draw/palette.hpp>
#include <sivid/report/text/escape.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sivid::report {

/// A coordinate as text, rounded to 0.01 units: never NaN or infinite, at most 1e6 in size.
[[nodiscard]] SIVID_DECL std::string coordinate(double value);

/// A data-`name` attribute.
struct attribute_text {
    std::string name{};
    std::string value{};
};

/// How a shape is filled and drawn. Colours are SVG paint values.
struct paint {
    std::string_view fill = "none";
    std::string_view stroke = "none";
    double width = 1;
    double opacity = 1;
    std::string_view dash = "";
};

enum class anchor { start, middle, end };

struct text_style {
    double size = 11;
    anchor align = anchor::start;
    std::string_view fill = palette::ink;
    bool bold = false;
    double rotate = 0; ///< degrees, about the text's own point
};

/// The outline of a path, written with absolute coordinates.
class path_data {
public:
    path_data& move(double x, double y) { return add('M', x, y); }
    path_data& line(double x, double y) { return add('L', x, y); }
    path_data& close() {
        text_ += 'Z';
        return *this;
    }
    path_data& rect(double x, double y, double w, double h);
    [[nodiscard]] bool empty() const { return text_.empty(); }
    [[nodiscard]] std::string const& str() const { return text_; }

private:
    path_data& add(char command, double x, double y);
    std::string text_;
};

/// A drawing, built shape by shape in painting order. Everything from outside is escaped; every
/// number is finite; ids carry a prefix chosen when the text is taken, so that many drawings can
/// stand in one page.
class svg {
public:
    svg(double width, double height, std::string_view label)
        : width_{width}, height_{height}, label_{label} {}

    [[nodiscard]] double width() const { return width_; }
    [[nodiscard]] double height() const { return height_; }

    svg& rect(double x, double y, double w, double h, paint const& p, double radius = 0,
              std::string_view tip = {});
    svg& line(double x1, double y1, double x2, double y2, paint const& p,
              std::string_view tip = {});
    svg& circle(double x, double y, double r, paint const& p, std::string_view tip = {});
    /// An empty path draws nothing.
    svg& path(path_data const& d, paint const& p, std::string_view tip = {});
    svg& text(double x, double y, std::string_view what, text_style const& s = {});
    /// Opens a group; shapes until `close` belong to it. The tip is shown for all of it.
    svg& group(std::string_view tip = {});
    /// Opens a window: what is drawn outside of it until `close` is cut off.
    svg& clip(double x, double y, double w, double h);
    svg& close();
    /// Attribute data-`name` of the whole drawing, for the page's script. The name is plain.
    svg& data(std::string_view name, std::string_view value);
    /// A fill of parallel diagonal lines on a base colour. @returns a paint value for `paint::fill`
    std::string hatch(std::string_view base, std::string_view ink, double spacing = 5);
    /// A fill of dots on a base colour. @returns a paint value for `paint::fill`
    std::string dots(std::string_view base, std::string_view ink, double spacing = 5);

    /// The drawing as a complete element. It can be a file of its own or stand in a page.
    [[nodiscard]] std::string str(std::string_view id_prefix = "s-") const;

private:
    // Never in escaped text, so no text from outside can forge an id.
    static constexpr char prefix_mark = '\x01';

    static std::string attribute(std::string_view name, double value);
    static std::string tip_text(std::string_view tip);
    // A fill that this class made names a pattern and is kept; any other is plain text.
    static std::string colour(std::string_view value);
    svg& shape(std::string_view name, std::string const& attributes, paint const& p,
               std::string_view tip);
    svg& opened(std::string_view closing);
    // Equal patterns share one definition.
    std::string pattern(std::string_view base, double spacing, std::string const& mark,
                        std::string_view transform);

    double width_;
    double height_;
    std::string label_;
    std::string data_;
    std::vector<std::string> patterns_;
    std::string definitions_;
    std::string body_;
    std::string open_;
};

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/draw/impl/svg.ipp>
#endif

#endif
