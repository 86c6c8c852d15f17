// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_CANDIDATE_SCREENING_HPP
#define SIVID_APPROXIMATE_CANDIDATE_SCREENING_HPP

#include <sivid/approximate/candidate/candidate.hpp>
#include <sivid/approximate/candidate/detail/beyond_prior.hpp>
#include <sivid/approximate/candidate/detail/candidate_fit.hpp>
#include <sivid/approximate/candidate/detail/effect_sets.hpp>
#include <sivid/approximate/candidate/detail/episode_search.hpp>
#include <sivid/approximate/candidate/detail/wrapped_channels.hpp>
#include <sivid/approximate/candidate/screened.hpp>
#include <sivid/approximate/fit/fit.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Fits a catalogue of effects, and channels that wrap, alone, in pairs and perhaps further, to one
/// campaign. Nothing here is proved.
class screening {
public:
    screening(identification_problem base, std::vector<effect> catalogue,
              screening_options options = {})
        : base_(std::move(base)),
          catalogue_(with_wrapped_channels(base_, std::move(catalogue))),
          options_(std::move(options)) {
        for (auto const& e : base_.experiments) measurements_ += e.measurements.size();
    }

    [[nodiscard]] std::vector<screened> const& candidates() const { return tried_; }
    /// What candidates name.
    [[nodiscard]] std::vector<effect> const& catalogue() const { return catalogue_; }
    [[nodiscard]] std::size_t measurements() const { return measurements_; }
    [[nodiscard]] std::vector<candidate> figures() const {
        std::vector<candidate> result;
        for (auto const& s : tried_) result.push_back(s.figures);
        return result;
    }

    /// How much of the plan is done. What pairs are planned depends on the single effects: before
    /// all of them are tried, as many as there will be where none explains alone.
    [[nodiscard]] tried_candidates counts() const {
        tried_candidates result;
        result.singles = count(singles());
        if (result.singles.tried < result.singles.planned) {
            auto const k = std::min(planned_, options_.partners);
            result.pairs.planned = k * (planned_ - k) + k * (k - std::min<std::size_t>(k, 1)) / 2;
        } else {
            result.pairs = count(pairs());
        }
        for (std::size_t size = 3; size <= options_.most_effects; ++size) {
            if (explained(size - 1)) break;
            auto const joins = count(joined(ranked(size - 1, most_joined)));
            result.larger.planned += joins.planned;
            result.larger.tried += joins.tried;
        }
        if (options_.most_effects < 3) { // tried beyond the plan
            auto const threes = ranked(3, tried_.size()).size();
            result.larger = {threes, threes};
        }
        return result;
    }

    /// The model itself, every single effect, then pairs, then larger sets where they are asked
    /// for; where none explains, those that end at their priors with wider ones. Called again, it
    /// goes on where it was stopped.
    /// @cost  23 effects: 24 fits, about 20 to 120 for pairs, about 60 for each further effect
    void run() {
        stopped_ = false;
        try_one({});
        try_all(singles());
        polish();
        if (!stopped_) try_all(pairs());
        for (std::size_t size = 3; size <= options_.most_effects && !stopped_; ++size) {
            if (explained(size - 1)) break;
            join_one_more(size, most_joined);
        }
        polish();
        if (!stopped_ && !explained(catalogue_.size())) go_beyond();
    }

    /// Descends on from every fit that misses an explanation by little: which side of 1 the largest
    /// misfit ends on decides what explains.
    void polish() {
        constexpr double close = 1.05;
        options_.workers(tried_.size(), [this](std::size_t k) {
            auto& s = tried_[k];
            double const before = s.figures.inflation;
            if (!(before > 1 && before < close) || !in_time()) return;
            auto better = sivid::fit(s.problem, fit_norm::largest, {s.fit.parameters, s.fit.starts},
                                     [this] { return in_time(); });
            if (!(better.inflation < before)) return;
            better.squares = s.fit.squares;
            s.fit = std::move(better);
            s.figures.inflation = s.fit.inflation;
        });
    }

    /// Tries single effects (none: all of the plan) as such that act in these experiments only.
    void try_within(std::vector<std::string> const& experiments, effect_sets some = {}) {
        if (some.empty()) some = singles();
        effect_sets wanted;
        for (auto const& one : some) {
            auto const& e = catalogue_[one.front()];
            wanted.push_back({index_of_effect(catalogue_, only_within(e, experiments))});
        }
        try_all(wanted);
    }

    /// Joins every other effect to each of the closest pairs; where none explains, to more of them.
    /// @returns  whether some three explain the data
    /// @cost  some sixty fits with 20 effects, and as many for each three pairs more
    [[nodiscard]] bool try_threes() {
        for (std::size_t pairs = most_joined; pairs <= 3 * most_joined; pairs += most_joined) {
            if (explained(3) || stopped_) break;
            join_one_more(3, pairs);
            polish();
        }
        return explained(3);
    }

    /// Tries effects that no catalogue has, alone and, where none explains and they may act
    /// `together`, each of the closest with every other one.
    /// @returns  whether one or two of them explain the data
    [[nodiscard]] bool try_further(std::vector<effect> effects, bool together) {
        effect_set numbers;
        for (auto& e : effects) numbers.push_back(index_of_effect(catalogue_, std::move(e)));
        effect_sets singles;
        for (auto const k : numbers) singles.push_back({k});
        try_all(singles);
        polish();
        if (explained(1) || !together) return explained(1);
        std::erase_if(singles, [this](auto const& one) { return find(one) == nullptr; });
        std::stable_sort(singles.begin(), singles.end(), [this](auto const& a, auto const& b) {
            return find(a)->figures.inflation < find(b)->figures.inflation;
        });
        singles.resize(std::min(most_joined, singles.size()));
        try_all(sets_joined(singles, numbers));
        polish();
        return explained(2);
    }

    /// Tries single effects of the plan as such that begin in each experiment at a time of its own
    /// (or end, or both), and adds those that explain the data so.
    /// @param ends  whether effects that end are tried, too
    void try_episodes(bool ends) {
        std::vector<episode_search::single> effects;
        for (auto const& one : singles()) {
            auto const* always = find(one);
            if (always == nullptr) continue;
            effects.push_back({catalogue_[one.front()], always->fit.parameters});
        }
        std::mutex asking;
        episode_search const search(base_, std::move(effects), options_.workers,
                                    {[&](std::string const& name) { return may_try(name, asking); },
                                     [this] { return in_time(); }});
        for (auto const& found : search(ends)) {
            screened s{{{}, 0, {}, {}}, found.problem(), found.fit()};
            s.figures.effects = {index_of_effect(catalogue_, found.acting())};
            take_figures(s);
            s.figures.unknowns += found.times();
            if (find(s.figures.effects) == nullptr) tried_.push_back(std::move(s));
        }
    }

    /// Fits one set of effects, unless that was done.
    void try_one(std::vector<std::size_t> const& effects) { try_all({effects}); }

    /// Fits sets of effects of which none contains another, each unless that was done or cannot be;
    /// several at once where there are workers.
    void try_all(effect_sets const& wanted) {
        effect_sets open;
        for (auto const& effects : wanted) {
            bool const known = std::find(open.begin(), open.end(), effects) != open.end();
            if (!known && find(effects) == nullptr && possible(effects)) open.push_back(effects);
        }
        std::vector<std::optional<screened>> fitted(open.size());
        auto const keep = [&](std::size_t k, screened s, bool whole) {
            // Cut short, it says nothing of a candidate, but the model itself is needed.
            bool const first = open[k].empty() && !s.fit.parameters.empty();
            if (whole || s.figures.explains() || first) fitted[k] = std::move(s);
        };
        std::mutex asking;
        auto const elsewhere = fitted_elsewhere(open, asking, keep);
        options_.workers(open.size(), [&](std::size_t k) {
            if (elsewhere[k] || !may_try(name_of(open[k]), asking)) return;
            auto s = posed(open[k]);
            s.fit = fit_candidate(s.problem, base_, best_part_of(open[k]), open[k].size(),
                                  options_.go_on, s.silent);
            take_figures(s);
            keep(k, std::move(s), in_time());
        });
        for (auto& s : fitted) {
            if (s) tried_.push_back(std::move(*s));
        }
    }

    /// A candidate with its problem, not yet fitted.
    [[nodiscard]] screened posed(std::vector<std::size_t> const& effects) const {
        std::vector<effect> chosen;
        for (auto const e : effects) chosen.push_back(catalogue_.at(e));
        return {{effects, 0, {}, {}}, affected(base_, chosen), {}};
    }
    /// What `screening_options::fit_elsewhere` has to do; for any thread.
    [[nodiscard]] made_fit make(wanted_fit const& w, std::function<bool()> const& go_on) const {
        made_fit made;
        made.fit = fit_candidate(posed(w.effects).problem, base_, w.part, w.effects.size(), go_on,
                                 made.silent);
        return made;
    }

    [[nodiscard]] screened const* find(std::vector<std::size_t> const& effects) const {
        auto const f = std::find_if(tried_.begin(), tried_.end(), [&](screened const& s) {
            return s.figures.effects == effects;
        });
        return f == tried_.end() ? nullptr : &*f;
    }

private:
    static constexpr std::size_t most_joined = 3; ///< sets that further effects join

    [[nodiscard]] effect_sets singles() const {
        effect_sets wanted;
        for (std::size_t e = 0; e < planned_; ++e) wanted.push_back({e});
        return wanted;
    }
    /// @given  all single effects were tried
    [[nodiscard]] effect_sets pairs() const {
        effect_sets wanted;
        bool const alone = explained(1);
        if (alone && !options_.always_pairs) return wanted;
        return joined(ranked(1, alone ? 1 : options_.partners));
    }
    /// Each of the sets with every other effect of the plan.
    [[nodiscard]] effect_sets joined(effect_sets const& sets) const {
        effect_set planned(planned_);
        std::iota(planned.begin(), planned.end(), std::size_t{0});
        return sets_joined(sets, planned, impossible_);
    }
    [[nodiscard]] tried_candidates::count count(effect_sets const& planned) const {
        auto const known = [this](auto const& set) { return find(set) != nullptr; };
        return {static_cast<std::size_t>(std::count_if(planned.begin(), planned.end(), known)),
                planned.size()};
    }
    /// Whether effects can be joined: what the catalogue states has to be, alone.
    [[nodiscard]] bool possible(effect_set const& effects) {
        bool const stated = effects.empty() || (effects.size() == 1 && effects[0] < planned_);
        return stated || impossible_.allow(effects, [&] { (void)posed(effects); });
    }
    /// Joins every other effect to the likeliest candidates of size - 1 effects, so many of them.
    /// What explains must then do without each of its effects, or a smaller candidate is the
    /// answer.
    void join_one_more(std::size_t size, std::size_t most) {
        try_all(joined(ranked(size - 1, most)));
        effect_sets parts;
        for (auto const& s : tried_) {
            if (s.figures.effects.size() != size || !s.figures.explains()) continue;
            for (std::size_t k = 0; k < size; ++k) {
                parts.push_back(s.figures.effects);
                parts.back().erase(parts.back().begin() + static_cast<std::ptrdiff_t>(k));
            }
        }
        try_all(parts);
    }
    /// The closest candidates of one or two effects that end at a prior, with wider ones there.
    void go_beyond() {
        constexpr std::size_t most = 6;
        auto closest = tried_;
        // Not that of std::ranges: libc++'s takes Boost's `next` for its own.
        std::stable_sort(closest.begin(), closest.end(), [](auto const& a, auto const& b) {
            return a.figures.inflation < b.figures.inflation;
        });
        effect_sets singles, others;
        for (auto const& s : closest) {
            if (s.figures.effects.size() > 2) continue;
            auto const further = beyond_prior(s, catalogue_, planned_);
            if (further == s.figures.effects) continue;
            for (auto const e : further)
                if (e >= planned_) singles.push_back({e}); // one effect is the simpler answer
            others.push_back(further);
            if (others.size() == most) break;
        }
        try_all(singles);
        if (!explained(1)) try_all(others);
        polish();
    }
    /// By at most so many effects.
    [[nodiscard]] bool explained(std::size_t effects) const {
        return std::any_of(tried_.begin(), tried_.end(), [effects](screened const& s) {
            return s.figures.effects.size() <= effects && s.figures.explains();
        });
    }

    [[nodiscard]] std::string name_of(std::vector<std::size_t> const& effects) const {
        return effects.empty()
                   ? "the model itself"
                   : sivid::joined(effects, " + ", [this](auto e) { return catalogue_[e].name; });
    }
    [[nodiscard]] bool may_try(std::string const& name, std::mutex& asking) {
        std::lock_guard const alone(asking);
        stopped_ = stopped_ || !in_time() || (options_.progress && !options_.progress(name));
        return !stopped_;
    }
    /// For any thread.
    [[nodiscard]] bool in_time() const { return limit_(); }
    static void take_figures(screened& s) {
        s.figures.inflation = s.fit.inflation;
        s.figures.squares = s.fit.squares;
        s.figures.unknowns = s.problem.prior.size();
    }
    /// Has sets of effects of the plan fitted by others, who know no wider ones.
    /// @returns  which
    template <class Keep>
    [[nodiscard]] std::vector<char> fitted_elsewhere(effect_sets const& open, std::mutex& asking,
                                                     Keep const& keep) {
        std::vector<char> which(open.size(), 0);
        std::vector<std::size_t> whose;
        std::vector<wanted_fit> wanted;
        for (std::size_t k = 0; k < open.size() && options_.fit_elsewhere; ++k) {
            // Then its parts are of the plan, too.
            if (!std::all_of(open[k].begin(), open[k].end(),
                             [this](std::size_t e) { return e < planned_; }))
                continue;
            which[k] = 1;
            if (!may_try(name_of(open[k]), asking)) continue;
            whose.push_back(k);
            wanted.push_back({open[k], best_part_of(open[k])});
        }
        if (wanted.empty()) return which;
        auto made = options_.fit_elsewhere(wanted, [this] { return in_time(); });
        for (std::size_t n = 0; n < whose.size(); ++n) {
            if (!made[n]) continue;
            auto s = posed(open[whose[n]]);
            s.fit = std::move(made[n]->fit);
            s.silent = made[n]->silent;
            take_figures(s);
            keep(whose[n], std::move(s), !made[n]->cut_short && in_time());
        }
        return which;
    }
    /// The likeliest candidate tried whose effects are all among these.
    [[nodiscard]] screened const* best_part_of(std::vector<std::size_t> const& effects) const {
        screened const* best = nullptr;
        for (auto const& s : tried_) {
            auto const& part = s.figures.effects;
            if (!std::includes(effects.begin(), effects.end(), part.begin(), part.end())) continue;
            if (best == nullptr || s.figures.squares < best->figures.squares) best = &s;
        }
        return best;
    }

    /// Sets of so many effects of the plan, at most so many of them, the likeliest first.
    [[nodiscard]] effect_sets ranked(std::size_t effects, std::size_t most) const {
        std::vector<screened const*> of_size;
        for (auto const& s : tried_) {
            auto const& set = s.figures.effects;
            if (set.size() == effects && (set.empty() || set.back() < planned_))
                of_size.push_back(&s);
        }
        std::stable_sort(of_size.begin(), of_size.end(), [&](auto const* a, auto const* b) {
            return a->figures.score(measurements_) < b->figures.score(measurements_);
        });
        effect_sets result;
        for (auto const* s : of_size)
            if (result.size() < most) result.push_back(s->figures.effects);
        return result;
    }

    identification_problem base_;
    std::vector<effect> catalogue_;
    std::size_t planned_ = catalogue_.size(); ///< of them; wider ones follow
    screening_options options_;
    std::vector<screened> tried_;
    impossible_sets impossible_;
    std::size_t measurements_ = 0;
    bool stopped_ = false; ///< changed by one thread at a time
    work_limit limit_{options_.seconds, options_.go_on};
};

} // namespace sivid

#endif
