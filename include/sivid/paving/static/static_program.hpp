// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_STATIC_PROGRAM_HPP
#define SIVID_PAVING_STATIC_STATIC_PROGRAM_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/arithmetic.hpp>
#include <sivid/model/graph/program.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/paving/static_problem.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

/// Values of a `static_program`, and what of them holds for the present parameters.
template <class I>
struct static_memory {
    using mask = typename interval_traits<I>::mask;

    std::vector<I> values; ///< by node
    mask common{}, time{}; ///< where they are not defined
    struct part {
        bool known = false;
        mask undefined{};
    };
    std::vector<part> value_part, slope_part; ///< by channel: what parameters alone decide
};

/// The measured channels of a static problem and their gradients as straight-line programs in which
/// the time is an input, so that all measurements of a channel share one. What parameters alone
/// decide is computed once for each of them, what time alone decides may be kept for each time.
/// @guarantee  with interval arithmetic: enclosures of the model's real functions
/// @cost  of the construction: that of the model, however many measurements there are
class static_program {
public:
    /// @given  a valid problem (checked)
    explicit static_program(static_problem const& problem) {
        problem.require_valid();
        auto const bound = bind(problem.model, problem.choice, {});
        auto const& g = bound.g;
        parameters_ = bound.parameter_count();
        channels_.resize(bound.channel_count());
        std::vector<bool> measured(channels_.size(), false);
        for (auto const& m : problem.measurements) measured[m.channel] = true;
        node_sorter sorted(g);
        leaves_ = program::marked(g, sorted.leaves);
        for (auto const& l : leaves_.leaves()) {
            if (l.op == operation::time) clock_.push_back(l.target);
        }
        for (std::size_t c = 0; c < channels_.size(); ++c) {
            if (measured[c]) sorted.count_users(bound.observe[c]);
        }
        common_ =
            sorted.block([&](std::size_t i) { return sorted.users[i] > 1 && !sorted.timed(i); });
        for (std::size_t c = 0; c < channels_.size(); ++c) {
            if (measured[c])
                channels_[c] = channel_of(sorted, bound.observe[c], bound.observe_dp[c]);
        }
    }

    [[nodiscard]] std::size_t parameters() const { return parameters_; }
    /// Whether the mean value theorem holds for a channel: no jump in it.
    [[nodiscard]] bool differentiable(std::size_t c) const { return channels_[c].differentiable; }
    /// The values that time alone decides and that the rest of a channel reads.
    [[nodiscard]] std::vector<node_id> const& timed(std::size_t c) const {
        return channels_[c].timed;
    }
    /// Besides these, what the gradient reads of what `value` has computed, and the value.
    [[nodiscard]] std::vector<node_id> const& kept(std::size_t c) const {
        return channels_[c].kept;
    }

    template <class I>
    [[nodiscard]] static_memory<I> memory() const {
        static_memory<I> m;
        m.values = leaves_.template memory<proven_arithmetic<I>>();
        m.value_part.resize(channels_.size());
        m.slope_part.resize(channels_.size());
        return m;
    }
    /// Writes the parameters and runs what channels share.
    template <class I, class Parameter>
    void start(static_memory<I>& m, Parameter const& parameter) const {
        for (auto const& l : leaves_.leaves()) {
            if (l.op == operation::constant) m.values[l.target] = parameter(std::size_t{l.index});
        }
        m.common = common_.template run<proven_arithmetic<I>>(m.values);
        for (auto& p : m.value_part) p.known = false;
        for (auto& p : m.slope_part) p.known = false;
    }
    /// Sets the time for a channel, in each lane its own.
    template <class I>
    void at(static_memory<I>& m, std::size_t c, I const& time) const {
        for (auto const target : clock_) m.values[target] = time;
        m.time = channels_[c].time_steps.template run<proven_arithmetic<I>>(m.values);
    }
    /// The channel over the parameters at the time; `undefined` is set where it is not defined.
    template <class I>
    I const& value(static_memory<I>& m, std::size_t c,
                   typename interval_traits<I>::mask& undefined) const {
        auto const& o = channels_[c];
        auto& part = m.value_part[c];
        if (!part.known) part = {true, o.once.template run<proven_arithmetic<I>>(m.values)};
        undefined = static_cast<typename interval_traits<I>::mask>(
            undefined | m.common | m.time | part.undefined |
            o.steps.template run<proven_arithmetic<I>>(m.values));
        return m.values[o.value];
    }
    /// What `value` gave last.
    template <class I>
    I const& last_value(static_memory<I> const& m, std::size_t c) const {
        return m.values[channels_[c].value];
    }
    /// Makes the gradient of a channel, after its value.
    template <class I>
    void differentiate_at(static_memory<I>& m, std::size_t c,
                          typename interval_traits<I>::mask& undefined) const {
        auto const& o = channels_[c];
        auto& part = m.slope_part[c];
        if (!part.known) part = {true, o.slopes_once.template run<proven_arithmetic<I>>(m.values)};
        undefined = static_cast<typename interval_traits<I>::mask>(
            undefined | part.undefined |
            o.slope_steps.template run<proven_arithmetic<I>>(m.values));
    }
    template <class I>
    I const& slope(static_memory<I> const& m, std::size_t c, std::size_t j) const {
        return m.values[channels_[c].slopes[j]];
    }

private:
    struct channel {
        node_id value = 0;
        std::vector<node_id> slopes, timed, kept;
        program once, slopes_once, time_steps, steps, slope_steps;
        bool differentiable = true;
    };

    /// Tells nodes apart by what they depend on.
    struct node_sorter {
        graph const& g;
        std::vector<bool> leaves;
        std::vector<std::size_t> users; ///< how many channels use each

        explicit node_sorter(graph const& of) : g(of), users(of.size(), 0) {
            for (auto const& n : g.nodes()) leaves.push_back(is_leaf(n.op));
        }
        void count_users(node_id channel) {
            auto const below = operands_of(g, {channel});
            for (std::size_t i = 0; i < g.size(); ++i) users[i] += below[i] ? 1 : 0;
        }
        [[nodiscard]] bool timed(std::size_t i) const {
            return (g.depends(static_cast<node_id>(i)) & on_time) != 0;
        }
        [[nodiscard]] bool time_alone(std::size_t i) const {
            return g.depends(static_cast<node_id>(i)) == on_time;
        }
        template <class F>
        [[nodiscard]] program block(F const& wanted) const {
            std::vector<bool> operations(g.size());
            for (std::size_t i = 0; i < g.size(); ++i) operations[i] = !leaves[i] && wanted(i);
            return program::marked(g, operations);
        }
    };
    [[nodiscard]] static channel channel_of(node_sorter const& of, node_id value,
                                            std::vector<node_id> const& slopes) {
        auto const& g = of.g;
        auto const below = operands_of(g, {value}), wanted = operands_of(g, slopes);
        auto const more = [&](std::size_t i) { return wanted[i] && !below[i]; };
        auto const later = [&](std::size_t i) { return of.timed(i) && !of.time_alone(i); };
        channel o;
        o.value = value;
        o.slopes = slopes;
        o.once =
            of.block([&](std::size_t i) { return below[i] && !of.timed(i) && of.users[i] == 1; });
        o.slopes_once =
            of.block([&](std::size_t i) { return more(i) && !of.timed(i) && of.users[i] < 2; });
        o.time_steps =
            of.block([&](std::size_t i) { return (below[i] || wanted[i]) && of.time_alone(i); });
        o.steps = of.block([&](std::size_t i) { return below[i] && later(i); });
        o.slope_steps = of.block([&](std::size_t i) { return more(i) && later(i); });
        auto const read = read_by(g.size(), o, {&o.steps, &o.slope_steps});
        for (std::size_t i = 0; i < g.size(); ++i) {
            if (read[i] && of.time_alone(i)) o.timed.push_back(static_cast<node_id>(i));
        }
        auto const read_by_slopes = read_by(g.size(), o, {&o.slope_steps});
        for (auto const& s : o.steps.steps()) {
            if (read_by_slopes[s.target]) o.kept.push_back(s.target);
        }
        for (std::size_t i = 0; i < g.size(); ++i) {
            bool const varies = (g.depends(static_cast<node_id>(i)) & on_constant) != 0;
            bool const jumps = below[i] && g.nodes()[i].op == operation::sign && varies;
            o.differentiable = o.differentiable && !jumps;
        }
        return o;
    }
    /// Which nodes are results of a channel, or what some of its programs read.
    [[nodiscard]] static std::vector<bool> read_by(std::size_t nodes, channel const& o,
                                                   std::vector<program const*> const& programs) {
        std::vector<bool> read(nodes, false);
        read[o.value] = true;
        for (auto const s : o.slopes) read[s] = true;
        for (auto const* p : programs) {
            for (auto const& s : p->steps()) read[s.a] = read[s.b] = true;
        }
        return read;
    }

    std::size_t parameters_ = 0;
    program leaves_, common_;
    std::vector<program::slot> clock_;
    std::vector<channel> channels_;
};

} // namespace sivid

#endif
