// SPDX-License-Identifier: MIT
#ifndef SIVID_TEXT_TEXT_MODEL_HPP
#define SIVID_TEXT_TEXT_MODEL_HPP

#include <sivid/io/allowed_disturbances.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/model.hpp>
#include <sivid/model/parameter_choice.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/space/box.hpp>

#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// A model that a file in the format sivid-model-1 (docs/formats.md) states, with all that
/// `identify` and `diagnose` ask for beside the data.
struct text_model {
    std::string about;                ///< what the file says of it, in a sentence or none
    recorded_model model;             ///< as `record_model` of a functor gives it
    std::vector<std::string> unknown; ///< the constants that have a prior, in the file's order
    box prior;                        ///< theirs, in the units of the constants
    std::vector<effect> effects;      ///< what the model may leave out, in the file's order
    /// What it allows for, as `[disturbance]` and `[error]` state it, in the model's units:
    /// `with_disturbance` poses a problem with it.
    allowed_disturbances disturbances;

    /// The constants with a prior are unknown, the others nominal.
    [[nodiscard]] parameter_choice parameters() const { return {unknown, {}}; }
    /// The states' own ranges: where an experiment may start that does not say so itself.
    [[nodiscard]] box start_ranges() const {
        std::vector<interval> sides;
        for (auto const& s : model.about.states) sides.push_back(s.limit.range());
        return box(std::move(sides));
    }
};

} // namespace sivid

#endif
