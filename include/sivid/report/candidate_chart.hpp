// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_CANDIDATE_CHART_HPP
#define SIVID_REPORT_CANDIDATE_CHART_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/legend.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/ticks.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sivid::report {

enum class candidate_state {
    explains, ///< proved
    excluded, ///< proved
    open
};

/// One row: what is left of the gap after the candidate is joined.
struct candidate_bar {
    std::string label{};
    candidate_state state = candidate_state::open;
    range proved{};    ///< of the inflation; empty or [0, infinity): nothing proved
    double fitted = 0; ///< of the best fit found, not proved; unless positive and finite: no fit
    bool answer = false;
};

struct candidate_chart_options {
    double width = 1000;
    std::string title{};
};

[[nodiscard]] SIVID_ENTRY std::string_view state_sign(candidate_state s);
[[nodiscard]] SIVID_ENTRY std::string_view state_words(candidate_state s);

/// True for a positive finite number: that of a fit.
[[nodiscard]] SIVID_ENTRY bool is_fitted(double inflation);
/// True when a proved range of an inflation says anything.
[[nodiscard]] SIVID_ENTRY bool says_something(range const& inflation);

/// Proved bounds as a reader sees them: three digits, outward; "at least 3.1", "at most 0.98".
[[nodiscard]] SIVID_ENTRY std::string span_text(range const& r, int digits = 3);

/// Proved bounds of an inflation, with enough digits that a gap is not rounded away.
[[nodiscard]] SIVID_ENTRY std::string inflation_text(range const& r);

/// A number that is not proved, three digits.
[[nodiscard]] SIVID_ENTRY std::string estimate_text(double x);

namespace detail {

/// Linear from 0 where all bars are of one size, else logarithmic.
class inflation_scale {
public:
    explicit inflation_scale(std::vector<candidate_bar> const& bars) {
        double least = 1;
        double most = 1;
        auto const see = [&](double v) {
            if (std::isfinite(v) && v > 0) {
                least = std::min(least, v);
                most = std::max(most, v);
            }
        };
        for (candidate_bar const& b : bars) {
            if (says_something(b.proved)) {
                see(b.proved.lo);
                see(b.proved.hi);
            }
            see(b.fitted);
        }
        logarithmic_ = most > 8;
        low_ = logarithmic_ ? std::clamp(least * 0.8, 0.1, 0.7) : 0;
        high_ = std::min(most * (logarithmic_ ? 1.3 : 1.06), 1e5);
    }
    [[nodiscard]] bool logarithmic() const { return logarithmic_; }
    [[nodiscard]] double high() const { return high_; }

    [[nodiscard]] double share(double v) const {
        if (!(v > low_)) return 0;
        double const s = logarithmic_ ? std::log(v / low_) / std::log(high_ / low_) : v / high_;
        return std::clamp(s, 0.0, 1.0);
    }
    [[nodiscard]] std::vector<tick> ticks() const {
        if (!logarithmic_) return nice_ticks({0, high_}, 8).ticks;
        std::vector<tick> out;
        bool const few = high_ / low_ > 2000;
        for (int power = -1; power <= 5; ++power) {
            for (int const digit : {1, 2, 5}) {
                double const v = digit * std::pow(10.0, power);
                if (v > low_ && v <= high_ && (digit == 1 || !few)) {
                    out.push_back({v, given_text(v)});
                }
            }
        }
        return out;
    }

private:
    bool logarithmic_ = false;
    double low_ = 0, high_ = 1;
};

SIVID_ENTRY std::string_view state_colour(candidate_state s);

} // namespace detail

[[nodiscard]] SIVID_ENTRY std::vector<legend_entry>
candidate_legend(std::vector<candidate_bar> const& bars);

/// For each candidate the inflation that is left: proved bounds as a bar, solid to the lower and
/// hatched to the upper one, the best fit as an open circle; the threshold at 1; sign and words for
/// what is proved.
[[nodiscard]] SIVID_ENTRY svg draw_candidate_chart(std::vector<candidate_bar> const& bars,
                                                   candidate_chart_options const& o = {});

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_CANDIDATE_CHART)
SIVID_ENTRY std::string_view state_sign(candidate_state s) {
    return s == candidate_state::explains   ? "\xE2\x9C\x93"
           : s == candidate_state::excluded ? "\xE2\x9C\x95"
                                            : "?";
}

SIVID_ENTRY std::string_view state_words(candidate_state s) {
    return s == candidate_state::explains   ? "explains (proved)"
           : s == candidate_state::excluded ? "excluded (proved)"
                                            : "open";
}

SIVID_ENTRY bool is_fitted(double inflation) { return std::isfinite(inflation) && inflation > 0; }

SIVID_ENTRY bool says_something(range const& inflation) {
    return !is_empty(inflation) && (inflation.lo > 0 || std::isfinite(inflation.hi));
}

SIVID_ENTRY std::string span_text(range const& r, int digits) {
    if (is_empty(r)) return "?";
    number_format const f{.significant = digits, .shift = 0};
    if (!std::isfinite(r.hi)) {
        return std::isfinite(r.lo) ? "at least " + rounded_text(r.lo, rounding::down, f)
                                   : "not bounded";
    }
    if (!std::isfinite(r.lo)) return "at most " + rounded_text(r.hi, rounding::up, f);
    std::string const low = rounded_text(r.lo, rounding::down, f);
    std::string const high = rounded_text(r.hi, rounding::up, f);
    return low == high ? low : low + " to " + high;
}

SIVID_ENTRY std::string inflation_text(range const& r) {
    if (!(r.lo > 0) && std::isfinite(r.hi)) return span_text({-INFINITY, r.hi});
    int digits = 3;
    for (double left = 0.01; r.lo > 1 && r.lo < 1 + 1.001 * left && digits < 12; left /= 10)
        ++digits;
    return span_text(r, digits);
}

SIVID_ENTRY std::string estimate_text(double x) {
    return std::isfinite(x) ? "\xE2\x89\x88\xE2\x80\xAF" + rounded_text(x, rounding::nearest) : "?";
}

namespace detail {

SIVID_ENTRY std::string_view state_colour(candidate_state s) {
    return s == candidate_state::explains   ? palette::inside
           : s == candidate_state::excluded ? palette::outlier
                                            : palette::frame;
}

} // namespace detail

SIVID_ENTRY std::vector<legend_entry> candidate_legend(std::vector<candidate_bar> const& bars) {
    bool proved = false, fitted = false;
    for (candidate_bar const& b : bars) {
        proved = proved || says_something(b.proved);
        fitted = fitted || is_fitted(b.fitted);
    }
    std::vector<legend_entry> out;
    if (proved) {
        out.push_back({symbol::bar_to_lower, "up to the proved lower bound"});
        out.push_back({symbol::bar_to_upper, "between the proved bounds"});
    }
    if (fitted) out.push_back({symbol::estimate, "best fit found (estimate)"});
    return out;
}

SIVID_ENTRY svg draw_candidate_chart(std::vector<candidate_bar> const& bars,
                                     candidate_chart_options const& o) {
    double const top = o.title.empty() ? 24 : 48;
    double const pitch = 27;
    double const bottom = top + pitch * static_cast<double>(std::max<std::size_t>(bars.size(), 1));
    svg out{o.width, bottom + 42, o.title.empty() ? "inflation of the candidates" : o.title};
    auto const note = [](candidate_bar const& b) {
        std::string text{state_words(b.state)};
        if (says_something(b.proved)) text += ", " + inflation_text(b.proved);
        if (b.state == candidate_state::open && is_fitted(b.fitted)) {
            text +=
                ", " + estimate_text(b.fitted) + (says_something(b.proved) ? "" : " (estimate)");
        }
        return text;
    };
    double label_width = 60, note_width = 90;
    for (candidate_bar const& b : bars) {
        label_width = std::max(label_width, approximate_text_width(shorten(b.label, 44), 12.5));
        note_width = std::max(note_width, approximate_text_width(note(b), 11.5));
    }
    double const left = std::min(label_width + 34, o.width * 0.36);
    double const right = std::max(o.width - note_width - 18, left + 80);
    detail::inflation_scale const scale(bars);
    auto const px = [&](double v) { return left + (right - left) * scale.share(v); };
    if (!o.title.empty()) out.text(0, 16, o.title, {.size = 13, .bold = true});
    for (std::size_t i = 0; i < bars.size(); ++i) {
        if (bars[i].answer) {
            out.rect(0, top + pitch * static_cast<double>(i) + 1, o.width, pitch - 2,
                     {.fill = "#eef6fb"}, 3);
        }
    }
    path_data grid;
    for (tick const& t : scale.ticks()) {
        grid.move(px(t.value), top).line(px(t.value), bottom);
        out.text(px(t.value), bottom + 15, t.label,
                 {.size = 11, .align = anchor::middle, .fill = palette::muted_ink});
    }
    out.path(grid, {.stroke = palette::grid});
    for (std::size_t i = 0; i < bars.size(); ++i) {
        candidate_bar const& b = bars[i];
        double const y = top + pitch * static_cast<double>(i);
        auto const colour = detail::state_colour(b.state);
        std::string const tip = b.label + ": " + note(b);
        out.text(8, y + 18, state_sign(b.state),
                 {.size = 13, .align = anchor::middle, .fill = colour, .bold = true});
        out.text(left - 10, y + 18, shorten(b.label, 44),
                 {.size = 12.5, .align = anchor::end, .bold = b.answer});
        if (says_something(b.proved)) {
            double const low = px(b.proved.lo);
            out.rect(left, y + 7, low - left, 13, {.fill = colour}, 0, tip);
            if (std::isfinite(b.proved.hi)) {
                out.rect(low, y + 7, px(b.proved.hi) - low, 13,
                         {.fill = out.hatch("#ffffff", colour), .stroke = colour}, 0, tip);
            } else {
                // Open to the right: no upper bound.
                out.path(
                    path_data{}.move(low, y + 7).line(low + 9, y + 13.5).line(low, y + 20).close(),
                    {.fill = out.hatch("#ffffff", colour), .stroke = colour}, tip);
            }
        }
        if (is_fitted(b.fitted)) {
            if (!says_something(b.proved)) {
                out.line(left, y + 13.5, px(b.fitted), y + 13.5,
                         {.stroke = palette::frame, .width = 1.2, .dash = "2 3"});
            }
            draw_estimate(out, px(b.fitted), y + 13.5,
                          b.label + ": " + estimate_text(b.fitted) + ", best fit");
            if (b.fitted > scale.high()) {
                out.text(right - 8, y + 18, "\xE2\x96\xB8", {.size = 11, .align = anchor::end});
            }
        }
        out.text(right + 12, y + 18, note(b), {.size = 11.5});
    }
    out.line(left, top, left, bottom, {.stroke = palette::frame});
    out.line(px(1), top - 5, px(1), bottom,
             {.stroke = palette::black, .width = 1.3, .dash = "4 3"});
    out.text(px(1), top - 9, "1: all data explained",
             {.size = 11, .align = px(1) > (left + right) / 2 ? anchor::end : anchor::start});
    out.text((left + right) / 2, bottom + 33,
             std::string{"factor by which all bounds must still grow"} +
                 (scale.logarithmic() ? " (logarithmic)" : ""),
             {.size = 11.5, .align = anchor::middle});
    return out;
}
#endif

} // namespace sivid::report

#endif
