// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_SIMULATE_APPROXIMATE_SIMULATOR_HPP
#define SIVID_APPROXIMATE_SIMULATE_APPROXIMATE_SIMULATOR_HPP

#include <sivid/approximate/simulate/approximate_model.hpp>
#include <sivid/approximate/simulate/detail/named_steps.hpp>
#include <sivid/approximate/simulate/detail/sensitive_rate.hpp>
#include <sivid/approximate/simulate/simulation_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

/// What a run returns; reused from run to run.
struct simulated_outputs {
    std::vector<double> values;     ///< one per request
    std::vector<double> jacobian;   ///< requests x columns, row by row
    std::vector<std::size_t> reach; ///< per request: its columns from there on are zero
};

/// States, rates and inputs at the points of the mesh, for those who want to look at a run.
struct simulated_trace {
    std::vector<double> times;
    std::vector<std::vector<double>> states, rates, inputs;
};

/// Simulates one experiment in plain doubles by a stepper of Boost.Odeint, with forward
/// sensitivities as part of its state: those of the method itself, exact but for rounding. Steps
/// end at the knots of the inputs, which delays may move, and at the measurements; between them
/// they are as long as the stepper's estimate of the states' errors allows, so that stiff phases
/// are stepped stably. Not a proof.
/// @cost  steps * stages * (program + non-zeros of the Jacobian * columns)
class approximate_simulator {
public:
    /// @param tolerances  per state, of one step; beside a share of its size: `set_accuracy`
    /// @param knots  of the disturbances, increasing; empty when there are none
    /// @param steps  makes the stepper: `classical_steps`, `dormand_prince_steps`, or `step_by`
    /// with
    ///               any explicit one of Odeint (`odeint_stepping.hpp`)
    approximate_simulator(std::shared_ptr<approximate_model const> model,
                          std::vector<signal> const& inputs, double begin,
                          std::vector<output_request> requests, std::vector<double> tolerances,
                          std::vector<double> knots = {}, stepping_maker steps = classical_steps)
        : mesh_(*model, inputs, begin, std::move(requests), knots),
          rate_(model, std::move(knots)),
          steps_(steps()),
          observe_value_memory_(model->observe().values.memory()),
          observe_memory_(model->observe().expansion.memory()) {
        steps_->tolerance.absolute = std::move(tolerances);
    }

    [[nodiscard]] approximate_model const& model() const { return rate_.model(); }
    [[nodiscard]] std::vector<double> const& knots() const { return rate_.knots(); }
    [[nodiscard]] std::vector<output_request> const& requests() const { return mesh_.requests(); }
    /// Per state, of one step, from now on.
    void set_tolerances(std::vector<double> tolerances) {
        steps_->tolerance.absolute = std::move(tolerances);
        steps_->restart();
    }
    /// Scales the tolerances of the steps from now on. @param relative  share of a state's size
    void set_accuracy(double factor, double relative = 1e-6) {
        steps_->tolerance.accuracy = factor;
        steps_->tolerance.relative = relative;
        steps_->restart();
    }
    /// Asked at the begin of a run and every 64 steps: false ends it without a result.
    void set_keep_going(std::function<bool()> keep_going) { keep_going_ = std::move(keep_going); }

    /// Outputs, and their derivatives when `with_sensitivities`.
    /// @param disturbance  values at the knots: [k * layout.disturbed.size() + equation]
    /// @returns false when the motion leaves the doubles, needs too many steps or was cancelled
    [[nodiscard]] bool operator()(std::vector<double> const& start,
                                  std::vector<double> const& parameters,
                                  std::vector<double> const& disturbance,
                                  sensitivity_layout const& layout, bool with_sensitivities,
                                  simulated_outputs& out, simulated_trace* trace = nullptr) {
        if (keep_going_ && !keep_going_()) return false;
        mesh_.place(parameters);
        rate_.begin(mesh_, parameters, disturbance, layout, with_sensitivities, start, x_);
        auto const& observe = model().observe();
        rate_.write_parameters(observe.values, parameters, observe_value_memory_);
        rate_.write_parameters(observe.expansion, parameters, observe_memory_);
        steps_->restart();
        taken_ = 0;
        out.values.assign(mesh_.requests().size(), 0.0);
        if (with_sensitivities) {
            out.jacobian.assign(mesh_.requests().size() * layout.columns, 0.0);
            out.reach.assign(mesh_.requests().size(), 0);
        }
        fresh_ = false;
        auto const pieces = mesh_.pieces();
        double suggested = 0.01 * (mesh_.time(pieces) - mesh_.time(0));
        for (std::size_t k = 0; k <= pieces; ++k) {
            bool turns = false; // S' does
            if (k < pieces) {
                turns = rate_.enter(k, x_);
                if (mesh_.jumps() && with_sensitivities && k > 0) rate_.shift_by_jumps(k, x_);
            }
            if (mesh_.jumps()) {
                fresh_ = false;
                steps_->restart();
            } else if (fresh_ && with_sensitivities && turns) {
                dx_.conservativeResize(x_.size());
                rate_.differentiate(x_, dx_, mesh_.time(k));
            }
            if (!mesh_.observed(k).empty()) look(k, out);
            if (trace != nullptr) record(k, *trace);
            if (k < pieces && !cross(mesh_.time(k), mesh_.time(k + 1), suggested)) return false;
        }
        return true;
    }

private:
    void refresh(double t) {
        if (fresh_) return;
        dx_.resize(x_.size());
        rate_(x_, dx_, t);
        fresh_ = true;
    }
    /// The outputs that are requested at a point of the mesh.
    void look(std::size_t k, simulated_outputs& out) {
        auto const& f = model().observe();
        auto& memory = rate_.sensitive() ? observe_memory_ : observe_value_memory_;
        auto const& program = rate_.sensitive() ? f.expansion : f.values;
        double const t = mesh_.time(k);
        auto const piece = rate_.exchange_piece(k); // the inputs after a jump
        rate_.write_arguments(memory, t, x_);
        (void)rate_.exchange_piece(piece);
        program.run(memory);
        for (auto const r : mesh_.observed(k)) {
            out.values[r] = memory[program.output(mesh_.requests()[r].channel)];
        }
        if (!rate_.sensitive()) return;
        auto const& layout = rate_.layout();
        for (auto const r : mesh_.observed(k)) {
            auto const channel = mesh_.requests()[r].channel;
            double* row = out.jacobian.data() + r * layout.columns;
            out.reach[r] = rate_.active();
            for (auto const& e : f.by_state) {
                if (e.row != channel) continue;
                double const a = memory[e.slot];
                constexpr auto lanes = sensitive_rate::lanes;
                for (std::size_t c = 0; c < rate_.active(); c += lanes) {
                    double const* s = x_.data() + rate_.at(e.column, c);
                    auto const count = std::min(lanes, rate_.active() - c);
                    for (std::size_t j = 0; j < count; ++j) row[c + j] += a * s[j];
                }
            }
            for (auto const& e : f.by_parameter) {
                auto const c = layout.parameter_column[e.column];
                if (e.row == channel && c != sensitivity_layout::none) row[c] += memory[e.slot];
            }
            look_through_inputs(channel, t, row);
            look_late(mesh_.requests()[r], t, row);
        }
    }
    void look_through_inputs(std::size_t channel, double t, double* row) const {
        auto const& layout = rate_.layout();
        auto const count = layout.disturbed.size();
        for (std::size_t d = 0; d < count; ++d) {
            for (auto const& e : model().observe().by_input) {
                if (e.row != channel || e.column + model().states() != layout.disturbed[d])
                    continue;
                auto const c = layout.first_disturbance + rate_.hat() * count + d;
                double const late = rate_.share(t);
                row[c] += (1 - late) * observe_memory_[e.slot];
                if (rate_.hat() + 1 < knots().size())
                    row[c + count] += late * observe_memory_[e.slot];
            }
        }
    }
    /// d y(t - tau) / d tau = -y'(t - tau), and likewise through an input with a memory.
    void look_late(output_request const& request, double t, double* row) {
        auto const& f = model().observe();
        auto const& memory = observe_memory_;
        auto const& column = rate_.layout().parameter_column;
        for (auto const& d : model().input_memory()) {
            if (!d.unknown) continue;
            auto const c = column[d.parameter];
            for (auto const& e : f.by_input) {
                if (e.row != request.channel || e.column != d.index) continue;
                if (c == sensitivity_layout::none) continue;
                row[c] += memory[e.slot] * mesh_.slope_by(d.kind, rate_.piece(), d.index, t);
            }
        }
        for (auto const& d : model().channel_delays()) {
            if (!d.unknown || !mesh_.shows_late(d, request)) continue;
            auto const c = column[d.parameter];
            if (c == sensitivity_layout::none || !(t > mesh_.time(0))) continue;
            refresh(t);
            double slope = 0;
            for (auto const& e : f.by_state) {
                if (e.row != request.channel) continue;
                slope += memory[e.slot] * dx_[static_cast<Eigen::Index>(e.column)];
            }
            for (auto const& e : f.by_time) {
                if (e.row == request.channel) slope += memory[e.slot];
            }
            for (auto const& e : f.by_input) {
                if (e.row != request.channel) continue;
                slope += memory[e.slot] * mesh_.slope(rate_.piece(), e.column);
            }
            row[c] -= slope * mesh_.moved_by(d.kind, request);
        }
    }
    void record(std::size_t k, simulated_trace& trace) {
        refresh(mesh_.time(k));
        auto const n = model().states();
        trace.times.push_back(mesh_.time(k));
        trace.states.emplace_back(x_.data(), x_.data() + n);
        trace.rates.emplace_back(dx_.data(), dx_.data() + n);
        auto& u = trace.inputs.emplace_back(model().shape().inputs, 0.0);
        for (auto const i : model().used_inputs()) u[i] = mesh_.input(k, i, mesh_.time(k));
    }

    /// From one point of the mesh to the next.
    [[nodiscard]] bool cross(double from, double to, double& suggested) {
        double const whole = to - from;
        double t = from;
        double h = std::min(whole, suggested);
        double const least = whole / (taken_ > 100000 ? 16 : 16384);
        steps_->tolerance.shortest = least;
        while (t < to) {
            bool const last = t + h * (1 + 1e-9) >= to;
            if (last) h = to - t;
            refresh(t);
            if (++taken_ > 400000 || (taken_ % 64 == 0 && keep_going_ && !keep_going_()))
                return false;
            auto const outcome = steps_->step(rate_, x_, dx_, t, next_x_, next_dx_, h);
            if (outcome == step_outcome::too_long) {
                if (!(h > least * 1e-3)) return false;
                suggested = h;
                continue;
            }
            std::swap(x_, next_x_);
            fresh_ = outcome == step_outcome::with_rate;
            if (fresh_) std::swap(dx_, next_dx_);
            if (last) t = to;
            // The last step of a piece is as long as was left; a longer suggestion stands.
            suggested = last ? std::max(suggested, h) : h;
            h = std::max(std::min(h, to - t), 0.0);
        }
        return true;
    }

    simulation_mesh mesh_;
    sensitive_rate rate_;
    std::unique_ptr<stepping> steps_;
    std::vector<double> observe_value_memory_, observe_memory_;
    simulation_state x_, dx_, next_x_, next_dx_;
    std::size_t taken_ = 0;
    std::function<bool()> keep_going_;
    bool fresh_ = false;
};

} // namespace sivid

#endif
