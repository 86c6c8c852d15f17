// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_HOLDOUT_HPP
#define SIVID_DIAGNOSIS_HOLDOUT_HPP

#include <sivid/diagnosis/affected_problem.hpp>
#include <sivid/diagnosis/candidate/detail/screened.hpp>

#include <utility>
#include <vector>

namespace sivid {

/// Experiments that choose nothing. What they measured can be read only through `judged_by`, which
/// takes candidates that are fitted already: no search, fit or verdict can reach them by mistake.
class holdout {
public:
    holdout() = default;
    explicit holdout(std::vector<experiment> experiments) : experiments_(std::move(experiments)) {}

    [[nodiscard]] bool empty() const { return experiments_.empty(); }

    /// The hold-out experiments as a problem of the model and effects of a fitted candidate.
    [[nodiscard]] identification_problem judged_by(screened const& fitted,
                                                   identification_problem const& base,
                                                   std::vector<effect> const& catalogue) const {
        std::vector<effect> chosen;
        for (auto const e : fitted.figures.effects) chosen.push_back(catalogue[e]);
        auto plain = base;
        plain.experiments = experiments_;
        return affected(plain, chosen);
    }

private:
    std::vector<experiment> experiments_;
};

} // namespace sivid

#endif
