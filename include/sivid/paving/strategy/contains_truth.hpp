// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STRATEGY_CONTAINS_TRUTH_HPP
#define SIVID_PAVING_STRATEGY_CONTAINS_TRUTH_HPP

#include <sivid/model/problem.hpp>
#include <sivid/paving/judge/feasibility_test_options.hpp>
#include <sivid/paving/strategy/contractor.hpp>
#include <sivid/paving/strategy/inquiry.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_limit.hpp>

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace sivid {

/// How a contractor is tried.
struct contractor_trial {
    std::size_t parts = 8;   ///< of the prior, drawn at random about the truth
    std::size_t repeats = 2; ///< each time on what it has left
    double seconds = 10;     ///< for each part
    std::uint64_t seed = 1;
    /// Of each experiment; none: starts are not looked at.
    std::vector<std::vector<double>> starts{};
    feasibility_test_options test{};
};

/// Whether a contractor keeps parameters (and starts) that explain the data: over the prior and
/// over parts of it, again and again, and in its test of parts where it has one. For tests of a
/// contractor of one's own, on data that were made with `truth`.
/// @given  `truth` lies in the prior and explains the data
/// @cost   the contractor, `(parts + 1) * repeats` times
[[nodiscard]] inline bool contains_truth(contractor const& by,
                                         identification_problem const& problem,
                                         std::vector<double> const& truth,
                                         contractor_trial const& how = {}) {
    std::mt19937_64 random(how.seed);
    auto const share = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    for (std::size_t k = 0; k <= how.parts; ++k) {
        auto posed = problem;
        for (std::size_t j = 0; k > 0 && j < truth.size(); ++j) {
            auto const& side = problem.prior[j];
            posed.prior[j] =
                interval_traits<interval>::bounds(truth[j] - share() * (truth[j] - side.lower()),
                                                  truth[j] + share() * (side.upper() - truth[j]));
        }
        if (!by.obstacle(posed).empty()) continue;
        work_limit const limit(how.seconds);
        inquiry asked(posed, limited(how.test, limit), {}, limit);
        for (std::size_t again = 0; again < how.repeats && !asked.empty(); ++again) {
            contraction_record says;
            asked.narrow(by(asked, limit, says));
        }
        auto const left = asked.left();
        if (!contains(left.parameters, truth)) return false;
        for (std::size_t e = 0; e < how.starts.size(); ++e)
            if (!contains(left.starts[e], how.starts[e])) return false;
        auto const test = by.for_parts(posed, limit);
        if (!test) continue;
        auto const found = test(posed.prior);
        if (found.verdict == box_verdict::outside || !contains(found.rest, truth)) return false;
    }
    return true;
}

} // namespace sivid

#endif
