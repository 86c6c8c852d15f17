// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_IMPL_RANK_IPP
#define SIVID_DECISION_IMPL_RANK_IPP

#include <sivid/decision/rank.hpp>

#include <sivid/compiled.hpp>
#include <sivid/decision/ranking/detail/effect_cover.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/parameter_choice.hpp>
#include <sivid/paving/judge/box_explorer.hpp>
#include <sivid/paving/products/dependence.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

namespace decision_detail {

/// [parameter][channel]: whether the equations carry a change of the parameter
/// to the channel.
[[nodiscard]] inline std::vector<std::vector<bool>> carried(identification_problem const& problem) {
    auto const& m = problem.model;
    auto const follows = followed(m, problem.choice);
    std::vector<std::vector<bool>> result;
    for (auto const& name : problem.choice.unknown) {
        std::vector<bool> constant(m.about.constants.size(), false);
        std::vector<bool> state(m.rate.size(), false);
        constant[index_of(m.about.constants, name, "constant")] = true;
        auto const reaches = [&](node_id output) {
            auto const among = [&](operation kind, std::vector<bool> const& marked) {
                auto const leaves = leaves_of(m.g, {output}, kind);
                return std::any_of(leaves.begin(), leaves.end(),
                                   [&](std::size_t k) { return marked[k]; });
            };
            return among(operation::constant, constant) || among(operation::state, state);
        };
        for (auto const& d : follows)
            constant[d.constant] = constant[d.constant] || reaches(d.value);
        for (bool more = true; more;) {
            more = false;
            for (std::size_t i = 0; i < state.size(); ++i) {
                if (state[i] || !reaches(m.rate[i])) continue;
                state[i] = more = true;
            }
        }
        result.emplace_back();
        for (auto const y : m.observe) result.back().push_back(reaches(y));
    }
    return result;
}

/// Two values of a parameter between which a sample may move most.
struct effect_trial {
    std::size_t parameter = 0;
    std::vector<double> start, from, to;
    double moved = -1; ///< about, in error bounds
};

/// At a start and a point of the others on a line, by the polynomials along it.
inline effect_trial trial_at(effect_cover const& cover, effect_cover::line const& l, std::size_t j,
                             std::vector<double> const& start, std::vector<double> p) {
    effect_trial t{j, start, p, p};
    double low = effect_cover::infinity, high = -low;
    for (auto const k : l.parts) {
        auto const& side = cover.at(k).set[j];
        for (double const value : {side.lower(), side.upper()}) {
            p[j] = value;
            auto const y = cover.guess(k, l.sample, start, p);
            if (!y) continue;
            if (*y < low) t.from[j] = value;
            if (*y > high) t.to[j] = value;
            low = std::min(low, *y);
            high = std::max(high, *y);
        }
    }
    if (high > low) t.moved = (high - low) * cover.scale(l.sample);
    return t;
}

/// A corner of the starts and of a line's other parameters, one coordinate
/// after the other.
inline effect_trial best_trial(effect_cover const& cover, effect_cover::line const& l,
                               std::size_t j, box const& starts) {
    auto best = trial_at(cover, l, j, mid(starts), mid(l.others));
    auto const try_ends = [&](box const& sides, std::size_t i, bool of_start) {
        if (width(sides[i]) == 0) return;
        for (double const value : {sides[i].lower(), sides[i].upper()}) {
            auto start = best.start, p = best.from;
            (of_start ? start : p)[i] = value;
            auto t = trial_at(cover, l, j, start, p);
            if (t.moved > best.moved) best = std::move(t);
        }
    };
    for (std::size_t i = 0; i < starts.size(); ++i) try_ends(starts, i, true);
    for (std::size_t i = 0; i < l.others.size(); ++i) {
        if (i != j) try_ends(l.others, i, false);
    }
    if (best.moved < 0) { // nothing is known there: the ends
        auto const& side = cover.at(0).set[j];
        best.from[j] = side.lower();
        best.to[j] = side.upper();
    }
    return best;
}

/// Bounds from both sides, round by round.
class ranking_work {
public:
    ranking_work(identification_problem const& problem, rank_options const& options)
        : limit_(options.seconds, options.keep_going),
          problem_(&problem),
          options_(options),
          test_(problem, tests(options, limit_)),
          cover_(problem, test_, carried(problem)) {
        for (auto const& c : cover_.channels()) {
            channel_effects own{c.experiment, c.channel, {}};
            for (std::size_t j = 0; j < problem.prior.size(); ++j) {
                parameter_effect e;
                e.parameter = j;
                e.acts = cover_.acts(j, c.channel);
                own.effects.push_back(std::move(e));
            }
            found_.push_back(std::move(own));
        }
        constexpr std::size_t numbers = std::size_t{1} << 26; // that all parts may take
        most_parts_ = std::min(options.parts, numbers / (2 * cover_.at(0).moves.size()) + 1);
    }

    [[nodiscard]] ranking operator()() {
        bool settled = false;
        for (bool more = true; more && !settled;) {
            std::map<std::size_t, effect_cover::plan> plans;
            all_trials trials;
            settled = look(plans, trials);
            more = prove(trials);
            if (!limit_() || cover_.parts() + plans.size() > most_parts_) break;
            if (!settled && !plans.empty()) {
                cover_.split(plans);
                more = true;
            }
        }
        ranking result;
        result.complete = true;
        for (auto const& c : found_) {
            for (auto const& e : c.effects) result.complete = result.complete && is_close(e);
        }
        for (std::size_t c = 0; c < found_.size(); ++c) {
            auto const& samples = cover_.channels()[c];
            if (samples.exact > 0) {
                exact_measurements own{samples.experiment, samples.channel, samples.exact, {}};
                for (auto const& e : found_[c].effects) own.acts.push_back(e.acts);
                result.exact.push_back(std::move(own));
            }
            if (samples.all > samples.exact) result.channels.push_back(std::move(found_[c]));
        }
        result.parts = cover_.parts();
        result.integrations = test_.integrations();
        return result;
    }

private:
    using all_trials = std::map<std::size_t, std::vector<effect_trial>>; ///< by experiment

    static feasibility_test_options tests(rank_options const& options, work_limit const& limit) {
        feasibility_test_options test;
        static_cast<run_options&>(test) = options.run;
        return limited(std::move(test), limit);
    }
    [[nodiscard]] bool is_close(parameter_effect const& e) const {
        return std::isfinite(e.high) && e.high - e.low <= options_.accuracy * std::max(1.0, e.high);
    }

    /// Takes the bounds of all lines; plans splits and points where they are not
    /// close, first where they are furthest apart.
    /// @returns whether all are close
    bool look(std::map<std::size_t, effect_cover::plan>& plans, all_trials& trials) {
        struct wish {
            double apart = 1;
            std::size_t parameter = 0, experiment = 0;
            effect_cover::line where;
        };
        std::vector<wish> open;
        for (std::size_t j = 0; j < problem_->prior.size(); ++j) {
            std::vector<bool> wanted;
            for (auto const& c : found_) wanted.push_back(!is_close(c.effects[j]));
            auto lines = cover_.worst_lines(j, wanted);
            for (std::size_t c = 0; c < lines.size(); ++c) {
                auto& mine = found_[c].effects[j];
                if (!wanted[c]) continue;
                mine.high = std::min(mine.high, std::max(0.0, lines[c].bound));
                if (is_close(mine)) continue;
                open.push_back({mine.high / std::max(1.0, mine.low), j, found_[c].experiment,
                                std::move(lines[c])});
                auto const& l = open.back().where;
                auto const e = found_[c].experiment;
                auto t = best_trial(cover_, l, j, problem_->experiments[e].initial);
                if (t.moved < 0 || t.moved > 1.001 * mine.low) trials[e].push_back(std::move(t));
            }
        }
        std::stable_sort(open.begin(), open.end(),
                         [](wish const& a, wish const& b) { return a.apart > b.apart; });
        for (auto const& w : open) {
            if (!std::isfinite(w.apart) || w.apart - 1 >= 0.25 * (open[0].apart - 1))
                plan_for(w.where, w.parameter, w.experiment, plans);
        }
        return open.empty();
    }
    /// Splits the parts of a line on which most may be lost.
    void plan_for(effect_cover::line const& l, std::size_t j, std::size_t e,
                  std::map<std::size_t, effect_cover::plan>& plans) const {
        std::vector<effect_cover::advice> says;
        double most = 0;
        for (std::size_t n = 0; n < l.parts.size(); ++n) {
            says.emplace_back();
            if (n < l.first || n > l.last) continue;
            says[n] = cover_.advise(l.parts[n], j, l.sample, l.first < n && n < l.last);
            most = std::max(most, says[n].slack);
        }
        for (std::size_t n = 0; n < says.size(); ++n) {
            if (says[n].side == effect_cover::none || says[n].slack < 0.5 * most) continue;
            auto const [at, fresh] = plans.try_emplace(l.parts[n]);
            auto& plan = at->second;
            if (fresh) {
                plan.side = says[n].side;
                plan.stale.assign(problem_->experiments.size(), false);
            }
            plan.stale[e] = plan.stale[e] || says[n].stale;
        }
    }

    /// Runs points, each once, and takes what they prove. @returns whether any
    /// was new
    bool prove(all_trials const& trials) {
        bool fresh = false;
        for (auto const& [e, own] : trials) {
            std::map<std::vector<double>, std::vector<box>> wanted; // by start
            for (auto const& t : own) {
                for (auto const* p : {&t.from, &t.to}) {
                    if (seen_[e].try_emplace({t.start, *p}).second)
                        wanted[t.start].push_back(point_box(*p));
                }
            }
            for (auto const& [start, points] : wanted) {
                fresh = true;
                auto const answers = test_.run(e, point_box(start), points);
                for (std::size_t k = 0; k < points.size(); ++k)
                    seen_[e][{start, mid(points[k])}] = output_ranges(*answers[k], points[k]);
            }
            for (auto const& t : own) take(e, t);
        }
        return fresh;
    }
    void take(std::size_t e, effect_trial const& t) {
        using traits = interval_traits<interval>;
        auto const& a = seen_[e].at({t.start, t.from});
        auto const& b = seen_[e].at({t.start, t.to});
        for (std::size_t c = 0; c < found_.size(); ++c) {
            if (found_[c].experiment != e) continue;
            auto& mine = found_[c].effects[t.parameter];
            for (auto const s : cover_.channels()[c].samples) {
                auto const y = cover_.place_of(s);
                if (y >= std::min(a.size(), b.size())) break;
                double const moved = mig(traits::sub(a[y], b[y])) * cover_.scale(s) * (1 - 1e-12);
                if (!(moved > mine.low)) continue;
                mine.low = moved;
                mine.time = test_.record_of(e)[y].time;
                mine.start = t.start;
                mine.at = t.from;
                mine.from = t.from[t.parameter];
                mine.to = t.to[t.parameter];
            }
        }
    }

    work_limit limit_;
    identification_problem const* problem_;
    rank_options options_;
    std::size_t most_parts_ = 0;
    feasibility_test test_;
    effect_cover cover_;
    using point = std::pair<std::vector<double>,
                            std::vector<double>>; ///< start and parameters
    /// Outputs at points, by experiment.
    std::map<std::size_t, std::map<point, std::vector<interval>>> seen_;
    std::vector<channel_effects> found_;
};

} // namespace decision_detail

SIVID_DECL std::vector<std::size_t> channel_effects::order() const {
    std::vector<std::size_t> result(effects.size());
    std::iota(result.begin(), result.end(), std::size_t{0});
    std::stable_sort(result.begin(), result.end(), [&](std::size_t a, std::size_t b) {
        return effects[a].high != effects[b].high ? effects[a].high > effects[b].high
                                                  : effects[a].low > effects[b].low;
    });
    return result;
}

SIVID_DECL interval ranking::overall(std::size_t parameter) const {
    double low = 0, high = 0;
    for (auto const& c : channels) {
        low = std::max(low, c.effects[parameter].low);
        high = std::max(high, c.effects[parameter].high);
    }
    return {low, high};
}

SIVID_DECL bool ranking::acts(std::size_t parameter) const {
    return moves_exact(parameter) ||
           std::any_of(channels.begin(), channels.end(),
                       [parameter](channel_effects const& c) { return c.effects[parameter].acts; });
}

SIVID_DECL bool ranking::moves_exact(std::size_t parameter) const {
    return std::any_of(exact.begin(), exact.end(),
                       [parameter](exact_measurements const& m) { return m.acts[parameter]; });
}

SIVID_DECL ranking rank(identification_problem const& problem, rank_options const& options) {
    stopwatch const clock;
    problem.require_data();
    if (problem.model.has_memory())
        throw std::invalid_argument(
            "rank: the model has a delay, a play or a rate limit of unknown size, which "
            "cannot be enclosed; leave the effect out");
    for (auto const& e : problem.experiments) {
        for (auto const& a : problem.model.added_states) {
            if (width(e.initial[a.state]) > 0)
                throw std::invalid_argument(
                    "rank: experiment '" + e.name +
                    "': starts that follow the parameters cannot be ranked");
        }
    }
    auto const everything = box_explorer::without_limit(problem); // misfits end nothing
    auto result = decision_detail::ranking_work(everything, options)();
    result.combinations = dependence_of(everything);
    std::erase_if(result.combinations.entangled, [&](std::size_t j) { return !result.acts(j); });
    result.seconds = clock.spent();
    return result;
}

} // namespace sivid

#endif
