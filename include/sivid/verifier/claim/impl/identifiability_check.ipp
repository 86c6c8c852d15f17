// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_IMPL_IDENTIFIABILITY_CHECK_IPP
#define SIVID_VERIFIER_CLAIM_IMPL_IDENTIFIABILITY_CHECK_IPP

#include <sivid/verifier/claim/detail/identifiability_check.hpp>

#include <sivid/compiled.hpp>
#include <sivid/paving/identifiability/detail/output_sensitivities.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace sivid {

SIVID_DECL stored_identification::identifiability_claims claims_of(identifiability const& found) {
    stored_identification::identifiability_claims result;
    for (auto const& q : found.unknowns) {
        result.unknowns.push_back(q.name);
        result.at[q.name] =
            q.experiment ? found.starts[*q.experiment][q.index] : found.parameters[q.index];
    }
    result.least_rank = found.least_rank;
    result.most_rank = found.most_rank;
    for (auto const& m : found.free) {
        if (!m.proved) continue;
        std::map<std::string, long> weights;
        for (std::size_t c = 0; c < m.weights.size(); ++c) {
            if (m.weights[c] != 0) weights[found.unknowns[c].name] = m.weights[c];
        }
        result.proved.push_back(io_detail::motion_claim(
            m.kind == motion_kind::scaling ? "scaling" : "translation", weights));
    }
    for (auto const& f : found.fixed)
        if (f.proved) result.proved.push_back("fixed " + f.formula);
    return result;
}

SIVID_DECL check_finding check_identifiability(identification_problem const& problem,
                                               stored_identification const& stored,
                                               std::function<bool()> const& keep_going) {
    using outcome = check_finding::outcome;
    std::string const what = "identifiability";
    if (!stored.identifiability) return {what, outcome::nothing, ""};
    auto const& said = *stored.identifiability;
    identifiability_options options;
    options.enclosure.keep_going = keep_going;
    auto at = problem.prior;
    for (auto const& e : problem.experiments) options.at_starts.push_back(e.initial);
    for (auto const& q : unknowns_of(problem, true)) {
        auto const own = said.at.find(q.name);
        if (own == said.at.end())
            return {what, outcome::undecided, "for which " + q.name + " is not stated"};
        (q.experiment ? options.at_starts[*q.experiment] : at)[q.index] = own->second;
    }
    auto const found = claims_of(identifiability_of(problem, at, options));
    if (said.unknowns != found.unknowns)
        return {what, outcome::refuted, "other unknowns than those of the problem"};
    if (said.least_rank > found.most_rank || said.most_rank < found.least_rank)
        return {what, outcome::refuted,
                "the rank is " + std::to_string(found.least_rank) + " to " +
                    std::to_string(found.most_rank)};
    if (said.least_rank > found.least_rank || said.most_rank < found.most_rank)
        return {what, outcome::undecided, "the rank is not proved anew"};
    for (auto const& claim : said.proved) {
        if (std::find(found.proved.begin(), found.proved.end(), claim) == found.proved.end())
            return {what, outcome::undecided, "not proved anew: " + claim};
    }
    return {what, outcome::verified,
            "rank and " + std::to_string(said.proved.size()) + " formulas and motions, anew"};
}

} // namespace sivid

#endif
