// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_SVG_HPP
#define SIVID_REPORT_SVG_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/escape.hpp>
#include <sivid/report/palette.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sivid::report {

/// A coordinate as text, rounded to 0.01 units: never NaN or infinite, at most 1e6 in size.
[[nodiscard]] SIVID_ENTRY std::string coordinate(double value);

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
    bool italic = false;
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
    std::vector<std::string> patterns_;
    std::string definitions_;
    std::string body_;
    std::string open_;
};

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_SVG)
SIVID_ENTRY std::string coordinate(double value) {
    double const safe = std::isnan(value) ? 0.0 : std::clamp(value, -1e6, 1e6);
    char text[32];
    auto const end = std::to_chars(text, text + sizeof text, safe, std::chars_format::fixed, 2).ptr;
    std::string_view out{text, static_cast<std::size_t>(end - text)};
    while (out.back() == '0') {
        out.remove_suffix(1);
    }
    if (out.back() == '.') {
        out.remove_suffix(1);
    }
    return out == "-0" ? "0" : std::string{out};
}

SIVID_ENTRY path_data& path_data::rect(double x, double y, double w, double h) {
    text_ += std::string(1, 'M') + coordinate(x) + ' ' + coordinate(y) + 'h' + coordinate(w) + 'v' +
             coordinate(h) + 'h' + coordinate(-w) + 'z';
    return *this;
}

SIVID_ENTRY path_data& path_data::add(char command, double x, double y) {
    text_ += command + coordinate(x) + ' ' + coordinate(y);
    return *this;
}

SIVID_ENTRY svg& svg::rect(double x, double y, double w, double h, paint const& p, double radius,
                           std::string_view tip) {
    std::string round = radius > 0 ? attribute("rx", radius) : std::string{};
    return shape("rect",
                 attribute("x", x) + attribute("y", y) + attribute("width", std::max(w, 0.0)) +
                     attribute("height", std::max(h, 0.0)) + round,
                 p, tip);
}

SIVID_ENTRY svg& svg::line(double x1, double y1, double x2, double y2, paint const& p,
                           std::string_view tip) {
    return shape("line",
                 attribute("x1", x1) + attribute("y1", y1) + attribute("x2", x2) +
                     attribute("y2", y2),
                 p, tip);
}

SIVID_ENTRY svg& svg::circle(double x, double y, double r, paint const& p, std::string_view tip) {
    return shape("circle", attribute("cx", x) + attribute("cy", y) + attribute("r", r), p, tip);
}

SIVID_ENTRY svg& svg::path(path_data const& d, paint const& p, std::string_view tip) {
    return d.empty() ? *this : shape("path", std::string{" d=\""} + d.str() + "\"", p, tip);
}

SIVID_ENTRY svg& svg::text(double x, double y, std::string_view what, text_style const& s) {
    body_ += std::string{"<text"} + attribute("x", x) + attribute("y", y) +
             attribute("font-size", s.size) + " fill=\"" + escape(s.fill) + '"';
    body_ += s.align == anchor::middle ? " text-anchor=\"middle\""
             : s.align == anchor::end  ? " text-anchor=\"end\""
                                       : "";
    body_ += s.bold ? " font-weight=\"600\"" : "";
    body_ += s.italic ? " font-style=\"italic\"" : "";
    if (s.rotate != 0) {
        body_ += std::string{" transform=\"rotate("} + coordinate(s.rotate) + ' ' + coordinate(x) +
                 ' ' + coordinate(y) + ")\"";
    }
    body_ += std::string(1, '>') + escape(what) + "</text>\n";
    return *this;
}

SIVID_ENTRY svg& svg::group(std::string_view tip) {
    body_ += std::string{"<g>"} + tip_text(tip);
    return opened("</g>\n");
}

SIVID_ENTRY svg& svg::clip(double x, double y, double w, double h) {
    std::string const box =
        coordinate(x) + ' ' + coordinate(y) + ' ' + coordinate(w) + ' ' + coordinate(h);
    body_ += std::string{"<svg"} + attribute("x", x) + attribute("y", y) + attribute("width", w) +
             attribute("height", h) + " viewBox=\"" + box + "\" overflow=\"hidden\">";
    return opened("</svg>\n");
}

SIVID_ENTRY svg& svg::close() {
    if (!open_.empty()) {
        auto const start = open_.rfind('<');
        body_ += open_.substr(start);
        open_.erase(start);
    }
    return *this;
}

SIVID_ENTRY std::string svg::hatch(std::string_view base, std::string_view ink, double spacing) {
    std::string const s = coordinate(spacing);
    return pattern(base, spacing,
                   "<path d=\"M0 0V" + s + "\" stroke=\"" + escape(ink) +
                       "\" stroke-width=\"1.6\"/>",
                   " patternTransform=\"rotate(45)\"");
}

SIVID_ENTRY std::string svg::dots(std::string_view base, std::string_view ink, double spacing) {
    return pattern(base, spacing,
                   std::string{"<circle"} + attribute("cx", spacing / 2) +
                       attribute("cy", spacing / 2) + " r=\"1\" fill=\"" + escape(ink) + "\"/>",
                   "");
}

SIVID_ENTRY std::string svg::str(std::string_view id_prefix) const {
    std::string out =
        std::string{"<svg xmlns=\"http://www.w3.org/2000/svg\""} + attribute("width", width_) +
        attribute("height", height_) + " viewBox=\"0 0 " + coordinate(width_) + ' ' +
        coordinate(height_) + "\" role=\"img\" aria-label=\"" + escape(label_) +
        "\" font-family=\"system-ui, -apple-system, 'Segoe UI', Roboto, 'Helvetica Neue', "
        "'Liberation Sans', Arial, sans-serif\">\n";
    out += std::string{"<rect width=\"100%\" height=\"100%\" fill=\""} +
           std::string{palette::paper} + "\"/>\n";
    std::string all = (definitions_.empty() ? "" : "<defs>" + definitions_ + "</defs>\n") + body_;
    for (auto end = open_.size(); end > 0;) {
        auto const start = open_.rfind('<', end - 1);
        all += open_.substr(start, end - start);
        end = start;
    }
    for (char const c : all) {
        c == prefix_mark ? out += escape(id_prefix) : out += c;
    }
    return out + "</svg>\n";
}

SIVID_ENTRY std::string svg::attribute(std::string_view name, double value) {
    return std::string(1, ' ') + std::string{name} + "=\"" + coordinate(value) + '"';
}

SIVID_ENTRY std::string svg::tip_text(std::string_view tip) {
    return tip.empty() ? std::string{} : std::string{"<title>"} + escape(tip) + "</title>";
}

SIVID_ENTRY std::string svg::colour(std::string_view value) {
    return value.starts_with(std::string{"url(#"} + prefix_mark) ? std::string{value}
                                                                 : escape(value);
}

SIVID_ENTRY svg& svg::shape(std::string_view name, std::string const& attributes, paint const& p,
                            std::string_view tip) {
    body_ +=
        std::string(1, '<') + std::string{name} + attributes + " fill=\"" + colour(p.fill) + '"';
    if (p.stroke != "none") {
        body_ += std::string{" stroke=\""} + colour(p.stroke) + '"' +
                 (p.width == 1 ? "" : attribute("stroke-width", p.width));
        body_ += p.dash.empty() ? "" : std::string{" stroke-dasharray=\""} + escape(p.dash) + '"';
    }
    body_ += p.opacity == 1 ? "" : attribute("opacity", p.opacity);
    body_ +=
        tip.empty() ? "/>\n" : std::string{">"} + tip_text(tip) + "</" + std::string{name} + ">\n";
    return *this;
}

SIVID_ENTRY svg& svg::opened(std::string_view closing) {
    open_ += closing;
    return *this;
}

SIVID_ENTRY std::string svg::pattern(std::string_view base, double spacing, std::string const& mark,
                                     std::string_view transform) {
    std::string const size = attribute("width", spacing) + attribute("height", spacing);
    std::string const rest = " patternUnits=\"userSpaceOnUse\"" + size + std::string{transform} +
                             "><rect" + size + " fill=\"" + escape(base) + "\"/>" + mark +
                             "</pattern>";
    auto const known = std::find(patterns_.begin(), patterns_.end(), rest);
    std::string const name = prefix_mark + std::to_string(known - patterns_.begin());
    if (known == patterns_.end()) {
        patterns_.push_back(rest);
        definitions_ += "<pattern id=\"" + name + "\"" + rest;
    }
    return "url(#" + name + ")";
}
#endif

} // namespace sivid::report

#endif
