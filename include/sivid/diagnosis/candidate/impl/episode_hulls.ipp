// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_IMPL_EPISODE_HULLS_IPP
#define SIVID_DIAGNOSIS_CANDIDATE_IMPL_EPISODE_HULLS_IPP

#include <sivid/diagnosis/candidate/detail/episode_hulls.hpp>

#include <sivid/diagnosis/affected_problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace diagnosis_detail {

class times_by_slices {
public:
    struct episode {
        double on = effect::from_start, off = effect::for_ever;
    };

    explicit times_by_slices(effect_hull_options const& options) : search_(options) {}

    /// @param whole   with the effect alone, its switch last among the inputs
    /// @param first   what may be, for each experiment
    /// @param likely  when it is likely: times next to these are not tried
    [[nodiscard]] episode_hulls operator()(identification_problem const& whole,
                                           std::vector<switch_times> first,
                                           std::vector<episode> const& likely) const {
        episode_hulls known{whole.prior, std::move(first)};
        // What is excluded at all mostly is so by few boxes.
        for (double const most : {1.0 / 200, 1.0 / 50, 1.0 / 12}) {
            if (!cut_times(whole, known, likely, most)) break;
        }
        return known;
    }

private:
    // Shares of the boxes and of the time that is left.
    static constexpr double of_onset_hull = 1.0 / 80;
    static constexpr double of_time = 1.0 / 4;

    /// The problem with each switch open over what is known of its times, for the experiments of
    /// which that is much and one more.
    [[nodiscard]] static identification_problem
    switched(identification_problem const& whole, episode_hulls const& known,
             std::size_t one = static_cast<std::size_t>(-1)) {
        auto result = whole;
        result.prior = known.parameters;
        result.experiments.clear();
        for (std::size_t s = 0; s < known.times.size(); ++s) {
            auto x = whole.experiments[s];
            auto const all = measured_time(x);
            double const open = open_time(x.begin, all.upper(), known.times[s]);
            if (s != one && !(open < 0.5 * width(all))) continue;
            x.inputs.back() = switched_within(x.begin, all.upper(), known.times[s]);
            result.experiments.push_back(std::move(x));
        }
        start_added_states(result);
        return result;
    }
    /// One end of what is known of one time.
    struct side {
        std::size_t experiment;
        interval switch_times::*range;
        bool late;
        double likely;
        double share; ///< of what is far from the likely time
    };
    static constexpr double least_share = 1.0 / 32;

    /// Cuts times off at both ends, as long as some are excluded.
    /// @param most  share of the boxes for each attempt
    /// @returns  false where nothing explains the data
    bool cut_times(identification_problem const& whole, episode_hulls& known,
                   std::vector<episode> const& likely, double most) const {
        std::vector<side> sides; // those come easily behind which nothing acts
        for (bool const easy : {true, false}) {
            double const share = easy ? 1 : 4 * least_share;
            for (std::size_t s = 0; s < known.times.size(); ++s) {
                sides.push_back({s, &switch_times::on, easy, likely[s].on, share});
                sides.push_back({s, &switch_times::off, !easy, likely[s].off, share});
            }
        }
        std::erase_if(sides, [&](side const& x) {
            auto const& range = known.times[x.experiment].*x.range;
            return !(range.lower() < range.upper());
        });
        for (bool open = true; open && search_.in_time();) {
            bool moved = false;
            open = false;
            for (auto& x : sides) {
                while (cut_times(whole, known, x, most)) {
                    moved = true;
                    x.share = std::min(1.0, 2 * x.share);
                }
                open |= x.share > least_share;
                x.share = std::max(least_share, x.share / 2);
            }
            open |= moved;
            auto const all = switched(whole, known);
            if (!moved || !search_.in_time() || all.experiments.empty()) continue;
            auto const left = search_(all, of_onset_hull, of_time);
            known.parameters = left ? left->parameters : nothing_of(whole.prior);
            if (!left) return false;
        }
        return true;
    }
    /// Cuts this share of the times off that are far from the likely one.
    /// @returns  whether they were excluded
    [[nodiscard]] bool cut_times(identification_problem const& whole, episode_hulls& known,
                                 side const& x, double most_boxes) const {
        auto const s = x.experiment;
        auto const all = measured_time(whole.experiments[s]);
        auto const now = known.times[s].*x.range;
        double const end = x.late ? now.upper() : now.lower();
        double const most = 0.875 * (std::clamp(x.likely, now.lower(), now.upper()) - end);
        double const cut = end + x.share * most;
        if (!(std::abs(cut - end) > search_.accuracy() * width(all)) || !search_.in_time())
            return false;
        auto slice = known;
        slice.times[s].*x.range = x.late ? interval(cut, end) : interval(end, cut);
        if (search_(switched(whole, slice, s), most_boxes, of_time)) return false;
        known.times[s].*x.range = x.late ? interval(now.lower(), cut) : interval(cut, now.upper());
        return true;
    }

    hull_search search_;
};

} // namespace diagnosis_detail

SIVID_DECL episode_hulls hulls_of_episodes(identification_problem const& base, effect e,
                                           effect_hull_options const& options) {
    using slices = diagnosis_detail::times_by_slices;
    std::vector<slices::episode> likely;
    std::vector<switch_times> first;
    std::vector<std::string> names;
    bool const begins = e.begins_later() || !e.ends(), ends = e.ends();
    for (auto const& x : base.experiments) {
        auto const& in = e.only_in;
        auto const k =
            static_cast<std::size_t>(std::find(in.begin(), in.end(), x.name) - in.begin());
        auto& l = likely.emplace_back();
        if (!in.empty() && k == in.size()) // not there: it never begins, or ends at once
            (begins ? l.on : l.off) = begins ? effect::for_ever : effect::from_start;
        if (k < e.since.size()) l.on = e.since[k];
        if (k < e.until.size()) l.off = e.until[k];
        auto const all = measured_time(x);
        auto& may = first.emplace_back(switch_times{interval(x.begin)});
        if (begins) may.on = all;
        if (ends) may.off = all;
        names.push_back(x.name);
    }
    e.only_in = std::move(names); // the switch is set for each slice
    e.since.clear();
    e.until.clear();
    return slices(options)(affected(base, {std::move(e)}), std::move(first), likely);
}

} // namespace sivid

#endif
