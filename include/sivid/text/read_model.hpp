// SPDX-License-Identifier: MIT
#ifndef SIVID_TEXT_READ_MODEL_HPP
#define SIVID_TEXT_READ_MODEL_HPP

/// @file
/// Needs toml++ (Debian: libtomlplusplus-dev; CMake: sivid::text).

#include <sivid/compiled.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/model.hpp>
#include <sivid/model/parameter_choice.hpp>
#include <sivid/space/box.hpp>
#include <sivid/text/model_text_error.hpp>

#include <filesystem>
#include <string>
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

    /// The constants with a prior are unknown, the others nominal.
    [[nodiscard]] parameter_choice parameters() const { return {unknown, {}}; }
    /// The states' own ranges: where an experiment may start that does not say so itself.
    [[nodiscard]] box start_ranges() const {
        std::vector<interval> sides;
        for (auto const& s : model.about.states) sides.push_back(s.limit.range());
        return box(std::move(sides));
    }
};

/// Reads a model from a file of the format sivid-model-1.
/// @guarantee  the recorded graph encloses what the equations say: numbers are the exact decimals
///             of the file, rounded outward; so are factors between units
/// @throws model_text_error  with line, column, and what to do: whatever is wrong with the file;
///                           each equation, effect and unit is tried, the domains of functions too
/// @throws input_error  where there is no such file
/// @cost  linear in the length of the file, which is 200 kB at most, times its effects
[[nodiscard]] SIVID_DECL text_model read_model(std::filesystem::path const& file);

/// The same from a text.
/// @param name  of the text, for messages
[[nodiscard]] SIVID_DECL text_model model_from_text(std::string text, std::string const& name);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/text/impl/read_model.ipp>
#endif

#endif
