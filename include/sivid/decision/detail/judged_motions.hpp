// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_DETAIL_JUDGED_MOTIONS_HPP
#define SIVID_DECISION_DETAIL_JUDGED_MOTIONS_HPP

#include <sivid/decision/motion_cover.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/decision/robustness.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid::decision_detail {

/// The motions of a prediction, judged by a requirement.
class judged_motions {
public:
    struct judgement {
        truth found;
        double reached = 0;
        bool coarse = false;             ///< the instants decide, what lies between them does not
        std::vector<std::size_t> hiding; ///< cells on which it hangs then
        bool worn = false;               ///< remainders weigh: integrate anew
        std::size_t side = motion_cover::none; ///< that promises most when it is halved
    };

    judged_motions(prediction_problem const& problem, requirement const& what,
                   std::vector<double> const& times, run_options const& options)
        : what_(what),
          outputs_(problem.model, what.margins),
          cover_(problem, outputs_, times, options),
          whole_(cover_.whole()) {}

    [[nodiscard]] motion_cover& cover() { return cover_; }

    /// @given  something is known of the part
    [[nodiscard]] judgement judge(motion_cover::part const& p) const {
        judgement result;
        auto const v = cover_.look(p);
        result.reached = v.reached == 0 ? 0 : cover_.times()[v.reached - 1];
        margin_bounds bounds{cover_.times(), {}, {}};
        bounds.low.resize(what_.margins.size());
        bounds.high.resize(what_.margins.size());
        for (std::size_t c = 0; c < what_.margins.size(); ++c)
            cover_.segments(p, v, outputs_.margins[c], bounds.low[c], bounds.high[c]);
        result.found = evaluate(what_, bounds);
        if (result.found.proved()) return result;
        if (p.known->reached == cover_.times().size() && !result.found.refuted())
            find_hiding(bounds, result);
        weigh(p, v, result);
        return result;
    }

    [[nodiscard]] bool is_tiny(motion_cover::part const& p) const {
        auto const below = [](box const& a, box const& whole) {
            for (std::size_t i = 0; i < a.size(); ++i) {
                if (width(whole[i]) > 0 && width(a[i]) > 1e-7 * width(whole[i])) return false;
            }
            return true;
        };
        return below(p.initial, whole_.initial) && below(p.parameters, whole_.parameters);
    }

    /// Starts and parameters at which the bounds of a part may be attained, most promising first.
    [[nodiscard]] std::vector<std::pair<std::vector<double>, std::vector<double>>>
    suspicious_points(motion_cover::part const& p, truth const& found) const {
        std::vector<std::pair<std::vector<double>, std::vector<double>>> result;
        auto const start = mid(p.initial), middle = mid(p.parameters);
        auto const v = cover_.look(p);
        auto const count = v.low.size();
        auto const instant =
            std::min(found.low_from.segment / 2, std::max(v.reached, std::size_t{1}) - 1);
        auto const y = instant * cover_.outputs() + outputs_.margins[found.low_from.comparison];
        for (double const sign : {-1.0, 1.0}) {
            if (!(y < count)) break;
            for (double const far : {1.0, 0.9, 0.5}) {
                auto x = start, q = middle;
                auto const n = x.size();
                for (std::size_t side = 0; side < cover_.sides(); ++side) {
                    auto const variable = cover_.variable_of(p, side);
                    if (variable == motion_cover::none) continue;
                    double const slope = sign * v.slope[variable * count + y];
                    auto const& range = side < n ? p.initial[side] : p.parameters[side - n];
                    auto& at = side < n ? x[side] : q[side - n];
                    double const to = slope > 0 ? range.upper() : slope < 0 ? range.lower() : at;
                    at += far * (to - at);
                }
                result.emplace_back(std::move(x), std::move(q));
            }
        }
        result.emplace_back(start, middle);
        return result;
    }

private:
    /// Whether the instants alone would decide, and between which of them something may hide.
    void find_hiding(margin_bounds bounds, judgement& result) const {
        std::vector<std::size_t> hiding;
        for (std::size_t c = 0; c < bounds.low.size(); ++c) {
            auto& low = bounds.low[c];
            auto& high = bounds.high[c];
            for (std::size_t s = 1; s < low.size(); s += 2) {
                double const least = std::min(low[s - 1], low[s + 1]);
                double const most = std::max(high[s - 1], high[s + 1]);
                bool const known = least > 0 || most < 0;
                bool const open = low[s] <= 0 && high[s] >= 0;
                if (known && open) hiding.push_back(s / 2);
                low[s] = std::max(low[s], least);
                high[s] = std::min(high[s], most);
            }
        }
        auto const instants = evaluate(what_, bounds);
        if (!instants.proved() && !instants.refuted()) return;
        result.coarse = true;
        std::sort(hiding.begin(), hiding.end());
        hiding.erase(std::unique(hiding.begin(), hiding.end()), hiding.end());
        if (hiding.empty()) { // it hangs on cells at whose ends it is open, too: refine all
            for (std::size_t k = 0; k + 1 < bounds.times.size(); ++k) hiding.push_back(k);
        }
        result.hiding = std::move(hiding);
    }

    /// Which side to halve, and whether to integrate anew: by the margins that are open.
    void weigh(motion_cover::part const& p, motion_cover::view const& v, judgement& result) const {
        if (v.reached < cover_.times().size()) {
            result.worn = true;
            result.side = cover_.telling_side(p, v);
            return;
        }
        auto const m = cover_.outputs();
        auto const count = v.low.size();
        std::vector<double> score(v.curvature.size(), 0.0);
        double rest = 0, lost = 0, reach = 0;
        double curvature = 0;
        for (double const c : v.curvature) curvature += c;
        for (std::size_t k = 0; k < v.reached; ++k) {
            for (auto const o : outputs_.margins) {
                auto const y = k * m + o;
                double const width = v.high[y] - v.low[y];
                bool const open = v.low[y] <= 0 && v.high[y] >= 0;
                if (!open || !std::isfinite(width) || !(width > 0)) continue;
                for (std::size_t q = 0; q < score.size(); ++q) {
                    double const bent =
                        curvature > 0 ? v.rest[y] * v.curvature[q] / curvature : 0.0;
                    score[q] += (std::abs(v.slope[q * count + y]) + bent) / width;
                }
                rest += v.rest[y] / width;
                lost += p.known->answer->radius[y] / width;
                reach += 0.5;
            }
        }
        result.worn = lost > 0.25 * reach || (lost > 0.5 * rest && lost > 0.05 * reach);
        double most = 0;
        for (std::size_t side = 0; side < cover_.sides(); ++side) {
            auto const q = cover_.variable_of(p, side);
            if (q == motion_cover::none || q >= score.size() || !(score[q] > most)) continue;
            most = score[q];
            result.side = side;
        }
    }

    requirement const& what_;
    followed_outputs outputs_;
    motion_cover cover_;
    motion_cover::part whole_;
};

} // namespace sivid::decision_detail

#endif
