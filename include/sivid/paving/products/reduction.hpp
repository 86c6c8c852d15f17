// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_PRODUCTS_REDUCTION_HPP
#define SIVID_PAVING_PRODUCTS_REDUCTION_HPP

#include <sivid/model/problem.hpp>
#include <sivid/model/structure/combination.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// A problem with fewer parameters that has the same trajectories.
///   Where parameters enter the equations only through products c, the others can be set to 1 and
///   one parameter of each product takes the value of c: for the hovercraft S_g = 1 and L = (L
///   S_g). Parameters that stand nowhere are set to 1, too.
class reduction {
public:
    /// A side of the reduced prior: a parameter of the original problem, or a combination of
    /// several.
    struct side {
        std::size_t parameter = 0;
        std::optional<combination> product;
    };

    /// @param sums  through which alone the equations see their terms (`sums_in`); terms that are
    ///              entangled otherwise are left as they are
    /// @returns nothing when no parameter can be spared in this way
    [[nodiscard]] static std::optional<reduction> find(identification_problem const& problem,
                                                       dependence_structure const& structure,
                                                       std::vector<combination> const& sums = {}) {
        if (structure.entangled.empty() && sums.empty()) return std::nullopt;
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
        if (structure.combinations.empty() && structure.entangled.size() == problem.prior.size()) {
            if (problem.prior.size() == 1) return std::nullopt;
            spared[0] = false; // a search needs a side
            result.sides_.push_back({0, std::nullopt});
            reduced.choice.unknown.push_back(problem.choice.unknown[0]);
            prior.push_back(problem.prior[0]);
        }
        // Each product needs a parameter of power one that stands in no other product.
        for (auto const& c : structure.combinations) {
            std::optional<std::size_t> pivot;
            for (std::size_t j = 0; j < c.exponents.size(); ++j) {
                if (c.exponents[j] != 0 && !is_entangled(j)) return std::nullopt;
                if (!pivot && c.exponents[j] == 1 && users_of(structure.combinations, j) == 1)
                    pivot = j;
            }
            if (!pivot) return std::nullopt;
            spared[*pivot] = false;
            auto const range = c.over(problem.prior);
            if (!std::isfinite(mag(range))) return std::nullopt;
            result.sides_.push_back({*pivot, c});
            reduced.choice.unknown.push_back(problem.choice.unknown[*pivot]);
            prior.push_back(range);
        }
        // The first term of a sum takes its value, the others are 0.
        std::vector<bool> in_sum(problem.prior.size(), false);
        for (auto const& c : sums) {
            std::optional<std::size_t> pivot;
            bool free = true;
            for (std::size_t j = 0; j < c.signs.size(); ++j) {
                if (c.signs[j] != 0) free = free && !is_entangled(j) && !in_sum[j];
                if (c.signs[j] == 1 && !pivot) pivot = j;
            }
            if (!pivot || !free) continue;
            for (std::size_t j = 0; j < c.signs.size(); ++j) {
                if (c.signs[j] == 0) continue;
                in_sum[j] = true;
                if (j != *pivot) reduced.choice.fixed[problem.choice.unknown[j]] = interval(0.0);
            }
            result.sides_.push_back({*pivot, c});
            reduced.choice.unknown.push_back(problem.choice.unknown[*pivot]);
            prior.push_back(c.over(problem.prior));
        }
        if (structure.entangled.empty() && result.sides_.empty()) return std::nullopt;
        for (std::size_t j = 0; j < problem.prior.size(); ++j) {
            if (in_sum[j]) continue;
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

    /// Whether a parameter of the original problem is a side or stands in one.
    [[nodiscard]] bool acts(std::size_t j) const {
        return std::any_of(sides_.begin(), sides_.end(),
                           [j](side const& s) { return stands_in(j, s); });
    }

    /// Whether parameters of the original prior reach every point of the reduced one, but for
    /// rounding: products that share a factor cannot be chosen independently.
    [[nodiscard]] bool fills() const {
        return std::none_of(sides_.begin(), sides_.end(), [this](side const& s) {
            if (!s.product) return false;
            for (std::size_t j = 0; j < s.product->exponents.size(); ++j) {
                if (s.product->has(j) &&
                    std::count_if(sides_.begin(), sides_.end(),
                                  [j](side const& other) { return stands_in(j, other); }) > 1)
                    return true;
            }
            return false;
        });
    }

    /// Whether a side is a sum.
    [[nodiscard]] bool has_sums() const {
        return std::any_of(sides_.begin(), sides_.end(),
                           [](side const& s) { return s.product && s.product->is_sum(); });
    }

    /// A box of the reduced problem that contains the image of a box of the original one.
    /// @param known  ranges of products in it, as of `products_over`
    [[nodiscard]] box forward(box const& p, std::vector<combination_hull> const& known = {}) const {
        box r(sides_.size());
        for (std::size_t k = 0; k < r.size(); ++k) {
            r[k] =
                sides_[k].product ? range_of(*sides_[k].product, p, known) : p[sides_[k].parameter];
        }
        return intersect(r, problem_.prior);
    }
    /// The ranges of products that a box of the reduced problem stands for.
    [[nodiscard]] std::vector<combination_hull> products_over(box const& r) const {
        std::vector<combination_hull> result;
        for (std::size_t k = 0; k < sides_.size(); ++k)
            if (sides_[k].product) result.push_back({*sides_[k].product, r[k]});
        return result;
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
            for (std::size_t j = 0; others.is_sum() && j < p.size(); ++j) {
                if (others.signs[j] == 0) continue;
                auto const rest = traits::sub(r[k], others.others_than(j, p));
                p[j] = traits::intersect(p[j], others.signs[j] > 0 ? rest : traits::neg(rest));
                if (is_empty(p[j])) return p;
            }
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

    [[nodiscard]] std::vector<side> const& sides() const { return sides_; }
    /// The formulas of the sides: the name of a parameter, or a product.
    [[nodiscard]] std::vector<std::string> side_names() const {
        std::vector<std::string> names;
        for (std::size_t k = 0; k < sides_.size(); ++k) {
            names.push_back(sides_[k].product ? sides_[k].product->formula
                                              : problem_.choice.unknown[k]);
        }
        return names;
    }

private:
    [[nodiscard]] static bool stands_in(std::size_t j, side const& s) {
        return s.product ? s.product->has(j) : s.parameter == j;
    }

    identification_problem problem_;
    std::vector<side> sides_;
};

} // namespace sivid

#endif
