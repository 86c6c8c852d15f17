// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_JUDGE_DETAIL_FITTED_WITNESS_HPP
#define SIVID_PAVING_JUDGE_DETAIL_FITTED_WITNESS_HPP

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/judge/witness.hpp>
#include <sivid/work_limit.hpp>

namespace sivid::paving_detail {

/// Fits and verifies. A fit that ends by a few percent outside of the bounds may have stopped short
/// of its minimum: it goes on from there.
inline void find_witness(feasibility_test& test, identification_problem const& problem,
                         work_limit const& limit, identification& result) {
    constexpr double nearly = 1.05;
    approximate_fitter fit(problem, limit);
    auto guess = fit();
    for (bool const sharpened : {false, true}) {
        if (guess.parameters.empty()) return;
        bool const better = !result.guess || guess.inflation < result.guess->inflation;
        if (sharpened && !better) return;
        result.witness = verify_witness(test, problem, guess.parameters, guess.starts);
        result.guess = guess;
        if (result.witness || !(guess.inflation < nearly) || !limit()) return;
        guess = fit({guess.parameters, guess.starts});
    }
}

} // namespace sivid::paving_detail

#endif
