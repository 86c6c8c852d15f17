// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STRATEGY_DETAIL_USUAL_STRATEGY_HPP
#define SIVID_PAVING_STRATEGY_DETAIL_USUAL_STRATEGY_HPP

#include <sivid/compiled.hpp>
#include <sivid/paving/strategy/strategy.hpp>

namespace sivid::paving_detail {

/// What `default_strategy` returns where a program has it.
[[nodiscard]] SIVID_DECL strategy usual_strategy(search_kind of);

} // namespace sivid::paving_detail

#ifndef SIVID_COMPILED
#include <sivid/paving/strategy/impl/default_strategy.ipp>
#endif

#endif
