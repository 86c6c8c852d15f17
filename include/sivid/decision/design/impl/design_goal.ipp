// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_DESIGN_IMPL_DESIGN_GOAL_IPP
#define SIVID_DECISION_DESIGN_IMPL_DESIGN_GOAL_IPP

#include <sivid/decision/design/design_goal.hpp>

#include <sivid/compiled.hpp>
#include <sivid/decision/requirement/detail/requirement_numbers.hpp>
#include <sivid/measurement/signal.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/parameter_choice.hpp>
#include <sivid/model/structure/find_combinations.hpp>
#include <sivid/space/exact/integer_span.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

namespace decision_detail {

/// Reads an expression of constants.
class goal_parser : requirement_numbers {
public:
    goal_parser(std::string_view text, recorded_model& model)
        : requirement_numbers("goal", text, model) {}

    [[nodiscard]] node_id read() {
        auto const value = sum();
        need_plain(value);
        if (!words_.at_end())
            words_.fail("nothing can follow here", "give one expression of constants");
        if ((g().depends(value.value) & ~on_constant) != 0)
            words_.fail_at(0, "it depends on states, inputs or time",
                           "give an expression of the model's constants");
        if ((g().depends(value.value) & on_constant) == 0)
            words_.fail_at(0, "it is the same for all parameters",
                           "give an expression of the model's constants");
        return value.value;
    }

private:
    operand in_brackets() override { return sum(); }
};

/// The exponents of the parameters in the one product that a node is, or is a function of.
inline std::optional<std::vector<int>> only_product(recorded_model model,
                                                    parameter_choice const& choice,
                                                    std::vector<signal> const& inputs,
                                                    node_id node) {
    model.stated.reset();
    for (auto& r : model.rate) r = model.g.constant(0.0);
    for (auto& y : model.observe) y = node;
    model_detail::monomial_set found;
    model_detail::collect_monomials(sivid::bind(model, choice, inputs), found);
    if (found.empty())
        throw std::invalid_argument("a goal is the same for all parameters: the constants in it "
                                    "are known");
    if (found.size() != 1) return std::nullopt;
    return *found.begin();
}

/// A goal that is one product, and the products that experiments see.
struct seen_products {
    std::vector<int> wanted;
    dependence_structure all;
};
inline std::optional<seen_products>
seen_of(recorded_model const& model, parameter_choice const& choice, design_goal const& goal) {
    if (model.has_memory() || model.observe.empty()) return std::nullopt; // a delay is no product
    // Inputs that take no term with them.
    std::vector<signal> const inputs(model.about.inputs.size(),
                                     sampled_signal({0.0, 1.0}, {0.3, 0.7}, interpolation::linear));
    auto wanted = only_product(model, choice, inputs, goal.value);
    // Starts that follow parameters tell of these.
    if (!wanted || !model.added_states.empty()) return std::nullopt;
    auto const bound = sivid::bind(model, choice, inputs);
    return seen_products{std::move(*wanted),
                         find_combinations(std::vector<bound_model const*>{&bound})};
}

/// Powers of one factor by which parameters are scaled with all products fixed: parameter j, and
/// in each product with it one that stands in no other; nothing where there is none.
inline std::optional<std::vector<int>> scaling_of(std::size_t j, dependence_structure const& all) {
    std::vector<int> powers(all.combinations.empty() ? 0 : all.combinations[0].exponents.size());
    if (j >= powers.size()) return std::nullopt;
    powers[j] = 1;
    for (auto const& c : all.combinations) {
        if (c.exponents[j] == 0) continue;
        for (std::size_t k = 0; k < powers.size(); ++k) {
            if (k == j || std::abs(c.exponents[k]) != 1 || users_of(all.combinations, k) != 1)
                continue;
            powers[k] = -c.exponents[j] * c.exponents[k];
            break;
        }
    }
    auto const changes = [&](combination const& c) {
        return std::inner_product(powers.begin(), powers.end(), c.exponents.begin(), 0L) != 0;
    };
    if (std::any_of(all.products.begin(), all.products.end(), changes)) return std::nullopt;
    return powers;
}

/// The parameters that are scaled by powers of a factor; nothing where one leaves its prior.
inline std::optional<box> scaled(box const& prior, std::vector<double> const& point,
                                 std::vector<int> const& powers, double factor) {
    using traits = interval_traits<interval>;
    auto result = point_box(point);
    for (std::size_t j = 0; j < powers.size(); ++j) {
        bool undefined = false;
        result[j] = traits::mul(result[j], traits::pown(interval(factor), powers[j], undefined));
        if (undefined || !subset(result[j], prior[j])) return std::nullopt;
    }
    return result;
}

/// The factor that brings a parameter to the first end of its prior, up or down.
inline double farthest(box const& prior, std::vector<double> const& point,
                       std::vector<int> const& powers, bool up) {
    double most = 30; // in logarithms
    for (std::size_t j = 0; j < powers.size(); ++j) {
        if (powers[j] == 0 || point[j] == 0) continue;
        bool const grows = (powers[j] > 0) == up;
        double const end = grows == (point[j] > 0) ? prior[j].upper() : prior[j].lower();
        if (end / point[j] > 0)
            most = std::min(most, std::abs(std::log(end / point[j]) / powers[j]));
    }
    return std::exp((up ? 1 : -1) * most * (1 - 1e-9));
}

inline interval range_of(prediction_problem const& p, design_goal const& goal,
                         box const& parameters) {
    auto const constants = constant_ranges(p.model, p.choice, parameters);
    graph_range range(p.model.g, {goal.value});
    range.evaluate({interval(0.0), {}, box(constants), {}});
    return range.undefined(goal.value) ? interval_traits<interval>::entire()
                                       : range.value(goal.value);
}

} // namespace decision_detail

SIVID_DECL design_goal parse_goal(std::string_view text, recorded_model& model) {
    return {std::string(text), decision_detail::goal_parser(text, model).read()};
}

SIVID_DECL std::optional<std::vector<std::string>> hidden_behind(recorded_model const& model,
                                                                 parameter_choice const& choice,
                                                                 design_goal const& goal) {
    auto const seen = decision_detail::seen_of(model, choice, goal);
    if (!seen) return std::nullopt;
    auto const& [wanted, all] = *seen;
    integer_span told(choice.unknown.size());
    for (auto const& p : all.products) told.add(p.exponents);
    if (told.contains(wanted)) return std::nullopt;
    std::vector<std::string> instead;
    for (auto const& c : all.combinations) {
        bool shared = false;
        for (std::size_t j = 0; j < wanted.size(); ++j)
            shared = shared || (wanted[j] != 0 && c.exponents[j] != 0);
        if (shared) instead.push_back(c.formula);
    }
    return instead;
}

SIVID_DECL double untold_share(prediction_problem const& left, prediction_problem const& direct,
                               std::vector<double> const& point, design_goal const& goal) {
    using traits = interval_traits<interval>;
    auto const seen = decision_detail::seen_of(direct.model, direct.choice, goal);
    auto const now = decision_detail::range_of(left, goal, left.around());
    if (!seen || !(width(now) > 0) || !std::isfinite(mag(now))) return 0;
    auto const prior = direct.around();
    double most = 0;
    for (std::size_t j = 0; j < point.size(); ++j) {
        auto const powers = decision_detail::scaling_of(j, seen->all);
        if (!powers) continue;
        std::vector<interval> ends;
        for (bool const up : {false, true}) {
            auto const to = decision_detail::farthest(prior, point, *powers, up);
            for (double const factor : {to, 1.0}) {
                auto const there = decision_detail::scaled(prior, point, *powers, factor);
                if (!there) continue;
                ends.push_back(decision_detail::range_of(direct, goal, *there));
                break;
            }
        }
        if (ends.size() < 2) continue; // the point is not in the prior
        for (bool const first : {false, true}) {
            auto const apart = traits::sub(traits::point(ends[first ? 1 : 0].lower()),
                                           traits::point(ends[first ? 0 : 1].upper()));
            bool undefined = false;
            auto const share = traits::div(
                apart, traits::sub(traits::point(now.upper()), traits::point(now.lower())),
                undefined);
            if (!undefined) most = std::max(most, share.lower());
        }
    }
    return most;
}

SIVID_DECL std::vector<design_goal> all_goals(recorded_model& model,
                                              parameter_choice const& choice) {
    std::vector<design_goal> all;
    auto const add = [&](std::string const& text) {
        if (std::none_of(all.begin(), all.end(), [&](auto const& g) { return g.text == text; }))
            all.push_back(parse_goal(text, model));
    };
    for (auto const& name : choice.unknown) {
        auto const instead = hidden_behind(model, choice, parse_goal(name, model));
        if (!instead) add(name);
        for (auto const& product : instead.value_or(std::vector<std::string>{})) add(product);
    }
    return all;
}

} // namespace sivid

#endif
