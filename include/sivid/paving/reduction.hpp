// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_REDUCTION_HPP
#define SIVID_PAVING_REDUCTION_HPP

#include <sivid/model/combination.hpp>
#include <sivid/paving/problem.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// A problem with fewer parameters that has the same trajectories.
///   Where parameters enter the equations only through products c, the others can be set to 1 and
///   one parameter of each product takes the value of c: for the hovercraft S_g = 1 and L = (L
///   S_g).
class reduction {
public:
    /// A side of the reduced prior: a parameter of the original problem, or a product of several.
    struct side {
        std::size_t parameter = 0;
        std::optional<combination> product;
    };

    /// @returns nothing when no parameter can be spared in this way
    [[nodiscard]] static std::optional<reduction> find(identification_problem const& problem,
                                                       dependence_structure const& structure) {
        if (structure.combinations.empty()) return std::nullopt;
        auto const is_entangled = [&](std::size_t j) {
            return std::find(structure.entangled.begin(), structure.entangled.end(), j) !=
                   structure.entangled.end();
        };
        reduction result;
        result.problem_ = problem;
        auto& reduced = result.problem_;
        reduced.choice.unknown.clear();
        std::vector<interval> prior;
        std::vector<bool> spared(problem.prior.size(), false);
        for (std::size_t j = 0; j < problem.prior.size(); ++j) spared[j] = is_entangled(j);
        // Each product needs a parameter of power one that stands in no other product.
        for (auto const& c : structure.combinations) {
            std::optional<std::size_t> pivot;
            for (std::size_t j = 0; j < c.exponents.size() && !pivot; ++j) {
                if (c.exponents[j] != 0 && !is_entangled(j)) return std::nullopt;
                auto const users = std::count_if(
                    structure.combinations.begin(), structure.combinations.end(),
                    [j](combination const& other) { return other.exponents[j] != 0; });
                if (c.exponents[j] == 1 && users == 1) pivot = j;
            }
            if (!pivot) return std::nullopt;
            spared[*pivot] = false;
            auto const range = c.over(problem.prior);
            if (!std::isfinite(mag(range))) return std::nullopt;
            result.sides_.push_back({*pivot, c});
            reduced.choice.unknown.push_back(problem.choice.unknown[*pivot]);
            prior.push_back(range);
        }
        for (std::size_t j = 0; j < problem.prior.size(); ++j) {
            if (spared[j]) {
                reduced.choice.fixed[problem.choice.unknown[j]] = interval(1.0);
            } else if (!is_entangled(j)) {
                result.sides_.push_back({j, std::nullopt});
                reduced.choice.unknown.push_back(problem.choice.unknown[j]);
                prior.push_back(problem.prior[j]);
            }
        }
        reduced.prior = box(std::move(prior));
        return result;
    }

    [[nodiscard]] identification_problem const& problem() const { return problem_; }

    /// A box of the reduced problem that contains the image of a box of the original one.
    [[nodiscard]] box forward(box const& p) const {
        box r(sides_.size());
        for (std::size_t k = 0; k < r.size(); ++k) {
            r[k] = sides_[k].product ? sides_[k].product->over(p) : p[sides_[k].parameter];
        }
        return intersect(r, problem_.prior);
    }

    /// Removes from p what maps outside r: \f$ p_j \leftarrow p_j \cap [c] / \prod_{l \ne j}
    /// p_l^{e_l} \f$ for the factors of power one.
    [[nodiscard]] box backward(box p, box const& r) const {
        using traits = interval_traits<interval>;
        for (std::size_t k = 0; k < sides_.size(); ++k) {
            if (!sides_[k].product) {
                auto& own = p[sides_[k].parameter];
                own = traits::intersect(own, r[k]);
                continue;
            }
            auto others = *sides_[k].product;
            for (std::size_t j = 0; j < others.exponents.size(); ++j) {
                if (others.exponents[j] != 1) continue;
                others.exponents[j] = 0;
                bool undefined = false;
                auto const allowed = traits::div(r[k], others.over(p), undefined);
                others.exponents[j] = 1;
                // 0 among the divisors excludes nothing here.
                if (!undefined) p[j] = traits::intersect(p[j], allowed);
                if (is_empty(p[j])) return p;
            }
        }
        return p;
    }

    /// A point of p whose image is close to r, as far as p allows; not proved.
    [[nodiscard]] std::vector<double> approximate_preimage(box p,
                                                           std::vector<double> const& r) const {
        box near(r.size());
        for (std::size_t k = 0; k < r.size(); ++k) {
            double const slack = 1e-9 * std::abs(r[k]);
            near[k] = interval_traits<interval>::bounds(r[k] - slack, r[k] + slack);
        }
        auto const narrow = [&] {
            auto const less = backward(p, near);
            if (!is_empty(less)) p = less;
        };
        narrow();
        // The pivots come last: they take what the other factors leave.
        for (bool const pivots : {false, true}) {
            for (std::size_t j = 0; j < p.size(); ++j) {
                auto const is_pivot = std::any_of(sides_.begin(), sides_.end(), [j](side const& s) {
                    return s.product && s.parameter == j;
                });
                if (is_pivot != pivots) continue;
                p[j] = interval(mid(p[j]));
                narrow();
            }
        }
        return mid(p);
    }

    /// Smear of the original parameters: that of a product, shared by its factors' relative widths.
    [[nodiscard]] std::vector<double> smear(box const& p, box const& r,
                                            std::vector<double> const& reduced) const {
        std::vector<double> result(p.size(), 0.0);
        for (std::size_t k = 0; k < sides_.size() && k < reduced.size(); ++k) {
            if (!sides_[k].product) {
                result[sides_[k].parameter] += reduced[k];
                continue;
            }
            auto const& e = sides_[k].product->exponents;
            double const whole = width(r[k]) / std::max(mag(r[k]), 1e-300);
            for (std::size_t j = 0; j < e.size(); ++j) {
                double const share = std::abs(e[j]) * width(p[j]) / std::max(mag(p[j]), 1e-300);
                if (e[j] != 0 && whole > 0) result[j] += reduced[k] * share / whole;
            }
        }
        return result;
    }

private:
    identification_problem problem_;
    std::vector<side> sides_;
};

/// Tests boxes of the original parameters by a test of the reduced ones, and shares what was
/// computed among all boxes that map into the same region.
template <learning_set_test Inner>
class reduced_test {
public:
    using knowledge = typename Inner::knowledge;

    reduced_test(Inner& inner, reduction const& map) : inner_(&inner), map_(&map) {}

    [[nodiscard]] assessment<knowledge> operator()(box const& p,
                                                   std::shared_ptr<knowledge const> const& given) {
        auto result = judge(p, given);
        return result.blind ? std::move(learn({p})[0]) : result;
    }
    [[nodiscard]] assessment<knowledge> judge(box const& p,
                                              std::shared_ptr<knowledge const> const& given) const {
        auto const r = map_->forward(p);
        if (is_empty(r)) return {.verdict = box_verdict::outside, .rest = p};
        // The way back keeps a little more than the region that `given` speaks of.
        auto known = given && subset(r, given->region) ? given : nullptr;
        double least = HUGE_VAL;
        for (auto const& [size, what] : shared_) { // the smallest region around r knows best
            if (size < least && subset(r, what->region)) {
                least = size;
                known = what;
            }
        }
        return mapped_back(p, r, inner_->judge(r, known));
    }
    [[nodiscard]] std::vector<assessment<knowledge>> learn(std::vector<box> const& boxes) {
        // None is empty: what `judge` finds empty is outside and not learnt about, and the image
        // of a part of a box stays within the reduced prior.
        std::vector<box> images;
        for (auto const& p : boxes) images.push_back(map_->forward(p));
        auto found = inner_->learn(images);
        std::vector<assessment<knowledge>> results;
        for (std::size_t k = 0; k < boxes.size(); ++k) {
            if (found[k].knowledge) {
                shared_.emplace_back(
                    relative_volume(found[k].knowledge->region, map_->problem().prior).upper(),
                    found[k].knowledge);
            }
            results.push_back(mapped_back(boxes[k], images[k], std::move(found[k])));
        }
        return results;
    }
    [[nodiscard]] std::size_t at_once() const { return inner_->at_once(); }

private:
    [[nodiscard]] assessment<knowledge> mapped_back(box const& p, box const& r,
                                                    assessment<knowledge> found) const {
        assessment<knowledge> result{.rest = p};
        result.verdict = found.verdict;
        result.knowledge = std::move(found.knowledge);
        result.blind = found.blind;
        if (found.verdict == box_verdict::outside || found.blind) return result;
        result.smear = map_->smear(p, r, found.smear);
        // Inside holds for the contracted part only, and the map back keeps a little more than
        // that.
        result.rest = map_->backward(p, found.rest);
        if (is_empty(result.rest)) {
            result.verdict = box_verdict::outside;
        } else if (found.verdict == box_verdict::inside &&
                   !subset(map_->forward(result.rest), found.rest)) {
            result.verdict = box_verdict::undecided;
        }
        return result;
    }

    Inner* inner_;
    reduction const* map_;
    /// Everything that was computed, with the relative volume of its region.
    std::vector<std::pair<double, std::shared_ptr<knowledge const>>> shared_;
};

} // namespace sivid

#endif
