// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CURVE_IMPL_SHAPED_PROBLEM_IPP
#define SIVID_PAVING_CURVE_IMPL_SHAPED_PROBLEM_IPP

#include <sivid/paving/curve/detail/shaped_problem.hpp>

#include <sivid/measurement/signal.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/paving/relation/detail/observed_motion.hpp>
#include <sivid/paving/relation/state_samples.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// Where arguments of curves are along motions that explain the data.
struct visited_arguments {
    std::vector<interval> range;              ///< of each curve's argument
    std::vector<std::vector<double>> middles; ///< of its range in each cell of time

    visited_arguments(bound_model model, identification_problem const& problem,
                      std::vector<unknown_curve> const& curves) {
        using traits = interval_traits<interval>;
        range.assign(curves.size(), traits::empty());
        middles.resize(curves.size());
        std::vector<node_id> arguments;
        for (auto const& c : curves) arguments.push_back(c.argument);
        auto const sums = find_state_sums(model.g, model.rate);
        graph_range at(model.g, arguments);
        for (auto const& e : problem.experiments) {
            auto const motion =
                proved_motion(model, problem.prior, e, measured_states(model, {&e}), 4, sums);
            bool const covered = !motion.cells.empty() && motion.cells.front().from <= e.begin &&
                                 e.end() <= motion.cells.back().to;
            if (!covered && e.end() > e.begin) range.assign(curves.size(), traits::entire());
            for (auto const& cell : motion.cells) {
                at.evaluate(cell.at);
                for (std::size_t k = 0; k < curves.size(); ++k) {
                    auto const i = arguments[k];
                    auto const here = at.undefined(i) ? traits::entire() : at.value(i);
                    range[k] = traits::hull(range[k], here);
                    if (is_bounded(here)) middles[k].push_back(mid(here));
                }
            }
        }
    }
};

/// What the unknowns of a curve are called after: nothing of the user's own.
[[nodiscard]] inline std::string curve_name(model_description const& own, std::size_t number) {
    auto const taken = [&own](std::string const& name) {
        auto const called = [&name](auto const& item) { return item.name == name; };
        return std::any_of(own.constants.begin(), own.constants.end(), called) ||
               std::any_of(own.inputs.begin(), own.inputs.end(), called);
    };
    return model_detail::unused_name(
        "curve " + std::to_string(number),
        [&taken](std::string const& n) { return taken("rest of " + n) || taken(n + " shape 1"); });
}

} // namespace paving_detail

SIVID_DECL std::optional<shaped_problem>
shaped_problem::of(identification_problem const& problem, std::function<bool()> const& keep_going) {
    bool const plain = !problem.model.has_memory() && problem.model.added_states.empty() &&
                       std::all_of(problem.experiments.begin(), problem.experiments.end(),
                                   [](experiment const& e) { return e.outliers == 0; });
    if (!plain) return std::nullopt;
    shaped_problem result;
    // Inputs stay leaves.
    std::vector<signal> const open(problem.model.about.inputs.size(),
                                   sampled_signal({0.0}, {0.0}, interpolation::linear));
    result.model_ = bind(problem.model, problem.choice, open);
    auto const& model = result.model_;
    auto const curves = find_curves(model);
    if (curves.empty()) return std::nullopt;
    paving_detail::visited_arguments const visited(model, problem, curves);
    for (std::size_t k = 0; k < curves.size(); ++k) {
        if (!is_bounded(visited.range[k])) continue;
        shaped_curve one{{model, curves[k], problem.prior, visited.range[k]}, visited.middles[k]};
        // Those that no shapes do for stay as they are.
        auto const shapes = one.family.shapes(one.visited, 1e-4, keep_going);
        if (shapes) result.curves_.push_back(std::move(one));
    }
    if (result.curves_.empty()) return std::nullopt;
    result.experiments_ = problem.experiments;
    result.parameters_ = problem.prior;
    auto outputs = model.rate;
    outputs.insert(outputs.end(), model.observe.begin(), model.observe.end());
    result.kept_ = leaves_of(model.g, outputs, operation::constant, result.instead());
    return result;
}

SIVID_DECL stand_ins shaped_problem::instead() const {
    stand_ins result;
    for (auto const& c : curves_) result[c.family.curve().value] = c.family.curve().argument;
    return result;
}

SIVID_DECL bool shaped_problem::shape(double negligible, std::function<bool()> const& keep_going) {
    for (auto& c : curves_) {
        auto found = c.family.shapes(c.visited, negligible, keep_going);
        if (!found) return false;
        c.shapes = *std::move(found);
        c.coefficients = c.shapes.coefficients;
    }
    return true;
}

SIVID_DECL identification_problem shaped_problem::posed() const {
    identification_problem result;
    auto& model = result.model;
    auto& about = model.about;
    about = model_.about;
    about.constants.clear();
    std::vector<interval> prior;
    for (auto const j : kept_) {
        about.constants.push_back(model_.about.constants[model_.parameters[j]]);
        prior.push_back(parameters_[j]);
    }
    result.experiments = experiments_;
    std::vector<std::size_t> first; // coefficient of each curve
    for (auto const& c : curves_) {
        auto const name = paving_detail::curve_name(model_.about, first.size() + 1);
        first.push_back(prior.size());
        for (std::size_t j = 0; j < c.shapes.count(); ++j) {
            about.constants.push_back(
                {name + " shape " + std::to_string(j + 1), "1", literal{interval(0.0), 0.0}});
            prior.push_back(c.coefficients[j]);
        }
        about.inputs.push_back({"rest of " + name, "1"});
        for (auto& e : result.experiments) {
            e.inputs.emplace_back(
                sampled_signal({e.begin}, {0.0}, interpolation::hold, {c.shapes.error}));
        }
    }
    for (auto const& c : about.constants) result.choice.unknown.push_back(c.name);
    result.prior = box(std::move(prior));
    auto const leaf = [this](node const& n, graph& to) {
        auto const k = static_cast<std::size_t>(n.index);
        if (n.op != operation::constant) return to.leaf(n.op, k);
        auto const at = std::lower_bound(kept_.begin(), kept_.end(), k);
        return to.leaf(n.op, static_cast<std::size_t>(at - kept_.begin()));
    };
    auto const shape = [&](node_id value, node_id z, graph& to) {
        std::size_t c = 0;
        while (curves_[c].family.curve().value != value) ++c;
        std::vector<node_id> theta;
        for (std::size_t j = 0; j < curves_[c].shapes.count(); ++j) {
            theta.push_back(to.leaf(operation::constant, first[c] + j));
        }
        auto const rest = to.leaf(operation::input, model_.about.inputs.size() + c);
        return to.binary(operation::add, curves_[c].shapes.in(to, z, theta), rest);
    };
    auto outputs = model_.rate;
    outputs.insert(outputs.end(), model_.observe.begin(), model_.observe.end());
    auto const images =
        copy_into(model.g, model_.g, outputs, leaf, same_operation{}, instead(), shape);
    auto const rates = images.begin() + static_cast<std::ptrdiff_t>(model_.rate.size());
    model.rate.assign(images.begin(), rates);
    model.observe.assign(rates, images.end());
    return result;
}

SIVID_DECL void shaped_problem::take(box const& rest) {
    using traits = interval_traits<interval>;
    std::size_t at = 0;
    for (auto const j : kept_) parameters_[j] = traits::intersect(parameters_[j], rest[at++]);
    for (auto& c : curves_) {
        for (std::size_t j = 0; j < c.coefficients.size(); ++j) {
            c.coefficients[j] = traits::intersect(c.coefficients[j], rest[at++]);
        }
    }
}

SIVID_DECL bool shaped_problem::contract() {
    for (auto& c : curves_) {
        auto const& own = c.family.curve().parameters;
        box within(own.size());
        for (std::size_t j = 0; j < own.size(); ++j) within[j] = parameters_[own[j]];
        if (!c.family.contract(within, c.shapes, c.coefficients)) return false;
        for (std::size_t j = 0; j < own.size(); ++j) {
            parameters_[own[j]] = c.family.parameters()[j];
        }
    }
    return !is_empty(parameters_);
}

SIVID_DECL std::vector<box> shaped_problem::parts(std::size_t most) {
    std::vector<std::vector<box>> of_curve;
    std::size_t each = 1, all = 1;
    while (std::pow(static_cast<double>(each + 1), static_cast<double>(curves_.size())) <=
           static_cast<double>(most)) {
        ++each;
    }
    for (auto& c : curves_) {
        c.parts = each;
        of_curve.push_back(c.family.parts(c.shapes, each));
        for (auto& theta : of_curve.back()) theta = intersect(theta, c.coefficients);
        all *= each;
    }
    std::vector<box> result;
    for (std::size_t k = 0; k < all; ++k) {
        std::vector<interval> part;
        for (auto const j : kept_) part.push_back(parameters_[j]);
        auto rest = k;
        for (auto const& list : of_curve) {
            auto const& theta = list[rest % each];
            rest /= each;
            part.insert(part.end(), theta.begin(), theta.end());
        }
        result.emplace_back(std::move(part));
    }
    return result;
}

SIVID_DECL bool shaped_problem::take_parts(std::vector<box> const& left) {
    box whole = empty_box(left.empty() ? 0 : left[0].size());
    for (auto const& part : left) whole = hull(whole, part);
    if (is_empty(whole)) return false;
    take(whole);
    std::size_t first = kept_.size(), step = 1;
    for (auto& c : curves_) {
        std::vector<box> own(c.parts, empty_box(c.coefficients.size()));
        for (std::size_t k = 0; k < left.size(); ++k) {
            if (is_empty(left[k])) continue;
            box theta(c.coefficients.size());
            for (std::size_t j = 0; j < theta.size(); ++j) theta[j] = left[k][first + j];
            auto& mine = own[k / step % c.parts];
            mine = hull(mine, theta);
        }
        if (!c.family.contract_parts(c.shapes, own)) return false;
        first += c.coefficients.size();
        step *= c.parts;
    }
    return contract();
}

} // namespace sivid

#endif
