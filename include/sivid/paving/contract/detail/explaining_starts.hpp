// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CONTRACT_DETAIL_EXPLAINING_STARTS_HPP
#define SIVID_PAVING_CONTRACT_DETAIL_EXPLAINING_STARTS_HPP

#include <sivid/paving/contract/detail/start_rule.hpp>
#include <sivid/paving/response/local_response.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// Finds out by a response for all starts whether each parameter of a part is explained from *some*
/// start. The start may differ from parameter to parameter: it follows an affine rule
/// \f$ s(d) = m + K d \f$ that is guessed by linear programs, and put into the polynomials. Nothing
/// is integrated.
///   With the starts' variables s = m + k t, \f$ k_i \ge \sum_j |K_{ij}| \f$ and t in [-1,1], the
///   re-expanded response is affine in (d, t) but for a bounded rest. For each d take the t with
///   k t = K d: the affine part is then affine in d alone, and the rest, which holds for all t,
///   holds for this one.
/// @guarantee  a rule that is returned is proved: for every parameter of the part the start lies
///   within its box, and with it at least n - q measurements hold
/// @cost  two or three re-expansions and the linear programs of `start_rule_search`
class explaining_starts {
    using traits = interval_traits<interval>;

public:
    /// @param part  inside the box of parameters that the response was computed for (trusted)
    explicit explaining_starts(response const& known, box const& part) : known_(&known) {
        auto const n = known.table->variables;
        middle_.assign(n, 0.0);
        reach_.assign(n, 0.0);
        for (std::size_t j = 0; j < part.size(); ++j) {
            auto const& side = known.unknowns.parameters[j];
            if (side.radius == 0) continue;
            parameters_.push_back(side.variable);
            paving_detail::normalise(side, part[j], middle_[side.variable], reach_[side.variable]);
        }
        for (auto const& side : known.unknowns.initial) {
            if (side.radius > 0) starts_.push_back(&side);
        }
    }

    /// @returns the rule, in the response's variables of the starts and over the part's parameters
    ///   that have a variable; nothing when none was found
    [[nodiscard]] std::optional<start_rule> operator()() {
        if (starts_.empty() || known_->outputs() + known_->allowed < known_->measurements) {
            return std::nullopt;
        }
        for (auto const* s : starts_) {
            middle_[s->variable] = 0;
            reach_[s->variable] = near;
        }
        auto local = expand(*known_, middle_, reach_);
        start_rule_search search;
        for (int attempt = 0; attempt < attempts; ++attempt) {
            auto const rule = search(forms(local), known_->allowed);
            if (!rule || !follow(*rule)) return std::nullopt;
            local = expand(*known_, middle_, reach_);
            if (holds(local, *rule)) return rule;
        }
        return std::nullopt;
    }

private:
    /// Reach of the starts where they are only linearised.
    static constexpr double near = 0x1p-20;
    /// The first rule is by slopes from the middle of the starts' boxes.
    static constexpr int attempts = 2;

    /// Sets the starts' variables to what the rule reaches. @returns false when a start may leave
    /// its box: its bounds may be outward neighbours of the decimals that are meant, and are kept
    /// off.
    [[nodiscard]] bool follow(start_rule const& rule) {
        auto const n = parameters_.size();
        std::size_t i = 0;
        for (auto const& side : known_->unknowns.initial) {
            if (side.radius == 0) continue;
            auto reach = traits::point(near);
            for (std::size_t j = 0; j < n; ++j) {
                reach = traits::add(reach, traits::abs(traits::point(rule.slope[i * n + j])));
            }
            middle_[side.variable] = rule.middle[i];
            reach_[side.variable] = reach.upper();
            auto const all = traits::add(traits::point(rule.middle[i]),
                                         traits::bounds(-reach.upper(), reach.upper()));
            constexpr double unit = std::numeric_limits<double>::epsilon();
            double const off =
                (1 - mag(all)) * side.radius; // from the nearer end, but for rounding
            if (!(off >= 8 * unit * (std::abs(side.centre) + side.radius))) return false;
            ++i;
        }
        return true;
    }

    [[nodiscard]] misfit_forms forms(local_response const& local) const {
        auto const count = known_->outputs();
        misfit_forms f;
        f.parameters = parameters_.size();
        f.starts = starts_.size();
        f.by_parameter.assign(f.parameters * count, 0.0);
        f.by_start.assign(f.starts * count, 0.0);
        for (std::size_t y = 0; y < count; ++y) {
            auto const& bound = known_->bounds[y];
            double const e = std::max(rad(bound), std::numeric_limits<double>::min());
            double offset = local.value[y] - mid(bound);
            for (std::size_t j = 0; j < f.parameters; ++j) {
                f.by_parameter[j * count + y] = local.slope[parameters_[j] * count + y] / e;
            }
            for (std::size_t i = 0; i < f.starts; ++i) {
                auto const v = starts_[i]->variable;
                double const slope = local.slope[v * count + y] / local.reach[v];
                f.by_start[i * count + y] = slope / e;
                offset -= slope * local.middle[v];
            }
            f.offset.push_back(offset / e);
            f.margin.push_back(std::max(1 - local.rest[y] / e, -1e9)); // finite
        }
        return f;
    }

    /// Whether so many measurements hold for all d that the experiment is explained.
    [[nodiscard]] bool holds(local_response const& local, start_rule const& rule) const {
        auto const count = known_->outputs();
        auto const n = parameters_.size();
        std::size_t held = 0;
        for (std::size_t y = 0; y < count && held + known_->allowed < known_->measurements; ++y) {
            auto spread = traits::point(local.rest[y]);
            for (std::size_t j = 0; j < n; ++j) {
                auto change = traits::point(local.slope[parameters_[j] * count + y]);
                for (std::size_t i = 0; i < starts_.size(); ++i) {
                    auto const v = starts_[i]->variable;
                    bool undefined = false;
                    auto const t = traits::div(traits::point(rule.slope[i * n + j]),
                                               traits::point(local.reach[v]), undefined);
                    auto const slope = traits::point(local.slope[v * count + y]);
                    change = traits::add(change, traits::mul(slope, t));
                }
                spread = traits::add(spread, traits::abs(change));
            }
            double const most = spread.upper();
            if (!std::isfinite(most)) continue;
            auto const value =
                traits::add(traits::point(local.value[y]), traits::bounds(-most, most));
            held += traits::subset(value, known_->bounds[y]) ? 1 : 0;
        }
        return held + known_->allowed >= known_->measurements;
    }

    response const* known_;
    std::vector<double> middle_, reach_;  ///< of the response's variables
    std::vector<std::size_t> parameters_; ///< variables
    std::vector<normalised_unknowns::side const*> starts_;
};

} // namespace sivid

#endif
