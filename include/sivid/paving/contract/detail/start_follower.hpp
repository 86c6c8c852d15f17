// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CONTRACT_DETAIL_START_FOLLOWER_HPP
#define SIVID_PAVING_CONTRACT_DETAIL_START_FOLLOWER_HPP

#include <sivid/paving/contract/detail/start_rule.hpp>
#include <sivid/paving/response/local_response.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace sivid {

/// Outputs as affine functions of the parameters of a part,
///   \f$ y \in value + \sum_j slope_j d_j \pm rest, \quad d \in [-1,1]^n. \f$
struct affine_outputs {
    std::vector<double> value, rest;
    std::vector<interval> slope; ///< [parameter * outputs + y]
};

/// What a response for all starts says of starts that follow the parameters by an affine rule
/// \f$ s(d) = m + K d \f$, put into its polynomials. Nothing is integrated.
///   With the starts' variables s = m + k t, \f$ k_i \ge \sum_j |K_{ij}| \f$ and t in [-1,1], the
///   re-expanded response is affine in (d, t) but for a bounded rest. For each d take the t with
///   k t = K d: the affine part is then affine in d alone, and the rest, which holds for all t,
///   holds for this one.
class start_follower {
    using traits = interval_traits<interval>;

public:
    /// @param part  inside the box of parameters that the response was computed for (trusted)
    start_follower(response const& known, box const& part) : known_(&known) {
        auto const n = known.table->variables;
        middle_.assign(n, 0.0);
        reach_.assign(n, 0.0);
        for (std::size_t j = 0; j < part.size(); ++j) {
            auto const& side = known.unknowns.parameters[j];
            if (side.radius == 0) continue;
            parameters_.push_back(j);
            variables_.push_back(side.variable);
            paving_detail::normalise(side, part[j], middle_[side.variable], reach_[side.variable]);
        }
        for (auto const& side : known.unknowns.initial) {
            if (!(side.radius > 0)) continue;
            starts_.push_back(&side);
            reach_[side.variable] = near;
        }
    }
    /// The sides of the part that the outputs depend on, in the order of the slopes.
    [[nodiscard]] std::vector<std::size_t> const& parameters() const { return parameters_; }
    [[nodiscard]] bool has_starts() const { return !starts_.empty(); }

    /// The misfits about the starts of the last rule, at first the middles of their sides.
    [[nodiscard]] misfit_forms forms() {
        if (!local_) local_ = expand(*known_, middle_, reach_);
        auto const& local = *local_;
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
                f.by_parameter[j * count + y] = local.slope[variables_[j] * count + y] / e;
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

    /// @returns nothing when a start may leave its box: its bounds may be outward neighbours of the
    ///   decimals that are meant, and are kept off
    /// @guarantee  encloses the outputs at every parameter of the part, from the rule's start
    /// @cost  a re-expansion
    [[nodiscard]] std::optional<affine_outputs> operator()(start_rule const& rule) {
        if (!follow(rule)) return std::nullopt;
        auto const& local = local_.emplace(expand(*known_, middle_, reach_));
        auto const count = known_->outputs();
        auto const n = parameters_.size();
        affine_outputs result{local.value, local.rest, {}};
        for (std::size_t j = 0; j < n; ++j) {
            for (std::size_t y = 0; y < count; ++y) {
                auto change = traits::point(local.slope[variables_[j] * count + y]);
                for (std::size_t i = 0; i < starts_.size(); ++i) {
                    auto const v = starts_[i]->variable;
                    bool undefined = false;
                    auto const t = traits::div(traits::point(rule.slope[i * n + j]),
                                               traits::point(local.reach[v]), undefined);
                    auto const slope = traits::point(local.slope[v * count + y]);
                    change = traits::add(change, traits::mul(slope, t));
                }
                result.slope.push_back(change);
            }
        }
        return result;
    }

private:
    /// Reach of the starts where they are only linearised.
    static constexpr double near = 0x1p-20;

    /// Sets the starts' variables to what the rule reaches.
    [[nodiscard]] bool follow(start_rule const& rule) {
        auto const n = parameters_.size();
        for (std::size_t i = 0; i < starts_.size(); ++i) {
            auto const& side = *starts_[i];
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
        }
        return true;
    }

    response const* known_;
    std::vector<double> middle_, reach_;  ///< of the response's variables
    std::vector<std::size_t> parameters_; ///< sides of the part
    std::vector<std::size_t> variables_;  ///< theirs
    std::vector<normalised_unknowns::side const*> starts_;
    std::optional<local_response> local_; ///< about the last rule
};

} // namespace sivid

#endif
