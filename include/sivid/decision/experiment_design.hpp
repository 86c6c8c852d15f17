// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_EXPERIMENT_DESIGN_HPP
#define SIVID_DECISION_EXPERIMENT_DESIGN_HPP

#include <sivid/compiled.hpp>
#include <sivid/decision/design/design_goal.hpp>
#include <sivid/decision/promised_width.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/decision/verification.hpp>
#include <sivid/model/manoeuvre.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sivid {

/// How an experiment is sought.
struct design_options {
    double seconds = 10;
    double target = 0;      ///< a promise that small, as a share, is good enough
    std::size_t proved = 4; ///< manoeuvres whose promise is sharpened, the most promising ones
    std::size_t pairs = 60; ///< of parts, for each of them
    run_options run{};
    std::function<bool()> keep_going{}; ///< false ends the work; what is proved stays proved
};

/// A manoeuvre with settings, and what is known of it.
struct tried_manoeuvre {
    std::string name;
    std::vector<manoeuvre_setting> about; ///< of the settings
    std::vector<double> settings;
    std::vector<signal> inputs;
    double estimate = 1;                        ///< of the factor; not proved
    std::optional<promise> promised{};          ///< where it was proved
    std::optional<requirement_answer> limits{}; ///< whether the limits are kept, where it was asked

    /// All that was asked of it is proved.
    [[nodiscard]] bool allowed() const {
        return promised && (!limits || *limits == requirement_answer::proved);
    }
    /// The product of the goals' factors; of two models 0 where they are told apart; 1 where
    /// nothing is proved.
    [[nodiscard]] double factor() const;
};

struct experiment_design {
    /// Best first: those that are allowed by their proved factor, then the rest by their estimate.
    std::vector<tried_manoeuvre> tried;
    std::size_t simulated = 0; ///< settings that were looked at
    std::size_t integrations = 0;
    double seconds = 0;

    /// The one to make; nothing where none has a proved promise and keeps the limits.
    [[nodiscard]] tried_manoeuvre const* best() const {
        return tried.empty() || !tried.front().allowed() ? nullptr : &tried.front();
    }
};

/// What was asked of a design, and what came of it.
struct design_answer {
    std::vector<design_goal> goals;
    std::string first, second; ///< the two models, in words
    double target = 0.5;       ///< the share of its width that each goal is to keep,
    bool jointly = false;      ///< or, of the volume of their box, all of them together
    planned_measurements plan;
    std::string limits; ///< "" for none
    std::vector<varied_input> varied;
    /// A goal that the equations hide, and what can be told instead; empty for none.
    std::string hidden;
    std::vector<std::string> instead;
    /// Whatever is measured, it keeps more than its target: nothing was sought.
    bool impossible = false;
    experiment_design found;

    /// Every goal, or their box, keeps at most its share, proved.
    [[nodiscard]] bool met() const {
        auto const* best = found.best();
        if (best == nullptr) return false;
        if (goals.empty()) return best->promised->told_apart;
        if (jointly) return best->factor() <= target;
        for (auto const& g : best->promised->goals) {
            if (!(g.factor() <= target)) return false;
        }
        return true;
    }
};

/// Seeks the manoeuvre of a menu whose data narrow down some goals most, at worst.
///   Settings are chosen by what one run over a small box about the middle says of the pairs that
/// the data could not tell apart, as if outputs were linear; the best are proved: what they promise
/// by `promise_widths`, that they keep the limits by `verify`.
/// @param problem  its inputs are replaced by those of each manoeuvre
/// @param plan     what is measured, when, with which errors
/// @param limits   what has to hold of the motion for all parameters and starts; may be null
/// @throws std::invalid_argument  for goals, inputs or errors that do not fit the model
/// @guarantee  promises and limits are proved; that nothing better exists is not
/// @cost  hundreds of simulations with sensitivities, integrations over parts for the best few
[[nodiscard]] SIVID_DECL experiment_design design_experiment(prediction_problem const& problem,
                                                             std::vector<manoeuvre> const& menu,
                                                             planned_measurements const& plan,
                                                             std::vector<design_goal> const& goals,
                                                             requirement const* limits,
                                                             design_options const& options = {});

/// Seeks the manoeuvre of a menu whose data refute one of two models, whichever they are of: see
/// `tell_apart`. Both have the same inputs and channels.
/// @param limits_of_first, limits_of_second  what has to hold of the motions of each; may be null
/// @throws std::invalid_argument  for models of other inputs or channels, or unequal plans
/// @guarantee  that the models are told apart, and that the limits are kept, is proved where it is
///             said; that no manoeuvre does is not
/// @cost  as that of `design_experiment`, with pairs of parts of both models
[[nodiscard]] SIVID_DECL experiment_design design_separation(prediction_problem const& first,
                                                             prediction_problem const& second,
                                                             std::vector<manoeuvre> const& menu,
                                                             planned_measurements const& plan,
                                                             requirement const* limits_of_first,
                                                             requirement const* limits_of_second,
                                                             design_options const& options = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/decision/impl/experiment_design.ipp>
#endif

#endif
