// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_HOLDOUT_HPP
#define SIVID_DIAGNOSIS_HOLDOUT_HPP

#include <sivid/approximate/candidate/screened.hpp>
#include <sivid/diagnosis/candidate/detail/explained_hull.hpp>
#include <sivid/diagnosis/candidate/detail/sliced_input.hpp>
#include <sivid/model/affected_problem.hpp>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// A candidate's problems over a box of its parameters, on the data that it was fitted to and on
/// held-out ones, in one form.
struct fitted_set {
    identification_problem fit, judged;
    std::vector<combination_hull> products; ///< of its unknowns
};

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
        return affected(with_own(base), effects_of(fitted, catalogue));
    }
    /// The same over a box of its parameters, beside the problem that it was fitted to, if one of
    /// them changes a recorded input so that enclosures do not follow (`sliced_input_of`).
    [[nodiscard]] std::optional<fitted_set> judged_over(screened const& fitted,
                                                        identification_problem const& base,
                                                        std::vector<effect> const& catalogue,
                                                        explained_hull const& explaining) const {
        auto const own = with_own(base);
        auto const effects = effects_of(fitted, catalogue);
        auto const fit = sliced_input_of(base, effects, own.experiments);
        auto const sliced = sliced_input_of(own, effects, base.experiments);
        if (!fit || !sliced) return std::nullopt;
        fitted_set result{
            fit->over(explaining.parameters), sliced->over(explaining.parameters), {}};
        result.products = products_in(result.fit, fitted.problem, *fit, explaining.products);
        // All samples count, and outliers of all of an experiment.
        std::size_t wanted = 0, kept = 0;
        bool whole = true;
        for (auto const& x : experiments_) {
            wanted += x.measurements.size();
            whole = whole &&
                    (x.outliers == 0 || result.judged.experiments.size() == experiments_.size());
        }
        for (auto const& x : result.judged.experiments) kept += x.measurements.size();
        return whole && kept == wanted ? std::optional{std::move(result)} : std::nullopt;
    }
    [[nodiscard]] static std::vector<effect> effects_of(screened const& fitted,
                                                        std::vector<effect> const& catalogue) {
        std::vector<effect> chosen;
        for (auto const e : fitted.figures.effects) chosen.push_back(catalogue[e]);
        return chosen;
    }

private:
    [[nodiscard]] identification_problem with_own(identification_problem base) const {
        base.experiments = experiments_;
        return base;
    }

    std::vector<experiment> experiments_;
};

} // namespace sivid

#endif
