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
#include <limits>
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

    /// See `without_memory`.
    [[nodiscard]] std::optional<identification_problem> without_memory(box const& p) const {
        auto const whole = affected(*base_, *effects_);
        auto const& model = whole.model;
        if (!model.channel_delays.empty() || model.input_memory.size() > 1) return std::nullopt;
        if (!model.has_memory()) return with_prior(whole, p);
        auto const& memory = model.input_memory[0];
        auto const j = index_of_parameter(whole, whole.model.about.constants[memory.constant].name);
        if (j == whole.prior.size() || !is_recorded(whole, memory)) return std::nullopt;
        return posed(whole, memory, linear_delay(whole, memory), j, p);
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
    static constexpr double of_octave = 1.0 / 8;
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

    /// The effect whose only parameter is the delay of one recorded input by straight lines, and
    /// does nothing else; none otherwise.
    [[nodiscard]] std::optional<std::size_t> linear_delay(identification_problem const& whole,
                                                          signal_memory const& memory) const {
        if (memory.kind != memory_kind::delay) return std::nullopt;
        for (auto const& x : whole.experiments) {
            auto const& u = std::get<sampled_signal>(x.inputs[memory.index]);
            if (u.kind() != interpolation::linear) return std::nullopt;
        }
        auto const& name = whole.model.about.constants[memory.constant].name;
        for (std::size_t k = 0; k < effects_->size(); ++k) {
            auto const& e = (*effects_)[k];
            bool const only = e.parameters.size() == 1 && !e.on_rates && !e.on_channels;
            if (only && e.name + "." + e.parameters[0].name == name) return k;
        }
        return std::nullopt;
    }
    /// The problem for delays within a range, with the distance from its middle as a parameter in
    /// the place of the delay: the input's slope is a further input, by which it acts.
    [[nodiscard]] identification_problem with_delays(signal_memory const& memory, std::size_t which,
                                                     interval const& delays) const {
        auto effects = *effects_;
        auto& e = effects[which];
        for (auto const& x : base_->experiments) e.only_in.push_back(x.name);
        e.order = std::numeric_limits<int>::min(); // what others see is late
        auto const input = base_->model.about.inputs[memory.index].name;
        e.on_inputs = [input](effect_scope& h) { h.input(input) += h.parameter(); };
        auto problem = affected(*base_, effects);
        auto const j = index_of_parameter(problem, e.name + "." + e.parameters[0].name);
        double middle = mid(delays);
        for (auto& x : problem.experiments) {
            auto const& u = std::get<sampled_signal>(x.inputs[memory.index]);
            auto late = late_by_parameter(u, x.begin, x.end(), delays);
            middle = late.middle_delay;
            x.inputs.back() = std::move(late.minus_slope);
            x.inputs[memory.index] = std::move(late.middle);
        }
        problem.prior[j] =
            interval_traits<interval>::sub(delays, interval_traits<interval>::point(middle));
        start_added_states(problem);
        return problem;
    }
    /// The problem for a range of delays or plays, as an input with errors.
    [[nodiscard]] static identification_problem within(identification_problem const& whole,
                                                       signal_memory const& memory, std::size_t j,
                                                       interval const& range) {
        auto middle = mid(whole.prior);
        middle[j] = mid(range);
        auto problem = resolve_memory(whole, middle).problem;
        for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
            auto const& as_recorded = whole.experiments[s];
            auto& e = problem.experiments[s];
            auto const& u = std::get<sampled_signal>(as_recorded.inputs[memory.index]);
            e.inputs[memory.index] = memory.kind == memory_kind::play
                                         ? played(u, e.begin, e.end(), range).within
                                         : delayed_within(u, e.begin, e.end(), range);
        }
        start_added_states(problem);
        return problem;
    }

    /// Slices of the prior, the widest first, each cut to what it leaves or halved, until they are
    /// excluded or narrow.
    [[nodiscard]] box over_sizes(identification_problem const& whole, signal_memory const& memory) {
        using traits = interval_traits<interval>;
        auto const& name = whole.model.about.constants[memory.constant].name;
        auto const j = index_of_parameter(whole, name);
        if (j == whole.prior.size()) return whole.prior; // a known size
        if (!is_recorded(whole, memory)) return whole.prior;
        auto const delay = linear_delay(whole, memory);
        struct slice {
            interval range;
            box left; ///< of all parameters, contains what the slice leaves
        };
        std::vector<slice> waiting;   // the widest first: in order of coming
        constexpr int begin_with = 8; // wider ones are rarely excluded
        auto const at = [&](int k) {
            double const way = static_cast<double>(k) / begin_with;
            auto const& all = whole.prior[j];
            return k == 0            ? all.lower()
                   : k == begin_with ? all.upper()
                                     : all.lower() + way * (all.upper() - all.lower());
        };
        auto const add_slice = [&](interval const& range, box left) {
            left[j] = range;
            waiting.push_back({range, std::move(left)});
        };
        for (int k = 0; k < begin_with; ++k) add_slice(interval(at(k), at(k + 1)), whole.prior);
        double const narrow = options_->accuracy * width(whole.prior[j]);
        box hulls;
        for (std::size_t next = 0; next < waiting.size(); ++next) {
            auto const now = waiting[next];
            if (!limit_()) {
                add(hulls, now.left);
                continue;
            }
            auto const found = hull_of(posed(whole, memory, delay, j, now.left), of_late_slice);
            if (!found) continue;
            auto left = delay ? *found : joined(*found, j, now.range);
            if (delay) {
                auto const middle = traits::point(mid(now.range));
                left[j] = intersect(traits::add(middle, left[j]), now.range);
                if (is_empty(left[j])) continue;
                // Closer, the input has less of an error.
                if (width(left[j]) < 0.7 * width(now.range)) {
                    add_slice(left[j], left);
                    continue;
                }
            }
            double const half = mid(left[j]);
            bool const splits = left[j].lower() < half && half < left[j].upper();
            if (!(width(left[j]) > narrow) || !splits) {
                add(hulls, left);
                continue;
            }
            add_slice(traits::bounds(left[j].lower(), half), left);
            add_slice(traits::bounds(half, left[j].upper()), left);
        }
        return hulls.size() == 0 ? nothing_of(whole.prior) : hulls;
    }
    [[nodiscard]] static bool is_recorded(identification_problem const& problem,
                                          signal_memory const& memory) {
        return std::all_of(
            problem.experiments.begin(), problem.experiments.end(), [&](experiment const& e) {
                return std::holds_alternative<sampled_signal>(e.inputs[memory.index]);
            });
    }
    [[nodiscard]] static identification_problem with_prior(identification_problem problem,
                                                           box prior) {
        problem.prior = std::move(prior);
        return problem;
    }
    /// The problem over a box of all parameters, of which side j is the memory's size.
    [[nodiscard]] identification_problem posed(identification_problem const& whole,
                                               signal_memory const& memory,
                                               std::optional<std::size_t> delay, std::size_t j,
                                               box const& parameters) const {
        if (!delay) {
            return with_prior(within(whole, memory, j, parameters[j]), without(parameters, j));
        }
        auto problem = with_delays(memory, *delay, parameters[j]);
        auto sides = parameters;
        sides[j] = problem.prior[j];
        return with_prior(std::move(problem), std::move(sides));
    }
    /// A box without side `j`.
    [[nodiscard]] static box without(box const& all, std::size_t j) {
        std::vector<interval> sides(all.begin(), all.end());
        sides.erase(sides.begin() + static_cast<std::ptrdiff_t>(j));
        return box(std::move(sides));
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
        // Over a range of time constants an octave long the rest is nearly a polynomial in them.
        auto const j = first_lag(whole);
        double const end = j < whole.prior.size() ? whole.prior[j].upper() : 0;
        double from = end > 0 ? whole.prior[j].lower() : 0;
        for (; from > 0 && 2 * from < end && limit_(); from *= 2) {
            auto octave = whole;
            octave.prior[j] = interval(from, 2 * from);
            if (auto const left = hull_of(octave, of_octave, of_time)) add(hulls, *left);
            whole.prior[j] = interval(2 * from, end);
        }
        if (auto const left = hull_of(whole, 1)) add(hulls, *left);
        return hulls.size() == 0 ? nothing_of(whole.prior) : hulls;
    }
    /// The side of the first effect that is a lag.
    [[nodiscard]] std::size_t first_lag(identification_problem const& whole) const {
        for (auto const& e : *effects_)
            if (e.lags) return index_of_parameter(whole, e.name + "." + e.parameters[0].name);
        return whole.prior.size();
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

SIVID_DECL std::optional<identification_problem> without_memory(identification_problem const& base,
                                                                std::vector<effect> const& effects,
                                                                box const& parameters) {
    return diagnosis_detail::hulls_by_slices(base, effects, {}).without_memory(parameters);
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
