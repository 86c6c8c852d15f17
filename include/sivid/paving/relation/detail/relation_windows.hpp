// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_RELATION_WINDOWS_HPP
#define SIVID_PAVING_RELATION_DETAIL_RELATION_WINDOWS_HPP

#include <sivid/model/problem.hpp>
#include <sivid/model/unit.hpp>
#include <sivid/number/decimal_output.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/paving/relation/detail/declared_variation.hpp>
#include <sivid/paving/relation/detail/observed_motion.hpp>
#include <sivid/paving/relation/detail/relation_row.hpp>
#include <sivid/paving/relation/detail/relation_terms.hpp>
#include <sivid/paving/relation/detail/stated_equation.hpp>
#include <sivid/paving/relation/detail/weak_windows.hpp>
#include <sivid/paving/relation/detail/window_integrals.hpp>
#include <sivid/paving/relation/relation_finding.hpp>
#include <sivid/paving/relation/state_samples.hpp>
#include <sivid/paving/relation/time_cell.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// The equations of a problem over windows of its experiments without an outlier budget and, where
/// variations are declared, with exact inputs. (What inputs within error bounds may do from one
/// moment to the next contradicts them.)
class relation_windows {
    using traits = interval_traits<interval>;

public:
    /// @param problem  outlives this object
    /// @param suspect  outlives this object; none: all sensors are right
    /// @param source   of what is known between samples
    /// @throws std::invalid_argument if the problem is not valid
    relation_windows(identification_problem const& problem, relation_options const& options,
                     suspected_sensor const* suspect = nullptr,
                     tube_source source = tube_source::declared)
        : problem_(&problem), options_(options), suspect_(suspect), source_(source) {
        problem.require_valid();
        bool const proved = source == tube_source::proved;
        std::vector<experiment const*> trusted;
        for (auto const& e : problem.experiments) {
            if (e.outliers == 0 && (proved || !any_uncertain(e.inputs))) trusted.push_back(&e);
        }
        if (problem.model.has_memory()) {
            obstacle_ = "the model has delays, plays or rate limits";
        } else if (trusted.empty()) {
            obstacle_ = "every experiment has an outlier budget or inputs with error bounds: no "
                        "window can be trusted";
        }
        if (!obstacle_.empty()) return;
        // The inputs stay leaves, so that all experiments share one graph.
        std::vector<signal> const open(about().inputs.size(),
                                       sampled_signal({0.0}, {0.0}, interpolation::linear));
        model_ = bind(problem.model, problem.choice, open);
        channels_ = measured_states(model_, trusted);
        if (proved) sums_ = find_state_sums(model_.g, model_.rate);
        auto const laws = proved ? std::vector<std::vector<rate_variation>>{} : laws_of(trusted);
        for (std::size_t e = 0; e < trusted.size() && !stopped(); ++e) {
            auto const& known = *trusted[e];
            motions_.push_back(proved ? proved_motion(model_, problem.prior, known, channels_,
                                                      options.cells_per_gap, sums_)
                                      : observe_motion(model_, problem.prior, known, channels_,
                                                       {laws[e], {}, {}}, options.cells_per_gap));
        }
        for (auto const& p : pairs_in(model_.g, model_.rate)) {
            bool const right =
                suspect == nullptr || (suspect->state != p.q && suspect->state != p.r);
            if (channels_[p.q] && right) pairs_.push_back(p);
        }
        put_sensed_first(pairs_, motions_);
        auto const seen = [this](std::size_t i) { return channels_[i].has_value(); };
        if (proved) stated_ = stated_relations(model_, problem.prior, pairs_, seen);
    }

    relation_windows(relation_windows const&) = delete; // what is prepared points into the graph
    relation_windows& operator=(relation_windows const&) = delete;

    /// Those of the states, then those of sums of states: where all is proved.
    [[nodiscard]] std::size_t equations_and_sums() const {
        return about().states.size() + sums_.size();
    }
    [[nodiscard]] model_description const& about() const { return problem_->model.about; }
    [[nodiscard]] observed_motion const& motion(std::size_t m) const { return motions_[m]; }
    [[nodiscard]] std::vector<observed_motion> const& motions() const { return motions_; }
    /// The channel that shows each state.
    [[nodiscard]] std::vector<std::optional<std::size_t>> const& channels() const {
        return channels_;
    }
    /// To which the rows refer.
    [[nodiscard]] graph const& equations() const { return model_.g; }
    /// @given  `obstacle(i)` was asked
    [[nodiscard]] relation_row const& row(std::size_t i,
                                          window_way way = window_way::direct) const {
        if (is_stated(way)) return stated_.row(i, way == window_way::stated_middle);
        return rows_.at({i, way == window_way::damped}).row;
    }
    [[nodiscard]] std::string rate_unit(std::size_t i) const {
        return sivid::rate_unit(about().states[i].unit, about().time_unit);
    }

    /// Why equation i cannot be examined; empty if it can.
    [[nodiscard]] std::string obstacle(std::size_t i) {
        if (stopped()) return "there was no time";
        if (!obstacle_.empty()) return obstacle_;
        if (is_sum(i))
            return prepared(i).row.bounded ? "" : "a coefficient is unbounded over the prior";
        if (!channels_[i] && stated_.pair_of(i))
            return stated_.bounded(i) ? "" : "a coefficient is unbounded over the prior";
        auto const& e = prepared(i);
        if (!e.row.bounded) return "a coefficient is unbounded over the prior";
        if (!shown(i) && !weak_form(i)) return "no measurement shows " + about().states[i].name;
        for (auto const s : e.row.states) {
            bool const seen = channels_[s] || s == i || source_ == tube_source::proved;
            if (!seen) return "no measurement shows " + about().states[s].name;
        }
        return {};
    }

    /// The ways in which equation i can be enclosed, the one with the fewest sensors first; of a
    /// state that is known by its integral alone the weak form, beside which others tell nothing.
    [[nodiscard]] std::vector<window_way> ways(std::size_t i) {
        if (is_sum(i)) return {window_way::direct};
        std::vector<window_way> const stated{window_way::stated, window_way::stated_middle};
        if (!channels_[i] && stated_.pair_of(i)) return stated;
        if (!shown(i)) return {window_way::weak};
        std::vector<window_way> result{window_way::direct};
        if (!pairs_of(i).empty()) result.push_back(window_way::by_parts);
        if (source_ == tube_source::proved) result.push_back(window_way::damped);
        if (stated_.pair_of(i)) result.insert(result.end(), stated.begin(), stated.end());
        return result;
    }

    /// All windows that are not shorter than the shortest; of too many every so many.
    [[nodiscard]] std::vector<window_row> all(std::size_t i, window_way way) {
        std::vector<window_row> result;
        if (is_stated(way))
            return stated_.windows(i, way == window_way::stated_middle, motions_, options_);
        if (way == window_way::weak) {
            auto const weak = weak_form(i);
            for (std::size_t m = 0; weak && m < motions_.size(); ++m) {
                auto more = weak->over(motions_[m], m, options_);
                std::move(more.begin(), more.end(), std::back_inserter(result));
            }
            return result;
        }
        auto& e = integrated(i, way);
        for (std::size_t pass = 0, total = 0; pass < 2; ++pass) {
            std::size_t count = 0;
            auto const stride = total / options_.most_windows + 1;
            for (std::size_t m = 0; m < motions_.size(); ++m) {
                if (!own_tube(e.row, motions_[m])) continue;
                auto const& times = own_tube(e.row, motions_[m])->times();
                auto const seen = state_samples{times, {}}.seen();
                double const shortest =
                    seen.span(options_.shortest_gaps, options_.shortest_share) * (1 - 1e-9);
                std::size_t ends = 0; // of so many samples windows that end at b may begin
                for (std::size_t b = 1; b < times.size() && !stopped(); ++b) {
                    while (ends < b && times[b] - times[ends] >= shortest) ++ends;
                    auto const before = count;
                    count += ends;
                    if (pass == 0) continue;
                    for (auto n = (before / stride + 1) * stride; n <= count; n += stride) {
                        auto found = row_over(e, way, m, times[ends - (n - before)], times[b]);
                        if (found) result.push_back(*std::move(found));
                    }
                }
            }
            total = count;
        }
        return result;
    }
    /// Windows of many lengths, from a gap to the whole record (`spread_windows`).
    [[nodiscard]] std::vector<window_row> spread(std::size_t i, window_way way) {
        if (way == window_way::weak || is_stated(way)) return all(i, way);
        std::vector<window_row> result;
        auto const& e = integrated(i, way);
        for (std::size_t m = 0; m < motions_.size() && !stopped(); ++m) {
            auto const& tube = own_tube(e.row, motions_[m]);
            if (!tube) continue;
            for (auto const& [a, b] : spread_windows(tube->times().size())) {
                auto found = row_over(e, way, m, tube->times()[a], tube->times()[b]);
                if (found) result.push_back(*std::move(found));
            }
        }
        return result;
    }

    /// Equation i over one window; nothing where its ends are no boundaries of the cells, or it is
    /// not covered.
    /// @given  `obstacle(i)` was asked
    [[nodiscard]] std::optional<window_row> over(std::size_t i, window_way way,
                                                 relation_window const& at) {
        if (way == window_way::weak || is_stated(way)) return std::nullopt;
        auto const& e = integrated(i, way);
        for (std::size_t m = 0; m < motions_.size(); ++m) {
            if (motions_[m].name != at.scenario || !own_tube(e.row, motions_[m])) continue;
            if (auto found = row_over(e, way, m, at.from, at.to)) return found;
        }
        return std::nullopt;
    }

    /// Sensors and assumptions of a proof that uses each motion since some time.
    void describe(std::size_t i, window_way way, std::map<std::size_t, double> const& since,
                  relation_finding& result) const {
        auto tubes = row(i).states;
        if (way == window_way::by_parts) {
            for (auto const& p : pairs_of(i)) add_pair(p, tubes, result);
        } else if (way == window_way::weak) {
            add_pair(*pair_of_rate(pairs_, i), tubes, result);
            tubes.erase(i);
        }
        for (auto const s : tubes) {
            // The variation is rounded so that the text assumes rather more than the proof does.
            std::string text;
            for (auto const& [m, from] : since) {
                auto const& law = motions_[m].variation[s];
                text += (text.empty() ? "" : ", ") + to_decimal_lower(law.variation, 6) + " " +
                        rate_unit(s) + " in " + motions_[m].name;
                result.variations.push_back({motions_[m].name, s, law.period, law.variation});
            }
            result.assumptions.push_back(
                about().states[s].name + "' varies within " +
                nearest_text(motions_[since.begin()->first].variation[s].period, 6) + " " +
                about().time_unit + " by at most " + text);
        }
        if (row(i).uses_inputs)
            result.assumptions.push_back("inputs exact" + bridging_words(problem_->experiments));
        auto used = tubes;
        if (!by_sensor_alone(row(i))) used.insert(i);
        bool starts = false;
        for (auto const& [m, from] : since)
            for (auto const s : used) starts = starts || motions_[m].rests_on_start(s, from);
        if (starts) result.assumptions.emplace_back("initial states in their boxes");
        if (way != window_way::weak) tubes.insert(i);
        for (auto const s : tubes) result.channels.push_back(about().channels[*channels_[s]].name);
    }

    [[nodiscard]] bool stopped() {
        stopped_ = stopped_ || (options_.go_on && !options_.go_on());
        return stopped_;
    }

private:
    /// Declared variations per experiment and state.
    [[nodiscard]] std::vector<std::vector<rate_variation>>
    laws_of(std::vector<experiment const*> const& trusted) const {
        if (suspect_ == nullptr) {
            return laws_above_model(model_, problem_->prior, trusted, channels_, options_.go_on);
        }
        std::vector<std::vector<rate_variation>> result;
        for (auto const* e : trusted) result.push_back(suspect_->laws.at(e->name));
        return result;
    }

    struct prepared_equation {
        relation_row row;
        integrand_set set;
        std::vector<window_integrals> integrals; ///< one per experiment with cells
    };

    [[nodiscard]] prepared_equation& prepared(std::size_t i, window_way way = window_way::direct) {
        std::pair const key{i, way == window_way::damped};
        if (auto const found = rows_.find(key); found != rows_.end()) return found->second;
        auto& e = rows_[key];
        e.row = is_sum(i) ? make_sum_row(model_.g, sums_[i - model_.state_count()], problem_->prior)
                          : make_relation_row(model_.g, model_.rate[i], i, problem_->prior);
        if (suspect_ != nullptr && suspect_->state == i) {
            add_difference(e.row, {i}, traits::neg(suspect_->scale));
            add_difference(e.row, {}, traits::neg(suspect_->drift));
            for (auto const& [m, share] : suspect_->mixing) {
                add_difference(e.row, {m}, traits::neg(share));
            }
        }
        if (key.second) combine(model_.g, e.row, damping_of(model_, i, motions_));
        e.set = integrand_set::of(model_.g, e.row.functions, model_.state_count(),
                                  about().inputs.size());
        return e;
    }
    [[nodiscard]] bool is_sum(std::size_t i) const { return i >= model_.state_count(); }
    /// Whether a state is known at samples: measured ones, or derived ones.
    [[nodiscard]] bool shown(std::size_t i) const {
        auto const known = [i](observed_motion const& m) { return m.tubes[i].has_value(); };
        return channels_[i] || std::any_of(motions_.begin(), motions_.end(), known);
    }
    /// Pairs that help with equation i, one for each r in its row; q is not its own state.
    [[nodiscard]] std::vector<derivative_pair> pairs_of(std::size_t i) const {
        std::vector<derivative_pair> result;
        for (auto const& p : pairs_) {
            bool const helps = p.q != i && shown(p.r) && row(i).states.count(p.r) > 0;
            if (helps && !pair_of_rate(result, p.r)) result.push_back(p);
        }
        return result;
    }
    [[nodiscard]] std::optional<weak_windows> weak_form(std::size_t i) {
        auto const own = pair_of_rate(pairs_, i);
        return own ? weak_windows::of(model_.g, prepared(i).set, *own) : std::nullopt;
    }
    void add_pair(derivative_pair const& p, std::set<std::size_t>& states,
                  relation_finding& result) const {
        states.insert(p.q);
        result.further.push_back(p.q);
        result.assumptions.push_back(about().states[p.q].name + "' = " + about().states[p.r].name);
    }
    /// Whether the differences of the equation's own state leave out the initial state: a kinematic
    /// equation is one between sensors. A constant error of the state's sensor, which it cannot
    /// see, would be taken for one of the equation.
    [[nodiscard]] bool by_sensor_alone(relation_row const& row) const {
        return row.kinematic && source_ == tube_source::declared;
    }
    [[nodiscard]] std::optional<channel_tube> const& own_tube(relation_row const& row,
                                                              observed_motion const& m) const {
        return by_sensor_alone(row) ? m.sensed[row.equation] : m.tubes[row.equation];
    }
    [[nodiscard]] prepared_equation& integrated(std::size_t i, window_way way) {
        auto& e = prepared(i, way);
        if (!e.integrals.empty()) return e;
        std::vector<derivative_pair> pairs;
        if (e.row.centre.empty() && !is_sum(i)) pairs = pairs_of(i);
        for (auto const& m : motions_) {
            // Slow beside the gaps, over which nothing is known, and quick beside the record.
            auto const& own = m.tubes[e.row.equation];
            double const slow = own ? state_samples{own->times(), {}}.seen().span(5, 0.025) : 0;
            e.integrals.emplace_back(e.set, m.cells, pairs, e.row.growth, slow);
        }
        return e;
    }
    [[nodiscard]] std::optional<window_row> row_over(prepared_equation const& e, window_way way,
                                                     std::size_t m, double from, double to) const {
        window_row w{m, from, to, {}, {}, traits::sub(traits::point(to), traits::point(from))};
        auto const& motion = motions_[w.motion];
        auto const& tube = *own_tube(e.row, motion);
        auto const& integral = e.integrals[w.motion];
        if (!tube.covers(w.from, w.to)) return std::nullopt;
        auto const first = motion.boundary_at(w.from);
        auto const last = motion.boundary_at(w.to);
        auto const& ends = motion.boundaries;
        if (last >= ends.size() || ends[first] != w.from || ends[last] != w.to) return std::nullopt;
        // Rows of earlier windows have smaller weights: all are scaled to about 1 at their ends.
        double const scale = 1 / mid(integral.weight_at(last));
        auto const scaled = [&](interval const& x) {
            return scale == 1 ? x : traits::mul(traits::point(scale), x);
        };
        w.difference =
            scaled(traits::sub(traits::mul(integral.weight_at(last), tube.over(w.to, w.to)),
                               traits::mul(integral.weight_at(first), tube.over(w.from, w.from))));
        auto const q_at = [&](auto q, auto k) { return motion.state_over(q, ends[k], ends[k]); };
        bool parts = way == window_way::by_parts;
        for (auto const& p : parts ? pairs_of(e.row.equation) : std::vector<derivative_pair>{}) {
            parts = parts && motion.sensed[p.q] && motion.sensed[p.q]->covers(w.from, w.to);
        }
        for (std::size_t j = 0; j < e.row.functions.size(); ++j) {
            auto value = integral.direct(j, first, last);
            if (parts && integral.has_parts(j))
                value = agreed(value, integral.by_parts(j, first, last, q_at));
            if (!is_bounded(value)) return std::nullopt;
            w.a.push_back(scaled(value));
        }
        auto const rest = w.a.back();
        w.a.pop_back();
        for (auto const& [state, factor] : e.row.differences) {
            if (!state) {
                w.a.push_back(w.length);
                continue;
            }
            auto const& shown =
                *state == e.row.equation ? own_tube(e.row, motion) : motion.tubes[*state];
            if (!shown || !shown->covers(w.from, w.to)) return std::nullopt;
            auto const change = traits::sub(shown->over(w.to, w.to), shown->over(w.from, w.from));
            w.a.push_back(traits::mul(factor, change));
            if (!is_bounded(w.a.back())) return std::nullopt;
        }
        w.a.push_back(rest);
        return is_bounded(w.difference) ? std::optional(std::move(w)) : std::nullopt;
    }

    identification_problem const* problem_;
    relation_options options_;
    suspected_sensor const* suspect_;
    tube_source source_;
    std::string obstacle_;
    bool stopped_ = false;
    bound_model model_;
    std::vector<std::optional<std::size_t>> channels_;
    std::vector<state_sum> sums_;
    std::vector<observed_motion> motions_;
    std::vector<derivative_pair> pairs_;
    std::map<std::pair<std::size_t, bool>, prepared_equation> rows_; ///< (equation, damped)
    stated_relations stated_;                                        ///< where all is proved
};

} // namespace sivid

#endif
