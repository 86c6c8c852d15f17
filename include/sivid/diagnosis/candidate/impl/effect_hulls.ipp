// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_IMPL_EFFECT_HULLS_IPP
#define SIVID_DIAGNOSIS_CANDIDATE_IMPL_EFFECT_HULLS_IPP

#include <sivid/diagnosis/candidate/detail/effect_hulls.hpp>

#include <sivid/diagnosis/affected_problem.hpp>
#include <sivid/diagnosis/candidate/detail/input_slices.hpp>
#include <sivid/diagnosis/candidate/resolve_memory.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/judge/data_test.hpp>
#include <sivid/paving/products/dependence.hpp>
#include <sivid/paving/products/reduction.hpp>
#include <sivid/paving/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

namespace diagnosis_detail {

class hulls_by_slices {
public:
    struct episode {
        double on = effect::from_start, off = effect::for_ever;
    };

    hulls_by_slices(identification_problem const& base, std::vector<effect> const& effects,
                    effect_hull_options const& options)
        : base_(&base),
          effects_(&effects),
          options_(&options),
          limit_(options.seconds, options.keep_going) {}

    [[nodiscard]] box operator()() {
        auto const whole = affected(*base_, *effects_);
        auto const& model = whole.model;
        if (model.has_memory()) {
            if (model.channel_delays.empty() && model.input_memory.size() == 1) {
                return over_sizes(whole, model.input_memory[0]);
            }
            return whole.prior;
        }
        return over_lags(whole);
    }

    /// Of the only effect, whenever it acts.
    /// @param first  what may be, for each experiment
    /// @param likely  when it is likely: times next to these are not tried
    [[nodiscard]] episode_hulls over_episodes(std::vector<switch_times> first,
                                              std::vector<episode> const& likely) {
        auto const whole = affected(*base_, *effects_);
        episode_hulls known{whole.prior, std::move(first)};
        // What is excluded at all mostly is so by few boxes.
        for (double const most : {1.0 / 200, 1.0 / 50, 1.0 / 12}) {
            if (!cut_times(whole, known, likely, most)) break;
        }
        return known;
    }

private:
    // Shares of the boxes and of the time that is left.
    static constexpr double of_late_slice = 1.0 / 32;
    static constexpr double of_quick_slice = 1.0 / 8;
    static constexpr double of_onset_hull = 1.0 / 80;
    static constexpr double of_time = 1.0 / 4;

    /// What a problem leaves of its prior; nothing when it explains nothing. Without a fit, which
    /// excludes nothing.
    /// @param share  of the boxes, and of the time that is left where that has no share of its own
    [[nodiscard]] std::optional<box> hull_of(identification_problem const& problem, double share,
                                             std::optional<double> time = std::nullopt) {
        if (problem.prior.size() == 0) return problem.prior;
        auto const map = reduction::find(problem, dependence_of(problem));
        auto const& posed = map ? map->problem() : problem;
        data_test test(posed, limited(options_->test, limit_));
        inversion_options search{
            .accuracy_of_hull = true, .hull_gain = 0.02, .keep_outside = false};
        search.seconds = time.value_or(share) * limit_.seconds();
        search.boxes = static_cast<std::size_t>(share * static_cast<double>(options_->boxes));
        search.keep_going = limit_;
        auto const paving = invert(test, posed.prior, search).paving;
        if (!paving.has_outer()) return std::nullopt;
        auto const left = paving.outer_hull();
        return map ? map->backward(problem.prior, left) : left;
    }

    /// A box of all parameters from one without parameter `j`, and the range of that.
    [[nodiscard]] static box joined(box const& others, std::size_t j, interval const& range) {
        std::vector<interval> sides(others.begin(), others.end());
        sides.insert(sides.begin() + static_cast<std::ptrdiff_t>(j), range);
        return box(std::move(sides));
    }
    static void add(box& hulls, box const& more) {
        hulls = hulls.size() == 0 ? more : hull(hulls, more);
    }
    [[nodiscard]] static std::size_t index_of_parameter(identification_problem const& problem,
                                                        std::string const& name) {
        auto const& names = problem.choice.unknown;
        return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) -
                                        names.begin());
    }
    [[nodiscard]] static box nothing_of(box const& whole) {
        return box(std::vector<interval>(whole.size(), interval_traits<interval>::empty()));
    }

    /// Halves of the prior, the widest first, until they are excluded or narrow.
    [[nodiscard]] box over_sizes(identification_problem const& whole, signal_memory const& memory) {
        auto const& name = whole.model.about.constants[memory.constant].name;
        auto const j = index_of_parameter(whole, name);
        if (j == whole.prior.size()) return whole.prior; // a known size
        for (auto const& e : whole.experiments) {
            if (!std::holds_alternative<sampled_signal>(e.inputs[memory.index])) return whole.prior;
        }
        struct slice {
            interval range;
            box others; ///< contains what the slice leaves
        };
        auto middle = mid(whole.prior);
        box const rest = resolve_memory(whole, middle).problem.prior;
        std::vector<slice> waiting;   // the widest first: in order of coming
        constexpr int begin_with = 8; // wider ones are rarely excluded
        auto const at = [&](int k) {
            double const way = static_cast<double>(k) / begin_with;
            auto const& all = whole.prior[j];
            return k == 0            ? all.lower()
                   : k == begin_with ? all.upper()
                                     : all.lower() + way * (all.upper() - all.lower());
        };
        for (int k = 0; k < begin_with; ++k) waiting.push_back({interval(at(k), at(k + 1)), rest});
        double const narrow = options_->accuracy * width(whole.prior[j]);
        box hulls;
        for (std::size_t next = 0; next < waiting.size(); ++next) {
            auto const now = waiting[next];
            if (!limit_()) {
                add(hulls, joined(now.others, j, now.range));
                continue;
            }
            middle[j] = mid(now.range);
            auto problem = resolve_memory(whole, middle).problem;
            problem.prior = now.others;
            for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
                auto const& as_recorded = whole.experiments[s];
                auto& e = problem.experiments[s];
                auto const& u = std::get<sampled_signal>(as_recorded.inputs[memory.index]);
                e.inputs[memory.index] = memory.kind == memory_kind::play
                                             ? played(u, e.begin, e.end(), now.range).within
                                             : delayed_within(u, e.begin, e.end(), now.range);
            }
            start_added_states(problem);
            auto const left = hull_of(problem, of_late_slice);
            if (!left) continue;
            double const half = mid(now.range);
            bool const splits = now.range.lower() < half && half < now.range.upper();
            if (!(width(now.range) > narrow) || !splits) {
                add(hulls, joined(*left, j, now.range));
                continue;
            }
            using traits = interval_traits<interval>;
            waiting.push_back({traits::bounds(now.range.lower(), half), *left});
            waiting.push_back({traits::bounds(half, now.range.upper()), *left});
        }
        return hulls.size() == 0 ? nothing_of(whole.prior) : hulls;
    }
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
                   std::vector<episode> const& likely, double most) {
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
        for (bool open = true; open && limit_();) {
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
            if (!moved || !limit_() || all.experiments.empty()) continue;
            auto const left = hull_of(all, of_onset_hull, of_time);
            known.parameters = left ? *left : nothing_of(whole.prior);
            if (!left) return false;
        }
        return true;
    }
    /// Cuts this share of the times off that are far from the likely one.
    /// @returns  whether they were excluded
    [[nodiscard]] bool cut_times(identification_problem const& whole, episode_hulls& known,
                                 side const& x, double most_boxes) {
        auto const s = x.experiment;
        auto const all = measured_time(whole.experiments[s]);
        auto const now = known.times[s].*x.range;
        double const end = x.late ? now.upper() : now.lower();
        double const most = 0.875 * (std::clamp(x.likely, now.lower(), now.upper()) - end);
        double const cut = end + x.share * most;
        if (!(std::abs(cut - end) > options_->accuracy * width(all)) || !limit_()) return false;
        auto slice = known;
        slice.times[s].*x.range = x.late ? interval(cut, end) : interval(end, cut);
        if (hull_of(switched(whole, slice, s), most_boxes, of_time)) return false;
        known.times[s].*x.range = x.late ? interval(now.lower(), cut) : interval(cut, now.upper());
        return true;
    }

    /// Where the time constant of a lag may be 0, short ones are excluded as inputs with errors, if
    /// possible: the lag's equation is for the others.
    [[nodiscard]] box over_lags(identification_problem whole) {
        box hulls;
        for (std::size_t k = 0; k < effects_->size(); ++k) {
            auto const& e = (*effects_)[k];
            if (!e.lags || !acts_first(k)) continue;
            auto const j = index_of_parameter(whole, e.name + "." + e.parameters[0].name);
            auto const prior = whole.prior[j];
            if (prior.lower() != 0) continue; // below 0 a lag is none
            for (double const share : {1.0 / 16, 1.0 / 64, 1.0 / 256}) {
                double const longest = share * prior.upper();
                auto const quick = without_lag(k, longest);
                if (!quick || !limit_()) break;
                auto const left = hull_of(*quick, of_quick_slice);
                if (left && share > 1.0 / 256) continue; // shorter ones may be excluded
                if (left) add(hulls, joined(*left, j, interval(prior.lower(), longest)));
                whole.prior[j] = interval(longest, prior.upper());
                break;
            }
        }
        if (auto const left = hull_of(whole, 1)) add(hulls, *left);
        return hulls.size() == 0 ? nothing_of(whole.prior) : hulls;
    }
    /// Whether what the lag sees is the recorded input.
    [[nodiscard]] bool acts_first(std::size_t k) const {
        auto const& own = (*effects_)[k];
        for (std::size_t i = 0; i < effects_->size(); ++i) {
            auto const& other = (*effects_)[i];
            if (i != k && other.on_inputs && other.order <= own.order) return false;
        }
        return true;
    }
    /// The problem for all time constants up to the longest; nothing where the input is a formula.
    [[nodiscard]] std::optional<identification_problem> without_lag(std::size_t k,
                                                                    double longest) const {
        auto const& lag = *(*effects_)[k].lags;
        auto others = *effects_;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
        auto late = *base_;
        auto const input = index_of(late.model.about.inputs, lag.input, "input");
        for (auto& e : late.experiments) {
            auto const* const recorded = std::get_if<sampled_signal>(&e.inputs[input]);
            if (recorded == nullptr) return std::nullopt;
            e.inputs[input] = lagged_within(*recorded, e.begin, e.end(), longest, lag.rests);
        }
        return affected(late, others);
    }

    identification_problem const* base_;
    std::vector<effect> const* effects_;
    effect_hull_options const* options_;
    work_limit limit_;
};

} // namespace diagnosis_detail

SIVID_DECL box effect_hulls(identification_problem const& base, std::vector<effect> const& effects,
                            effect_hull_options const& options) {
    return diagnosis_detail::hulls_by_slices(base, effects, options)();
}

SIVID_DECL episode_hulls hulls_of_episodes(identification_problem const& base, effect e,
                                           effect_hull_options const& options) {
    using slices = diagnosis_detail::hulls_by_slices;
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
    std::vector<effect> const effects{std::move(e)};
    return slices(base, effects, options).over_episodes(std::move(first), likely);
}

} // namespace sivid

#endif
