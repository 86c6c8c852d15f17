// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_PLACE_DETAIL_PLACE_SEARCH_HPP
#define SIVID_APPROXIMATE_PLACE_DETAIL_PLACE_SEARCH_HPP

#include <sivid/approximate/place/detail/place_fit.hpp>
#include <sivid/approximate/place/place_options.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace sivid {

/// Which smallest set of places, allowed to be wrong, explains the data.
class place_search {
public:
    place_search(place_fitter& fit, place_state base, place_search_options options = {})
        : fit_(&fit), base_(std::move(base)), options_(options) {}

    /// Every set that was tried, in order of its cost.
    [[nodiscard]] std::vector<place_fit> const& tried() const { return tried_; }
    [[nodiscard]] place_fit const& best() const { return tried_[best_]; }
    /// The chosen set's members, most indispensable first, with what the score loses without each.
    [[nodiscard]] std::vector<std::pair<std::size_t, double>> const& ranking() const {
        return ranking_;
    }
    /// Sets that explain as well at the same cost.
    [[nodiscard]] std::vector<std::vector<std::size_t>> const& alternatives() const {
        return alternatives_;
    }

    /// @param inputs  whether an input may be blamed. When one was, but its error has no plain law,
    ///                parameters and an input that makes up for them may imitate any force: then
    ///                run once more without.
    void run(bool inputs = true) {
        inputs_ = inputs;
        ranking_.clear();
        alternatives_.clear();
        auto const& places = fit_->places();
        std::vector<std::size_t> equations, others, sensors;
        for (std::size_t p = 0; p < places.size(); ++p) {
            (places[p].kind == place_kind::sensor     ? sensors
             : places[p].kind == place_kind::equation ? equations
                                                      : others)
                .push_back(p);
        }
        if (!inputs_) {
            others.erase(
                std::remove_if(others.begin(), others.end(),
                               [&](auto p) { return places[p].kind == place_kind::input; }),
                others.end());
        }
        try_set({});
        for (std::size_t p = 0; p < places.size(); ++p) try_set({p});
        if (!explained(1.5)) {
            pairs(equations, equations);
            pairs(sensors, equations);
            pairs(sensors, sensors);
        }
        if (!explained(2)) {
            for (auto const k : others) {
                if (places[k].cost < 2) pairs({k}, equations);
                if (places[k].kind == place_kind::input) pairs({k}, sensors);
            }
        }
        if (!explained(2.5)) {
            if (equations.size() > 2) {
                for (std::size_t a = 0; a < equations.size(); ++a) {
                    for (std::size_t b = a + 1; b < equations.size(); ++b) {
                        for (std::size_t c = b + 1; c < equations.size(); ++c) {
                            try_set({equations[a], equations[b], equations[c]});
                        }
                    }
                }
            }
            if (equations.size() > 3) try_set(equations);
            triples(sensors, equations);
        }
        refit_from_supersets();
        choose();
        rank();
    }

private:
    [[nodiscard]] bool late() const { return tried_.size() >= options_.most_sets; }
    [[nodiscard]] bool stopped() {
        if (!stopped_ && !tried_.empty() && options_.go_on) stopped_ = !options_.go_on();
        return stopped_;
    }
    [[nodiscard]] place_fit* find(std::vector<std::size_t> const& set) {
        auto const at = index_.find(set);
        return at == index_.end() ? nullptr : &tried_[at->second];
    }
    /// Starts from the best subset with one place less.
    void try_set(std::vector<std::size_t> set) {
        std::sort(set.begin(), set.end());
        if (find(set) != nullptr || (late() && set.size() > 1) || stopped()) return;
        place_state const* from = &base_;
        double score = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < set.size(); ++k) {
            auto part = set;
            part.erase(part.begin() + static_cast<std::ptrdiff_t>(k));
            auto const* known = find(part);
            if (known == nullptr || !(known->score < score)) continue;
            score = known->score;
            from = &known->state;
        }
        auto result = (*fit_)(set, *from);
        if (!tried_.empty() && stopped()) return; // in its midst
        // A start that did not lead anywhere: the base once more.
        if (result.inflation > 1 && from != &base_ && result.score > 0.9 * score &&
            set.size() > 1 && !stopped()) {
            auto again = (*fit_)(set, base_);
            if (again.score < result.score) result = std::move(again);
        }
        index_[set] = tried_.size();
        tried_.push_back(std::move(result));
    }
    void pairs(std::vector<std::size_t> const& a, std::vector<std::size_t> const& b) {
        for (auto const i : a) {
            for (auto const j : b) {
                if (i != j) try_set({i, j});
            }
        }
    }
    void triples(std::vector<std::size_t> const& sensors,
                 std::vector<std::size_t> const& equations) {
        for (std::size_t a = 0; a < equations.size(); ++a) {
            for (std::size_t b = a + 1; b < equations.size(); ++b) {
                for (auto const s : sensors) try_set({s, equations[a], equations[b]});
            }
        }
    }
    /// Whether a set may be chosen.
    [[nodiscard]] bool allowed(place_fit const& f) const {
        return inputs_ || std::none_of(f.set.begin(), f.set.end(), [this](auto p) {
                   return fit_->places()[p].kind == place_kind::input;
               });
    }
    [[nodiscard]] bool explained(double cost) const {
        return std::any_of(tried_.begin(), tried_.end(), [&](place_fit const& f) {
            return f.cost <= cost && f.inflation <= 1 && allowed(f);
        });
    }
    /// Local minima are real: a set may do better from where a superset ended.
    void refit_from_supersets() {
        for (auto& own : tried_) {
            if (own.inflation <= 1 || own.set.empty()) continue;
            place_fit const* above = nullptr;
            for (auto const& other : tried_) {
                if (other.set.size() <= own.set.size() || other.inflation > 1) continue;
                if (!std::includes(other.set.begin(), other.set.end(), own.set.begin(),
                                   own.set.end())) {
                    continue;
                }
                if (other.score < own.score - options_.much_better &&
                    (above == nullptr || other.score < above->score)) {
                    above = &other;
                }
            }
            if (above == nullptr || late() || stopped()) continue;
            auto again = (*fit_)(own.set, above->state);
            if (again.score < own.score || again.inflation < own.inflation) own = std::move(again);
        }
    }
    void choose() {
        best_ = 0;
        auto const better = [this](place_fit const& a, place_fit const& b) {
            if (allowed(a) != allowed(b)) return allowed(a);
            bool const holds_a = a.inflation <= 1;
            bool const holds_b = b.inflation <= 1;
            if (holds_a != holds_b) return holds_a;
            if (holds_a && a.cost != b.cost) return a.cost < b.cost;
            return a.score < b.score;
        };
        for (std::size_t k = 1; k < tried_.size(); ++k) {
            if (better(tried_[k], tried_[best_])) best_ = k;
        }
        for (std::size_t k = 0; k < tried_.size(); ++k) {
            if (k == best_ || tried_[k].cost != tried_[best_].cost) continue;
            bool const as_good = tried_[k].inflation <= std::max(1.0, tried_[best_].inflation);
            if (as_good && tried_[k].score < tried_[best_].score + options_.equal_score) {
                alternatives_.push_back(tried_[k].set);
            }
        }
    }
    void rank() {
        auto const set = tried_[best_].set;
        auto const score = tried_[best_].score;
        for (std::size_t k = 0; k < set.size(); ++k) {
            auto part = set;
            part.erase(part.begin() + static_cast<std::ptrdiff_t>(k));
            try_set(part);
            auto const* without = find(part);
            ranking_.emplace_back(set[k], without == nullptr ? 0 : without->score - score);
        }
        std::stable_sort(ranking_.begin(), ranking_.end(),
                         [](auto const& a, auto const& b) { return a.second > b.second; });
    }

    place_fitter* fit_;
    place_state base_;
    place_search_options options_;
    std::vector<place_fit> tried_;
    std::map<std::vector<std::size_t>, std::size_t> index_;
    std::size_t best_ = 0;
    bool inputs_ = true;
    bool stopped_ = false;
    std::vector<std::pair<std::size_t, double>> ranking_;
    std::vector<std::vector<std::size_t>> alternatives_;
};

} // namespace sivid

#endif
