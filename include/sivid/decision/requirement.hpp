// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_REQUIREMENT_HPP
#define SIVID_DECISION_REQUIREMENT_HPP

#include <sivid/compiled.hpp>
#include <sivid/decision/requirement/requirement_types.hpp>
#include <sivid/model/model.hpp>

#include <string_view>

namespace sivid {

/// Reads a requirement and enters what it compares into the graph of `model`.
///   Numbers are decimals, read outward; times mean the nearest double.
/// @param end  of the motion, in the model's unit of time, > 0
/// @throws requirement_error also for windows that reach beyond the end; any text ends so or in a
///         requirement: at most 10 000 characters, nested at most 60 deep
[[nodiscard]] SIVID_DECL requirement parse_requirement(std::string_view text, recorded_model& model,
                                                       double end);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/decision/impl/requirement.ipp>
#endif

#endif
