// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_IMPL_RELATION_CONTRACTION_IPP
#define SIVID_PAVING_RELATION_IMPL_RELATION_CONTRACTION_IPP

#include <sivid/paving/relation/relation_contraction.hpp>

#include <sivid/model/graph/graph_range.hpp>
#include <sivid/paving/relation/detail/relation_row.hpp>
#include <sivid/paving/relation/detail/relation_windows.hpp>
#include <sivid/paving/relation/linear_refutation.hpp>
#include <sivid/paving/set_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// A product of constants and where it lies.
struct known_product {
    parameter_product theta;
    interval range;
    double blur; ///< how much of what its equation leaves open is due to it (`blur_of`)
};

/// Where the programs of one equation leave its coefficients; nothing when they leave none.
[[nodiscard]] inline std::optional<std::vector<known_product>>
known_products(relation_windows& windows, std::size_t equation) {
    using traits = interval_traits<interval>;
    std::vector<known_product> result;
    if (!windows.obstacle(equation).empty()) return result;
    // Ways of one equation share a program where they share its products.
    struct shared_program {
        relation_row const* row;
        linear_system system;
        std::vector<double> blur;
    };
    std::vector<shared_program> programs;
    for (auto const way : windows.ways(equation)) {
        auto const list = windows.spread(equation, way); // before its row is there
        auto const& row = windows.row(equation, way);
        auto const n = row.theta.size();
        if (list.empty() || n == 0) continue;
        auto at = std::find_if(programs.begin(), programs.end(),
                               [&](auto const& p) { return p.row->theta == row.theta; });
        if (at == programs.end())
            at = programs.insert(at, {&row, linear_system(n), std::vector<double>(n, 0.0)});
        at->system.add(system_of(row, list));
        auto const own = blur_of(row, list);
        for (std::size_t j = 0; j < own.size(); ++j) at->blur[j] += own[j];
    }
    if (windows.stopped()) return result;
    for (auto const& [shared, system, blur] : programs) {
        auto const& row = *shared;
        auto const n = row.theta.size();
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
            result.push_back({row.theta[j], traits::intersect(range, row.range[j]), blur[j]});
            if (is_empty(result.back().range)) return std::nullopt;
        }
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

/// How much each side of a box blurs the equations: that of a product goes to its factors by how
/// far each moves it alone.
[[nodiscard]] inline std::vector<double>
smear_of(graph const& g, std::vector<known_product> const& known, box const& x) {
    std::vector<double> smear(x.size(), 0.0), alone(known.size() * x.size(), 0.0);
    std::vector<node_id> factors;
    for (auto const& k : known) {
        for (auto const& factor : k.theta) factors.push_back(factor.first);
    }
    graph_range atoms(g, factors);
    for (std::size_t i = 0; i < x.size(); ++i) {
        auto about = point_box(mid(x));
        about[i] = x[i];
        atoms.evaluate({interval(0.0), {}, about, {}});
        for (std::size_t k = 0; k < known.size(); ++k) {
            double const moved = width(range_of(known[k].theta, atoms));
            alone[k * x.size() + i] = std::isfinite(moved) ? moved : 1e100;
        }
    }
    for (std::size_t k = 0; k < known.size(); ++k) {
        auto const* const moved = alone.data() + k * x.size();
        double const sum = std::accumulate(moved, moved + x.size(), 0.0);
        for (std::size_t i = 0; sum > 0 && i < x.size(); ++i) {
            smear[i] += known[k].blur * moved[i] / sum;
        }
    }
    return smear;
}

} // namespace paving_detail

SIVID_DECL assessment<> relation_test::operator()(box const& x) const {
    auto narrowed = *problem_;
    narrowed.prior = x;
    auto& rest = narrowed.prior;
    assessment<> const nothing{.verdict = box_verdict::outside, .rest = x};
    std::vector<double> smear;
    relation_options how;
    how.go_on = options_.keep_going;
    how.cells_per_gap = options_.cells_per_gap;
    for (std::size_t round = 0; round < options_.rounds; ++round) {
        relation_windows windows(narrowed, how, nullptr, tube_source::proved);
        std::vector<paving_detail::known_product> known;
        for (std::size_t i = 0; i < windows.equations_and_sums(); ++i) {
            auto more = paving_detail::known_products(windows, i);
            if (!more) return nothing;
            std::move(more->begin(), more->end(), std::back_inserter(known));
        }
        if (windows.stopped()) break;
        smear = paving_detail::smear_of(windows.equations(), known, rest);
        auto const before = rest;
        if (!paving_detail::product_contraction(windows.equations(), known)(rest)) return nothing;
        bool gained = false;
        for (std::size_t i = 0; i < rest.size(); ++i) {
            gained = gained || width(rest[i]) < (1 - options_.gain) * width(before[i]);
        }
        if (!gained) break;
    }
    if (is_empty(rest)) return nothing;
    return {.rest = std::move(rest), .smear = std::move(smear)};
}

SIVID_DECL std::string relation_obstacle(identification_problem const& problem) {
    if (problem.prior.size() == 0) return "no parameter is unknown";
    if (problem.model.has_memory()) return "the model has delays, plays or rate limits";
    bool const trusted = std::any_of(problem.experiments.begin(), problem.experiments.end(),
                                     [](experiment const& e) { return e.outliers == 0; });
    return trusted ? "" : "every experiment has an outlier budget: no window can be trusted";
}

SIVID_DECL box contract_by_relations(identification_problem const& problem,
                                     relation_contraction_options const& options) {
    if (!relation_obstacle(problem).empty()) return problem.prior;
    auto const found = relation_test(problem, options)(problem.prior);
    if (found.verdict != box_verdict::outside) return found.rest;
    return empty_box(problem.prior.size());
}

} // namespace sivid

#endif
