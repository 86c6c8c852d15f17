// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_MOTION_DETAIL_OPEN_PARTS_HPP
#define SIVID_DECISION_MOTION_DETAIL_OPEN_PARTS_HPP

#include <sivid/decision/motion/detail/judged_motions.hpp>
#include <sivid/decision/motion/detail/motion_cover.hpp>
#include <sivid/decision/requirement/robustness.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <set>
#include <utility>
#include <vector>

namespace sivid::decision_detail {

/// Parts of which a requirement is not proved, or not refuted: judged many at a time, halved where
/// that promises most, and dropped once it is.
class open_parts {
public:
    enum class aim { proof, refutation };
    struct item {
        motion_cover::part what;
        judged_motions::judgement says{};
        bool judged = false;
        bool settled = false; ///< no half gets further
        int violations = 0;   ///< how often the contrary was found of it, or what it is a half of
        int halvings = 0;     ///< that led to it
        double before = -1;   ///< how far what it is a half of was carried; time
    };

    /// @param roughly  see `judged_motions::judge`
    explicit open_parts(judged_motions& motions, aim wanted = aim::proof, bool roughly = false)
        : motions_(&motions), aim_(wanted), roughly_(roughly) {}

    void add(motion_cover::part p) { items_.push_back({std::move(p)}); }
    [[nodiscard]] std::vector<item>& items() { return items_; }
    [[nodiscard]] std::vector<item> const& items() const { return items_; }
    [[nodiscard]] std::size_t judged() const { return judged_; }

    /// Judges as many as are integrated at once. @returns false when all are judged
    /// @param dropped  is called with each that is
    bool judge_some(std::function<void(item const&)> const& dropped = nullptr) {
        auto& cover = motions_->cover();
        std::vector<item*> next;
        std::vector<motion_cover::part*> fresh;
        for (auto& i : items_) {
            if (i.judged) continue;
            if (!i.what.known && fresh.size() == cover.at_once()) break;
            next.push_back(&i);
            if (!i.what.known) fresh.push_back(&i.what);
        }
        if (next.empty()) return false;
        if (!fresh.empty()) cover.learn(fresh);
        for (auto* i : next) {
            i->says = motions_->judge(i->what, roughly_);
            i->judged = true;
            ++judged_;
        }
        std::erase_if(items_, [&](item const& i) {
            bool const drop = i.judged && is_done(i);
            if (drop && dropped) dropped(i);
            return drop;
        });
        return true;
    }

    /// What can go on first, and of that what is furthest from the aim. @returns whether anything
    /// can
    bool sort() {
        std::sort(items_.begin(), items_.end(), [this](item const& a, item const& b) {
            if (a.settled != b.settled) return b.settled;
            return aim_ == aim::proof ? a.says.found.low < b.says.found.low
                                      : a.says.found.high > b.says.found.high;
        });
        return !items_.empty() && !items_.front().settled;
    }

    /// The first ones in two, as many as are integrated at once.
    /// @param leaves  whether a part need not be looked at, for another reason
    /// @given  all are judged, and sorted
    void halve(std::function<bool(item&)> const& leaves = nullptr) {
        auto& cover = motions_->cover();
        std::vector<item> halves;
        std::size_t taken = 0;
        for (auto& i : items_) {
            if (2 * taken >= cover.at_once()) break;
            if (i.settled) continue;
            ++taken;
            bool const stuck = i.says.reached < cover.times().back() && i.says.reached <= i.before;
            auto score = stuck ? reached_by_halves(i) : i.says.score; // of halves, further down
            auto parts = i.says.coarse ? std::vector<motion_cover::part>{} // not by smaller boxes
                                       : cover.split_by(score, i.what);
            if (parts.empty() || motions_->is_tiny(i.what)) {
                i.settled = true;
                continue;
            }
            ++i.halvings;
            if (leaves && leaves(i)) {
                i.judged = false;
                continue;
            }
            if (is_hopeless(i) && ++i.violations > 5) { // such as what is not known to be feasible
                i.settled = true;
                continue;
            }
            // Boxes side by side cost little more than one: what is integrated anew is cut finer.
            auto const most = cover.at_once() / taken;
            while (i.says.worn && 2 * parts.size() <= most) {
                reduce(score);
                std::vector<motion_cover::part> finer;
                for (auto& p : parts) {
                    auto cut = cover.split_by(score, p);
                    if (cut.empty()) cut.push_back(std::move(p));
                    for (auto& c : cut) finer.push_back(std::move(c));
                }
                bool const more = finer.size() > parts.size();
                parts = std::move(finer);
                if (!more) break;
            }
            for (auto& p : parts) {
                if (i.says.worn) p.known = nullptr;
                halves.push_back(
                    {std::move(p), i.says, false, false, i.violations, i.halvings, i.says.reached});
            }
            i.judged = false; // its halves take its place
        }
        std::erase_if(items_, [](item const& i) { return !i.judged; });
        for (auto& h : halves) items_.push_back(std::move(h));
    }

    [[nodiscard]] bool is_done(item const& i) const {
        return aim_ == aim::proof ? i.says.found.proved() : i.says.found.refuted();
    }
    /// Whether the contrary of the aim holds for all of it.
    [[nodiscard]] bool is_hopeless(item const& i) const {
        return aim_ == aim::proof ? i.says.found.hopeless() : i.says.found.proved();
    }

private:
    /// How far a half along each side is carried: what moves a motion most until it is lost need
    /// not be what loses it.
    [[nodiscard]] std::vector<double> reached_by_halves(item const& i) const {
        auto& cover = motions_->cover();
        std::vector<motion_cover::part> tried;
        std::vector<std::size_t> sides;
        for (std::size_t side = 0; side < cover.sides(); ++side) {
            auto halves = cover.split(i.what, side);
            if (halves.empty()) continue;
            tried.push_back(std::move(halves.front()));
            tried.back().known = nullptr;
            sides.push_back(side);
        }
        if (!tried.empty()) cover.learn(tried);
        std::vector<double> score(cover.sides(), 0.0);
        for (std::size_t k = 0; k < tried.size(); ++k) {
            auto const reached = static_cast<double>(tried[k].known->reached);
            score[sides[k]] = 1 + reached + 0.9 * cover.share(i.what, sides[k]); // the wider of two
        }
        return score;
    }
    /// A side that was halved moves half as much.
    static void reduce(std::vector<double>& score) {
        auto const side = motion_cover::most(score);
        if (side != motion_cover::none) score[side] /= 2;
    }

    judged_motions* motions_;
    aim aim_;
    bool roughly_;
    std::vector<item> items_;
    std::size_t judged_ = 0;
};

/// A grid in which some cells are cut in four.
[[nodiscard]] inline std::vector<double> finer_grid(std::vector<double> const& times,
                                                    std::set<std::size_t> const& cells) {
    std::vector<double> finer;
    for (std::size_t k = 0; k + 1 < times.size(); ++k) {
        finer.push_back(times[k]);
        if (cells.count(k) == 0) continue;
        double const length = times[k + 1] - times[k];
        for (int part = 1; part < 4; ++part) {
            double const t = times[k] + length * part / 4;
            if (t > finer.back() && t < times[k + 1]) finer.push_back(t);
        }
    }
    finer.push_back(times.back());
    return finer;
}

} // namespace sivid::decision_detail

#endif
