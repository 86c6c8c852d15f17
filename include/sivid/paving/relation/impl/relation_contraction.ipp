// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_IMPL_RELATION_CONTRACTION_IPP
#define SIVID_PAVING_RELATION_IMPL_RELATION_CONTRACTION_IPP

#include <sivid/paving/relation/relation_contraction.hpp>

#include <sivid/model/graph/graph_range.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/relation/detail/relation_row.hpp>
#include <sivid/paving/relation/detail/relation_windows.hpp>
#include <sivid/paving/relation/linear_refutation.hpp>
#include <sivid/paving/set_test.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// A product of constants and where it lies.
struct known_product {
    parameter_product theta;
    interval range;
};

/// Where the programs of one equation leave its coefficients; nothing when they leave none.
[[nodiscard]] inline std::optional<std::vector<known_product>>
known_products(relation_windows& windows, std::size_t equation) {
    using traits = interval_traits<interval>;
    std::vector<known_product> result;
    if (!windows.obstacle(equation).empty()) return result;
    auto const& row = windows.row(equation);
    auto const n = row.theta.size();
    linear_system system(n);
    for (auto const way : windows.ways(equation)) {
        if (n == 0) break;
        auto const list = windows.spread(equation, way); // before its row is there
        if (!list.empty()) system.add(system_of(windows.row(equation, way), list));
    }
    if (system.size() == 0 || windows.stopped()) return result;
    for (std::size_t j = 0; j < n; ++j) {
        std::vector<double> goal(n, 0.0);
        goal[j] = 1;
        double const least = proved_least(system, goal);
        goal[j] = -1;
        double const most = -proved_least(system, goal);
        if (!(least <= most)) return std::nullopt;
        auto const range =
            traits::add(traits::point(row.anchor[j]),
                        traits::mul(traits::point(row.width[j]), traits::bounds(least, most)));
        result.push_back({row.theta[j], traits::intersect(range, row.range[j])});
        if (is_empty(result.back().range)) return std::nullopt;
    }
    return result;
}

/// Cuts slices off the sides of a box over which some product cannot be where it lies.
class product_contraction {
public:
    product_contraction(graph const& g, std::vector<known_product> const& known)
        : known_(&known), atoms_(g, factors_of(known)) {}

    /// @returns false when nothing is left
    [[nodiscard]] bool operator()(box& x) {
        if (!possible(x)) return false;
        for (bool again = true; again;) {
            again = false;
            for (std::size_t i = 0; i < x.size(); ++i) {
                double const before = width(x[i]);
                for (bool const lower : {true, false}) cut(x, i, lower);
                again = again || width(x[i]) < 0.95 * before;
            }
        }
        return true;
    }

private:
    [[nodiscard]] static std::vector<node_id> factors_of(std::vector<known_product> const& known) {
        std::vector<node_id> result;
        for (auto const& k : known) {
            for (auto const& factor : k.theta) result.push_back(factor.first);
        }
        return result;
    }
    [[nodiscard]] bool possible(box const& x) {
        atoms_.evaluate({interval(0.0), {}, x, {}});
        return std::none_of(known_->begin(), known_->end(), [this](known_product const& k) {
            return disjoint(range_of(k.theta, atoms_), k.range);
        });
    }
    void cut(box& x, std::size_t i, bool lower) {
        using traits = interval_traits<interval>;
        for (double share = 0.5; share > 0.01;) {
            auto const side = x[i];
            if (!(width(side) > 0) || !is_bounded(side)) return;
            double const at =
                lower ? side.lower() + share * width(side) : side.upper() - share * width(side);
            if (!(side.lower() < at && at < side.upper())) return;
            auto const below = traits::bounds(side.lower(), at);
            auto const above = traits::bounds(at, side.upper());
            x[i] = lower ? below : above;
            bool const kept = possible(x);
            x[i] = kept ? side : lower ? above : below;
            if (kept) share /= 2;
        }
    }

    std::vector<known_product> const* known_;
    graph_range atoms_;
};

/// Tests boxes of parameters by the equations over windows.
class relation_test {
public:
    relation_test(identification_problem const& problem,
                  relation_contraction_options const& options)
        : problem_(problem), options_(options), rounds_(options.rounds) {}

    [[nodiscard]] assessment<> operator()(box const& x) {
        assessment<> result{.rest = contracted(x)};
        // Parts of a box that rests are excluded soon or not at all.
        rounds_ = std::max<std::size_t>(options_.rounds / 4, 1);
        if (is_empty(result.rest)) {
            result.rest = x;
            result.verdict = box_verdict::outside;
        }
        if (!inseparable_.empty()) result.smear.assign(x.size(), 0.0);
        for (auto const i : inseparable_) {
            result.smear[i] = width(result.rest[i]) / std::max(width(problem_.prior[i]), 1e-300);
        }
        return result;
    }

private:
    /// Empty when nothing is left.
    [[nodiscard]] box contracted(box const& x) {
        auto narrowed = problem_;
        auto& rest = narrowed.prior;
        rest = x;
        box const nothing(std::vector<interval>(x.size(), interval_traits<interval>::empty()));
        relation_options how;
        how.go_on = options_.keep_going;
        for (std::size_t round = 0; round < rounds_; ++round) {
            relation_windows windows(narrowed, how, nullptr, tube_source::proved);
            std::vector<known_product> known;
            for (std::size_t i = 0; i < problem_.model.about.states.size(); ++i) {
                auto more = known_products(windows, i);
                if (!more) return nothing;
                std::move(more->begin(), more->end(), std::back_inserter(known));
                if (windows.obstacle(i).empty()) {
                    auto const& own = windows.row(i).inseparable;
                    inseparable_.insert(own.begin(), own.end());
                }
            }
            if (windows.stopped()) break;
            auto const before = rest;
            if (!product_contraction(windows.equations(), known)(rest)) return nothing;
            bool gained = false;
            for (std::size_t i = 0; i < rest.size(); ++i) {
                gained = gained || width(rest[i]) < (1 - options_.gain) * width(before[i]);
            }
            if (!gained) break;
        }
        return rest;
    }

    identification_problem problem_;
    relation_contraction_options options_;
    std::size_t rounds_; ///< of the next box
    std::set<std::size_t> inseparable_;
};

} // namespace paving_detail

SIVID_DECL box contract_by_relations(identification_problem const& problem,
                                     relation_contraction_options const& options) {
    if (problem.model.has_memory() || problem.prior.size() == 0) return problem.prior;
    paving_detail::relation_test test(problem, options);
    auto const whole = test(problem.prior);
    box const nothing(
        std::vector<interval>(problem.prior.size(), interval_traits<interval>::empty()));
    if (whole.verdict == box_verdict::outside) return nothing;
    if (options.boxes < 2) return whole.rest;
    inversion_options search{.accuracy = 1e-3, .keep_outside = false};
    search.boxes = options.boxes;
    search.keep_going = options.keep_going;
    auto const found = invert(test, whole.rest, search);
    return found.paving.has_outer() ? found.paving.outer_hull() : nothing;
}

} // namespace sivid

#endif
