// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STRATEGY_STRATEGY_HPP
#define SIVID_PAVING_STRATEGY_STRATEGY_HPP

#include <sivid/compiled.hpp>
#include <sivid/paving/strategy/contractor.hpp>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

/// What is tried before a search, one step after the other.
struct strategy {
    /// Whether a step is worth its time, and why or why not.
    struct promise {
        bool worth = true;
        std::string why{};
    };
    struct step {
        /// Asked in turn: each again when another has gained, until they rest.
        std::vector<std::shared_ptr<contractor const>> by;
        double share = 1;                                ///< of the time that is left, at most
        std::function<promise(inquiry&)> when = nullptr; ///< nothing: always
        bool ends = false; ///< where it gains, no other step is tried before the search
    };
    std::vector<step> steps{};

    /// The same but for contractors of this name.
    [[nodiscard]] strategy without(std::string_view name) const {
        auto result = *this;
        for (auto& s : result.steps) {
            std::erase_if(s.by, [&](auto const& by) { return by->name() == name; });
            for (auto& by : s.by)
                if (auto less = by->without(name)) by = std::move(less);
        }
        std::erase_if(result.steps, [](step const& s) { return s.by.empty(); });
        return result;
    }
};

/// Asks contractors for what they leave of a problem, and notes each in its journal.
/// @param asked  receives what is left
/// @guarantee  as those of the contractors together
SIVID_DECL void contract(strategy const& how, inquiry& asked);

/// For what the steps of `default_strategy` save time.
enum class search_kind {
    one,  ///< one search of the prior, by runs
    parts ///< many searches of parts, by runs and what contractors say of parts
};
/// What is tried before a search, where the program has it (`complete.hpp`); otherwise nothing is,
/// and the journal says so. Its contractors by name, for `without`, in their order: shapes, state
/// equations, interval observers, growing window, guided windows, slower inputs, windows all along,
/// groups of measurements, parts of the prior (`search_kind::one`).
[[nodiscard]] SIVID_DECL strategy default_strategy(search_kind of = search_kind::one);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/strategy/impl/strategy.ipp>
#endif

#endif
