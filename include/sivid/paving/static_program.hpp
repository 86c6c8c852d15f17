// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_PROGRAM_HPP
#define SIVID_PAVING_STATIC_PROGRAM_HPP

#include <sivid/model/arithmetic.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/rewrite.hpp>
#include <sivid/paving/static_problem.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sivid {

/// The measured outputs of a static problem and their gradients as straight-line programs: what
/// several outputs share is a common part, the rest of each output stands apart, so that outputs
/// which are decided already cost nothing.
class static_program {
public:
    /// @given  a valid problem (checked)
    explicit static_program(static_problem const& problem) {
        problem.require_valid();
        auto const bound = bind(problem.model, problem.choice, {});
        parameters_ = bound.parameter_count();
        std::vector<node_id> values;
        std::vector<std::vector<node_id>> slopes;
        for (auto const& m : problem.measurements) {
            auto const leaf = [&m](node const& n, graph& to) {
                if (n.op == operation::time) return to.constant(m.time);
                return to.leaf(n.op, static_cast<std::size_t>(n.index));
            };
            std::vector<node_id> outputs{bound.observe[m.channel]};
            for (auto const d : bound.observe_dp[m.channel]) outputs.push_back(d);
            auto const images = copy_into(g_, bound.g, outputs, leaf);
            values.push_back(images[0]);
            slopes.emplace_back(images.begin() + 1, images.end());
        }
        for (std::size_t i = 0; i < g_.size(); ++i) {
            auto const& n = g_.nodes()[i];
            if (n.op != operation::constant) continue;
            leaves_.emplace_back(i, static_cast<std::size_t>(n.index));
        }
        std::vector<std::size_t> users(g_.size(), 0);
        std::vector<std::vector<bool>> below;
        for (auto const v : values) {
            below.push_back(reachable(g_, {v}));
            for (std::size_t i = 0; i < g_.size(); ++i) users[i] += below.back()[i] ? 1 : 0;
        }
        add_block(common_, [&](std::size_t i) { return users[i] > 1; });
        for (std::size_t k = 0; k < values.size(); ++k) {
            auto& o = outputs_.emplace_back();
            o.value = values[k];
            o.slopes = slopes[k];
            add_block(o.value_steps, [&](std::size_t i) { return below[k][i] && users[i] == 1; });
            auto const wanted = reachable(g_, slopes[k]);
            add_block(o.slope_steps, [&](std::size_t i) {
                return wanted[i] && users[i] < 2 && !(below[k][i] && users[i] == 1);
            });
            count_uses(o, below[k]);
        }
    }

    [[nodiscard]] std::size_t parameters() const { return parameters_; }
    [[nodiscard]] std::size_t outputs() const { return outputs_.size(); }
    /// Whether the mean value theorem holds for an output: no jump in it.
    [[nodiscard]] bool differentiable(std::size_t k) const { return outputs_[k].differentiable; }
    /// Whether a parameter stands in an output more than once, so that its plain evaluation
    /// overestimates.
    [[nodiscard]] bool repeats(std::size_t k) const { return outputs_[k].repeats; }

    /// Memory for one evaluation at a time.
    template <class I>
    [[nodiscard]] std::vector<I> memory() const {
        std::vector<I> m(g_.size(), interval_traits<I>::point(0.0));
        for (std::size_t i = 0; i < g_.size(); ++i) {
            auto const& n = g_.nodes()[i];
            if (n.op == operation::literal) m[i] = proven_arithmetic<I>::enclose(g_.value(n));
        }
        return m;
    }
    /// Writes the parameters and runs the common part.
    /// @returns where that is not defined
    template <class I, class Parameter>
    typename interval_traits<I>::mask start(std::vector<I>& m, Parameter const& parameter) const {
        for (auto const& [slot, j] : leaves_) m[slot] = parameter(j);
        return run(common_, m);
    }
    /// Output k over the parameters; `undefined` is set where it is not defined.
    template <class I>
    I const& value(std::vector<I>& m, std::size_t k,
                   typename interval_traits<I>::mask& undefined) const {
        undefined = static_cast<typename interval_traits<I>::mask>(undefined |
                                                                   run(outputs_[k].value_steps, m));
        return m[outputs_[k].value];
    }
    /// What `value` gave last.
    template <class I>
    I const& last_value(std::vector<I> const& m, std::size_t k) const {
        return m[outputs_[k].value];
    }
    /// Makes the gradient of output k, after its value.
    template <class I>
    void differentiate_at(std::vector<I>& m, std::size_t k,
                          typename interval_traits<I>::mask& undefined) const {
        undefined = static_cast<typename interval_traits<I>::mask>(undefined |
                                                                   run(outputs_[k].slope_steps, m));
    }
    template <class I>
    I const& slope(std::vector<I> const& m, std::size_t k, std::size_t j) const {
        return m[outputs_[k].slopes[j]];
    }

private:
    struct step {
        operation op;
        std::int32_t index;
        node_id target, a, b;
    };
    struct output {
        node_id value = 0;
        std::vector<node_id> slopes;
        std::vector<step> value_steps, slope_steps;
        bool differentiable = true, repeats = false;
    };

    template <class Wanted>
    void add_block(std::vector<step>& block, Wanted const& wanted) const {
        for (std::size_t i = 0; i < g_.size(); ++i) {
            auto const& n = g_.nodes()[i];
            if (is_leaf(n.op) || !wanted(i)) continue;
            block.push_back(
                {n.op, n.index, static_cast<node_id>(i), n.a, is_binary(n.op) ? n.b : n.a});
        }
    }
    /// How often parameters are read on the way to an output.
    void count_uses(output& o, std::vector<bool> const& below) const {
        std::vector<std::size_t> paths(g_.size(), 0);
        paths[o.value] = 1;
        for (std::size_t i = g_.size(); i-- > 0;) {
            auto const& n = g_.nodes()[i];
            if (!below[i]) continue;
            if (n.op == operation::sign) o.differentiable = false;
            if (n.op == operation::constant) o.repeats = o.repeats || paths[i] > 1;
            if (is_leaf(n.op)) continue;
            auto const more = [&](node_id child) { // two is as good as many
                paths[child] = std::min<std::size_t>(paths[child] + paths[i], 2);
            };
            more(n.a);
            if (is_binary(n.op)) more(n.b);
        }
    }
    template <class I>
    static typename interval_traits<I>::mask run(std::vector<step> const& steps,
                                                 std::vector<I>& m) {
        typename interval_traits<I>::mask undefined{};
        for (auto const& s : steps) {
            m[s.target] = apply<proven_arithmetic<I>>(s.op, m[s.a], m[s.b], s.index, undefined);
        }
        return undefined;
    }

    graph g_;
    std::size_t parameters_ = 0;
    std::vector<step> common_;
    std::vector<output> outputs_;
    std::vector<std::pair<std::size_t, std::size_t>> leaves_; ///< node and parameter
};

} // namespace sivid

#endif
