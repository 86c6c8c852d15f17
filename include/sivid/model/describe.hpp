// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_DESCRIBE_HPP
#define SIVID_MODEL_DESCRIBE_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/graph/graph_listing.hpp>
#include <sivid/model/model.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace sivid {

/// A model as text: names and units of states, inputs, channels and constants, and the recorded
/// graph as numbered lines. A line says whether it is computed once for each box of parameters
/// ("parameters only"), once for each scenario ("inputs only"), how often its value is used, and
/// whether only the Taylor series of another line needs it. Literals are shown as decimals.
/// @cost  O(size of the graph)
[[nodiscard]] SIVID_DECL std::string describe(recorded_model const& model);

/// The same of a model whose constants are bound: its unknown parameters, and the graph in which
/// everything else is folded. The derivatives are counted, not listed.
[[nodiscard]] SIVID_DECL std::string describe(bound_model const& model);

/// `describe(model{})` of a functor: records it first.
template <dynamic_model M>
[[nodiscard]] std::string describe(M const& model) {
    return describe(record_model(model));
}

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/impl/describe.ipp>
#endif

#endif
