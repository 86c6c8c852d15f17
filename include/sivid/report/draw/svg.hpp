// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_SVG_HPP
#define SIVID_REPORT_DRAW_SVG_HPP

#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Colours by meaning. The hues are those of Okabe and Ito, which stay apart for every common form
/// of colour blindness; they also differ in lightness, and each meaning has a second mark beside
/// its colour (a hatch, a symbol, a dash), so that a grey print can be read.
/// @ref  M. Okabe, K. Ito, Color Universal Design, 2008
namespace sivid::report {

namespace palette {

inline constexpr std::string_view black = "#1a1d21";
inline constexpr std::string_view blue = "#0072b2";
inline constexpr std::string_view vermillion = "#d55e00";

inline constexpr std::string_view inside = "#00805d";      // bluish green, darker: solid
inline constexpr std::string_view undecided = "#f2b93b";   // orange, lighter: hatched
inline constexpr std::string_view pending = "#d9a3c2";     // reddish purple, lighter: dotted
inline constexpr std::string_view outside = "#eceef1";     // plain light grey
inline constexpr std::string_view outlier = vermillion;    // cross in a ring
inline constexpr std::string_view outlier_ink = "#b34e00"; // for letters
inline constexpr std::string_view suspect = "#a0447a";     // open diamond
inline constexpr std::string_view tube = "#56b4e9";        // filled band
inline constexpr std::string_view tube_edge = "#2b86bd";
inline constexpr std::string_view measurement = "#1a1d21"; // bar with caps
inline constexpr std::string_view truth = vermillion;      // dashed line
inline constexpr std::string_view prior = "#d5d9df";

inline constexpr std::string_view ink = "#1a1d21";
inline constexpr std::string_view muted_ink = "#5b6470";
inline constexpr std::string_view grid = "#e6e8ec";
inline constexpr std::string_view frame = "#8b94a0";
inline constexpr std::string_view paper = "#ffffff";

} // namespace palette

/// A light-to-dark ramp of one hue; `at` is clamped to [0, 1].
struct colour_ramp {
    std::array<std::array<double, 3>, 4> stops;

    [[nodiscard]] std::string at(double share) const {
        double const place = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) * 3 : 0.0;
        auto const left = std::min<std::size_t>(static_cast<std::size_t>(place), 2);
        double const part = place - static_cast<double>(left);
        std::string out = "#";
        for (std::size_t i = 0; i < 3; ++i) {
            double const value = stops[left][i] * (1 - part) + stops[left + 1][i] * part;
            auto const level = static_cast<unsigned>(std::lround(value));
            constexpr std::string_view digits = "0123456789abcdef";
            out += digits[level / 16];
            out += digits[level % 16];
        }
        return out;
    }
};

/// Blue for what is in order, orange to red-brown for what is not: told apart by hue for every
/// reader, and each ramp is ordered by lightness.
inline constexpr colour_ramp blue_ramp{
    {{{247, 251, 255}, {198, 219, 239}, {107, 174, 214}, {8, 81, 156}}}};
inline constexpr colour_ramp orange_ramp{
    {{{253, 224, 178}, {253, 174, 97}, {224, 102, 20}, {140, 45, 4}}}};

/// A coordinate as text, rounded to 0.01 units: never NaN or infinite, at most 1e6 in size.
[[nodiscard]] inline std::string coordinate(double value) {
    double const safe = std::isnan(value) ? 0.0 : std::clamp(value, -1e6, 1e6);
    char text[32];
    auto const end = std::to_chars(text, text + sizeof text, safe, std::chars_format::fixed, 2).ptr;
    std::string_view out{text, static_cast<std::size_t>(end - text)};
    while (out.back() == '0') out.remove_suffix(1);
    if (out.back() == '.') out.remove_suffix(1);
    return out == "-0" ? "0" : std::string{out};
}

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
    path_data& rect(double x, double y, double w, double h) {
        text_ += std::string(1, 'M') + coordinate(x) + ' ' + coordinate(y) + 'h' + coordinate(w) +
                 'v' + coordinate(h) + 'h' + coordinate(-w) + 'z';
        return *this;
    }
    [[nodiscard]] bool empty() const { return text_.empty(); }
    [[nodiscard]] std::string const& str() const { return text_; }

private:
    path_data& add(char command, double x, double y) {
        text_ += command + coordinate(x) + ' ' + coordinate(y);
        return *this;
    }
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
              std::string_view tip = {}) {
        std::string round = radius > 0 ? attribute("rx", radius) : std::string{};
        return shape("rect",
                     attribute("x", x) + attribute("y", y) + attribute("width", std::max(w, 0.0)) +
                         attribute("height", std::max(h, 0.0)) + round,
                     p, tip);
    }
    svg& line(double x1, double y1, double x2, double y2, paint const& p) {
        return shape("line",
                     attribute("x1", x1) + attribute("y1", y1) + attribute("x2", x2) +
                         attribute("y2", y2),
                     p, {});
    }
    svg& circle(double x, double y, double r, paint const& p, std::string_view tip = {}) {
        return shape("circle", attribute("cx", x) + attribute("cy", y) + attribute("r", r), p, tip);
    }
    /// An empty path draws nothing.
    svg& path(path_data const& d, paint const& p, std::string_view tip = {}) {
        return d.empty() ? *this : shape("path", std::string{" d=\""} + d.str() + "\"", p, tip);
    }
    svg& text(double x, double y, std::string_view what, text_style const& s = {}) {
        body_ += "<text" + attribute("x", x) + attribute("y", y) + attribute("font-size", s.size) +
                 " fill=\"" + escape(s.fill) + '"';
        body_ += s.align == anchor::middle ? " text-anchor=\"middle\""
                 : s.align == anchor::end  ? " text-anchor=\"end\""
                                           : "";
        body_ += s.bold ? " font-weight=\"600\"" : "";
        if (s.rotate != 0) {
            body_ += " transform=\"rotate(" + coordinate(s.rotate) + ' ' + coordinate(x) + ' ' +
                     coordinate(y) + ")\"";
        }
        body_ += std::string(1, '>') + escape(what) + "</text>\n";
        return *this;
    }
    /// Opens a group; shapes until `close` belong to it. The tip is shown for all of it.
    svg& group(std::string_view tip = {}) {
        body_ += "<g>" + tip_text(tip);
        open_ += "</g>\n";
        return *this;
    }
    /// Opens a window: what is drawn outside of it until `close` is cut off.
    svg& clip(double x, double y, double w, double h) {
        std::string const box =
            coordinate(x) + ' ' + coordinate(y) + ' ' + coordinate(w) + ' ' + coordinate(h);
        body_ += "<svg" + attribute("x", x) + attribute("y", y) + attribute("width", w) +
                 attribute("height", h) + " viewBox=\"" + box + "\" overflow=\"hidden\">";
        open_ += "</svg>\n";
        return *this;
    }
    svg& close() {
        if (!open_.empty()) {
            auto const start = open_.rfind('<');
            body_ += open_.substr(start);
            open_.erase(start);
        }
        return *this;
    }
    /// Attribute data-`name` of the whole drawing, for the page's script. The name is plain.
    svg& data(std::string_view name, std::string_view value) {
        data_ += " data-" + std::string{name} + "=\"" + escape(value) + '"';
        return *this;
    }
    /// A fill of parallel diagonal lines on a base colour. @returns a paint value for `paint::fill`
    std::string hatch(std::string_view base, std::string_view ink) {
        return pattern(base,
                       "<path d=\"M0 0V5\" stroke=\"" + escape(ink) + "\" stroke-width=\"1.6\"/>",
                       " patternTransform=\"rotate(45)\"");
    }
    /// A fill of dots on a base colour. @returns a paint value for `paint::fill`
    std::string dots(std::string_view base, std::string_view ink) {
        return pattern(base, "<circle cx=\"2.5\" cy=\"2.5\" r=\"1\" fill=\"" + escape(ink) + "\"/>",
                       "");
    }

    /// The drawing as a complete element. It can be a file of its own or stand in a page.
    [[nodiscard]] std::string str(std::string_view id_prefix = "s-") const {
        std::string out =
            "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", width_) +
            attribute("height", height_) + " viewBox=\"0 0 " + coordinate(width_) + ' ' +
            coordinate(height_) + "\" role=\"img\" aria-label=\"" + escape(label_) + '"' + data_ +
            " font-family=\"system-ui, -apple-system, 'Segoe UI', Roboto, 'Helvetica Neue', "
            "'Liberation Sans', Arial, sans-serif\">\n";
        out +=
            "<rect width=\"100%\" height=\"100%\" fill=\"" + std::string{palette::paper} + "\"/>\n";
        std::string all =
            (definitions_.empty() ? "" : "<defs>" + definitions_ + "</defs>\n") + body_;
        for (auto end = open_.size(); end > 0;) {
            auto const start = open_.rfind('<', end - 1);
            all += open_.substr(start, end - start);
            end = start;
        }
        for (char const c : all) c == prefix_mark ? out += escape(id_prefix) : out += c;
        return out + "</svg>\n";
    }

private:
    // Never in escaped text, so no text from outside can forge an id.
    static constexpr char prefix_mark = '\x01';

    static std::string attribute(std::string_view name, double value) {
        return std::string(1, ' ') + std::string{name} + "=\"" + coordinate(value) + '"';
    }
    static std::string tip_text(std::string_view tip) {
        return tip.empty() ? std::string{} : "<title>" + escape(tip) + "</title>";
    }
    // A fill that this class made names a pattern and is kept; any other is plain text.
    static std::string colour(std::string_view value) {
        return value.starts_with(std::string{"url(#"} + prefix_mark) ? std::string{value}
                                                                     : escape(value);
    }
    svg& shape(std::string_view name, std::string const& attributes, paint const& p,
               std::string_view tip) {
        body_ += std::string(1, '<') + std::string{name} + attributes + " fill=\"" +
                 colour(p.fill) + '"';
        if (p.stroke != "none") {
            body_ += " stroke=\"" + colour(p.stroke) + '"' +
                     (p.width == 1 ? "" : attribute("stroke-width", p.width));
            body_ += p.dash.empty() ? "" : " stroke-dasharray=\"" + escape(p.dash) + '"';
        }
        body_ += p.opacity == 1 ? "" : attribute("opacity", p.opacity);
        body_ += tip.empty() ? "/>\n" : ">" + tip_text(tip) + "</" + std::string{name} + ">\n";
        return *this;
    }
    // Equal patterns share one definition.
    std::string pattern(std::string_view base, std::string const& mark,
                        std::string_view transform) {
        std::string const size = " width=\"5\" height=\"5\"";
        std::string const rest = " patternUnits=\"userSpaceOnUse\"" + size +
                                 std::string{transform} + "><rect" + size + " fill=\"" +
                                 escape(base) + "\"/>" + mark + "</pattern>";
        auto const known = std::find(patterns_.begin(), patterns_.end(), rest);
        std::string const name = prefix_mark + std::to_string(known - patterns_.begin());
        if (known == patterns_.end()) {
            patterns_.push_back(rest);
            definitions_ += "<pattern id=\"" + name + "\"" + rest;
        }
        return "url(#" + name + ")";
    }

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

#endif
