// SPDX-License-Identifier: MIT
#ifndef SIVID_TEXT_READ_MODEL_HPP
#define SIVID_TEXT_READ_MODEL_HPP

/// @file
/// Needs toml++ (Debian: libtomlplusplus-dev; CMake: sivid::text).

#include <sivid/compiled.hpp>
#include <sivid/text/model_text_error.hpp>
#include <sivid/text/text_model.hpp>

#include <filesystem>
#include <string>

namespace sivid {

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

/// Reads effects of a model in C++ from a file of the format sivid-effects-1: named parts in [let],
/// and [effect.NAME] as in a model's file, over the model's states, constants, inputs and channels.
/// @guarantee  as `read_model`
/// @throws model_text_error, input_error  as there; also where the model has names that formulas
///                                        cannot hold, or a unit that is none
[[nodiscard]] SIVID_DECL std::vector<effect> read_effects(std::filesystem::path const& file,
                                                          recorded_model const& on);

/// The same from a text.
/// @param name  of the text, for messages
[[nodiscard]] SIVID_DECL std::vector<effect>
effects_from_text(std::string text, std::string const& name, recorded_model const& on);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/text/impl/read_model.ipp>
#endif

#endif
