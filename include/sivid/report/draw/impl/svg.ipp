// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_IMPL_SVG_IPP
#define SIVID_REPORT_DRAW_IMPL_SVG_IPP

#include <sivid/report/draw/svg.hpp>

#include <charconv>

namespace sivid::report {

SIVID_DECL std::string coordinate(double value) {
    double const safe = std::isnan(value) ? 0.0 : std::clamp(value, -1e6, 1e6);
    char text[32];
    auto const end = std::to_chars(text, text + sizeof text, safe, std::chars_format::fixed, 2).ptr;
    std::string_view out{text, static_cast<std::size_t>(end - text)};
    while (out.back() == '0') out.remove_suffix(1);
    if (out.back() == '.') out.remove_suffix(1);
    return out == "-0" ? "0" : std::string{out};
}

SIVID_DECL path_data& path_data::rect(double x, double y, double w, double h) {
    text_ += std::string(1, 'M') + coordinate(x) + ' ' + coordinate(y) + 'h' + coordinate(w) + 'v' +
             coordinate(h) + 'h' + coordinate(-w) + 'z';
    return *this;
}

SIVID_DECL path_data& path_data::add(char command, double x, double y) {
    text_ += command + coordinate(x) + ' ' + coordinate(y);
    return *this;
}

SIVID_DECL svg& svg::rect(double x, double y, double w, double h, paint const& p, double radius,
                          std::string_view tip) {
    std::string round = radius > 0 ? attribute("rx", radius) : std::string{};
    return shape("rect",
                 attribute("x", x) + attribute("y", y) + attribute("width", std::max(w, 0.0)) +
                     attribute("height", std::max(h, 0.0)) + round,
                 p, tip);
}

SIVID_DECL svg& svg::line(double x1, double y1, double x2, double y2, paint const& p,
                          std::string_view tip) {
    return shape("line",
                 attribute("x1", x1) + attribute("y1", y1) + attribute("x2", x2) +
                     attribute("y2", y2),
                 p, tip);
}

SIVID_DECL svg& svg::circle(double x, double y, double r, paint const& p, std::string_view tip) {
    return shape("circle", attribute("cx", x) + attribute("cy", y) + attribute("r", r), p, tip);
}

SIVID_DECL svg& svg::path(path_data const& d, paint const& p, std::string_view tip) {
    return d.empty() ? *this : shape("path", std::string{" d=\""} + d.str() + "\"", p, tip);
}

SIVID_DECL svg& svg::text(double x, double y, std::string_view what, text_style const& s) {
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

SIVID_DECL svg& svg::group(std::string_view tip) {
    body_ += "<g>" + tip_text(tip);
    return opened("</g>\n");
}

SIVID_DECL svg& svg::clip(double x, double y, double w, double h) {
    std::string const box =
        coordinate(x) + ' ' + coordinate(y) + ' ' + coordinate(w) + ' ' + coordinate(h);
    body_ += "<svg" + attribute("x", x) + attribute("y", y) + attribute("width", w) +
             attribute("height", h) + " viewBox=\"" + box + "\" overflow=\"hidden\">";
    return opened("</svg>\n");
}

SIVID_DECL svg& svg::close() {
    if (!open_.empty()) {
        auto const start = open_.rfind('<');
        body_ += open_.substr(start);
        open_.erase(start);
    }
    return *this;
}

SIVID_DECL svg& svg::data(std::string_view name, std::string_view value) {
    data_ += " data-" + std::string{name} + "=\"" + escape(value) + '"';
    return *this;
}

SIVID_DECL std::string svg::hatch(std::string_view base, std::string_view ink, double spacing) {
    std::string const s = coordinate(spacing);
    return pattern(base, spacing,
                   "<path d=\"M0 0V" + s + "\" stroke=\"" + escape(ink) +
                       "\" stroke-width=\"1.6\"/>",
                   " patternTransform=\"rotate(45)\"");
}

SIVID_DECL std::string svg::dots(std::string_view base, std::string_view ink, double spacing) {
    return pattern(base, spacing,
                   "<circle" + attribute("cx", spacing / 2) + attribute("cy", spacing / 2) +
                       " r=\"1\" fill=\"" + escape(ink) + "\"/>",
                   "");
}

SIVID_DECL std::string svg::str(std::string_view id_prefix) const {
    std::string out =
        "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", width_) +
        attribute("height", height_) + " viewBox=\"0 0 " + coordinate(width_) + ' ' +
        coordinate(height_) + "\" role=\"img\" aria-label=\"" + escape(label_) + '"' + data_ +
        " font-family=\"system-ui, -apple-system, 'Segoe UI', Roboto, 'Helvetica Neue', "
        "'Liberation Sans', Arial, sans-serif\">\n";
    out += "<rect width=\"100%\" height=\"100%\" fill=\"" + std::string{palette::paper} + "\"/>\n";
    std::string all = (definitions_.empty() ? "" : "<defs>" + definitions_ + "</defs>\n") + body_;
    for (auto end = open_.size(); end > 0;) {
        auto const start = open_.rfind('<', end - 1);
        all += open_.substr(start, end - start);
        end = start;
    }
    for (char const c : all) c == prefix_mark ? out += escape(id_prefix) : out += c;
    return out + "</svg>\n";
}

SIVID_DECL std::string svg::attribute(std::string_view name, double value) {
    return std::string(1, ' ') + std::string{name} + "=\"" + coordinate(value) + '"';
}

SIVID_DECL std::string svg::tip_text(std::string_view tip) {
    return tip.empty() ? std::string{} : "<title>" + escape(tip) + "</title>";
}

SIVID_DECL std::string svg::colour(std::string_view value) {
    return value.starts_with(std::string{"url(#"} + prefix_mark) ? std::string{value}
                                                                 : escape(value);
}

SIVID_DECL svg& svg::shape(std::string_view name, std::string const& attributes, paint const& p,
                           std::string_view tip) {
    body_ +=
        std::string(1, '<') + std::string{name} + attributes + " fill=\"" + colour(p.fill) + '"';
    if (p.stroke != "none") {
        body_ += " stroke=\"" + colour(p.stroke) + '"' +
                 (p.width == 1 ? "" : attribute("stroke-width", p.width));
        body_ += p.dash.empty() ? "" : " stroke-dasharray=\"" + escape(p.dash) + '"';
    }
    body_ += p.opacity == 1 ? "" : attribute("opacity", p.opacity);
    body_ += tip.empty() ? "/>\n" : ">" + tip_text(tip) + "</" + std::string{name} + ">\n";
    return *this;
}

SIVID_DECL svg& svg::opened(std::string_view closing) {
    open_ += closing;
    return *this;
}

SIVID_DECL std::string svg::pattern(std::string_view base, double spacing, std::string const& mark,
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

} // namespace sivid::report

#endif
