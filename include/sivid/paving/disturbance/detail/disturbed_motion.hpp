// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_DISTURBANCE_DETAIL_DISTURBED_MOTION_HPP
#define SIVID_PAVING_DISTURBANCE_DETAIL_DISTURBED_MOTION_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/disturbance.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/model/structure/state_sum.hpp>
#include <sivid/model/structure/states_seen.hpp>
#include <sivid/paving/relation/detail/cell_means.hpp>
#include <sivid/paving/relation/detail/motion_cells.hpp>
#include <sivid/paving/relation/detail/observed_motion.hpp>
#include <sivid/paving/relation/input_range.hpp>
#include <sivid/paving/relation/integrand_set.hpp>
#include <sivid/paving/relation/time_cell.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

/// What the undisturbed equations do in one cell of time around a straight line l(t) of the states,
/// for z = x - l and parameters p around their middle:
///   \f$ z' = c(t) + J z + F (p - \bar p) + r + d \f$.
struct disturbed_cell {
    interval length;
    std::vector<interval> by_state, by_parameter; ///< J and F, row by row, at all places of the box
    std::vector<interval> defect;                 ///< the mean of c = f(l) - l'
    std::vector<double> swing;                    ///< of c: at most so far from some number
    std::vector<interval> rough;                  ///< r, of rates without slopes: then J = F = 0
    std::vector<interval> beside;                 ///< z in the cell
};
/// One measurement: \f$ y - g(l) = H z + G (p - \bar p) \f$.
struct disturbed_sample {
    std::size_t node = 0, channel = 0;
    std::vector<interval> by_state, by_parameter;
    interval rest; ///< what was measured, with its bound, less g(l)
};
/// One experiment along lines between nodes; `beside[k]` encloses z at node k.
struct disturbed_motion {
    std::vector<std::vector<double>> line;
    std::vector<box> beside;
    std::vector<disturbed_cell> cells;
    std::vector<disturbed_sample> samples;
};

/// Where the states are at the nodes, and over the cells between.
struct motion_tube {
    std::vector<box> at, over;

    static void narrow(box& x, box const& known) {
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = agreed(x[i], known[i]);
    }
};

/// The motions of a problem around lines: of all that keep the bounds of the measured states with
/// disturbances up to a size, or of one trajectory.
class disturbed_motions {
    using traits = interval_traits<interval>;

public:
    /// @given  a valid problem without outlier budgets, a valid set
    disturbed_motions(identification_problem const& problem, disturbance_set const& set)
        : problem_(&problem), set_(&set) {
        // A channel for each state: one of which nothing is measured gives the cells of time where
        // no other does.
        auto seen = with_disturbance(problem, set, 0);
        seen.model = with_states_seen(std::move(seen.model));
        driven_ = sivid::bind(seen.model, problem.choice, open(seen.model));
        sums_ = find_state_sums(driven_.g, driven_.rate);
        std::vector<experiment const*> all;
        for (auto const& e : problem.experiments) all.push_back(&e);
        model_ = sivid::bind(problem.model, problem.choice, open(problem.model));
        shown_ = measured_states(model_, all);
        alone_ = std::none_of(shown_.begin(), shown_.end(), [](auto const& s) { return s; });
        if (alone_) shown_[0] = problem.model.about.channels.size();
        clock_ = **std::find_if(shown_.begin(), shown_.end(), [](auto const& s) { return s; });
        auto functions = model_.rate;
        rates_ = integrand_set::of(model_.g, functions, model_.state_count(),
                                   model_.about.inputs.size());
        for (std::size_t s = 0; s < problem.experiments.size(); ++s) cut(s);
    }
    disturbed_motions(disturbed_motions const&) = delete; // sets point into graphs
    disturbed_motions& operator=(disturbed_motions const&) = delete;

    [[nodiscard]] std::size_t states() const { return model_.state_count(); }
    [[nodiscard]] std::size_t experiments() const { return grids_.size(); }
    [[nodiscard]] std::vector<double> const& times(std::size_t s) const { return grids_[s].times; }
    /// The measurements in the order of their samples.
    [[nodiscard]] record const& measured(std::size_t s) const { return grids_[s].measured; }

    /// Where the states of all motions can be that keep the bounds of measured states, for
    /// parameters of a box and disturbances up to `size`.
    [[nodiscard]] motion_tube tube(std::size_t s, box const& parameters, double size) const {
        auto const e = disturbed(s, size);
        motion_cells const known(driven_, parameters, e, shown_, false, sums_);
        auto const reach = known.enclosures();
        auto const& grid = grids_[s];
        auto const n = states();
        motion_tube result;
        for (auto const t : grid.times) {
            auto& x = result.at.emplace_back(n);
            for (std::size_t i = 0; i < n; ++i) x[i] = known.over(reach, i, t, t);
        }
        for (std::size_t c = 0; c < known.size(); ++c) {
            narrow_at(grid, known[c].from, reach.at[c], result.at);
            narrow_at(grid, known[c].to, reach.at[c + 1], result.at);
        }
        motion_tube::narrow(result.at[0], e.initial);
        for (std::size_t k = 0; k + 1 < grid.times.size(); ++k) {
            auto& x = result.over.emplace_back(n);
            for (std::size_t i = 0; i < n; ++i)
                x[i] = known.over(reach, i, grid.times[k], grid.times[k + 1]);
        }
        return result;
    }
    /// Around the middle of a tube.
    [[nodiscard]] disturbed_motion within(std::size_t s, motion_tube const& tube,
                                          box const& parameters, double size) const {
        std::vector<std::vector<double>> line;
        for (auto const& x : tube.at) line.push_back(middle_of(x));
        return around(s, std::move(line), tube.at, tube.over, parameters, size);
    }
    /// Along one trajectory, which is given at the times of the nodes: nothing beside it.
    [[nodiscard]] disturbed_motion along(std::size_t s, std::vector<std::vector<double>> line,
                                         std::vector<double> const& parameters) const {
        std::vector<box> at, over;
        for (auto const& x : line) at.push_back(point_box(x));
        for (std::size_t k = 0; k + 1 < at.size(); ++k) over.push_back(hull(at[k], at[k + 1]));
        return around(s, std::move(line), at, over, point_box(parameters), 0);
    }

private:
    struct time_grid {
        std::vector<double> times;
        record measured;
        std::vector<box> inputs;                   ///< over each cell
        std::vector<std::vector<cell_line>> lines; ///< of inputs, then time
    };

    [[nodiscard]] static std::vector<signal> open(recorded_model const& model) {
        return std::vector<signal>(model.about.inputs.size(),
                                   sampled_signal({0.0}, {0.0}, interpolation::linear));
    }
    [[nodiscard]] static std::vector<double> middle_of(box const& x) {
        std::vector<double> result;
        for (auto const& side : x) result.push_back(is_bounded(side) ? mid(side) : 0.0);
        return result;
    }
    /// The experiment with its disturbances, and with samples that say nothing: at its end, and
    /// where no channel shows a state at all measured times.
    [[nodiscard]] experiment disturbed(std::size_t s, double size) const {
        auto asked = *problem_;
        asked.experiments = {problem_->experiments[s]};
        auto e = std::move(with_disturbance(std::move(asked), *set_, size).experiments.front());
        record idle;
        for (auto const& m : e.measurements) {
            if (alone_ || m.time == e.end()) idle.push_back({m.time, clock_, traits::entire()});
        }
        e.measurements.insert(e.measurements.end(), idle.begin(), idle.end());
        return e;
    }
    void cut(std::size_t s) {
        auto const& e = problem_->experiments[s];
        time_grid grid;
        motion_cells const known(driven_, problem_->prior, disturbed(s, 0), shown_, false, sums_);
        grid.times = {e.begin};
        for (std::size_t c = 0; c < known.size(); ++c) grid.times.push_back(known[c].to);
        grid.measured = sorted(e.measurements);
        double const end = grid.measured.back().time;
        for (auto const& m : grid.measured) grid.times.push_back(m.time);
        add_knots(grid.times, e.inputs, e.begin, end);
        std::sort(grid.times.begin(), grid.times.end());
        std::erase_if(grid.times, [end](double t) { return t > end; });
        grid.times.erase(std::unique(grid.times.begin(), grid.times.end()), grid.times.end());
        for (std::size_t k = 0; k + 1 < grid.times.size(); ++k) {
            double const from = grid.times[k], to = grid.times[k + 1];
            auto& over = grid.inputs.emplace_back(e.inputs.size());
            auto& lines = grid.lines.emplace_back();
            for (std::size_t u = 0; u < e.inputs.size(); ++u) {
                over[u] = input_over(e.inputs[u], from, to);
                lines.push_back(input_line(e.inputs[u], from, to));
            }
            lines.push_back(cell_line::of(from, to, interval(0.0)));
        }
        grids_.push_back(std::move(grid));
    }
    static void narrow_at(time_grid const& grid, double t, box const& known, std::vector<box>& at) {
        auto const k = std::lower_bound(grid.times.begin(), grid.times.end(), t);
        if (k == grid.times.end() || *k != t) return;
        motion_tube::narrow(at[static_cast<std::size_t>(k - grid.times.begin())], known);
    }

    [[nodiscard]] disturbed_motion around(std::size_t s, std::vector<std::vector<double>> line,
                                          std::vector<box> const& at, std::vector<box> const& over,
                                          box const& parameters, double size) const {
        disturbed_motion result;
        result.line = std::move(line);
        for (std::size_t k = 0; k < at.size(); ++k) {
            auto& z = result.beside.emplace_back(states());
            for (std::size_t i = 0; i < states(); ++i)
                z[i] = traits::sub(at[k][i], traits::point(result.line[k][i]));
        }
        auto all = rates_.functions;
        for (auto const& row : rates_.slopes) all.insert(all.end(), row.begin(), row.end());
        for (auto const& row : model_.rate_dp) all.insert(all.end(), row.begin(), row.end());
        cell_ranges along{{model_.g, all}, {model_.g, rates_.functions}, {model_.g, {}}};
        graph_range range(model_.g, all);
        for (std::size_t k = 0; k + 1 < at.size(); ++k)
            result.cells.push_back(cell_of(s, k, result, over[k], parameters, size, along, range));
        add_samples(s, result, at, parameters);
        return result;
    }
    [[nodiscard]] disturbed_cell cell_of(std::size_t s, std::size_t k,
                                         disturbed_motion const& motion, box const& over,
                                         box const& parameters, double size, cell_ranges& along,
                                         graph_range& range) const {
        auto const n = states();
        auto const& grid = grids_[s];
        double const from = grid.times[k], to = grid.times[k + 1];
        time_cell cell{
            from,
            to,
            {traits::bounds(from, to), box(n), point_box(mid(parameters)), grid.inputs[k]},
            {}};
        auto const& first = motion.line[k];
        auto const& last = motion.line[k + 1];
        box wide(n);
        for (std::size_t i = 0; i < n; ++i) {
            cell.at.states[i] = hull(interval(first[i]), interval(last[i]));
            cell.lines.push_back(cell_line::of(first[i], last[i], interval(0.0)));
            wide[i] = hull(cell.at.states[i], over[i]);
        }
        cell.lines.insert(cell.lines.end(), grid.lines[k].begin(), grid.lines[k].end());
        along.natural.evaluate(cell.at);
        along.centred.evaluate(centre_of(cell));
        range.evaluate({cell.at.time, wide, parameters, cell.at.inputs});

        disturbed_cell result;
        result.length = traits::sub(traits::point(to), traits::point(from));
        bool undefined = false;
        for (std::size_t i = 0; i < n; ++i) {
            auto const mean = mean_over(rates_, i, cell, along, {});
            auto const rise = traits::sub(traits::point(last[i]), traits::point(first[i]));
            auto const slope = traits::div(rise, result.length, undefined);
            result.defect.push_back(traits::sub(mean.whole, slope));
            result.swing.push_back(mean.swing);
            auto const f = rates_.functions[i];
            bool const defined = !range.undefined(f) && !along.natural.undefined(f);
            result.rough.push_back(add_slopes(i, range, result) ? traits::point(0.0)
                                   : defined ? traits::sub(range.value(f), along.natural.value(f))
                                             : traits::entire());
            result.beside.push_back(beside_line(i, motion, k, over,
                                                defined ? range.value(f) : traits::entire(), slope,
                                                size, result.length));
        }
        return result;
    }
    /// @returns false, and slopes of 0, where a rate has none
    [[nodiscard]] bool add_slopes(std::size_t i, graph_range const& range,
                                  disturbed_cell& cell) const {
        auto const f = rates_.functions[i];
        bool smooth = rates_.continuous[i] && !range.undefined(f);
        auto const take = [&](node_id d, std::vector<interval>& to) {
            auto const& slope = range.value(d);
            smooth = smooth && (model_.g.is(d, 0) || (!range.undefined(d) && is_bounded(slope)));
            to.push_back(model_.g.is(d, 0) ? traits::point(0.0) : slope);
        };
        auto const x = cell.by_state.size(), p = cell.by_parameter.size();
        for (std::size_t j = 0; j < states(); ++j) take(rates_.slopes[i][j], cell.by_state);
        for (auto const d : model_.rate_dp[i]) take(d, cell.by_parameter);
        if (smooth) return true;
        std::fill(cell.by_state.begin() + static_cast<std::ptrdiff_t>(x), cell.by_state.end(),
                  traits::point(0.0));
        std::fill(cell.by_parameter.begin() + static_cast<std::ptrdiff_t>(p),
                  cell.by_parameter.end(), traits::point(0.0));
        return false;
    }
    /// x - l over a cell: what is there beside the line, and what the ends and the rate allow.
    [[nodiscard]] interval beside_line(std::size_t i, disturbed_motion const& motion, std::size_t k,
                                       box const& over, interval const& rate, interval const& slope,
                                       double size, interval const& length) const {
        auto const line = hull(interval(motion.line[k][i]), interval(motion.line[k + 1][i]));
        auto result = traits::sub(over[i], line);
        auto moves = traits::sub(rate, slope);
        for (auto const& q : set_->equations) {
            if (q.index != i) continue;
            double const most = traits::mul(traits::point(size), traits::point(q.scale)).upper();
            moves = traits::add(moves, traits::bounds(-most, most));
        }
        auto const span = traits::mul(traits::bounds(0.0, 1.0), length);
        result = agreed(result, traits::add(motion.beside[k][i], traits::mul(span, moves)));
        return agreed(result, traits::sub(motion.beside[k + 1][i], traits::mul(span, moves)));
    }
    void add_samples(std::size_t s, disturbed_motion& motion, std::vector<box> const& at,
                     box const& parameters) const {
        auto const& e = problem_->experiments[s];
        auto const& grid = grids_[s];
        auto all = model_.observe;
        for (auto const& row : model_.observe_dx) all.insert(all.end(), row.begin(), row.end());
        for (auto const& row : model_.observe_dp) all.insert(all.end(), row.begin(), row.end());
        graph_range centred(model_.g, all), range(model_.g, all);
        for (auto const& m : grid.measured) {
            disturbed_sample sample;
            sample.node = static_cast<std::size_t>(
                std::lower_bound(grid.times.begin(), grid.times.end(), m.time) -
                grid.times.begin());
            sample.channel = m.channel;
            leaf_ranges here{traits::point(m.time), point_box(motion.line[sample.node]),
                             point_box(mid(parameters)), box(e.inputs.size())};
            for (std::size_t u = 0; u < e.inputs.size(); ++u)
                here.inputs[u] = input_over(e.inputs[u], m.time, m.time);
            centred.evaluate(here);
            here.states = hull(here.states, at[sample.node]);
            here.constants = parameters;
            range.evaluate(here);
            add_slopes(m, centred, range, sample);
            motion.samples.push_back(std::move(sample));
        }
    }
    void add_slopes(measurement const& m, graph_range const& centred, graph_range const& range,
                    disturbed_sample& sample) const {
        auto const g = model_.observe[m.channel];
        auto const needed = reachable(model_.g, {g});
        bool smooth = !range.undefined(g) && !centred.undefined(g);
        for (std::size_t k = 0; k < needed.size(); ++k)
            smooth = smooth && !(needed[k] && model_.g.nodes()[k].op == operation::sign);
        auto const take = [&](node_id d, std::vector<interval>& to) {
            smooth = smooth && !range.undefined(d) && is_bounded(range.value(d));
            to.push_back(range.value(d));
        };
        for (auto const d : model_.observe_dx[m.channel]) take(d, sample.by_state);
        for (auto const d : model_.observe_dp[m.channel]) take(d, sample.by_parameter);
        // What cannot be written in slopes says nothing.
        sample.rest = smooth ? traits::sub(m.bound, centred.value(g)) : traits::entire();
        if (smooth) return;
        std::fill(sample.by_state.begin(), sample.by_state.end(), traits::point(0.0));
        std::fill(sample.by_parameter.begin(), sample.by_parameter.end(), traits::point(0.0));
    }

    identification_problem const* problem_;
    disturbance_set const* set_;
    bound_model model_, driven_; ///< without and with disturbances, inputs as leaves
    integrand_set rates_;        ///< of the first
    std::vector<state_sum> sums_;
    std::vector<std::optional<std::size_t>> shown_;
    bool alone_ = false;    ///< no channel shows a state as it is
    std::size_t clock_ = 0; ///< a channel that shows one, or would
    std::vector<time_grid> grids_;
};

} // namespace sivid::paving_detail

#endif
