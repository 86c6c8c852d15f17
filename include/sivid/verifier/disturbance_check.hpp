// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_DISTURBANCE_CHECK_HPP
#define SIVID_VERIFIER_DISTURBANCE_CHECK_HPP

#include <sivid/paving/least_disturbance.hpp>
#include <sivid/verifier/check_finding.hpp>
#include <sivid/verifier/proof/detail/plain_proof.hpp>

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace sivid {

/// Whether a witness shows the upper size of disturbances: its pieces are no larger, and a run of
/// first-order sets with them keeps all bounds.
/// @param keep_going  once false, nothing is proved
[[nodiscard]] inline check_finding
check_disturbance_witness(identification_problem const& problem, disturbance_set const& set,
                          disturbance_bound const& found, std::function<bool()> const& keep_going) {
    using outcome = check_finding::outcome;
    using traits = interval_traits<interval>;
    if (!found.witness) return {"witness", outcome::nothing, ""};
    double const size = found.size.upper();
    auto posed = with_disturbance(problem, set, size);
    for (std::size_t s = 0; s < posed.experiments.size(); ++s) {
        for (std::size_t q = 0; q < set.equations.size(); ++q) {
            auto const& of = set.equations[q];
            bool undefined = false;
            std::vector<double> from, values;
            for (auto const& p : found.pieces) {
                if (p.experiment != s || p.equation != of.index) continue;
                auto const share = traits::div(traits::point(std::abs(p.value)),
                                               traits::point(of.scale), undefined);
                if (!(share.upper() <= size))
                    return {"witness", outcome::refuted, "a piece is larger"};
                from.push_back(p.from);
                values.push_back(p.value);
            }
            posed.experiments[s].inputs[problem.model.about.inputs.size() + q] =
                sampled_signal(from, values, interpolation::hold);
        }
    }
    approximate_fit const at{found.witness->parameters, found.witness->starts, {}};
    bool const kept =
        io_detail::judge_point<interval>(posed, at, true, keep_going) == run_finding::explained;
    if (!kept && !keep_going()) return {"witness", outcome::undecided, "no time is left"};
    return {"witness", kept ? outcome::verified : outcome::undecided,
            "by first-order sets, with its disturbances"};
}

} // namespace sivid

#endif
