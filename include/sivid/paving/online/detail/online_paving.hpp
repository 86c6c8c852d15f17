// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_ONLINE_DETAIL_ONLINE_PAVING_HPP
#define SIVID_PAVING_ONLINE_DETAIL_ONLINE_PAVING_HPP

#include <sivid/paving/online/detail/online_refinement.hpp>
#include <sivid/paving/online/detail/online_test.hpp>
#include <sivid/paving/search/detail/hull_rest.hpp>
#include <sivid/paving/search/frontier.hpp>
#include <sivid/paving/verdict.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// The boxes of a prior that are not excluded, kept up to date while measurements arrive.
///   Boxes whose measurements so far and the new one certainly hold stay as they are; the others
///   are judged again, contracted, and split while the update's budget lasts. What is left open is
///   looked at again by the next update.
/// @guarantee  every feasible parameter lies in a live box; what was excluded stays excluded
class online_paving {
public:
    /// @param problem  as for `online_test`
    online_paving(identification_problem const& problem, feasibility_test_options const& options)
        : prior_(problem.prior), test_(problem, options) {
        boxes_.push_back({.set = prior_});
    }

    struct live_box {
        box set;
        box_verdict verdict = box_verdict::pending; ///< never outside
        std::shared_ptr<online_region> home = nullptr;
        std::vector<double> smear = {};
        bool judged = false; ///< by all measurements so far
        bool blind = false;  ///< see `online_test::blind`
        double volume = 1;   ///< share of the prior, for choices only
    };

    [[nodiscard]] std::vector<live_box> const& boxes() const { return boxes_; }
    [[nodiscard]] online_test& test() { return test_; }
    [[nodiscard]] online_test const& test() const { return test_; }
    [[nodiscard]] std::size_t judged() const { return judged_; }
    [[nodiscard]] std::size_t regions() const { return living().size(); }
    /// The smallest box around all that is left; empty sides when nothing is.
    [[nodiscard]] box hull() const {
        auto around = empty_box(prior_.size());
        for (auto const& b : boxes_) around = sivid::hull(around, b.set);
        return around;
    }

    /// Takes new measurements, per experiment, and refines.
    void update(std::vector<record> const& samples, online_refinement const& how,
                work_limit const& limit) {
        auto const regions = living();
        for (auto const& r : regions) r->forget_news();
        for (std::size_t e = 0; e < samples.size(); ++e) {
            if (!samples[e].empty()) test_.add(e, samples[e], regions);
        }
        drop_refuted();
        for (auto& b : boxes_) {
            if (b.home && b.judged && !b.home->concerned(b.set)) continue;
            b.judged = false;
            b.verdict = box_verdict::pending;
        }
        for (auto const& r : regions) contract_together(r);
        refine(how, limit);
    }
    /// Judges and splits what is open, largest ones first, within the budgets.
    /// @param limit  asked instead of `how.seconds`; a run that was begun is ended, since one that
    ///               is cut short is never carried on
    void refine(online_refinement const& how, work_limit const& limit) {
        gather_open();
        auto const before = judged_;
        paving_detail::hull_rest rest{.last = hull_of_all(),
                                      .next_look = std::max<std::size_t>(8, open_.size())};
        std::optional<stop_reason> ended;
        while (!ended) {
            bool const fresh = std::any_of(open_.begin(), open_.end(),
                                           [](live_box const& b) { return !b.judged; });
            if (open_.empty() && !reopen(how)) {
                ended = stop_reason::accuracy_reached;
            } else if (!fresh && much_inside(how)) {
                ended = stop_reason::inside_share;
            } else if (!fresh && rests(how, rest, judged_ - before)) {
                ended = stop_reason::hulls_rest;
            } else if (judged_ >= before + how.boxes) {
                ended = stop_reason::box_budget;
            } else if (!limit()) {
                ended = stop_reason::time_budget;
            } else if (fresh) { // what is new is judged before anything is split
                judge_all(before + how.boxes, limit);
            } else if (!learn_blind()) {
                if (boxes_.size() + open_.size() < how.live) {
                    split_largest(how);
                } else {
                    ended = stop_reason::box_budget;
                }
            }
        }
        ended_ = *ended;
        for (auto& b : open_) boxes_.push_back(std::move(b));
        open_.clear();
        if (limit()) consolidate();
        narrow_regions();
    }
    /// Why what is left was refined no further by the last update.
    [[nodiscard]] stop_reason reason() const {
        bool const decided = std::all_of(boxes_.begin(), boxes_.end(), [](live_box const& b) {
            return b.verdict == box_verdict::inside;
        });
        return decided ? stop_reason::decided : ended_;
    }
    /// Nothing is left elsewhere (trusted).
    void restrict_to(box const& left) {
        for (auto& b : boxes_) {
            b.set = intersect(b.set, left);
            b.volume = volume(b.set);
        }
        std::erase_if(boxes_, [](live_box const& b) { return is_empty(b.set); });
        narrow_regions();
    }
    /// Integrates anew over what is left of each region: from other starts, say.
    /// @cost  a run for each of them, eight at a time; until the next refinement nothing is judged
    void learn_anew() {
        auto const old = living();
        std::vector<box> sets;
        for (auto const& r : old) sets.push_back(r->live);
        auto const now = test_.learn(sets);
        for (auto& b : boxes_) {
            auto const at = std::find(old.begin(), old.end(), b.home);
            if (at == old.end()) continue;
            b.home = now[static_cast<std::size_t>(at - old.begin())];
            b.judged = false;
        }
        drop_refuted();
    }

private:
    void drop_refuted() {
        std::erase_if(boxes_, [](live_box const& b) { return b.home && b.home->refuted; });
    }
    /// What all boxes of a region lose is found by one look at the box around them.
    void contract_together(std::shared_ptr<online_region> const& r) {
        if (std::none_of(boxes_.begin(), boxes_.end(),
                         [&](live_box const& b) { return b.home == r && !b.judged; })) {
            return;
        }
        ++judged_;
        auto const says = test_.judge(*r, r->live);
        r->refuted = says.verdict == box_verdict::outside || is_empty(says.rest);
        if (r->refuted) {
            drop_refuted();
            return;
        }
        std::vector<live_box> rest;
        for (auto& b : boxes_) {
            if (b.home == r) {
                b.set = intersect(b.set, says.rest);
                if (is_empty(b.set)) continue;
                b.volume = volume(b.set);
                if (says.verdict == box_verdict::inside) {
                    b.verdict = says.verdict;
                    b.judged = true;
                }
            }
            rest.push_back(std::move(b));
        }
        boxes_ = std::move(rest);
        r->narrow(says.rest);
    }

    [[nodiscard]] double volume(box const& x) const { return relative_volume(x, prior_).upper(); }
    [[nodiscard]] online_test::region_list living() const {
        online_test::region_list list;
        for (auto const& b : boxes_) {
            if (b.home && std::find(list.begin(), list.end(), b.home) == list.end()) {
                list.push_back(b.home);
            }
        }
        return list;
    }

    /// Takes the open boxes out.
    void gather_open() {
        take_out([](live_box const& b) { return !b.judged || b.verdict != box_verdict::inside; });
    }
    /// Takes out those that were small against an older hull and are not against that of what is
    /// left. @returns false when there is none
    [[nodiscard]] bool reopen(online_refinement const& how) {
        take_out([&, whole = hull()](live_box const& b) {
            return b.verdict != box_verdict::inside &&
                   paving_detail::side_to_split(b.set, whole, b.smear, how.accuracy);
        });
        return !open_.empty();
    }
    template <class Opens>
    void take_out(Opens const& opens) {
        std::vector<live_box> settled;
        for (auto& b : boxes_) (opens(b) ? open_ : settled).push_back(std::move(b));
        boxes_ = std::move(settled);
    }

    [[nodiscard]] bool much_inside(online_refinement const& how) const {
        double inner = 0, outer = 0;
        for (auto const& b : boxes_) {
            outer += b.volume;
            inner += b.verdict == box_verdict::inside ? b.volume : 0;
        }
        for (auto const& b : open_) outer += b.volume;
        return inner > 0 && inner >= how.sufficient_ratio * outer;
    }
    /// The hull of what is left while refining.
    [[nodiscard]] box hull_of_all() const {
        auto around = hull();
        for (auto const& b : open_) around = sivid::hull(around, b.set);
        return around;
    }
    /// @param judged  boxes since the refinement began
    [[nodiscard]] bool rests(online_refinement const& how, paving_detail::hull_rest& rest,
                             std::size_t judged) const {
        return how.hull_gain > 0 && rest(
                                        judged, how.hull_gain, [this] { return hull_of_all(); },
                                        [](box const&) { return true; });
    }

    void judge_all(std::size_t until, work_limit const& limit) {
        std::vector<live_box> open, homeless;
        for (auto& b : open_) {
            bool const learns = !b.judged && !b.home;
            (learns ? homeless : open).push_back(std::move(b));
        }
        open_ = std::move(open);
        if (!homeless.empty()) give_homes(std::move(homeless));
        std::vector<live_box> kept;
        for (auto& b : open_) {
            if (b.judged || judged_ >= until || !limit()) {
                kept.push_back(std::move(b));
                continue;
            }
            judge(std::move(b), kept);
        }
        open_ = std::move(kept);
    }
    void give_homes(std::vector<live_box> boxes) {
        std::vector<box> sets;
        for (auto const& b : boxes) sets.push_back(b.set);
        auto const regions = test_.learn(sets);
        for (std::size_t k = 0; k < boxes.size(); ++k) {
            if (regions[k]->refuted) continue;
            boxes[k].home = regions[k];
            boxes[k].judged = false;
            open_.push_back(std::move(boxes[k]));
        }
    }
    /// @param open  takes what is left undecided
    void judge(live_box b, std::vector<live_box>& open) {
        ++judged_;
        auto says = test_.judge(*b.home, b.set);
        if (says.verdict == box_verdict::outside || is_empty(says.rest)) return;
        b.blind = test_.blind(says);
        b.verdict =
            says.verdict == box_verdict::inside ? box_verdict::inside : box_verdict::undecided;
        double const before = b.volume;
        b.set = std::move(says.rest);
        b.volume = volume(b.set);
        b.smear = std::move(says.smear);
        // What shrank much is worth another look.
        b.judged = b.verdict == box_verdict::inside || !(b.volume < 0.5 * before);
        (b.verdict == box_verdict::inside ? boxes_ : open).push_back(std::move(b));
    }

    /// Blind boxes that are much smaller than their regions get their own, the largest first and as
    /// many as cost one. @returns false when there is none
    bool learn_blind() {
        std::vector<live_box> learns, others;
        std::stable_sort(open_.begin(), open_.end(),
                         [](live_box const& a, live_box const& b) { return a.volume > b.volume; });
        auto const limit = test_.at_once();
        for (auto& b : open_) {
            bool const gains = b.blind && b.volume < 0.6 * volume(b.home->domain);
            (gains && learns.size() < limit ? learns : others).push_back(std::move(b));
        }
        open_ = std::move(others);
        bool const any = !learns.empty();
        if (any) give_homes(std::move(learns));
        return any;
    }
    /// The largest box, and those that are not much smaller.
    void split_largest(online_refinement const& how) {
        auto whole = hull();
        double most = 0;
        for (auto const& b : open_) {
            whole = sivid::hull(whole, b.set);
            most = std::max(most, b.volume);
        }
        std::vector<live_box> parts;
        for (auto& b : open_) {
            if (!(b.volume >= 0.5 * most)) {
                parts.push_back(std::move(b));
                continue;
            }
            auto const side = paving_detail::side_to_split(b.set, whole, b.smear, how.accuracy);
            if (!side) {
                boxes_.push_back(std::move(b));
                continue;
            }
            auto [low, high] = bisect(b.set, *side, mid(b.set[*side]));
            for (auto* half : {&low, &high}) {
                auto part = b;
                part.set = std::move(*half);
                part.volume = volume(part.set);
                part.judged = false;
                part.verdict = box_verdict::pending;
                parts.push_back(std::move(part));
            }
        }
        open_ = std::move(parts);
    }

    void narrow_regions() {
        for (auto const& r : living()) {
            auto rest = empty_box(prior_.size());
            for (auto const& b : boxes_) {
                if (b.home == r) rest = sivid::hull(rest, b.set);
            }
            if (volume(rest) < 0.7 * volume(r->live)) r->narrow(rest);
        }
    }
    /// When what is left has become smaller, one region may do for all of it: cheaper to carry on,
    /// and sharper.
    void consolidate() {
        auto const around = hull();
        double const size = volume(around);
        if (boxes_.empty() || !(size < 0.5 * consolidated_)) return;
        auto const old = living();
        bool const one_will_do =
            old.size() == 1 && size > 0.1 * volume(old[0]->domain) &&
            std::none_of(boxes_.begin(), boxes_.end(), [](live_box const& b) { return b.blind; });
        if (one_will_do) return;
        consolidated_ = size;
        auto const region = test_.learn({around})[0];
        if (region->refuted) {
            boxes_.clear();
            return;
        }
        auto const says = test_.judge(*region, around);
        if (says.verdict == box_verdict::outside) {
            boxes_.clear();
            return;
        }
        if (test_.blind(says)) return;
        for (auto& b : boxes_) {
            b.home = region;
            b.blind = false;
            b.judged = b.judged && b.verdict == box_verdict::inside;
        }
    }

    box prior_;
    online_test test_;
    std::vector<live_box> boxes_;
    std::vector<live_box> open_;               ///< while refining: what is open
    stop_reason ended_ = stop_reason::decided; ///< what the last refinement ended by
    std::size_t judged_ = 0;
    double consolidated_ = 1;
};

} // namespace sivid

#endif
