// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_ADVICE_DETAIL_FAILURE_TRIALS_HPP
#define SIVID_ENCLOSURE_ADVICE_DETAIL_FAILURE_TRIALS_HPP

#include <sivid/enclosure/runge_kutta/implicit_tableau.hpp>
#include <sivid/enclosure/set/parametric_set.hpp>
#include <sivid/enclosure/suggested_degree.hpp>
#include <sivid/enclosure/trajectory.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace sivid::enclosure_detail {

[[nodiscard]] inline box hull_of(doubleton<interval> const& set) { return set.hull; }
template <class Model>
[[nodiscard]] box hull_of(parametric_set<Model> const& set) {
    return set.hull();
}

/// Slopes of state i over initial states and parameters, in any scale of its own for each.
[[nodiscard]] inline std::vector<double> slopes(trajectory<interval> const& run, std::size_t i) {
    std::vector<double> result;
    auto const& c = run.set().shape;
    for (Eigen::Index k = 0; k < c.cols(); ++k) {
        result.push_back(c(static_cast<Eigen::Index>(i), k));
    }
    return result;
}
[[nodiscard]] inline std::vector<double> slopes(taylor_model<double> const& p,
                                                normalised_unknowns const& unknowns) {
    std::vector<double> result;
    for (auto const* sides : {&unknowns.initial, &unknowns.parameters}) {
        for (auto const& s : *sides) {
            double slope = 0;
            if (s.radius != 0 && !p.is_number()) slope = p.c(p.space().variable(s.variable));
            result.push_back(slope);
        }
    }
    return result;
}
template <class Run>
[[nodiscard]] std::vector<double> slopes(Run const& run, std::size_t i) {
    return slopes(run.set().centre[i], run.unknowns());
}

/// A method of higher order and the same kind.
[[nodiscard]] inline tableau higher(tableau const& m) {
    if (m.is_explicit()) return butcher6();
    return m.order < 5 ? radau_iia5() : lobatto_iiic6();
}

/// A run for a box, of the degree that suits its unknowns where a run has one.
template <class Run>
[[nodiscard]] Run run_for(flow const& f, enclosure_options const& options, box const& initial,
                          box const& parameters) {
    if constexpr (std::is_constructible_v<Run, flow const&, enclosure_options const&>) {
        return Run(f, options);
    } else {
        auto const unknowns = normalised_unknowns(initial, parameters).variables;
        return Run(f, options, unknowns, suggested_degree(unknowns));
    }
}

/// Runs a failed enclosure again, and what could help it.
template <class Run, class Other>
class failure_trials {
public:
    failure_trials(flow const& f, enclosure_options const& options, box const& initial,
                   box const& parameters, double begin, double end)
        : flow_(f),
          options_(options),
          initial_(initial),
          parameters_(parameters),
          begin_(begin),
          end_(end) {}

    [[nodiscard]] std::optional<advised_failure> explain() {
        auto const failed = run_whole();
        if (!failed) return std::nullopt;
        result_.failure = *failed;
        result_.end = end_;
        if (failed->reason == failure_reason::cancelled || follow_members()) return result_;
        try_remedies();
        choose();
        return result_;
    }

private:
    struct outcome {
        double reached = 0;
        std::optional<enclosure_failure> failure;
        std::size_t steps = 0;
        std::vector<double> times;
        std::vector<std::vector<double>> middles; ///< of the states, at the times
    };
    using part = std::pair<box, box>;

    template <class Engine>
    [[nodiscard]] outcome follow(part const& p, enclosure_options const& options,
                                 bool record = false) const {
        auto run = run_for<Engine>(flow_, options, p.first, p.second);
        run.begin(begin_, p.first, p.second);
        outcome result;
        auto const note = [&] {
            if (!record) return;
            result.times.push_back(run.time());
            result.middles.push_back(mid(hull_of(run.set())));
        };
        note();
        while (run.time() < end_ && run.step(end_)) note();
        result.reached = run.time();
        if (run.time() < end_) result.failure = run.failure();
        result.steps = run.steps();
        return result;
    }

    /// The failure of the whole box; learns its directions.
    [[nodiscard]] std::optional<enclosure_failure> run_whole() {
        auto run = run_for<Run>(flow_, options_, initial_, parameters_);
        run.begin(begin_, initial_, parameters_);
        std::vector<double> times;
        while (run.time() < end_ && run.step(end_)) times.push_back(run.time());
        if (!(run.time() < end_)) return std::nullopt;
        reached_ = run.time();
        slopes_ = slopes(run, run.failure()->component);
        // Ever shorter steps at the end are not what a remedy should need.
        auto const late = std::find_if(times.begin(), times.end(), [this](double t) {
            return t - begin_ >= 0.9 * (reached_ - begin_);
        });
        auto const before = static_cast<std::size_t>(late - times.begin());
        cap_ = std::min(options_.maximum_steps, std::min(times.size(), 2 * before) + 200);
        return run.failure();
    }
    [[nodiscard]] bool further(double t) const {
        return t >= end_ || t - begin_ > 1.05 * (reached_ - begin_);
    }

    /// A point of the box: its middle, or the corner where the failed state is least (-1) or most
    /// (+1).
    [[nodiscard]] part member(int where) const {
        part p{initial_, parameters_};
        std::size_t k = 0;
        for (auto* sides : {&p.first, &p.second}) {
            for (std::size_t j = 0; j < sides->size(); ++j) {
                auto& x = (*sides)[j];
                double const slope = slopes_[k++] * where;
                if (!is_wide(x)) continue;
                x = interval(slope > 0 ? x.upper() : slope < 0 ? x.lower() : mid(x));
            }
        }
        return p;
    }
    [[nodiscard]] static bool is_wide(interval const& x) {
        return rad(x) > normalised_unknowns::negligible * mag(x);
    }
    [[nodiscard]] bool is_point() const {
        return std::none_of(initial_.begin(), initial_.end(), is_wide) &&
               std::none_of(parameters_.begin(), parameters_.end(), is_wide);
    }
    [[nodiscard]] std::vector<part> members() const {
        if (is_point()) return {member(0)};
        return {member(0), member(1), member(-1)};
    }

    [[nodiscard]] enclosure_options capped() const {
        auto o = options_;
        o.maximum_steps = cap_;
        return o;
    }
    [[nodiscard]] enclosure_options higher_order() const {
        auto o = capped();
        auto const grow = [](std::size_t k) { return k + std::max<std::size_t>(4, k / 2); };
        o.order = grow(o.order);
        if (o.variational_order > 0) o.variational_order = grow(o.variational_order);
        if (o.method) o.method = higher(*o.method);
        return o;
    }
    [[nodiscard]] enclosure_options sharper() const {
        auto o = higher_order();
        o.tolerance *= 1e-3;
        o.relative_tolerance *= 0.1;
        return o;
    }
    [[nodiscard]] enclosure_options strongest() const {
        auto o = sharper();
        o.minimum_step *= 1e-3;
        if constexpr (std::is_same_v<Run, trajectory<interval>>) o.method.reset();
        return o;
    }

    /// Follows single trajectories.
    /// @returns whether one of them ends where the box did: then nothing helps all of the box
    [[nodiscard]] bool follow_members() {
        bool some_go_on = false;
        std::optional<outcome> stopped;
        for (auto const& p : members()) {
            auto const o = follow<Run>(p, strongest(), true);
            result_.members.push_back(o.reached);
            if (further(o.reached)) {
                some_go_on = true;
            } else if (!stopped && o.failure->reason != failure_reason::step_limit) {
                stopped = o;
            }
        }
        if (!stopped) return false;
        auto& why = result_.failure;
        why.help = some_go_on ? advice::parts_only : advice::nothing;
        if (auto const edge = edge_of(*stopped)) {
            why.reason = failure_reason::undefined;
            why.note(edge);
        } else if (auto const grown = grown_state(*stopped)) {
            why.reason = failure_reason::blow_up;
            why.component = *grown;
        }
        return true;
    }
    /// What a single trajectory ran into: what its last step met, or what lies as close ahead as it
    /// came in its last steps.
    [[nodiscard]] std::optional<domain_edge> edge_of(outcome const& o) const {
        if (o.failure->edge) return o.failure->edge;
        auto const count = std::min(o.middles.size(), 2 + o.middles.size() / 8);
        box near(flow_.states());
        for (std::size_t i = 0; i < near.size(); ++i) {
            double lower = HUGE_VAL, upper = -HUGE_VAL;
            for (std::size_t k = o.middles.size() - count; k < o.middles.size(); ++k) {
                lower = std::min(lower, o.middles[k][i]);
                upper = std::max(upper, o.middles[k][i]);
            }
            if (!std::isfinite(upper - lower)) return std::nullopt;
            near[i] = interval(lower - (upper - lower), upper + (upper - lower));
        }
        box p(parameters_.size());
        for (std::size_t j = 0; j < p.size(); ++j) p[j] = interval(mid(parameters_[j]));
        return find_domain_edge<interval>(flow_, o.reached, interval(o.reached), near, p);
    }
    /// The state whose rate of change has grown most, if that is by more than a thousand since the
    /// first half of the time.
    [[nodiscard]] static std::optional<std::size_t> grown_state(outcome const& o) {
        std::optional<std::size_t> result;
        if (o.times.size() < 3) return result;
        double most = 1e3;
        double const half = 0.5 * (o.times.front() + o.times.back());
        for (std::size_t i = 0; i < o.middles.front().size(); ++i) {
            double early = 0, late = 0, size = 0;
            for (std::size_t k = 1; k < o.times.size(); ++k) {
                double const rate =
                    std::abs(o.middles[k][i] - o.middles[k - 1][i]) / (o.times[k] - o.times[k - 1]);
                size = std::max(size, std::abs(o.middles[k - 1][i]));
                if (o.times[k - 1] <= half) {
                    early = std::max(early, rate);
                } else {
                    late = rate; // the last one stays
                }
            }
            double const least = 1e-6 * size / (o.times.back() - o.times.front());
            double const growth = late / std::max({early, least, 1e-300});
            if (!(growth > most)) continue;
            most = growth;
            result = i;
        }
        return result;
    }

    /// Tries the whole box.
    /// @returns whether it reaches the end
    template <class Engine>
    bool attempt(advice remedy, enclosure_options const& options) {
        double const reached = follow<Engine>({initial_, parameters_}, options).reached;
        result_.trials.push_back({remedy, 1, options, reached, further(reached)});
        return reached >= end_;
    }
    /// Halves all sides in turn and goes on with the half that gets less far, until it gets further
    /// than the box, or is 1/64 as wide.
    void try_parts() {
        part worst{initial_, parameters_};
        remedy_trial t{advice::smaller_box, 1, capped(), 0, false};
        while (!t.further && t.share > 1.0 / 64) {
            t.share /= 2;
            for (auto* sides : {&worst.first, &worst.second}) {
                for (std::size_t j = 0; j < sides->size(); ++j) {
                    auto const x = (*sides)[j];
                    if (!is_wide(x)) continue;
                    (*sides)[j] = interval(x.lower(), mid(x));
                    double const below = follow<Run>(worst, t.options).reached;
                    (*sides)[j] = interval(mid(x), x.upper());
                    double const above = follow<Run>(worst, t.options).reached;
                    if (below <= above) (*sides)[j] = interval(x.lower(), mid(x));
                    t.reached = std::min(below, above);
                    parts_go_on_ = parts_go_on_ || further(std::max(below, above));
                }
            }
            t.further = further(t.reached);
        }
        result_.trials.push_back(t);
    }
    [[nodiscard]] bool last_helped() const { return result_.trials.back().further; }
    [[nodiscard]] bool any_helped() const {
        return std::any_of(result_.trials.begin(), result_.trials.end(),
                           [](remedy_trial const& t) { return t.further; });
    }

    void try_remedies() {
        auto const reason = result_.failure.reason;
        if (reason == failure_reason::step_limit) {
            auto more = options_;
            more.maximum_steps *= 2;
            if (attempt<Run>(advice::more_steps, more)) return;
        }
        if (attempt<Run>(advice::higher_order, higher_order())) return;
        if (!last_helped() && reason != failure_reason::step_limit &&
            attempt<Run>(advice::higher_order, sharper()))
            return;
        if (reason == failure_reason::minimum_step || reason == failure_reason::unsolved_stages) {
            auto shorter = capped();
            shorter.minimum_step *= 1e-3;
            if (attempt<Run>(advice::shorter_steps, shorter)) return;
        }
        if (options_.method && !options_.method->is_explicit()) {
            auto explicit_one = capped();
            explicit_one.method = butcher6();
            if (attempt<Run>(advice::other_method, explicit_one)) return;
        }
        if (reason == failure_reason::minimum_step && !any_helped() &&
            attempt<Run>(advice::higher_order, strongest()))
            return;
        if constexpr (!std::is_void_v<Other>) {
            constexpr bool first_order = std::is_same_v<Run, trajectory<interval>>;
            if (attempt<Other>(first_order ? advice::other_set : advice::higher_degree, capped()))
                return;
        }
        if (!is_point()) try_parts();
    }
    /// The remedy that reached furthest, the earlier one among equals.
    void choose() {
        remedy_trial const* best = nullptr;
        for (auto const& t : result_.trials) {
            if (t.further && (best == nullptr || t.reached > best->reached)) best = &t;
        }
        result_.failure.help = best != nullptr ? best->remedy
                               : parts_go_on_  ? advice::parts_only
                                               : advice::nothing;
    }

    flow const& flow_;
    enclosure_options const& options_;
    box const& initial_;
    box const& parameters_;
    double begin_, end_;
    advised_failure result_;
    double reached_ = 0;
    std::vector<double> slopes_; ///< of the state that stopped the box
    std::size_t cap_ = 0;
    bool parts_go_on_ = false;
};

} // namespace sivid::enclosure_detail

#endif
