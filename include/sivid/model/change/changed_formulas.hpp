// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_CHANGE_CHANGED_FORMULAS_HPP
#define SIVID_MODEL_CHANGE_CHANGED_FORMULAS_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/model.hpp>

#include <map>
#include <string>
#include <vector>

namespace sivid {

/// What effects change in a model, for whoever writes its simulator.
struct changed_formulas {
    /// "delta becomes max(delta - b, 0) + min(delta + b, 0)" or "v' becomes v' - k * Ff * v / m":
    /// what is remembered of inputs, then inputs and constants, then rates, then sensors. Lines of
    /// one kind take effect together: on the right stands what was there before, v' is the rate
    /// that the model has with the changed inputs and constants. "part_1 = ..." is a part of rates
    /// that would be too long otherwise. The last lines say where and when effects act that do not
    /// act everywhere.
    std::vector<std::string> lines;
    /// By full name, "wind.wx", the symbol that stands for a parameter in them: "wx", or "k_1" and
    /// "k_2" where several effects, or an effect and the model, have a k.
    std::map<std::string, std::string> symbols;
};

/// The formulas are read off the model with the effects (`with`), so that they say what is computed
/// and nothing else. One that is very long with all its parts is left out, and said to be.
/// @throws std::invalid_argument  as `with`
/// @cost  O(size of the graph) but for the text
[[nodiscard]] SIVID_DECL changed_formulas formulas_of(recorded_model const& base,
                                                      std::vector<effect> effects);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/change/impl/changed_formulas.ipp>
#endif

#endif
