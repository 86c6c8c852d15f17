// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_PROGRAM_HPP
#define SIVID_PAVING_STATIC_PROGRAM_HPP

#include <sivid/model/arithmetic.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/program.hpp>
#include <sivid/model/rewrite.hpp>
#include <sivid/paving/static_problem.hpp>

#include <algorithm>
#include <cstddef>
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
        leaves_ = program::marked(g_, leaves_of());
        std::vector<std::size_t> users(g_.size(), 0);
        std::vector<std::vector<bool>> below;
        for (auto const v : values) {
            below.push_back(reachable(g_, {v}));
            for (std::size_t i = 0; i < g_.size(); ++i) users[i] += below.back()[i] ? 1 : 0;
        }
        common_ = block([&](std::size_t i) { return users[i] > 1; });
        for (std::size_t k = 0; k < values.size(); ++k) {
            auto& o = outputs_.emplace_back();
            o.value = values[k];
            o.slopes = slopes[k];
            o.value_steps = block([&](std::size_t i) { return below[k][i] && users[i] == 1; });
            auto const wanted = reachable(g_, slopes[k]);
            o.slope_steps = block([&](std::size_t i) {
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
        return leaves_.template memory<proven_arithmetic<I>>();
    }
    /// Writes the parameters and runs the common part.
    /// @returns where that is not defined
    template <class I, class Parameter>
    typename interval_traits<I>::mask start(std::vector<I>& m, Parameter const& parameter) const {
        leaves_.read(m, [&](operation, std::size_t j) { return parameter(j); });
        return common_.run<proven_arithmetic<I>>(m);
    }
    /// Output k over the parameters; `undefined` is set where it is not defined.
    template <class I>
    I const& value(std::vector<I>& m, std::size_t k,
                   typename interval_traits<I>::mask& undefined) const {
        undefined = static_cast<typename interval_traits<I>::mask>(
            undefined | outputs_[k].value_steps.template run<proven_arithmetic<I>>(m));
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
        undefined = static_cast<typename interval_traits<I>::mask>(
            undefined | outputs_[k].slope_steps.template run<proven_arithmetic<I>>(m));
    }
    template <class I>
    I const& slope(std::vector<I> const& m, std::size_t k, std::size_t j) const {
        return m[outputs_[k].slopes[j]];
    }

private:
    struct output {
        node_id value = 0;
        std::vector<node_id> slopes;
        program value_steps, slope_steps;
        bool differentiable = true, repeats = false;
    };

    /// The wanted operations.
    template <class Wanted>
    [[nodiscard]] program block(Wanted const& wanted) const {
        auto operations = leaves_of();
        operations.flip();
        for (std::size_t i = 0; i < g_.size(); ++i) operations[i] = operations[i] && wanted(i);
        return program::marked(g_, operations);
    }
    [[nodiscard]] std::vector<bool> leaves_of() const {
        std::vector<bool> leaves;
        for (auto const& n : g_.nodes()) leaves.push_back(is_leaf(n.op));
        return leaves;
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
    graph g_;
    std::size_t parameters_ = 0;
    program leaves_, common_;
    std::vector<output> outputs_;
};

} // namespace sivid

#endif
