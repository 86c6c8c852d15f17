// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_MOTION_DETAIL_JUDGED_MOTIONS_HPP
#define SIVID_DECISION_MOTION_DETAIL_JUDGED_MOTIONS_HPP

#include <sivid/decision/motion/detail/motion_cover.hpp>
#include <sivid/decision/prediction_problem.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/decision/requirement/robustness.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid::decision_detail {

/// @throws std::invalid_argument  when a requirement cannot be asked of a prediction
inline void require_asked(prediction_problem const& p, requirement const& what) {
    p.require_valid();
    for (auto const m : what.margins) {
        if (m >= p.model.g.size())
            throw std::invalid_argument("verify: the requirement was read for another model");
    }
}

/// The motions of a prediction, judged by a requirement.
class judged_motions {
public:
    struct judgement {
        truth found;
        double reached = 0;
        bool coarse = false;             ///< the instants decide, what lies between them does not
        std::vector<std::size_t> hiding; ///< cells on which it hangs then
        bool worn = false;               ///< remainders weigh: integrate anew
        std::vector<double> score{};     ///< what halving each side promises; may be empty
    };

    judged_motions(prediction_problem const& problem, requirement const& what,
                   std::vector<double> const& times, run_options const& options)
        : what_(what),
          outputs_(problem.model, what.margins),
          cover_(problem, outputs_, times, options),
          whole_(cover_.whole()),
          differ_(cover_.sides(), false) {
        for (auto const& s : problem.sets) {
            for (std::size_t j = 0; j < s.size(); ++j) {
                auto const& all = whole_.parameters[j];
                if (s[j].lower() != all.lower() || s[j].upper() != all.upper())
                    differ_[problem.initial.size() + j] = true;
            }
        }
    }

    [[nodiscard]] motion_cover& cover() { return cover_; }

    /// @param roughly  over the hull of the part's sets where they hardly count, instead of each
    /// @given  something is known of the part
    [[nodiscard]] judgement judge(motion_cover::part const& p, bool roughly = false) const {
        if (!roughly) return judge(p, cover_.look(p));
        auto const rough = judge(p, cover_.look(p, true));
        bool const decided = rough.found.proved() || rough.found.refuted();
        if (decided || p.sets.size() < 2 || !sets_count(rough)) return rough;
        return judge(p, cover_.look(p));
    }

    [[nodiscard]] bool is_tiny(motion_cover::part const& p) const {
        return cover_.widest_share(p) <= 1e-7;
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
    [[nodiscard]] judgement judge(motion_cover::part const& p, motion_cover::view const& v) const {
        judgement result;
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
    /// Whether sides in which the sets differ have a share in what is open.
    [[nodiscard]] bool sets_count(judgement const& j) const {
        double all = 0, own = 0;
        for (std::size_t side = 0; side < j.score.size(); ++side) {
            all += j.score[side];
            if (differ_[side]) own += j.score[side];
        }
        return !(own <= 0.05 * all);
    }

    /// Whether a finer grid would decide, and between which instants something may hide: the
    /// formula on grids 8, 64 and 512 times as fine, as if all margins went straight between the
    /// instants.
    ///   A guess, no proof rests on it. It sees what margins do together: between two instants
    ///   abs(u) < 0.01 may come and go, where u < 0.01 and -u < 0.01 have both signs each.
    void find_hiding(margin_bounds const& bounds, judgement& result) const {
        auto const cells = bounds.times.size() - 1;
        std::vector<std::size_t> open;
        for (std::size_t k = 0; k < cells; ++k) {
            for (std::size_t c = 0; c < bounds.low.size(); ++c) {
                if (bounds.low[c][2 * k + 1] > 0 || bounds.high[c][2 * k + 1] < 0) continue;
                open.push_back(k);
                break;
            }
        }
        if (open.empty()) return;
        for (std::size_t pieces = 8; pieces <= 512 && pieces * open.size() <= 20'000; pieces *= 8) {
            auto const says = evaluate(what_, between_instants(bounds, open, pieces));
            if (!says.proved() && !says.refuted()) continue;
            result.coarse = true;
            result.hiding = std::move(open);
            return;
        }
    }
    /// The bounds on a finer grid in some cells, as if all margins went straight there.
    static margin_bounds between_instants(margin_bounds const& bounds,
                                          std::vector<std::size_t> const& cells,
                                          std::size_t pieces) {
        margin_bounds fine;
        fine.low.resize(bounds.low.size());
        fine.high.resize(bounds.high.size());
        auto next = cells.begin();
        for (std::size_t k = 0; k + 1 < bounds.times.size(); ++k) {
            bool const cut = next != cells.end() && *next == k;
            if (cut) ++next;
            std::size_t const count = cut ? pieces : 1;
            double const from = bounds.times[k], length = bounds.times[k + 1] - from;
            for (std::size_t j = 0; j < count; ++j) {
                double const share = static_cast<double>(j) / static_cast<double>(count);
                double const t = from + length * share;
                if (!fine.times.empty() && !(t > fine.times.back())) continue;
                bool const first = fine.times.empty();
                fine.times.push_back(t);
                for (std::size_t c = 0; c < bounds.low.size(); ++c) {
                    auto const line = [&](std::vector<double> const& of) {
                        return j == 0 ? of[2 * k] : of[2 * k] + share * (of[2 * k + 2] - of[2 * k]);
                    };
                    double const low = line(bounds.low[c]), high = line(bounds.high[c]);
                    add(fine, c, first, low, high);
                }
            }
            if (cut) continue;
            for (std::size_t c = 0; c < bounds.low.size(); ++c) { // as it is
                fine.low[c].push_back(bounds.low[c][2 * k + 1]);
                fine.high[c].push_back(bounds.high[c][2 * k + 1]);
            }
        }
        fine.times.push_back(bounds.times.back());
        for (std::size_t c = 0; c < bounds.low.size(); ++c)
            add(fine, c, false, bounds.low[c].back(), bounds.high[c].back());
        return fine;
    }
    /// An instant behind what is there, and what lies between if that is not.
    static void add(margin_bounds& to, std::size_t c, bool first, double low, double high) {
        if (!first && to.low[c].size() % 2 == 1) {
            to.low[c].push_back(std::min(to.low[c].back(), low));
            to.high[c].push_back(std::max(to.high[c].back(), high));
        }
        to.low[c].push_back(low);
        to.high[c].push_back(high);
    }

    /// Which side to halve, and whether to integrate anew: by the margins that are open.
    void weigh(motion_cover::part const& p, motion_cover::view const& v, judgement& result) const {
        if (v.reached < cover_.times().size()) {
            result.worn = true;
            result.score = cover_.lost_by_sides(p, v);
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
        result.score.assign(cover_.sides(), 0.0);
        for (std::size_t side = 0; side < cover_.sides(); ++side) {
            auto const q = cover_.variable_of(p, side);
            if (q < score.size()) result.score[side] = score[q];
        }
    }

    requirement const& what_;
    followed_outputs outputs_;
    motion_cover cover_;
    motion_cover::part whole_;
    std::vector<bool> differ_; ///< sides in which the sets differ
};

} // namespace sivid::decision_detail

#endif
