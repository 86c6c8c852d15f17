// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CLAIM_DETAIL_EMBEDDED_PROBLEM_HPP
#define SIVID_DIAGNOSIS_CLAIM_DETAIL_EMBEDDED_PROBLEM_HPP

#include <sivid/model/effect.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/paving/relation/detail/untouched_relation.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sivid {

/// What an unknown of a richer model has to be for the model to move as a poorer one does.
struct embedded_parameter {
    std::optional<std::size_t> same; ///< this unknown of the poorer model; nothing: `neutral`
    double neutral = 0;
};
/// One for each unknown of the richer model.
using embedding = std::vector<embedded_parameter>;

/// The name of an effect, or of its parameter, without what wider priors add to it.
[[nodiscard]] inline std::string without_wider(std::string name) {
    for (auto at = name.find(detail::wider); at != std::string::npos; at = name.find(detail::wider))
        name.erase(at, detail::wider.size());
    return name;
}

namespace diagnosis_detail {

/// An operation as it is, but for products and quotients with 0 that are defined everywhere, such
/// as friction that is smooth at rest: those are 0.
struct operation_without_zeros {
    [[nodiscard]] node_id operator()(node const& n, node_id a, node_id b, graph& to) const {
        auto const made = same_operation{}(n, a, b, to);
        bool const zero = (n.op == operation::mul && (to.is(a, 0) || to.is(b, 0))) ||
                          (n.op == operation::div && to.is(a, 0));
        return zero && is_defined_everywhere(to, made) ? to.constant(0.0) : made;
    }

private:
    [[nodiscard]] static bool is_defined_everywhere(graph const& g, node_id i) {
        auto const anything = [&](operation kind) {
            std::size_t count = 0;
            for (auto const k : leaves_of(g, {i}, kind)) count = std::max(count, k + 1);
            return box(std::vector<interval>(count, interval_traits<interval>::entire()));
        };
        graph_range range(g, {i});
        range.evaluate({interval_traits<interval>::entire(), anything(operation::state),
                        anything(operation::constant), anything(operation::input)});
        return !range.undefined(i);
    }
};

/// Looks whether one problem is a part of another one.
class embedding_search {
public:
    embedding_search(identification_problem const& poorer, identification_problem const& richer)
        : poorer_(&poorer), richer_(&richer) {}

    [[nodiscard]] std::optional<embedding> operator()() {
        auto const &a = poorer_->model, &b = richer_->model;
        bool const alike = a.rate.size() == b.rate.size() && a.observe.size() == b.observe.size() &&
                           a.derived.size() == b.derived.size() &&
                           a.added_states.size() == b.added_states.size();
        if (!alike || !same_data() || !match_constants()) return std::nullopt;
        match_inputs();
        bool const same = same_memory(a.input_memory, b.input_memory, true) &&
                          same_memory(a.channel_delays, b.channel_delays, false) && same_graphs();
        return same ? std::optional(found_) : std::nullopt;
    }

private:
    /// Stands for what the poorer model has not.
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    template <class Items>
    [[nodiscard]] static std::size_t place(Items const& all, std::string const& name) {
        auto const at =
            std::find_if(all.begin(), all.end(), [&](auto const& x) { return x.name == name; });
        return at == all.end() ? none : static_cast<std::size_t>(at - all.begin());
    }
    [[nodiscard]] static std::size_t unknown(identification_problem const& p,
                                             std::string const& name) {
        auto const& all = p.choice.unknown;
        auto const at = std::find(all.begin(), all.end(), name);
        return at == all.end() ? none : static_cast<std::size_t>(at - all.begin());
    }

    /// Experiments of one campaign, and each start of the poorer problem is one of the richer.
    [[nodiscard]] bool same_data() const {
        auto const &a = poorer_->experiments, &b = richer_->experiments;
        if (a.size() != b.size()) return false;
        for (std::size_t e = 0; e < a.size(); ++e) {
            if (a[e].name != b[e].name || a[e].begin != b[e].begin ||
                a[e].outliers != b[e].outliers || a[e].initial.size() != b[e].initial.size() ||
                a[e].measurements.size() != b[e].measurements.size())
                return false;
            for (std::size_t i = 0; i < a[e].initial.size(); ++i)
                if (!subset(a[e].initial[i], b[e].initial[i])) return false;
        }
        return true;
    }

    [[nodiscard]] bool match_constants() {
        auto const &a = poorer_->model.about.constants, &b = richer_->model.about.constants;
        found_.resize(richer_->choice.unknown.size());
        for (auto const& c : b) {
            auto k = place(a, c.name);
            for (std::size_t i = 0; k == none && i < a.size(); ++i)
                if (without_wider(a[i].name) == without_wider(c.name)) k = i;
            auto const own = unknown(*richer_, c.name);
            constants_.push_back(k);
            if (k == none) {
                auto const& value = c.nominal.enclosure;
                bool const neutral = own != none && interval_traits<interval>::is_point(value) &&
                                     subset(value, richer_->prior[own]);
                if (!neutral) return false;
                found_[own].neutral = value.lower();
                continue;
            }
            auto const other = unknown(*poorer_, a[k].name);
            if ((own == none) != (other == none)) return false;
            if (own == none) continue; // a value of the model, or of the data: the same for both
            if (!subset(poorer_->prior[other], richer_->prior[own])) return false;
            found_[own].same = other;
        }
        return true;
    }
    /// A switch, and counted readings, belong to the effect of their name.
    void match_inputs() {
        for (auto const& u : richer_->model.about.inputs)
            inputs_.push_back(place(poorer_->model.about.inputs, u.name));
    }

    /// Delays, clocks and plays of size 0 change nothing; nor do those of an input that the poorer
    /// model lacks, if the graphs are the same.
    [[nodiscard]] bool same_memory(std::vector<signal_memory> const& a,
                                   std::vector<signal_memory> const& b, bool of_inputs) const {
        auto next = a.begin();
        for (auto const& m : b) {
            auto const index = of_inputs ? inputs_[m.index] : m.index;
            auto const size = constants_[m.constant];
            auto const& nominal = richer_->model.about.constants[m.constant].nominal.enclosure;
            bool const zero = size == none && nominal.lower() == 0 && nominal.upper() == 0 &&
                              m.kind != memory_kind::rate_limit;
            if (zero || index == none) continue;
            auto const only_if = m.only_if ? std::optional(inputs_[*m.only_if]) : std::nullopt;
            if (next == a.end() || next->index != index || next->constant != size ||
                next->kind != m.kind || next->only_if != only_if)
                return false;
            ++next;
        }
        return next == a.end();
    }

    /// Rates, channels, derived constants and starts of added states.
    [[nodiscard]] bool same_graphs() const {
        auto const outputs = [](recorded_model const& m) {
            auto all = m.rate;
            all.insert(all.end(), m.observe.begin(), m.observe.end());
            for (auto const& d : m.derived) all.push_back(d.value);
            for (auto const& s : m.added_states) all.push_back(s.at_begin);
            return all;
        };
        auto const &a = poorer_->model, &b = richer_->model;
        for (std::size_t k = 0; k < a.derived.size(); ++k)
            if (a.derived[k].constant != constants_[b.derived[k].constant] ||
                a.derived[k].always != b.derived[k].always)
                return false;
        for (std::size_t k = 0; k < a.added_states.size(); ++k)
            if (a.added_states[k].state != b.added_states[k].state) return false;
        graph left, right;
        auto const lefts = copy_into(left, a.g, outputs(a), same_leaf{}, operation_without_zeros{});
        auto const leaf = [this](node const& n, graph& to) {
            auto const i = static_cast<std::size_t>(n.index);
            if (n.op == operation::constant)
                return constants_[i] == none
                           ? to.constant(richer_->model.about.constants[i].nominal)
                           : to.leaf(n.op, constants_[i]);
            if (n.op == operation::input)
                return to.leaf(n.op, inputs_[i] == none ? poorer_->model.about.inputs.size() + i
                                                        : inputs_[i]);
            return same_leaf{}(n, to);
        };
        auto const rights = copy_into(right, b.g, outputs(b), leaf, operation_without_zeros{});
        paving_detail::same_expressions same(left, right);
        for (std::size_t k = 0; k < lefts.size(); ++k)
            if (!same(lefts[k], rights[k])) return false;
        return true;
    }

    identification_problem const *poorer_, *richer_;
    embedding found_;
    std::vector<std::size_t> constants_, inputs_; ///< of the richer model, in the poorer one
};

} // namespace diagnosis_detail

/// Whether all that one problem can do another one can do, too: with its further unknowns at the
/// values at which their effects vanish.
/// @given  both are one problem with effects joined (`affected`), each known by its name
/// @guarantee  a result: each parameter and start that explain `poorer`, its bounds grown or not,
///   explain `richer` so when embedded. This is read off the recorded models, not believed of the
///   effects: with the further unknowns at these values, which lie in their priors, rates, channels
///   and starts are the same expressions, and no signal is late or held back by more. What has
///   further states (a lag, which has no value at a time constant of 0) is no such problem.
/// @returns  nothing where that is not found
/// @cost  O(size of both models)
[[nodiscard]] inline std::optional<embedding> embedded(identification_problem const& poorer,
                                                       identification_problem const& richer) {
    return diagnosis_detail::embedding_search(poorer, richer)();
}

} // namespace sivid

#endif
