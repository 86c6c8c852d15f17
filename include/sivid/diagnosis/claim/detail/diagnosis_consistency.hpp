// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CLAIM_DETAIL_DIAGNOSIS_CONSISTENCY_HPP
#define SIVID_DIAGNOSIS_CLAIM_DETAIL_DIAGNOSIS_CONSISTENCY_HPP

#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/number/text/joined.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Two claims of one diagnosis that cannot both be true, or a claim without what it rests on.
struct contradiction {
    enum class about { gap, relation, place, cause, hull, part, confined, shrink, answer };
    about kind = about::gap;
    std::size_t index = 0;  ///< of the claim in doubt, in its list
    std::size_t member = 0; ///< of a cause's parameter
    std::string claim;      ///< the one in doubt: what rests on assumptions where one of them does
    std::string reason;
};

/// Whether an answer says that nothing explains the data, so far as was tried.
[[nodiscard]] constexpr bool unanswered(answer_kind a) {
    return a == answer_kind::unexplained || a == answer_kind::open;
}

/// Where nothing was found that explains the data, and then a cause was proved to (the search for
/// the least inflation of the closest one may get where no fit did), this cause is the answer.
/// @returns whether it is now
inline bool answer_by_proof(diagnosis& d) {
    if (!unanswered(d.answer)) return false;
    for (auto const& c : d.causes) {
        if (c.verdict != cause_verdict::explains) continue;
        d.effects = c.effects;
        d.answer = c.effects.empty() ? answer_kind::none : answer_kind::effects;
        d.remainder.reset();
        return true;
    }
    return false;
}

namespace diagnosis_detail {

/// Compares the claims of one diagnosis with each other.
class claim_comparison {
public:
    claim_comparison(diagnosis const& d, std::function<bool(std::string const&)> const& vanishes)
        : d_(&d), vanishes_(&vanishes) {}

    [[nodiscard]] std::vector<contradiction> operator()() {
        gap();
        relations();
        for (std::size_t k = 0; k < d_->where.size(); ++k) place(k);
        for (std::size_t k = 0; k < d_->causes.size(); ++k) cause_alone(k);
        nested_causes();
        parts(d_->scenario_inflation, 0);
        parts(d_->channel_inflation, d_->scenario_inflation.size());
        for (std::size_t k = 0; k < d_->confined.size(); ++k) confined(k);
        answer();
        return std::move(found_);
    }

private:
    using about = contradiction::about;

    void add(about kind, std::size_t index, std::string claim, std::string reason,
             std::size_t member = 0) {
        found_.push_back({kind, index, member, std::move(claim), std::move(reason)});
    }
    [[nodiscard]] static bool is_range(inflation_range const& x) {
        return !is_empty(x) && x.lower() >= 0 && x.lower() <= x.upper();
    }
    [[nodiscard]] static std::string text(std::vector<std::string> const& effects) {
        return effects.empty() ? "the model as it is" : sivid::joined(effects, " + ");
    }

    void gap() {
        auto const& range = d_->inflation;
        if (!is_range(range)) {
            add(about::gap, 0, "gap", "its inflation is no range");
        } else if (d_->gap == gap_verdict::certified && !(range.lower() > 1)) {
            add(about::gap, 0, "gap certified", "its inflation is not proved to be above 1");
        } else if (d_->gap == gap_verdict::none && !(range.upper() <= 1)) {
            add(about::gap, 0, "gap none", "its inflation is not proved to be 1 at most");
        }
    }

    void relations() {
        for (std::size_t k = 0; k < d_->relations.size(); ++k) {
            auto const& r = d_->relations[k];
            if (!r.proved) continue;
            auto const claim = "relation " + r.equation;
            if (d_->gap == gap_verdict::none) {
                add(about::relation, k, claim, "the model as it is explains the data");
                continue;
            }
            for (auto const& c : d_->causes) {
                if (c.verdict != cause_verdict::explains) continue;
                if (std::find(c.untouched.begin(), c.untouched.end(), r.equation) ==
                    c.untouched.end()) {
                    continue;
                }
                add(about::relation, k, claim,
                    text(c.effects) + " explains the data and leaves it as it is");
                break;
            }
        }
    }

    [[nodiscard]] broken_relation_report const* proved_relation(std::string const& equation) const {
        for (auto const& r : d_->relations) {
            if (r.proved && r.equation == equation) return &r;
        }
        return nullptr;
    }
    void place(std::size_t k) {
        auto const& p = d_->where[k];
        auto const claim = "place " + p.kind + " " + p.name;
        auto const* r = proved_relation(p.name);
        if (p.proved && (p.kind != "equation" || r == nullptr)) {
            add(about::place, k, claim, "no relation of it is proved not to hold");
        } else if (p.proved && r->definition) {
            add(about::place, k, claim, "no constant acts in the equation");
        } else if (p.missing && !p.proved) {
            add(about::place, k, claim, "bounds of what is missing without a proof that it is");
        } else if (p.missing && (is_empty(*p.missing) || contains(*p.missing, 0.0))) {
            add(about::place, k, claim, "what is missing may be nothing");
        } else if (p.missing && p.estimate && !contains(*p.missing, *p.estimate)) {
            add(about::place, k, claim, "the estimate lies outside of what is proved");
        } else if (p.missing && !(p.where.from < p.where.to)) {
            add(about::place, k, claim, "something is missing in a window without length");
        }
    }

    void cause_alone(std::size_t k) {
        auto const& c = d_->causes[k];
        auto const claim = "cause " + text(c.effects) + " " + std::string{to_string(c.verdict)};
        if (!is_range(c.inflation)) {
            add(about::cause, k, claim, "its inflation is no range");
            return;
        }
        if (c.verdict == cause_verdict::explains && !(c.inflation.upper() <= 1)) {
            add(about::cause, k, claim, "its inflation is not proved to be 1 at most");
        } else if (c.verdict == cause_verdict::excluded && c.inflation.upper() <= 1) {
            add(about::cause, k, claim, "its inflation is proved to be 1 at most");
        } else if (c.verdict == cause_verdict::excluded && c.excluded_by.empty() &&
                   !(c.inflation.lower() > 1)) {
            add(about::cause, k, claim, "its inflation is not proved to be above 1");
        } else if (c.verdict == cause_verdict::excluded && !c.excluded_by.empty() &&
                   proved_relation(c.excluded_by) == nullptr) {
            add(about::cause, k, claim,
                "the relation " + c.excluded_by + " that excludes it is not proved");
        }
        if (c.verdict != cause_verdict::explains || !c.witness) return;
        for (std::size_t j = 0; j < c.parameters.size(); ++j) {
            auto const& p = c.parameters[j];
            for (auto const& w : c.witness->parameters) {
                if (w.name != p.name || !p.hull || contains(*p.hull, w.value)) continue;
                add(about::hull, k, "bounds of " + p.name + " with " + text(c.effects),
                    "the witness lies outside", j);
            }
        }
    }

    /// Whether all that `fewer` can do `more` can do, too: the further effects may vanish.
    [[nodiscard]] bool nested(std::vector<std::string> const& fewer,
                              std::vector<std::string> const& more) const {
        if (fewer.size() >= more.size()) return false;
        auto const in = [](auto const& list, std::string const& e) {
            return std::find(list.begin(), list.end(), e) != list.end();
        };
        return std::all_of(fewer.begin(), fewer.end(),
                           [&](auto const& e) { return in(more, e); }) &&
               std::all_of(more.begin(), more.end(), [&](auto const& e) {
                   return in(fewer, e) || !*vanishes_ || (*vanishes_)(e);
               });
    }
    void nested_causes() {
        auto const compare = [this](std::vector<std::string> const& fewer, bool explains,
                                    inflation_range const& range) {
            for (std::size_t k = 0; k < d_->causes.size(); ++k) {
                auto const& c = d_->causes[k];
                bool const same = fewer.empty() && c.effects.empty();
                if (!same && !nested(fewer, c.effects)) continue;
                auto const claim = "cause " + text(c.effects);
                if (explains && c.verdict == cause_verdict::excluded) {
                    add(about::cause, k, claim + " excluded", text(fewer) + " explains the data");
                } else if (c.inflation.lower() > range.upper()) {
                    add(about::cause, k, claim, "its inflation is above that of " + text(fewer));
                }
            }
        };
        compare({}, d_->gap == gap_verdict::none, d_->inflation);
        for (auto const& c : d_->causes) {
            if (c.effects.empty()) continue;
            compare(c.effects, c.verdict == cause_verdict::explains, c.inflation);
        }
    }

    /// No scenario and no channel alone can be met worse than all of them.
    void parts(std::vector<named_estimate> const& all, std::size_t first) {
        for (std::size_t k = 0; k < all.size(); ++k) {
            if (!all[k].hull) continue;
            if (!is_range(*all[k].hull) || all[k].hull->lower() > d_->inflation.upper()) {
                add(about::part, first + k, "inflation of " + all[k].name,
                    "it is above that of all data");
            }
        }
    }

    /// One parameter explains all but a part: what others contradict without it is in doubt.
    void confined(std::size_t k) {
        auto const& c = d_->confined[k];
        auto const infinity = unknown_inflation().upper();
        if (!is_range(c.factor) || !(c.factor.upper() < infinity)) {
            add(about::confined, k, "the rest explained", "its factor is no range");
        } else if (d_->gap == gap_verdict::none || c.factor.upper() < d_->inflation.lower()) {
            add(about::confined, k, "bounds that must grow",
                d_->gap == gap_verdict::none ? "the model as it is explains the data"
                                             : "all of them must grow by more");
        } else {
            beside_confined(c);
        }
    }
    void beside_confined(confined_gap const& c) {
        auto const outside = [&c](std::string const& scenario) {
            auto const& in = c.scenarios;
            return !in.empty() && std::find(in.begin(), in.end(), scenario) == in.end();
        };
        std::string const reason = "without a part of the data that it does not rest on the model "
                                   "as it is explains them";
        for (std::size_t k = 0; k < d_->relations.size(); ++k) {
            auto const& r = d_->relations[k];
            auto const& seen = r.sensors;
            bool const channel =
                c.channel.empty() || std::find(seen.begin(), seen.end(), c.channel) != seen.end();
            bool const apart = !r.windows.empty() &&
                               std::all_of(r.windows.begin(), r.windows.end(),
                                           [&](auto const& w) { return outside(w.scenario); });
            if (r.proved && (!channel || apart)) {
                add(about::relation, k, "relation " + r.equation, reason);
            }
        }
        auto const alone = [&](std::vector<named_estimate> const& all, std::size_t first,
                               auto const& is_outside) {
            for (std::size_t k = 0; k < all.size(); ++k) {
                if (all[k].hull && all[k].hull->lower() > 1 && is_outside(all[k].name)) {
                    add(about::part, first + k, "inflation of " + all[k].name, reason);
                }
            }
        };
        alone(d_->scenario_inflation, 0, outside);
        alone(d_->channel_inflation, d_->scenario_inflation.size(),
              [&c](std::string const& name) { return !c.channel.empty() && c.channel != name; });
    }

    void answer() {
        cause const* chosen = nullptr;
        for (std::size_t k = 0; k < d_->causes.size(); ++k) {
            auto const& c = d_->causes[k];
            if (d_->answer == answer_kind::effects && c.effects == d_->effects) chosen = &c;
            if (c.verdict == cause_verdict::explains && unanswered(d_->answer)) {
                add(about::answer, 0,
                    d_->answer == answer_kind::open ? "answer open" : "answer unexplained",
                    text(c.effects) + " explains the data");
            }
            for (auto const& other : d_->indistinguishable) {
                if (c.effects != other || c.verdict != cause_verdict::excluded) continue;
                add(about::answer, 0, "not told apart: " + text(other), "it is excluded");
            }
        }
        if (d_->answer == answer_kind::none && d_->gap == gap_verdict::certified) {
            add(about::answer, 0, "answer none", "a gap is certified");
        }
        if (chosen != nullptr && chosen->verdict == cause_verdict::excluded) {
            add(about::answer, 0, "answer " + text(d_->effects), "it is excluded");
        }
        if (!d_->shrink_fit) return;
        auto const& s = *d_->shrink_fit;
        if (is_empty(s) || s.upper() > 1 || !(d_->inflation.upper() > 1)) {
            add(about::shrink, 0, "shrink", "there is no gap, or more than all of it goes");
        } else if (chosen != nullptr) {
            auto const again = shrink(d_->inflation, chosen->inflation);
            if (!again || is_empty(intersect(*again, s))) {
                add(about::shrink, 0, "shrink", "the inflations before and after say otherwise");
            }
        }
    }

    diagnosis const* d_;
    std::function<bool(std::string const&)> const* vanishes_;
    std::vector<contradiction> found_;
};

} // namespace diagnosis_detail

/// All contradictions inside a diagnosis, as it would be written:
///   - a gap that is certified or none against its inflation;
///   - a relation that is proved not to hold while there is no gap, or while a cause that leaves it
///     as it is explains the data;
///   - a place that is proved without a relation, or for an equation in which no constant acts;
///     bounds of what is missing without a proof, with zero in them, or that miss the estimate;
///   - a cause that explains or is excluded against its own inflation, that is excluded by a
///     relation which is not proved, or whose witness lies outside of the bounds of its parameters;
///   - a cause that is excluded, or whose inflation is greater, while some of its effects alone
///     explain, or do with less: further effects may vanish;
///   - a scenario or channel that alone is met worse than all data;
///   - a part of the data that alone stands against the model, by a factor below that of all, or
///     beside a relation or an inflation of others, which do without this part;
///   - an answer that is excluded, "none" beside a certified gap, "unexplained" beside a cause that
///     explains, an excluded cause called not told apart; a shrink that the inflations do not give.
/// @param vanishes  whether an effect does at its neutral value, which lies in its prior; empty:
///   every one does
[[nodiscard]] inline std::vector<contradiction>
find_contradictions(diagnosis const& d,
                    std::function<bool(std::string const&)> const& vanishes = {}) {
    return diagnosis_detail::claim_comparison(d, vanishes)();
}

} // namespace sivid

#endif
