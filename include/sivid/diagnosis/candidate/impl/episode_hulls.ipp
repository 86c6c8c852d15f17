// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_IMPL_EPISODE_HULLS_IPP
#define SIVID_DIAGNOSIS_CANDIDATE_IMPL_EPISODE_HULLS_IPP

#include <sivid/diagnosis/candidate/detail/episode_hulls.hpp>

#include <sivid/diagnosis/candidate/detail/hull_search.hpp>
#include <sivid/diagnosis/candidate/detail/late_channels.hpp>
#include <sivid/diagnosis/candidate/detail/sliced_input.hpp>
#include <sivid/model/affected_problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

namespace diagnosis_detail {

class times_by_slices {
public:
    struct episode {
        double on = effect::from_start, off = effect::for_ever;
    };

    /// @param base  without the effect, outlives this object
    /// @param e     all the time
    times_by_slices(identification_problem const& base, effect const& e,
                    effect_hull_options const& options)
        : base_(&base),
          effect_(switched_within_all(base, e)),
          whole_(affected(base, {effect_})),
          at_switch_(index_of(whole_.model.about.inputs, effect_.name, "input")),
          search_(options) {
        auto const& model = whole_.model;
        auto const add = [this](signal_memory const& m, bool is_parameter) {
            auto const& name = whole_.model.about.constants[m.constant].name;
            sizes_.sides.push_back({index_of_parameter(whole_, name), is_parameter});
        };
        for (auto const& m : model.input_memory) add(m, false);
        late_.assign(model.about.channels.size(), false);
        for (auto const& m : model.channel_delays) {
            if (sizes_.sides.empty()) add(m, true);
            late_[m.index] = true;
        }
        // Without a memory, or where its size can be taken apart.
        possible_ = !base.model.has_memory() && sizes_.sides.size() <= 1 &&
                    (sizes_.sides.empty() || sliced_input_of(base, {e}));
    }

    /// @param first   what may be, for each experiment
    /// @param likely  when it is likely: times next to these are not tried
    [[nodiscard]] episode_hulls operator()(std::vector<switch_times> first,
                                           std::vector<episode> const& likely) const {
        episode_hulls known{whole_.prior, std::move(first)};
        // What is excluded at all mostly is so by few boxes.
        for (double const most : {1.0 / 200, 1.0 / 50, 1.0 / 12}) {
            if (!possible_ || !cut_ends(known, likely, most)) break;
        }
        return known;
    }

private:
    // Shares of the boxes and of the time that is left.
    static constexpr double of_onset_hull = 1.0 / 80;
    static constexpr double of_time = 1.0 / 4;

    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    /// What is left of what is known, with each switch open over its times, in the experiments in
    /// which that is not for long and one more. Nothing: nothing explains the data.
    [[nodiscard]] std::optional<explained_hull> left_of(episode_hulls const& known, std::size_t one,
                                                        double boxes) const {
        auto part = whole_;
        part.prior = known.parameters;
        part.experiments.clear();
        std::vector<switch_times> times;
        for (std::size_t s = 0; s < known.times.size(); ++s) {
            auto const& x = whole_.experiments[s];
            auto const all = measured_time(x);
            double const open = open_time(x.begin, all.upper(), known.times[s]);
            if (s != one && !(open < 0.5 * width(all))) continue;
            part.experiments.push_back(x);
            part.experiments.back().inputs[at_switch_] =
                switched_within(x.begin, all.upper(), known.times[s]);
            times.push_back(known.times[s]);
        }
        if (part.experiments.empty()) return explained_hull{known.parameters};
        auto const posed = sizes_.sides.empty() ? std::move(part) : over_sizes(part, times);
        if (posed.experiments.empty()) return explained_hull{known.parameters};
        auto const found = search_(posed, boxes, of_time);
        if (!found) return std::nullopt;
        return explained_by(whole_, sizes_, explained_hull{known.parameters}, posed, *found);
    }
    /// The same problem, over its prior, without a memory.
    [[nodiscard]] identification_problem over_sizes(identification_problem part,
                                                    std::vector<switch_times> const& times) const {
        auto const j = sizes_.sides.front().index;
        auto const range = part.prior[j];
        if (sizes_.sides.front().is_parameter) {
            auto own = *base_;
            for (std::size_t k = 0; k < own.prior.size(); ++k) own.prior[k] = part.prior[k];
            own.experiments.clear();
            for (auto& x : part.experiments) {
                x.inputs.resize(base_->model.about.inputs.size());
                own.experiments.push_back(std::move(x));
            }
            return with_late_channels(own, effect_, late_, range, times);
        }
        for (auto& x : part.experiments)
            for (auto const& m : part.model.input_memory)
                x.inputs[m.index] = remembered_within(x, m, range);
        part.model.input_memory.clear();
        auto const at = static_cast<std::ptrdiff_t>(j);
        part.choice.fixed[part.choice.unknown[j]] = range; // equations may read it, too
        part.choice.unknown.erase(part.choice.unknown.begin() + at);
        std::vector<interval> sides(part.prior.begin(), part.prior.end());
        sides.erase(sides.begin() + at);
        part.prior = box(std::move(sides));
        start_added_states(part);
        return part;
    }
    /// One end of what is known of one time, or of a size.
    struct side {
        std::size_t experiment = none;
        interval switch_times::*range = nullptr;
        bool late = false;
        double likely = 0;
        double share = 4 * least_share; ///< of what is far from the likely value
    };
    static constexpr double least_share = 1.0 / 32;

    [[nodiscard]] interval& range_of(episode_hulls& known, side const& x) const {
        return x.range != nullptr ? known.times[x.experiment].*x.range
                                  : known.parameters[sizes_.sides.front().index];
    }
    /// Cuts times and sizes off at both ends, as long as some are excluded.
    /// @param most  share of the boxes for each attempt
    /// @returns  false where nothing explains the data
    bool cut_ends(episode_hulls& known, std::vector<episode> const& likely, double most) const {
        std::vector<side> sides; // those come easily behind which nothing acts
        for (bool const easy : {true, false}) {
            double const share = easy ? 1 : 4 * least_share;
            for (std::size_t s = 0; s < known.times.size(); ++s) {
                sides.push_back({s, &switch_times::on, easy, likely[s].on, share});
                sides.push_back({s, &switch_times::off, !easy, likely[s].off, share});
            }
        }
        for (auto const& size : sizes_.sides)
            for (bool const late : {true, false})
                sides.push_back({.late = late, .likely = mid(known.parameters[size.index])});
        std::erase_if(sides, [&](side const& x) {
            auto const& range = range_of(known, x);
            return !(range.lower() < range.upper());
        });
        for (bool open = true; open && search_.in_time();) {
            bool moved = false;
            open = false;
            for (auto& x : sides) {
                while (cut_end(known, x, most)) {
                    moved = true;
                    x.share = std::min(1.0, 2 * x.share);
                }
                open |= x.share > least_share;
                x.share = std::max(least_share, x.share / 2);
            }
            open |= moved;
            if (!moved || !search_.in_time()) continue;
            auto const left = left_of(known, none, of_onset_hull);
            known.parameters = left ? left->parameters : empty_box(whole_.prior.size());
            if (!left) return false;
        }
        return true;
    }
    /// Cuts this share of the values off that are far from the likely one.
    /// @returns  whether they were excluded
    [[nodiscard]] bool cut_end(episode_hulls& known, side const& x, double most_boxes) const {
        auto const now = range_of(known, x);
        double const whole = x.range != nullptr
                                 ? width(measured_time(whole_.experiments[x.experiment]))
                                 : width(whole_.prior[sizes_.sides.front().index]);
        double const end = x.late ? now.upper() : now.lower();
        double const most = 0.875 * (std::clamp(x.likely, now.lower(), now.upper()) - end);
        double const cut = end + x.share * most;
        if (!(std::abs(cut - end) > search_.accuracy() * whole) || !search_.in_time()) return false;
        auto slice = known;
        range_of(slice, x) = x.late ? interval(cut, end) : interval(end, cut);
        if (left_of(slice, x.experiment, most_boxes)) return false;
        range_of(known, x) = x.late ? interval(now.lower(), cut) : interval(cut, now.upper());
        return true;
    }

    identification_problem const* base_;
    effect effect_; ///< with a switch in all experiments
    identification_problem whole_;
    std::size_t at_switch_;
    sliced_input sizes_; ///< its sides alone: one at most, of what is remembered
    std::vector<bool> late_;
    bool possible_ = true;
    hull_search search_;
};

} // namespace diagnosis_detail

SIVID_DECL episode_hulls hulls_of_episodes(identification_problem const& base, effect e,
                                           effect_hull_options const& options) {
    using slices = diagnosis_detail::times_by_slices;
    std::vector<slices::episode> likely;
    std::vector<switch_times> first;
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
    }
    e.only_in.clear(); // the switch is set for each slice
    e.since.clear();
    e.until.clear();
    return slices(base, e, options)(std::move(first), likely);
}

} // namespace sivid

#endif
