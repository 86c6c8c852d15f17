// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_EFFECT_HULLS_CHECK_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_EFFECT_HULLS_CHECK_HPP

#include <sivid/diagnosis/candidate/detail/describe_candidate.hpp>
#include <sivid/diagnosis/candidate/detail/effect_hulls.hpp>
#include <sivid/diagnosis/candidate/detail/episode_hulls.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/model/named_effects.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/verifier/claim/detail/finding_of_all.hpp>
#include <sivid/verifier/claim/detail/inflation_proof.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sivid::io_detail {

/// The problem with these effects; `why` says what is unknown about them otherwise.
[[nodiscard]] inline std::optional<identification_problem>
with_effects(identification_problem const& base, std::vector<effect> const& catalogue,
             std::vector<std::string> const& effects, std::vector<effect>& named,
             std::string& why) {
    try {
        named = effects_named(catalogue, effects, &base.model.about);
        return affected(base, named);
    } catch (std::invalid_argument const& e) {
        why = e.what();
        return std::nullopt;
    }
}

/// What a diagnosis says of the parameters of its answer: hulls, combinations, times.
class effect_hulls_check {
    using outcome = check_finding::outcome;

public:
    effect_hulls_check(identification_problem const& base, std::vector<effect> const& catalogue,
                       diagnosis const& d, inflation_proof const& proof, work_limit const& limit)
        : base_(&base), catalogue_(&catalogue), d_(&d), proof_(&proof), limit_(&limit) {}

    /// As found anew; no sides where none was.
    [[nodiscard]] explained_hull const& found() const { return hull_; }

    /// Hulls of the answer: what lies outside of them is excluded anew.
    [[nodiscard]] check_finding operator()(cause const* c) {
        finding_of_all all;
        auto const stated = [](std::vector<named_estimate> const& list) {
            return std::ranges::any_of(list, [](auto const& e) { return e.hull.has_value(); });
        };
        for (auto const& other : d_->causes) {
            if (&other == c) continue;
            if (stated(other.parameters) || !other.onsets.empty() || !other.ends.empty())
                all.note(outcome::undecided, "hulls of a cause that is not the answer");
        }
        bool const some =
            (c != nullptr && (stated(c->parameters) || !c->onsets.empty() || !c->ends.empty())) ||
            stated(d_->constants) || !d_->combinations.empty();
        std::string why;
        std::vector<effect> named;
        auto const p = some && c != nullptr
                           ? with_effects(*base_, *catalogue_, c->effects, named, why)
                           : std::nullopt;
        if (some && !p) all.note(outcome::undecided, "hulls of no answer, or of another one");
        if (!p) return all.finding("hulls", "");
        effect_hull_options how;
        how.seconds = 0.4 * limit_->seconds();
        how.boxes = 40000;
        how.keep_going = *limit_;
        how.test = proof_->test();
        bool const later =
            named.size() == 1 && (named.front().begins_later() || named.front().ends());
        if (later) {
            auto const found = hulls_of_episodes(*base_, named.front(), how);
            hull_ = explained_hull{found.parameters};
            times(c->onsets, found, true, all);
            times(c->ends, found, false, all);
        } else {
            hull_ = effect_hulls(*base_, named, how);
            if (!c->onsets.empty() || !c->ends.empty())
                all.note(outcome::refuted, "times of effects that act all the time");
        }
        sides(*p, *c, all);
        return all.finding("hulls", "all that lies outside is excluded anew");
    }

private:
    /// The ranges of parameters and of combinations that are stated against those found.
    void sides(identification_problem const& p, cause const& c, finding_of_all& all) const {
        auto const range = [&](named_estimate const& e) {
            if (!e.hull) return;
            auto const j = std::ranges::find(p.choice.unknown, e.name) - p.choice.unknown.begin();
            auto const at = static_cast<std::size_t>(j);
            if (at >= hull_.parameters.size()) {
                all.note(outcome::refuted, "a hull of no parameter: " + e.name);
                return;
            }
            auto says = compared(hull_.parameters[at], *e.hull);
            // A hull is no more than an enclosure: only a proof that some lie outside refutes it.
            if (says != outcome::verified) says = outside(p, at, *e.hull);
            all.note(says, "values of " + e.name + " beyond its hull are not excluded");
        };
        for (auto const& e : c.parameters) range(e);
        for (auto const& e : d_->constants) range(e);
        if (d_->combinations.empty()) return;
        auto const again = told_combinations(p, d_->constants, hull_);
        for (auto const& k : d_->combinations) {
            auto const at =
                std::ranges::find(again, k.about.name, [](auto const& t) { return t.about.name; });
            bool const found = at != again.end() && k.about.hull && at->about.hull &&
                               at->about.unit == k.about.unit &&
                               within_stated(*at->about.hull, *k.about.hull);
            all.note(found ? outcome::verified : outcome::undecided,
                     "the range of " + k.about.name + " is not proved again");
        }
    }
    /// Whether nothing beyond a range of parameter j explains the data.
    [[nodiscard]] outcome outside(identification_problem const& p, std::size_t j,
                                  interval const& range) const {
        using traits = interval_traits<interval>;
        auto result = outcome::verified;
        for (bool const above : {false, true}) {
            auto slab = p;
            auto const& whole = p.prior[j];
            bool const none =
                above ? range.upper() >= whole.upper() : range.lower() <= whole.lower();
            if (none) continue;
            slab.prior[j] =
                above ? traits::bounds(std::max(range.upper(), whole.lower()), whole.upper())
                      : traits::bounds(whole.lower(), std::min(range.lower(), whole.upper()));
            auto const says = proof_->none_explains(slab, 0.1);
            if (says == outcome::refuted) return says;
            if (says == outcome::undecided) result = says;
        }
        return result;
    }
    void times(std::vector<named_estimate> const& stated, episode_hulls const& found, bool onset,
               finding_of_all& all) const {
        for (auto const& t : stated) {
            auto const& list = base_->experiments;
            auto const e = static_cast<std::size_t>(
                std::ranges::find(list, t.name, &experiment::name) - list.begin());
            bool const there =
                e < list.size() && e < found.times.size() && t.hull &&
                within_stated(onset ? found.times[e].on : found.times[e].off, *t.hull);
            all.note(there ? outcome::verified : outcome::undecided,
                     "when it acts in " + t.name + " is not proved again");
        }
    }

    identification_problem const* base_;
    std::vector<effect> const* catalogue_;
    diagnosis const* d_;
    inflation_proof const* proof_;
    work_limit const* limit_;
    explained_hull hull_;
};

} // namespace sivid::io_detail

#endif
