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
        auto const& products = structure.combinations;
        if (structure.entangled.empty() && sums.empty()) return std::nullopt;
        builder reduced(problem, structure);
        if (products.empty() && structure.entangled.size() == problem.prior.size()) {
            if (problem.prior.size() == 1) return std::nullopt;
            reduced.keep(0); // a search needs a side
        }
        for (auto const& c : products) {
            if (!reduced.take_product(c, products)) return std::nullopt;
        }
        for (auto const& c : sums) reduced.take_sum(c);
        if (structure.entangled.empty() && reduced.is_unchanged()) return std::nullopt;
        return std::move(reduced).with_the_others();
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
    /// Takes the sides of a reduction one after the other.
    class builder {
    public:
        builder(identification_problem const& problem, dependence_structure const& structure)
            : of_(&problem),
              reduced_(problem),
              entangled_(problem.prior.size(), false),
              settled_(problem.prior.size(), false) {
            reduced_.choice.unknown.clear();
            for (auto const j : structure.entangled) entangled_[j] = true;
        }

        /// A parameter as it is.
        void keep(std::size_t j) { add({j, std::nullopt}, of_->prior[j]); }
        /// A product needs a parameter of power one that stands in no other product: it takes its
        /// value. @returns false when there is none
        [[nodiscard]] bool take_product(combination const& c, std::vector<combination> const& all) {
            std::optional<std::size_t> pivot;
            for (std::size_t j = 0; j < c.exponents.size(); ++j) {
                if (c.exponents[j] != 0 && !entangled_[j]) return false;
                if (!pivot && c.exponents[j] == 1 && users_of(all, j) == 1) pivot = j;
            }
            if (!pivot) return false;
            auto const range = c.over(of_->prior);
            if (!std::isfinite(mag(range))) return false;
            add({*pivot, c}, range);
            return true;
        }
        /// The first term of a sum takes its value, the others are 0; unless they are entangled.
        void take_sum(combination const& c) {
            std::optional<std::size_t> pivot;
            bool free = true;
            for (std::size_t j = 0; j < c.signs.size(); ++j) {
                if (c.signs[j] != 0) free = free && !entangled_[j] && !settled_[j];
                if (c.signs[j] == 1 && !pivot) pivot = j;
            }
            if (!pivot || !free) return;
            for (std::size_t j = 0; j < c.signs.size(); ++j) {
                if (c.signs[j] != 0 && j != *pivot) fix(j, 0.0);
            }
            add({*pivot, c}, c.over(of_->prior));
        }
        [[nodiscard]] bool is_unchanged() const { return sides_.empty(); }
        /// Entangled parameters that no product took are 1, all others stay as they are.
        [[nodiscard]] reduction with_the_others() && {
            for (std::size_t j = 0; j < settled_.size(); ++j) {
                if (settled_[j]) continue;
                if (entangled_[j])
                    fix(j, 1.0);
                else
                    keep(j);
            }
            reduced_.prior = box(std::move(prior_));
            reduction result;
            result.problem_ = std::move(reduced_);
            result.sides_ = std::move(sides_);
            return result;
        }

    private:
        void add(side s, interval const& range) {
            settled_[s.parameter] = true;
            reduced_.choice.unknown.push_back(of_->choice.unknown[s.parameter]);
            sides_.push_back(std::move(s));
            prior_.push_back(range);
        }
        void fix(std::size_t j, double value) {
            settled_[j] = true;
            reduced_.choice.fixed[of_->choice.unknown[j]] = interval(value);
        }

        identification_problem const* of_;
        identification_problem reduced_;
        std::vector<side> sides_;
        std::vector<interval> prior_;
        std::vector<bool> entangled_;
        std::vector<bool> settled_; ///< sides already, or fixed
    };

    [[nodiscard]] static bool stands_in(std::size_t j, side const& s) {
        return s.product ? s.product->has(j) : s.parameter == j;
    }

    identification_problem problem_;
    std::vector<side> sides_;
};

} // namespace sivid

#endif
