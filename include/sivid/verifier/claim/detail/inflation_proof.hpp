// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_INFLATION_PROOF_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_INFLATION_PROOF_HPP

#include <sivid/approximate/fit/detail/counterexample.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/diagnosis/gap/detail/confined_gap.hpp>
#include <sivid/diagnosis/verification.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/inflation.hpp>
#include <sivid/paving/inflation/observer_refutation.hpp>
#include <sivid/verifier/claim/check_finding.hpp>
#include <sivid/verifier/claim/detail/finding_of_all.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// The point that a witness names, if it is one of the problem: parameters of the prior, allowed
/// starts. States that effects added start where the parameters say.
[[nodiscard]] inline std::optional<approximate_fit> point_of(identification_problem const& p,
                                                             named_witness const& w) {
    approximate_fit result;
    auto const value = [](std::vector<named_estimate> const& all,
                          std::string const& name) -> std::optional<double> {
        auto const at = std::ranges::find(all, name, &named_estimate::name);
        return at == all.end() ? std::nullopt : std::optional{at->value};
    };
    if (w.parameters.size() != p.prior.size() || w.starts.size() != p.experiments.size())
        return std::nullopt;
    for (std::size_t j = 0; j < p.prior.size(); ++j) {
        auto const x = value(w.parameters, p.choice.unknown[j]);
        if (!x || !contains(p.prior[j], *x)) return std::nullopt;
        result.parameters.push_back(*x);
    }
    auto const& states = p.model.about.states;
    for (auto const& e : p.experiments) {
        auto const at = std::ranges::find(w.starts, e.name, &named_witness::start::scenario);
        if (at == w.starts.end()) return std::nullopt;
        auto& start = result.starts.emplace_back();
        for (std::size_t i = 0; i < states.size(); ++i) {
            auto const x = value(at->states, states[i].name);
            bool const added = std::ranges::any_of(p.model.added_states,
                                                   [i](auto const& a) { return a.state == i; });
            if (!x || (!added && !contains(e.initial[i], *x))) return std::nullopt;
            start.push_back(*x);
        }
    }
    return result;
}

/// Proofs about the least factor by which bounds must grow until a parameter explains the data, by
/// the provers of the diagnosis.
class inflation_proof {
    using outcome = check_finding::outcome;

public:
    /// @param limit  of all that it does; outlives it
    inflation_proof(feasibility_test_options test, work_limit const& limit)
        : test_(limited(std::move(test), limit)), limit_(&limit) {}

    /// Whether a validated run of the witness proves that the factor is `most` at most.
    /// @param assumptions  receives what the run rests on; may be null
    [[nodiscard]] outcome at_most(identification_problem const& p, named_witness const& w,
                                  double most,
                                  std::vector<std::string>* assumptions = nullptr) const {
        auto const point = point_of(p, w);
        if (!point) return outcome::refuted;
        auto const proved = verify_at(p, *point, test_);
        if (assumptions != nullptr) *assumptions = proved.assumptions;
        return proved.range.upper() <= most  ? outcome::verified
               : proved.range.lower() > most ? outcome::refuted
                                             : outcome::undecided;
    }

    /// Whether a search finds parameters for which the factor is `most` at most, where nobody says
    /// which they are.
    [[nodiscard]] outcome found_at_most(identification_problem const& p, double most,
                                        double share) const {
        if (p.model.has_memory()) return outcome::undecided;
        auto const found = bounds(p, share * limit_->seconds());
        return !io_detail::below(most, found.upper()) ? outcome::verified
               : found.lower() > most                 ? outcome::refuted
                                                      : outcome::undecided;
    }

    /// Whether no parameter explains the data while all bounds are `least` times as wide, or less.
    /// @param share  of the time that is left
    [[nodiscard]] outcome at_least(identification_problem const& p, double least,
                                   double share) const {
        if (!(least > 0)) return outcome::verified;
        if (!p.model.has_memory() && !has_wide_starts(p)) {
            auto const found = bounds(p, 0.5 * share * limit_->seconds());
            if (!io_detail::below(found.lower(), least)) return outcome::verified;
            if (found.upper() <= clearly * least) return outcome::refuted;
        }
        return none_explains(bound_growth::of(p, {})(p, least - 1), share);
    }

    /// What a search proves of the factor.
    [[nodiscard]] inflation_bound search(identification_problem const& p,
                                         approximate_fit const* guess, double seconds) const {
        inflation_options how;
        how.relative_width = 0.01;
        how.seconds = seconds;
        how.keep_going = *limit_;
        how.test = test_;
        return bound_inflation(p, guess, how);
    }
    [[nodiscard]] interval bounds(identification_problem const& p, double seconds) const {
        return search(p, nullptr, seconds).value;
    }

    /// Whether no parameter of the prior explains the data; refuted where one does with room to
    /// spare: what was rounded away is no contradiction.
    /// @cost  a fit, then a search until it is decided, or the time is up
    [[nodiscard]] outcome none_explains(identification_problem const& p, double share) const {
        double const seconds = share * limit_->seconds();
        bool const memory = p.model.has_memory();
        counterexample_options fits;
        fits.seconds = 0.2 * seconds;
        fits.keep_going = *limit_;
        fits.confirms = [&](approximate_fit const& f) {
            return verify_at(p, f, test_).range.upper() <= clearly;
        };
        if (find_explaining_point(p, {p.prior}, fits)) return outcome::refuted;
        if (memory || !(*limit_)()) return outcome::undecided; // no search over delays
        bool const wide = has_wide_starts(p);
        if (wide && by_observers(p, 0.4 * seconds)) return outcome::verified;
        inflation_options how;
        how.only_verdict = true;
        how.relative_width = 0;
        how.seconds = 0.5 * seconds;
        how.keep_going = *limit_;
        how.test = test_;
        auto const found = bound_inflation(p, nullptr, how).value;
        if (found.lower() > 1) return outcome::verified;
        if (found.upper() <= clearly) return outcome::refuted;
        return !wide && by_observers(p, 0.3 * seconds) ? outcome::verified : outcome::undecided;
    }

    [[nodiscard]] feasibility_test_options const& test() const { return test_; }

private:
    /// An inflation that is below 1 by more than roundings of decimals.
    static constexpr double clearly = 1 - 1e-6;

    [[nodiscard]] bool by_observers(identification_problem const& p, double seconds) const {
        observer_effort most;
        most.boxes = static_cast<std::size_t>(-1);
        most.seconds = seconds;
        most.go_on = *limit_;
        most.only_verdict = true;
        return inflation_refuted_by_observers(p, detail::infinity, most).lower > 1;
    }

    feasibility_test_options test_;
    work_limit const* limit_;
};

} // namespace sivid

#endif
