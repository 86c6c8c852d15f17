// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_DESIGN_IMPL_DESIGN_GOAL_IPP
#define SIVID_DECISION_DESIGN_IMPL_DESIGN_GOAL_IPP

#include <sivid/decision/design/detail/design_goal.hpp>

#include <sivid/compiled.hpp>
#include <sivid/decision/requirement/detail/requirement_numbers.hpp>
#include <sivid/measurement/signal.hpp>
#include <sivid/model/parameter_choice.hpp>
#include <sivid/model/structure/find_combinations.hpp>
#include <sivid/space/exact/integer_span.hpp>

#include <algorithm>
#include <cstddef>
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

} // namespace decision_detail

SIVID_DECL design_goal parse_goal(std::string_view text, recorded_model& model) {
    return {std::string(text), decision_detail::goal_parser(text, model).read()};
}

SIVID_DECL std::optional<std::vector<std::string>> hidden_behind(recorded_model const& model,
                                                                 parameter_choice const& choice,
                                                                 design_goal const& goal) {
    if (model.has_memory() || model.observe.empty()) return std::nullopt; // a delay is no product
    // Inputs that take no term with them.
    std::vector<signal> const inputs(model.about.inputs.size(),
                                     sampled_signal({0.0, 1.0}, {0.3, 0.7}, interpolation::linear));
    auto const wanted = decision_detail::only_product(model, choice, inputs, goal.value);
    // Starts that follow parameters tell of these.
    if (!wanted || !model.added_states.empty()) return std::nullopt;
    auto const bound = sivid::bind(model, choice, inputs);
    auto const all = find_combinations(std::vector<bound_model const*>{&bound});
    integer_span told(choice.unknown.size());
    for (auto const& p : all.products) told.add(p.exponents);
    if (told.contains(*wanted)) return std::nullopt;
    std::vector<std::string> instead;
    for (auto const& c : all.combinations) {
        bool shared = false;
        for (std::size_t j = 0; j < wanted->size(); ++j)
            shared = shared || ((*wanted)[j] != 0 && c.exponents[j] != 0);
        if (shared) instead.push_back(c.formula);
    }
    return instead;
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
