// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CLAIM_DETAIL_SHARED_BOUNDS_HPP
#define SIVID_DIAGNOSIS_CLAIM_DETAIL_SHARED_BOUNDS_HPP

#include <sivid/approximate/candidate/screened.hpp>
#include <sivid/diagnosis/candidate/detail/describe_candidate.hpp>
#include <sivid/diagnosis/claim/detail/embedded_problem.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/diagnosis/diagnosis_run.hpp>
#include <sivid/diagnosis/gap/detail/gap_proof.hpp>
#include <sivid/paving/identification.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace diagnosis_detail {

/// What is proved of one hypothesis: the model as it is, or with effects.
struct hypothesis {
    screened const* posed = nullptr;
    std::vector<std::string> effects{}; ///< sorted, without what wider priors add to their names
    inflation_range range = unknown_inflation();
    std::optional<named_witness> witness{}; ///< attains `range.upper()`
    std::vector<std::string> assumptions{};
};

/// Lets bounds hold wherever they follow.
class bound_sharing {
public:
    explicit bound_sharing(diagnosis_run& run) : run_(&run), d_(&run.result) {}

    void operator()() {
        from_parts();
        collect();
        auto const proved = all_; // what follows from what is transitive: one pass does
        for (std::size_t i = 0; i < all_.size(); ++i)
            for (std::size_t j = 0; j < all_.size(); ++j)
                if (i != j) share(proved[i], proved[j], all_[i], all_[j]);
        for (std::size_t k = 0; k < d_->causes.size(); ++k) state(d_->causes[k], all_[k + 1]);
        set_base(all_.front());
        set_answer();
        to_parts();
    }

private:
    /// A scenario or a channel alone is met at least as well as all data; where the bounds of a
    /// part have grown enough, all bounds have.
    void from_parts() {
        for (auto const* parts : {&d_->scenario_inflation, &d_->channel_inflation})
            for (auto const& part : *parts)
                if (part.hull) raise(d_->inflation, part.hull->lower());
        auto& base = run_->base_bound;
        for (auto const& c : d_->confined) {
            bool const complete =
                c.witness.parameters.size() == run_->base.prior.size() && c.factor.upper() >= 1;
            if (!complete || !lower_to(d_->inflation, c.factor.upper())) continue;
            base.witness = verified(c.witness);
            d_->witness = c.witness;
            add(base.assumptions, c.assumptions);
        }
        base.range = d_->inflation;
    }
    void to_parts() {
        for (auto* parts : {&d_->scenario_inflation, &d_->channel_inflation}) {
            for (auto& part : *parts) {
                if (!part.hull || !lower_to(*part.hull, d_->inflation.upper())) continue;
                part.value = part.hull->upper();
            }
        }
        for (auto& c : d_->confined) raise(c.factor, d_->inflation.lower());
    }

    void collect() {
        auto const& base = run_->base_bound;
        auto& first = all_.emplace_back();
        first = {&run_->candidates.front(), {}, d_->inflation, {}, base.assumptions};
        if (base.witness)
            first.witness = named(run_->base, base.witness->parameters, base.witness->starts);
        for (auto const& c : d_->causes) {
            auto const at =
                std::find_if(run_->candidates.begin(), run_->candidates.end(), [&](auto const& s) {
                    return names_of(s.figures, run_->catalogue) == c.effects;
                });
            auto& h = all_.emplace_back();
            h = {at == run_->candidates.end() ? nullptr : &*at, c.effects, c.inflation, c.witness,
                 c.assumptions};
            for (auto& e : h.effects) e = without_wider(std::move(e));
            std::sort(h.effects.begin(), h.effects.end());
        }
    }

    /// Below, what holds for a richer model holds for a poorer one; above, the other way round.
    void share(hypothesis const& poorer, hypothesis const& richer, hypothesis& to_poorer,
               hypothesis& to_richer) const {
        bool const below = richer.range.lower() > poorer.range.lower();
        bool const above = poorer.witness && poorer.range.upper() < richer.range.upper();
        if (!(below || above) || poorer.posed == nullptr || richer.posed == nullptr) return;
        if (richer.range.lower() > poorer.range.upper()) return; // they contradict each other
        auto const &few = poorer.effects, &many = richer.effects;
        if (!std::includes(many.begin(), many.end(), few.begin(), few.end())) return;
        auto const how = embedded(poorer.posed->problem, richer.posed->problem);
        if (!how) return;
        if (below) raise(to_poorer.range, richer.range.lower());
        if (above && lower_to(to_richer.range, poorer.range.upper())) {
            to_richer.witness = moved(*poorer.witness, *how, richer.posed->problem);
            add(to_richer.assumptions, poorer.assumptions);
        }
    }
    /// A witness of a poorer model as one of a richer.
    [[nodiscard]] static named_witness moved(named_witness const& w, embedding const& how,
                                             identification_problem const& richer) {
        std::vector<double> values;
        for (auto const& p : how)
            values.push_back(p.same ? w.parameters.at(*p.same).value : p.neutral);
        return named(richer, values, starts_of(w));
    }
    [[nodiscard]] static std::vector<std::vector<double>> starts_of(named_witness const& w) {
        std::vector<std::vector<double>> starts;
        for (auto const& s : w.starts) {
            auto& own = starts.emplace_back();
            for (auto const& x : s.states) own.push_back(x.value);
        }
        return starts;
    }
    [[nodiscard]] static verified_witness verified(named_witness const& w) {
        verified_witness result;
        for (auto const& p : w.parameters) result.parameters.push_back(p.value);
        result.starts = starts_of(w);
        return result;
    }

    static void state(cause& c, hypothesis const& h) {
        bool const better = h.range.upper() < c.inflation.upper();
        c.inflation = h.range;
        if (better) {
            c.witness = h.witness;
            add(c.assumptions, h.assumptions);
        }
        if (c.verdict != cause_verdict::undecided) return; // an exclusion may rest on a relation
        if (c.inflation.upper() <= 1) c.verdict = cause_verdict::explains;
        if (c.inflation.lower() > 1) c.verdict = cause_verdict::excluded;
    }
    void set_base(hypothesis const& h) {
        d_->inflation = run_->base_bound.range = h.range;
        d_->gap = gap_of(h.range);
        if (d_->gap != gap_verdict::undecided) d_->reach.clear();
    }
    void set_answer() {
        if (run_->answer == 0) {
            if (d_->remainder) d_->remainder->inflation = d_->inflation;
            return;
        }
        auto const names = names_of(run_->candidates[run_->answer].figures, run_->catalogue);
        for (auto const& c : d_->causes) {
            if (c.effects != names) continue;
            auto& bound = run_->answer_bound;
            if (c.inflation.upper() < bound.range.upper() && c.witness) {
                bound.witness = verified(*c.witness);
                add(bound.assumptions, c.assumptions);
            }
            bound.range = c.inflation;
            if (d_->remainder) d_->remainder->inflation = c.inflation;
            if (d_->shrink_fit) d_->shrink_fit = shrink(d_->inflation, c.inflation);
        }
    }

    /// A bound from below that does not contradict the one from above.
    static void raise(inflation_range& range, double lower) {
        if (lower > range.lower() && lower <= range.upper())
            range = interval_traits<interval>::bounds(lower, range.upper());
    }
    /// @returns  whether the upper end moved
    static bool lower_to(inflation_range& range, double upper) {
        if (!(upper < range.upper()) || upper < range.lower()) return false;
        range = interval_traits<interval>::bounds(range.lower(), upper);
        return true;
    }
    static void add(std::vector<std::string>& to, std::vector<std::string> const& more) {
        for (auto const& a : more)
            if (std::find(to.begin(), to.end(), a) == to.end()) to.push_back(a);
    }

    diagnosis_run* run_;
    diagnosis* d_;
    std::vector<hypothesis> all_; ///< the model as it is, then the causes in their order
};

} // namespace diagnosis_detail

/// Carries each bound of an inflation to wherever it follows, so that no figure of a diagnosis says
/// less than another one implies:
///   - from below, what is proved of a model with more effects holds for the one with fewer, and
///     what is proved with a wider prior for the narrower one, where `embedded` shows that the
///     further effects may vanish; what is proved of a part of the data holds for all of it;
///   - from above, with its witness, the other way round; and where bounds of a part of the data
///     are grown until a parameter explains all data, all bounds grown so let it, too.
/// Verdicts follow their bounds. Bounds that contradict each other are left for
/// `withdraw_contradictions`.
/// @given  candidates, causes and what was proved of them are known
/// @cost  a comparison of recorded models for each two hypotheses of which one may follow
inline void share_bounds(diagnosis_run& run) {
    if (run.candidates.empty()) return;
    diagnosis_detail::bound_sharing{run}();
}

} // namespace sivid

#endif
