// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_MOTION_DETAIL_IDLE_PARTS_HPP
#define SIVID_DECISION_MOTION_DETAIL_IDLE_PARTS_HPP

#include <sivid/decision/prediction_problem.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/model/graph/arithmetic.hpp>
#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/program.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/parameter_choice.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

namespace sivid::decision_detail {

/// A prediction of margins without what cannot move or matter: inputs that are constant are
/// numbers; states that begin at 0 and stay there are 0; parameters on which nothing depends have
/// one value.
///   States S stay at 0 when they begin there and their rates are 0 wherever all of S are 0: that
/// is a motion, and it is the only one where the rates have no jumps and no roots of what may be 0
/// (they are locally Lipschitz where they are defined). What is struck out is defined for every
/// state, so that no motion is gained either.
/// @guarantee  the other states and the margins have the same motions
/// @cost  a few passes through the graph
struct without_idle_parts {
    prediction_problem problem;
    requirement what;       ///< margins: in `problem.model`
    std::vector<bool> idle; ///< parameters that were given one value, some point of `around()`

    without_idle_parts(prediction_problem const& original, requirement const& asked)
        : problem(original), what(asked), idle(original.choice.unknown.size(), false) {
        auto const& from = original.model;
        auto const around = original.around();
        std::vector<interval> ranges;
        try {
            ranges = constant_ranges(from, original.choice, around);
        } catch (std::domain_error const&) {
            return; // a derived constant may be undefined somewhere: all stays as it is
        }
        auto const values = values_of(from.g, ranges);
        for (auto const& u : original.inputs) held_.push_back(constant_value(u));
        still_.assign(from.rate.size(), false);
        if (lipschitz(from, values)) find_still(original);
        rewrite(from);
        fix_idle(around);
    }

private:
    using traits = interval_traits<interval>;

    static std::optional<double> constant_value(signal const& s) {
        auto const* u = std::get_if<sampled_signal>(&s);
        if (u == nullptr || !u->exact() || u->times().front() > 0) return std::nullopt;
        auto const& v = u->values();
        bool const same = std::all_of(v.begin(), v.end(), [&](double x) { return x == v.front(); });
        return same ? std::optional(v.front()) : std::nullopt;
    }
    /// Values of all nodes, whatever the states, the inputs and the time; which are defined.
    std::vector<interval> values_of(graph const& g, std::vector<interval> const& constants) {
        using arithmetic = proven_arithmetic<interval>;
        auto const all = program::marked(g, std::vector<bool>(g.size(), true));
        auto x = all.memory<arithmetic>();
        all.read(x, [&](operation op, std::size_t k) {
            return op == operation::constant ? constants[k] : traits::entire();
        });
        defined_.assign(g.size(), true);
        all.run<arithmetic>(x, [&](program::step const& s, bool undefined) {
            defined_[s.target] = !undefined && defined_[s.a] && defined_[s.b];
            if (!defined_[s.target]) x[s.target] = traits::entire();
        });
        return x;
    }
    /// Whether motions are unique: no jumps, no roots of what may be 0.
    static bool lipschitz(recorded_model const& m, std::vector<interval> const& values) {
        auto const needed = operands_of(m.g, m.rate);
        for (std::size_t k = 0; k < m.g.size(); ++k) {
            auto const& n = m.g.nodes()[k];
            if (!needed[k]) continue;
            if (n.op == operation::sign) return false;
            if (n.op == operation::sqrt && !(values[n.a].lower() > 0)) return false;
        }
        return true;
    }
    /// Copies nodes; what is idle becomes a number.
    [[nodiscard]] std::vector<node_id> images(graph& to, recorded_model const& from,
                                              std::vector<node_id> const& nodes) const {
        auto const leaf = [&](node const& n, graph& g) -> node_id {
            auto const k = static_cast<std::size_t>(n.index);
            if (n.op == operation::state && still_[k]) return g.constant(0.0);
            if (n.op == operation::input && held_[k]) return g.constant(*held_[k]);
            return same_leaf{}(n, g);
        };
        auto const make = [&](node const& n, node_id a, node_id b, graph& g) -> node_id {
            auto const own = static_cast<std::size_t>(&n - from.g.nodes().data());
            bool const zero = (n.op == operation::mul && (g.is(a, 0) || g.is(b, 0))) ||
                              (n.op == operation::div && g.is(a, 0));
            if (zero && defined_[own]) return g.constant(0.0); // defined for all states
            return same_operation{}(n, a, b, g);
        };
        return copy_into(to, from.g, nodes, leaf, make);
    }
    /// The largest set of states that begin at 0 and whose rates are 0 where all of them are 0.
    void find_still(prediction_problem const& p) {
        for (std::size_t i = 0; i < still_.size(); ++i)
            still_[i] = p.initial[i].lower() == 0 && p.initial[i].upper() == 0;
        for (bool changed = true; changed;) {
            changed = false;
            graph g;
            auto const rate = images(g, p.model, p.model.rate);
            for (std::size_t i = 0; i < still_.size(); ++i) {
                if (!still_[i] || g.is(rate[i], 0)) continue;
                still_[i] = false;
                changed = true;
            }
        }
    }
    void rewrite(recorded_model const& from) {
        auto& m = problem.model;
        m.g = graph();
        m.stated.reset();
        auto nodes = from.rate;
        nodes.insert(nodes.end(), what.margins.begin(), what.margins.end());
        auto const image = images(m.g, from, nodes);
        auto const split = image.begin() + static_cast<std::ptrdiff_t>(from.rate.size());
        m.rate.assign(image.begin(), split);
        what.margins.assign(split, image.end());
        m.observe.clear();
        m.about.channels.clear();
        m.added_states.clear();
        for (auto& d : m.derived) d.value = images(m.g, from, {d.value}).front();
    }
    void fix_idle(box const& around) {
        auto const& m = problem.model;
        auto outputs = m.rate;
        outputs.insert(outputs.end(), what.margins.begin(), what.margins.end());
        auto const follows = followed(m, problem.choice);
        // Derived constants depend on those of their formulas.
        std::vector<bool> used(m.about.constants.size(), false);
        auto const mark = [&](std::vector<node_id> const& of) {
            for (auto const k : leaves_of(m.g, of, operation::constant)) used[k] = true;
        };
        mark(outputs);
        for (auto d = follows.rbegin(); d != follows.rend(); ++d) {
            if (used[d->constant]) mark({d->value});
        }
        auto const& unknown = problem.choice.unknown;
        for (std::size_t j = 0; j < unknown.size(); ++j) {
            idle[j] = !used[index_of(m.about.constants, unknown[j], "constant")];
            if (!idle[j]) continue;
            auto const one = interval(mid(around[j]));
            for (auto& s : problem.sets) s[j] = one;
        }
        std::sort(problem.sets.begin(), problem.sets.end(),
                  [](box const& a, box const& b) { return ends_of(a) < ends_of(b); });
        problem.sets.erase(
            std::unique(problem.sets.begin(), problem.sets.end(),
                        [](box const& a, box const& b) { return ends_of(a) == ends_of(b); }),
            problem.sets.end());
    }

    std::vector<bool> defined_, still_;
    std::vector<std::optional<double>> held_;
};

} // namespace sivid::decision_detail

#endif
