// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_CANDIDATE_CHART_HPP
#define SIVID_REPORT_DRAW_CANDIDATE_CHART_HPP

#include <sivid/compiled.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/report/draw/legend.hpp>
#include <sivid/report/draw/ticks.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sivid::report {

/// One row: what is left of the gap after the candidate is joined.
struct candidate_bar {
    std::string label{};
    cause_verdict state = cause_verdict::undecided;
    range proved{};    ///< of the inflation; empty or [0, infinity): nothing proved
    double fitted = 0; ///< of the best fit found, not proved; unless positive and finite: no fit
    bool answer = false;
};

struct candidate_chart_options {
    double width = 1000;
    std::string title{};
};

[[nodiscard]] SIVID_DECL std::string_view state_sign(cause_verdict s);
[[nodiscard]] SIVID_DECL std::string_view state_words(cause_verdict s);

/// True for a positive finite number: that of a fit.
[[nodiscard]] SIVID_DECL bool is_fitted(double inflation);
/// True when a proved range of an inflation says anything.
[[nodiscard]] SIVID_DECL bool says_something(range const& inflation);

/// Proved bounds as a reader sees them: three digits, outward; "at least 3.1", "at most 0.98".
[[nodiscard]] SIVID_DECL std::string span_text(range const& r, int digits = 3);

/// Proved bounds of an inflation, with enough digits that a gap is not rounded away.
[[nodiscard]] SIVID_DECL std::string inflation_text(range const& r);

/// A number that is not proved, three digits.
[[nodiscard]] SIVID_DECL std::string estimate_text(double x);

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

} // namespace detail

[[nodiscard]] SIVID_DECL std::vector<legend_entry>
candidate_legend(std::vector<candidate_bar> const& bars);

/// For each candidate the inflation that is left: proved bounds as a bar, solid to the lower and
/// hatched to the upper one, the best fit as an open circle; the threshold at 1; sign and words for
/// what is proved.
[[nodiscard]] SIVID_DECL svg draw_candidate_chart(std::vector<candidate_bar> const& bars,
                                                  candidate_chart_options const& o = {});

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/draw/impl/candidate_chart.ipp>
#endif

#endif
