// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_POINT_JUDGEMENT_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_POINT_JUDGEMENT_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/verifier/proof/detail/proved_campaign.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

namespace io_detail {

/// What validated runs prove of the parameters that a fit ended at.
/// @param at_its_starts  explained for the fitted starts; else refuted for all starts
template <class I>
[[nodiscard]] run_finding judge_point(identification_problem const& problem,
                                      approximate_fit const& f, bool at_its_starts) {
    std::vector<box> starts;
    for (std::size_t e = 0; e < f.starts.size() && at_its_starts; ++e) {
        starts.push_back(point_within(problem.experiments[e].initial, f.starts[e]));
    }
    enclosure_options const fine{
        .order = 14, .tolerance = 1e-11, .relative_tolerance = 1e-3, .minimum_step = 1e-7};
    proved_campaign<I> campaign(problem, std::move(starts), fine);
    auto const p = point_box(f.parameters);
    return campaign.judge(campaign.learn(p, false), p);
}

} // namespace io_detail

} // namespace sivid

#endif
