// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_JUDGE_IMPL_RESPONSE_JUDGEMENT_IPP
#define SIVID_PAVING_JUDGE_IMPL_RESPONSE_JUDGEMENT_IPP

#include <sivid/paving/judge/detail/response_judgement.hpp>

#include <sivid/compiled.hpp>
#include <sivid/paving/contract/detail/explaining_starts.hpp>
#include <sivid/paving/contract/detail/lp_contractor.hpp>
#include <sivid/paving/response/local_response.hpp>
#include <sivid/paving/verdict.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sivid {

SIVID_DECL response_judgement judge_by_responses(response_list const& all,
                                                 response_list const& chosen, box part,
                                                 judgement_options const& options) {
    response_judgement result{.rest = std::move(part)};
    auto& rest = result.rest;
    std::vector<std::size_t> open; // experiments that are not explained so far
    result.smear.assign(rest.size(), 0.0);
    for (std::size_t e = 0; e < all.size(); ++e) {
        auto narrowed = rest;
        auto const says = assess(*all[e], narrowed);
        if (says.refuted) {
            result.verdict = box_verdict::outside;
            result.proof.push_back({proof_step::kind::empty});
            return result;
        }
        bool holds = says.explained;
        if (!holds && chosen[e] != all[e]) {
            auto copy = rest;
            holds = assess(*chosen[e], copy).explained;
        }
        if (!holds) {
            open.push_back(e);
            result.share = std::max(result.share, says.sharpness);
            if (all[e]->outputs() < all[e]->measurements) {
                result.share = std::numeric_limits<double>::infinity();
            }
        }
        if (options.contract) {
            narrowed = rounded_within(narrowed, rest);
            add_cuts(result.proof, rest, narrowed);
            rest = std::move(narrowed);
        }
        for (std::size_t j = 0; j < rest.size(); ++j) result.smear[j] += says.smear[j];
    }
    bool const inside = std::all_of(open.begin(), open.end(), [&](std::size_t e) {
        return options.contract && options.any_start &&
               explaining_starts(*all[e], rest)().has_value();
    });
    result.verdict = inside ? box_verdict::inside : box_verdict::undecided;
    if (!inside && options.contract && options.cut && !lp_contractor()(all, rest, &result.proof)) {
        result.verdict = box_verdict::outside;
        result.share = 0;
    }
    return result;
}

} // namespace sivid

#endif
