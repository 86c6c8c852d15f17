// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CONTRACT_DETAIL_EXPLAINING_STARTS_HPP
#define SIVID_PAVING_CONTRACT_DETAIL_EXPLAINING_STARTS_HPP

#include <sivid/paving/contract/detail/start_follower.hpp>

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace sivid {

/// Finds out by a response for all starts whether each parameter of a part is explained from *some*
/// start. The start may differ from parameter to parameter: it follows an affine rule that is
/// guessed by linear programs (`start_follower`).
/// @guarantee  a rule that is returned is proved: for every parameter of the part the start lies
///   within its box, and with it at least n - q measurements hold
/// @cost  two or three re-expansions and the linear programs of `start_rule_search`
class explaining_starts {
    using traits = interval_traits<interval>;

public:
    /// @param part  inside the box of parameters that the response was computed for (trusted)
    explicit explaining_starts(response const& known, box const& part)
        : known_(&known), follower_(known, part) {}

    /// @returns the rule, in the response's variables of the starts and over the part's parameters
    ///   that have a variable; nothing when none was found
    [[nodiscard]] std::optional<start_rule> operator()() {
        if (!follower_.has_starts() || known_->outputs() + known_->allowed < known_->measurements) {
            return std::nullopt;
        }
        start_rule_search search;
        for (int attempt = 0; attempt < attempts; ++attempt) {
            auto const rule = search(follower_.forms(), known_->allowed);
            if (!rule) return std::nullopt;
            auto const outputs = follower_(*rule);
            if (!outputs) return std::nullopt;
            if (holds(*outputs)) return rule;
        }
        return std::nullopt;
    }

private:
    /// The first rule is by slopes from the middle of the starts' boxes.
    static constexpr int attempts = 2;

    /// Whether so many measurements hold for all d that the experiment is explained.
    [[nodiscard]] bool holds(affine_outputs const& outputs) const {
        auto const count = known_->outputs();
        std::size_t held = 0;
        for (std::size_t y = 0; y < count && held + known_->allowed < known_->measurements; ++y) {
            auto spread = traits::point(outputs.rest[y]);
            for (std::size_t k = y; k < outputs.slope.size(); k += count)
                spread = traits::add(spread, traits::abs(outputs.slope[k]));
            double const most = spread.upper();
            if (!std::isfinite(most)) continue;
            auto const value =
                traits::add(traits::point(outputs.value[y]), traits::bounds(-most, most));
            held += traits::subset(value, known_->bounds[y]) ? 1 : 0;
        }
        return held + known_->allowed >= known_->measurements;
    }

    response const* known_;
    start_follower follower_;
};

} // namespace sivid

#endif
