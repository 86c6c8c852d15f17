// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IMPL_DIVISORS_IPP
#define SIVID_PAVING_IMPL_DIVISORS_IPP

#include <sivid/paving/divisors.hpp>

#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/detail/formula_text.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/relation/input_range.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// Where one node of a graph may be zero, as a set test over the leaves that it depends on.
class zero_test {
    using traits = interval_traits<interval>;

public:
    struct leaf {
        operation kind;
        std::size_t index;
    };

    zero_test(graph const& g, node_id of, leaf_ranges all)
        : range_(g, {of}), of_(of), at_(std::move(all)) {
        auto const needed = operands_of(g, {of});
        for (std::size_t k = 0; k < needed.size(); ++k) {
            auto const& n = g.nodes()[k];
            if (!needed[k]) continue;
            jumps_ = jumps_ || n.op == operation::sign;
            bool const varies = n.op == operation::time || n.op == operation::state ||
                                n.op == operation::constant || n.op == operation::input;
            if (varies) leaves_.push_back({n.op, static_cast<std::size_t>(n.index)});
        }
        range_.evaluate(at_);
        continuous_ = !jumps_ && !range_.undefined(of_);
    }

    [[nodiscard]] std::vector<leaf> const& leaves() const { return leaves_; }
    [[nodiscard]] box domain() {
        std::vector<interval> sides;
        for (auto const& l : leaves_) sides.push_back(side(l));
        return box(std::move(sides));
    }
    [[nodiscard]] assessment<> operator()(box const& x) {
        assessment<> result{.rest = x};
        auto const over = value(x);
        if (!contains(over, 0.0)) {
            result.verdict = box_verdict::outside;
            return result;
        }
        auto const middle = mid(x);
        auto const there = value(point_box(middle));
        positive_ = positive_ || there.lower() > 0;
        negative_ = negative_ || there.upper() < 0;
        if (mag(there) < least_) {
            least_ = mag(there);
            nearest_ = middle;
        }
        // How far each side moves it about the middle.
        for (std::size_t i = 0; i < x.size(); ++i) {
            auto about = point_box(middle);
            about[i] = x[i];
            double const moved = width(value(about));
            result.smear.push_back(std::isfinite(moved) ? moved : 1e100);
        }
        return result;
    }
    /// Both signs occur over a box in which it is continuous.
    [[nodiscard]] bool vanishes() const { return continuous_ && positive_ && negative_; }
    [[nodiscard]] std::vector<double> const& nearest() const { return nearest_; }

private:
    [[nodiscard]] interval& side(leaf const& l) {
        return l.kind == operation::time       ? at_.time
               : l.kind == operation::state    ? at_.states[l.index]
               : l.kind == operation::constant ? at_.constants[l.index]
                                               : at_.inputs[l.index];
    }
    /// The whole line where it may be undefined.
    [[nodiscard]] interval value(box const& x) {
        for (std::size_t i = 0; i < leaves_.size(); ++i) side(leaves_[i]) = x[i];
        range_.evaluate(at_);
        return range_.undefined(of_) ? traits::entire() : range_.value(of_);
    }

    graph_range range_;
    node_id of_;
    leaf_ranges at_;
    std::vector<leaf> leaves_;
    bool jumps_ = false, continuous_ = false, positive_ = false, negative_ = false;
    double least_ = detail::infinity;
    std::vector<double> nearest_;
};

/// Everything within which a problem's equations may be asked.
[[nodiscard]] inline leaf_ranges domain_of(identification_problem const& problem) {
    using traits = interval_traits<interval>;
    auto const& about = problem.model.about;
    leaf_ranges result{traits::empty(), box(about.states.size()), problem.prior,
                       empty_box(about.inputs.size())};
    for (std::size_t i = 0; i < about.states.size(); ++i) {
        result.states[i] = about.states[i].limit.range();
    }
    for (auto const& e : problem.experiments) {
        result.time = hull(result.time, traits::bounds(e.begin, e.end()));
        for (std::size_t u = 0; u < e.inputs.size(); ++u) {
            result.inputs[u] = hull(result.inputs[u], input_across(e.inputs[u], e.begin, e.end()));
        }
    }
    return result;
}

/// What a node divides by, if it does.
[[nodiscard]] inline std::optional<node_id> divided_by(node const& n) {
    if (n.op == operation::div) return n.b;
    if (n.op == operation::pown && n.index < 0) return n.a;
    return std::nullopt;
}

/// Names of equations with the nodes that they need.
using named_equations = std::vector<std::pair<std::string, std::vector<bool>>>;

[[nodiscard]] inline named_equations equations_of(bound_model const& model,
                                                  model_description const& about) {
    named_equations result;
    for (std::size_t i = 0; i < model.rate.size(); ++i) {
        result.emplace_back(about.states[i].equation_name(), operands_of(model.g, {model.rate[i]}));
    }
    for (std::size_t y = 0; y < model.observe.size(); ++y) {
        result.emplace_back("output " + about.channels[y].name,
                            operands_of(model.g, {model.observe[y]}));
    }
    return result;
}
/// Which of the equations divide by a node.
[[nodiscard]] inline std::vector<std::string> dividing_by(node_id below, graph const& g,
                                                          named_equations const& equations) {
    std::vector<std::string> names;
    for (auto const& [name, needs] : equations) {
        bool any = false; // of the divisions by it
        for (std::size_t j = 0; j < g.size(); ++j)
            any = any || (needs[j] && divided_by(g.nodes()[j]) == below);
        if (any) names.push_back(name);
    }
    return names;
}

/// Searches the zeros of a divisor.
/// @returns false where no time was left to look
[[nodiscard]] inline bool find_zeros(divisor& d, zero_test test, leaf_names const& names,
                                     divisor_options const& options) {
    inversion_options search;
    search.boxes = options.boxes;
    search.keep_outside = false;
    search.keep_going = [&] {
        return !test.vanishes() && (!options.keep_going || options.keep_going());
    };
    auto const whole = test.domain();
    // An input that is not bounded (a formula with a pole) leaves it open.
    bool const bounded = std::all_of(whole.begin(), whole.end(),
                                     [](interval const& side) { return is_bounded(side); });
    bool none = bounded && test(whole).verdict == box_verdict::outside;
    if (!none && !search.keep_going() && !test.vanishes()) return false;
    none = none || (bounded && !invert(test, whole, search).paving.has_outer());
    if (none) {
        d.zeros = zeros::none;
        return true;
    }
    if (test.vanishes()) d.zeros = zeros::some;
    auto const name_of = [&names](zero_test::leaf const& l) {
        return l.kind == operation::time       ? std::string{"t"}
               : l.kind == operation::state    ? names.states[l.index]
               : l.kind == operation::constant ? names.constants[l.index]
                                               : names.inputs[l.index];
    };
    for (std::size_t i = 0; i < test.nearest().size(); ++i) {
        d.near.emplace_back(name_of(test.leaves()[i]), test.nearest()[i]);
    }
    return true;
}

} // namespace paving_detail

SIVID_DECL std::vector<divisor> divisors_of(identification_problem const& problem,
                                            divisor_options const& options) {
    problem.require_valid();
    std::vector<divisor> result;
    if (problem.model.has_memory()) return result;
    auto const& about = problem.model.about;
    std::vector<signal> const open(about.inputs.size(),
                                   sampled_signal({0.0}, {0.0}, interpolation::linear));
    auto const model = bind(problem.model, problem.choice, open);
    auto const& g = model.g;
    auto const domain = paving_detail::domain_of(problem);
    leaf_names names{problem.choice.unknown};
    for (auto const& s : about.states) names.states.push_back(s.name);
    for (auto const& u : about.inputs) names.inputs.push_back(u.name);
    auto const equations = paving_detail::equations_of(model, about);
    std::vector<node_id> done;
    for (auto const& n : g.nodes()) {
        auto const below = paving_detail::divided_by(n);
        if (!below || g.depends(*below) == on_nothing) continue;
        if (std::find(done.begin(), done.end(), *below) != done.end()) continue;
        divisor d;
        d.equations = paving_detail::dividing_by(*below, g, equations);
        if (d.equations.empty()) continue; // of derivatives alone
        done.push_back(*below);
        if (is_short(g, *below, names, 40)) d.formula = formula_text(g, *below, names);
        if (paving_detail::find_zeros(d, {g, *below, domain}, names, options))
            result.push_back(std::move(d));
    }
    return result;
}

} // namespace sivid

#endif
