// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IMPL_LEAST_DISTURBANCE_IPP
#define SIVID_PAVING_IMPL_LEAST_DISTURBANCE_IPP

#include <sivid/paving/least_disturbance.hpp>

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/number/guard.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/paving/disturbance/detail/disturbance_program.hpp>
#include <sivid/paving/disturbance/detail/disturbance_witness.hpp>
#include <sivid/paving/disturbance/detail/disturbed_motion.hpp>
#include <sivid/paving/disturbance/detail/weighted_motion.hpp>
#include <sivid/paving/relation/relation_contraction.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace sivid {

namespace paving_detail {

/// One bounding of the least disturbance of one problem.
class least_disturbance_work {
    using traits = interval_traits<interval>;

public:
    least_disturbance_work(identification_problem const& problem, disturbance_set const& set,
                           least_disturbance_options const& options)
        : problem_(&problem),
          set_(&set),
          options_(&options),
          limit_(options.seconds, options.keep_going),
          motions_(problem, set),
          witness_(problem, set, motions_, limit_) {}

    [[nodiscard]] disturbance_bound operator()() {
        segments_ = witness_.segments(options_->segments);
        seek_witness();
        result_.hull = problem_->prior;
        // Again with more patience, where parts that say nothing ended it before its time did: a
        // servo's motor off (docs/servo.md).
        for (; upper_ > 0 && limit_() && boxes_ < options_->boxes && !(lower_ > 0.5 * upper_);
             patience_ *= 4) {
            auto const begun = boxes_;
            bound_below();
            if (boxes_ - begun < patience_) break;
        }
        double const lower = std::min(lower_, upper_);
        result_.size = traits::bounds(lower, upper_);
        if (!(lower > 0)) result_.needed.clear();
        result_.boxes = boxes_;
        result_.seconds = watch_.spent();
        say_assumptions();
        return std::move(result_);
    }

private:
    /// A part of the prior, and what is proved of it.
    struct part {
        box set;
        double lower = 0;
        std::vector<double> influence;
        std::vector<disturbed_stretch> needed;
    };

    void seek_witness() {
        work_limit const own(0.4 * options_->seconds, limit_);
        auto fit = sivid::fit(*problem_, fit_norm::largest, {}, own);
        if (fit.parameters.size() != problem_->prior.size() ||
            fit.starts.size() != problem_->experiments.size()) {
            fit.parameters = mid(problem_->prior);
            fit.starts.clear();
            for (auto const& e : problem_->experiments) fit.starts.push_back(mid(e.initial));
        }
        auto guess = witness_.improve(witness_.without(fit, segments_), segments_);
        try_witness(guess);
    }
    void try_witness(disturbance_guess const& guess) {
        double size = 0;
        auto test = limited(options_->test, limit_);
        if (!(guess.violation < 1)) return;
        auto found = witness_.verify(guess, segments_, test, size);
        if (!found || !(size < upper_)) return;
        upper_ = size;
        result_.witness = std::move(found);
        result_.pieces = pieces_of(guess);
    }
    [[nodiscard]] std::vector<disturbance_piece> pieces_of(disturbance_guess const& guess) const {
        std::vector<disturbance_piece> result;
        for (std::size_t s = 0; s < segments_.size(); ++s) {
            auto const& times = motions_.times(s);
            for (std::size_t q = 0; q < set_->equations.size(); ++q) {
                auto const& d = guess.values[s][q];
                for (std::size_t k = 0; k < d.size(); ++k) {
                    double const to = k + 1 < d.size() ? times[segments_[s][k + 1]] : times.back();
                    result.push_back(
                        {{s, times[segments_[s][k]], to}, set_->equations[q].index, d[k]});
                }
            }
        }
        return result;
    }

    /// Searches up to the witness's size; where its motions are too wide to say much, up to less.
    void bound_below() {
        level_ = std::isfinite(upper_) ? upper_ : usual_size();
        for (int round = 0; round < 8 && limit_(); ++round) {
            auto const prior = left_at_level();
            if (round == 0 && prior && level_ >= upper_) result_.hull = *prior;
            if (prior) {
                seek_lower(*prior);
            } else if (level_ > lower_) { // only where there is no witness
                lower_ = level_;
                result_.needed = whole_records();
            }
            bool const all = lower_ >= (1 - 1e-9) * level_;
            if (all && level_ < upper_ && !(lower_ > 0.4 * upper_)) {
                level_ *= std::isfinite(upper_) ? 1.6 : 4;
            } else if (lower_ > 0.4 * level_ || boxes_ >= options_->boxes) {
                break;
            } else {
                level_ /= 2.5;
                if (level_ <= lower_) break;
            }
        }
    }
    /// What a program says of the motions without disturbances, where there is no witness.
    [[nodiscard]] double usual_size() {
        part all{problem_->prior, 0, {}, {}};
        std::vector<motion_tube> tubes;
        for (std::size_t s = 0; s < motions_.experiments(); ++s)
            tubes.push_back(motions_.tube(s, all.set, 0));
        double const size = weigh(all, tubes);
        return std::isfinite(size) && size > 0 ? size : 1;
    }
    /// What equations leave of the prior where disturbances are no larger than the level; nothing
    /// where that is no bound.
    [[nodiscard]] std::optional<box> left_at_level() const {
        relation_contraction_options how;
        work_limit const own(0.1 * options_->seconds, limit_);
        how.keep_going = own;
        how.rounds = 4;
        auto left = contract_by_relations(with_disturbance(*problem_, *set_, level_), how);
        return is_empty(left) ? std::nullopt : std::optional(std::move(left));
    }
    [[nodiscard]] std::vector<disturbed_stretch> whole_records() const {
        std::vector<disturbed_stretch> all;
        for (std::size_t s = 0; s < problem_->experiments.size(); ++s)
            all.push_back({s, motions_.times(s).front(), motions_.times(s).back()});
        return all;
    }

    /// Halves the part of the least bound, until that is near the level. Where half of some
    /// parts say nothing, smaller ones will not soon.
    void seek_lower(box const& prior) {
        std::vector<part> open{bounded({prior, 0, {}, {}})};
        auto const less = [](part const& a, part const& b) { return a.lower > b.lower; };
        auto const begun = boxes_;
        while (boxes_ < options_->boxes && limit_() && open.front().lower < enough()) {
            auto const side = side_to_halve(open.front());
            if (side == prior.size()) break;
            auto const silent = static_cast<std::size_t>(std::count_if(
                open.begin(), open.end(), [](part const& p) { return !(p.lower > 0); }));
            if (boxes_ - begun > patience_ && 2 * silent > open.size()) break;
            std::pop_heap(open.begin(), open.end(), less);
            auto const whole = std::move(open.back());
            open.pop_back();
            auto halves = bisect(whole.set, side, mid(whole.set[side]));
            for (auto* half : {&halves.first, &halves.second}) {
                open.push_back(bounded({*half, whole.lower, {}, whole.needed}));
                std::push_heap(open.begin(), open.end(), less);
            }
        }
        // What holds for no part below its bound holds for disturbances up to `level_`.
        double const proved = std::min(open.front().lower, level_);
        if (!(proved > lower_)) return;
        lower_ = proved;
        result_.needed.clear();
        // Larger ones than the level might act elsewhere.
        if (level_ < upper_) result_.needed = whole_records();
        for (auto const& p : open) join(p.needed);
    }
    void join(std::vector<disturbed_stretch> const& more) {
        for (auto const& m : more) {
            auto const known =
                std::find_if(result_.needed.begin(), result_.needed.end(),
                             [&](auto const& k) { return k.experiment == m.experiment; });
            if (known == result_.needed.end()) {
                result_.needed.push_back(m);
                continue;
            }
            known->from = std::min(known->from, m.from);
            known->to = std::max(known->to, m.to);
        }
    }
    [[nodiscard]] std::size_t side_to_halve(part const& p) const {
        std::size_t side = p.set.size();
        double most = 0;
        for (std::size_t j = 0; j < p.set.size(); ++j) {
            double const share = width(p.set[j]) / std::max(width(problem_->prior[j]), 1e-300);
            if (!(share > 1e-6)) continue;
            // Where motions are without bounds no influence is known: the widest side is halved.
            double const told = j < p.influence.size() ? p.influence[j] : 0;
            double const worth = (std::isfinite(told) ? told : 0) + 1e-12 * share;
            if (worth > most) {
                most = worth;
                side = j;
            }
        }
        return side;
    }
    /// Bounds a part from below.
    [[nodiscard]] part bounded(part p) {
        ++boxes_;
        std::vector<motion_tube> tubes;
        for (std::size_t s = 0; s < motions_.experiments(); ++s)
            tubes.push_back(motions_.tube(s, p.set, level_));
        weigh(p, tubes);
        return p;
    }
    [[nodiscard]] double enough() const { return (1 - options_->relative_width) * level_; }
    /// By the weights that a program finds. @returns  the size that it finds, an estimate
    double weigh(part& p, std::vector<motion_tube> const& tubes) {
        std::vector<disturbed_motion> motions;
        std::vector<plain_motion> plain;
        program_room room;
        for (auto const& side : p.set)
            room.parameters.push_back(traits::sub(side, traits::point(mid(side))));
        for (std::size_t s = 0; s < tubes.size(); ++s) {
            motions.push_back(motions_.within(s, tubes[s], p.set, level_));
            plain.emplace_back(motions.back(), room.parameters);
            room.starts.push_back(motions.back().beside.front());
        }
        auto const found = disturbance_program(motions, plain, *set_, segments_, room)(limit_);
        // All weights, and those alone that count, which act in a shorter stretch.
        for (bool const few : {false, true}) {
            weighted_motion sum(*set_, p.set);
            std::vector<disturbed_stretch> needed;
            for (std::size_t s = 0; s < found.weights.size(); ++s) {
                auto const weights =
                    few ? without_small(found.weights, motions, s) : found.weights[s];
                auto const first = sum.add(motions[s], plain[s], weights);
                add_stretch(s, motions[s], first, weights, needed);
            }
            auto const proved = sum.proved();
            if (!few) p.influence = proved.influence;
            bool const enough = proved.lower > (few ? 0.98 : 1) * p.lower;
            if (!enough || !(proved.lower > 0)) break;
            p.lower = proved.lower;
            p.needed = std::move(needed);
        }
        return found.size;
    }
    /// The weights of one experiment that count beside the largest, in bounds of measurements.
    [[nodiscard]] static std::vector<double> without_small(sample_weights const& all,
                                                           std::vector<disturbed_motion> const& of,
                                                           std::size_t s) {
        auto const worth = [&](std::size_t e, std::size_t i) {
            return std::abs(all[e][i]) * rad(of[e].samples[i].rest);
        };
        double most = 0;
        for (std::size_t e = 0; e < all.size(); ++e)
            for (std::size_t i = 0; i < all[e].size(); ++i)
                if (all[e][i] != 0) most = std::max(most, worth(e, i));
        auto result = all[s];
        for (std::size_t i = 0; i < result.size(); ++i)
            if (result[i] != 0 && worth(s, i) < 1e-4 * most) result[i] = 0;
        return result;
    }
    /// From where weights act to the last sample that has one.
    void add_stretch(std::size_t s, disturbed_motion const& motion, std::size_t first,
                     std::vector<double> const& weights, std::vector<disturbed_stretch>& to) const {
        std::size_t last = 0;
        for (std::size_t i = 0; i < weights.size(); ++i)
            if (weights[i] != 0) last = std::max(last, motion.samples[i].node);
        if (last > first) to.push_back({s, motions_.times(s)[first], motions_.times(s)[last]});
    }
    void say_assumptions() {
        result_.assumptions = {"measurements within their stated bounds",
                               input_assumption(problem_->experiments)};
    }

    stopwatch watch_;
    identification_problem const* problem_;
    disturbance_set const* set_;
    least_disturbance_options const* options_;
    work_limit limit_;
    disturbed_motions motions_;
    disturbance_witness witness_;
    segment_begins segments_;
    double lower_ = 0, upper_ = detail::infinity;
    double level_ = 0;          ///< up to which lower bounds are proved
    std::size_t patience_ = 12; ///< so many parts are bounded, even where half of them say nothing
    std::size_t boxes_ = 0;
    disturbance_bound result_;
};

} // namespace paving_detail

SIVID_DECL disturbance_bound least_disturbance(identification_problem const& problem,
                                               disturbance_set const& set,
                                               least_disturbance_options const& options) {
    require_sound_environment();
    problem.require_data();
    require_valid(set, problem.model);
    for (auto const& e : problem.experiments)
        if (e.outliers > 0)
            throw std::invalid_argument("least disturbance: experiment '" + e.name +
                                        "' allows outliers, which are not covered; allow none, or "
                                        "disturb the channel instead");
    return paving_detail::least_disturbance_work(problem, set, options)();
}

SIVID_DECL std::vector<disturbance_share>
least_disturbance_curve(identification_problem const& problem, disturbance_set const& set,
                        std::size_t points, least_disturbance_options options) {
    if (set.equations.empty() || set.channels.empty() || points < 2)
        throw std::invalid_argument("a curve needs equations and channels that are disturbed, and "
                                    "at least 2 points");
    options.seconds /= static_cast<double>(points);
    auto const bounded = [&](double equations, double channels) {
        auto own = set;
        for (auto& q : own.equations) q.scale *= equations;
        for (auto& q : own.channels) q.scale *= channels;
        if (equations == 0) own.equations.clear();
        if (channels == 0) own.channels.clear();
        return disturbance_share{equations, channels, least_disturbance(problem, own, options)};
    };
    auto const needed = [](disturbance_bound const& found) {
        double const most = found.size.upper(), least = found.size.lower();
        return most > 0 && std::isfinite(most) ? most : least > 0 ? least : 1;
    };
    std::vector<disturbance_share> curve{bounded(1, 0)};
    auto last = bounded(0, 1);
    double const w = needed(curve.front().found), e = needed(last.found);
    for (std::size_t k = 1; k + 1 < points; ++k) {
        double const share = static_cast<double>(k) / static_cast<double>(points - 1);
        curve.push_back(bounded((1 - share) * w, share * e));
    }
    curve.push_back(std::move(last));
    return curve;
}

SIVID_DECL std::vector<disturbance_piece> strong_stretches(disturbance_set const& set,
                                                           disturbance_bound const& found) {
    std::vector<disturbance_piece> result;
    for (auto const& p : found.pieces) {
        auto const q = std::find_if(set.equations.begin(), set.equations.end(),
                                    [&](auto const& e) { return e.index == p.equation; });
        if (!(std::abs(p.value) >= 0.9 * found.size.upper() * q->scale) || p.value == 0) continue;
        bool const goes_on = !result.empty() && result.back().to == p.from &&
                             result.back().experiment == p.experiment &&
                             result.back().equation == p.equation &&
                             (result.back().value > 0) == (p.value > 0);
        if (goes_on)
            result.back().to = p.to;
        else
            result.push_back(p);
    }
    std::stable_sort(result.begin(), result.end(),
                     [](auto const& a, auto const& b) { return a.to - a.from > b.to - b.from; });
    return result;
}

} // namespace sivid

#endif
