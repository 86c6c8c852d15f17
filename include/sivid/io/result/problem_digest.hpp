// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_RESULT_PROBLEM_DIGEST_HPP
#define SIVID_IO_RESULT_PROBLEM_DIGEST_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/problem_text.hpp>
#include <sivid/number/text/sha256.hpp>
#include <sivid/paving/identify.hpp>

#include <string>
#include <variant>
#include <vector>

namespace sivid {

namespace io_detail {

using model_detail::canonical_text;

/// A digest of each node: of its operation and those of its operands, whatever their numbers.
inline std::vector<std::string> structure_of(graph const& g) {
    std::vector<std::string> digests;
    digests.reserve(g.size());
    for (auto const& n : g.nodes()) {
        canonical_text t;
        t("node", n.op);
        if (n.op == operation::literal) {
            t("literal", g.value(n).enclosure, g.value(n).nearest);
        } else if (is_leaf(n.op)) {
            t("leaf", n.index);
        } else if (is_binary(n.op)) {
            auto const& a = digests[n.a];
            auto const& b = digests[n.b];
            bool const ordered = n.op == operation::sub || n.op == operation::div || a < b;
            t("operands", ordered ? a : b, ordered ? b : a);
        } else {
            t("operand", digests[n.a], n.index);
        }
        digests.push_back(sha256(t.text()));
    }
    return digests;
}

/// The problem, but of its graphs only what they say: a compiler may record the operands of a sum
/// in either order, and a graph may hold more than is needed.
inline void describe_meaning(canonical_text& t, identification_problem p) {
    auto& m = p.model;
    auto const nodes = structure_of(m.g);
    for (auto const k : m.rate) t("rate", nodes[k]);
    for (auto const k : m.observe) t("observe", nodes[k]);
    for (auto const& s : m.added_states) t("added state", s.state, nodes[s.at_begin]);
    for (auto const& d : m.derived) t("derived constant", d.constant, nodes[d.value], d.always);
    m.g = graph();
    m.rate.clear();
    m.observe.clear();
    m.added_states.clear();
    m.derived.clear();
    for (auto& e : p.experiments) {
        for (auto& input : e.inputs) {
            auto const* formula = std::get_if<analytic_signal>(&input);
            if (formula == nullptr) continue;
            t("formula", structure_of(formula->g)[formula->value]);
            input = sampled_signal{};
        }
    }
    describe(t, p);
}

inline void describe(canonical_text& t, run_options const& o) {
    t("run", o.set, o.degree, o.hopeless, o.order, o.variational_order, o.method.has_value(),
      o.tolerance, o.relative_tolerance, o.minimum_step, 1.0, o.maximum_steps, o.widest,
      o.remainder_share);
    if (o.maximum_step) t("longest step", *o.maximum_step);
    if (!o.method) return;
    t("method", o.method->name, o.method->order);
    auto const coefficients = [&t](std::vector<surd> const& list) {
        for (auto const& x : list) t("surd", x.numerator, x.denominator, x.factor, x.radicand);
    };
    for (auto const& row : o.method->a) coefficients(row);
    coefficients(o.method->b);
    coefficients(o.method->c);
}

/// Everything that decides what a search does; budgets and threads do not.
inline void describe(canonical_text& t, identify_options const& o) {
    auto const& s = o.search;
    t("options", o.only_hulls, o.drawn_boxes);
    for (auto const& step : o.strategy.steps)
        for (auto const& by : step.by) t("contractor", by->name(), step.share, step.ends);
    t("search", s.accuracy, s.accuracy_of_hull, s.hull_gain, s.small_hull, s.sufficient_ratio,
      s.order, s.keep_outside, s.batches);
    t("test", o.test.contract, o.test.cut, o.test.sharp_enough, o.test.witness_steps);
    describe(t, static_cast<run_options const&>(o.test));
    describe(t, o.test.witness);
}

} // namespace io_detail

/// A digest of a problem and of the options that decide what its search does: SHA-256 over model
/// (its recorded equations), constants, prior, inputs, measurements and options, numbers exact.
/// Budgets of time, boxes and memory, and threads are not in it.
/// @param also  what else it shall depend on, the digest of the data set's files for instance
/// @cost  linear in the problem
[[nodiscard]] SIVID_DECL std::string problem_digest(identification_problem const& problem,
                                                    identify_options const& options,
                                                    std::string const& also = {});

/// A digest of what is asked, for whoever reads the answer later: SHA-256 over model, constants,
/// prior, inputs, measurements, starts and budgets of outliers. Of the recorded equations counts
/// what they say, not in which order they were recorded.
/// @cost  linear in the problem
[[nodiscard]] SIVID_DECL std::string problem_digest(identification_problem const& problem);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/result/impl/problem_digest.ipp>
#endif

#endif // SIVID_IO_RESULT_PROBLEM_DIGEST_HPP
