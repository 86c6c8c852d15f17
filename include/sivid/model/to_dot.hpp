// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_TO_DOT_HPP
#define SIVID_MODEL_TO_DOT_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/graph/graph_listing.hpp>
#include <sivid/model/model.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace sivid {

/// The graph of a model in the DOT language of Graphviz: leaves as boxes, operations as ellipses,
/// rates and channels as double frames; edges run from operands to results, the first operand
/// first. What depends on parameters alone is green, on inputs and time alone blue, on both teal; a
/// bold frame means that a value is used more than once, a dashed edge leads to what only the
/// series of an operation need.
/// @ref  https://graphviz.org/doc/info/lang.html
[[nodiscard]] SIVID_DECL std::string to_dot(graph_listing const& listing);

[[nodiscard]] SIVID_DECL std::string to_dot(recorded_model const& model);
[[nodiscard]] SIVID_DECL std::string to_dot(bound_model const& model);
/// `to_dot(model{})` of a functor: records it first.
template <dynamic_model M>
[[nodiscard]] std::string to_dot(M const& model) {
    return to_dot(record_model(model));
}

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/impl/to_dot.ipp>
#endif

#endif
