// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_SIMULATE_SENSITIVE_SIMULATOR_HPP
#define SIVID_APPROXIMATE_SIMULATE_SENSITIVE_SIMULATOR_HPP

#include <sivid/approximate/simulate/forward_sensitivity.hpp>
#include <sivid/approximate/simulate/plain_model.hpp>
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

/// Simulates one experiment in plain doubles by the classical Runge-Kutta method with forward
/// sensitivities: those of the method itself, exact but for rounding. Steps end at the knots of the
/// inputs, which delays may move, and at the measurements; between them they are halved until the
/// embedded third-order error is small, so that stiff phases are stepped stably. Not a proof.
/// @cost  steps * 4 * (program + non-zeros of the Jacobian * columns)
class sensitive_simulator {
public:
    /// @param tolerances  per state, of one step
    /// @param knots  of the disturbances, increasing; empty when there are none
    sensitive_simulator(std::shared_ptr<plain_model const> model, std::vector<signal> const& inputs,
                        double begin, std::vector<output_request> requests,
                        std::vector<double> tolerances, std::vector<double> knots = {})
        : model_(std::move(model)),
          mesh_(*model_, inputs, begin, std::move(requests), knots),
          tolerances_(std::move(tolerances)),
          knots_(std::move(knots)),
          value_memory_(model_->rate().values.memory()),
          memory_(model_->rate().expansion.memory()),
          observe_value_memory_(model_->observe().values.memory()),
          observe_memory_(model_->observe().expansion.memory()) {
        auto const n = model_->states();
        trial_.assign(n, 0.0);
        std::size_t delays = 0;
        for (auto const& d : model_->input_delays()) delays += d.unknown ? 1 : 0;
        for (auto& s : stages_) {
            s.rate.assign(n, 0.0);
            s.linear.by_state.assign(model_->rate().by_state.size(), 0.0);
            s.linear.by_parameter.assign(model_->rate().by_parameter.size(), 0.0);
            s.linear.by_input.assign(model_->rate().by_input.size(), 0.0);
            s.linear.by_delay.assign(delays * n, 0.0);
        }
    }

    [[nodiscard]] plain_model const& model() const { return *model_; }
    [[nodiscard]] std::vector<double> const& knots() const { return knots_; }
    [[nodiscard]] std::vector<output_request> const& requests() const { return mesh_.requests(); }
    /// Scales the tolerances of the steps from now on.
    void set_accuracy(double factor) { accuracy_ = factor; }
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
        layout_ = &layout;
        disturbance_ = &disturbance;
        sensitive_ = with_sensitivities;
        mesh_.place(parameters);
        set_parameters(parameters);
        x_ = start;
        steps_ = hat_ = 0;
        out.values.assign(mesh_.requests().size(), 0.0);
        if (sensitive_) {
            out.jacobian.assign(mesh_.requests().size() * layout.columns, 0.0);
            out.reach.assign(mesh_.requests().size(), 0);
            sensitivity_.start(*model_, layout);
        }
        fresh_ = false;
        double suggested = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0, pieces = mesh_.pieces(); k <= pieces; ++k) {
            if (k < pieces) enter(k);
            if (k < pieces && mesh_.jumps() && sensitive_ && k > 0) shift_by_jumps(k);
            if (mesh_.jumps()) fresh_ = false;
            if (!mesh_.observed(k).empty()) look(k, out);
            if (trace != nullptr) record(k, *trace);
            if (k < pieces && !cross(mesh_.time(k), mesh_.time(k + 1), suggested)) return false;
        }
        return true;
    }

private:
    struct stage {
        std::vector<double> rate;
        linear_stage linear;
    };

    void set_parameters(std::vector<double> const& p) {
        auto const at = static_cast<std::ptrdiff_t>(model_->shape().constant());
        auto const into = [&](plain_program const& program, std::vector<double>& memory) {
            std::copy(p.begin(), p.end(), memory.begin() + at);
            program.prepare(memory);
        };
        into(model_->rate().values, value_memory_);
        into(model_->rate().expansion, memory_);
        into(model_->observe().values, observe_value_memory_);
        into(model_->observe().expansion, observe_memory_);
    }
    /// The piece of the mesh that the next steps lie on.
    void enter(std::size_t k) {
        piece_ = k;
        double const middle = 0.5 * (mesh_.time(k) + mesh_.time(k + 1));
        while (hat_ + 2 < knots_.size() && knots_[hat_ + 1] <= middle) ++hat_;
        active_ = layout_->columns;
        if (!layout_->disturbed.empty()) {
            active_ = layout_->first_disturbance +
                      std::min(hat_ + 2, knots_.size()) * layout_->disturbed.size();
        }
        if (sensitive_ && fresh_) linearise_piece(mesh_.time(k), stages_[0].linear);
    }
    /// Share of the later of the two hats that stand on this piece.
    [[nodiscard]] double share(double t) const {
        if (hat_ + 1 >= knots_.size()) return 0;
        return std::clamp((t - knots_[hat_]) / (knots_[hat_ + 1] - knots_[hat_]), 0.0, 1.0);
    }
    /// Value of disturbance number d of the layout.
    [[nodiscard]] double disturbance(std::size_t d, double t) const {
        auto const count = layout_->disturbed.size();
        double const late = share(t);
        double const early = (1 - late) * (*disturbance_)[hat_ * count + d];
        return late > 0 ? early + late * (*disturbance_)[(hat_ + 1) * count + d] : early;
    }
    void write_arguments(std::vector<double>& memory, double t,
                         std::vector<double> const& x) const {
        memory[0] = t;
        std::copy(x.begin(), x.end(), memory.begin() + 1);
        auto const at = model_->shape().input();
        for (auto const i : model_->used_inputs()) memory[at + i] = mesh_.input(piece_, i, t);
        auto const n = model_->states();
        for (std::size_t d = 0; d < layout_->disturbed.size(); ++d) {
            auto const target = layout_->disturbed[d];
            if (target >= n) memory[at + target - n] += disturbance(d, t);
        }
    }
    void add_disturbance(double t, std::vector<double>& rate) const {
        for (std::size_t d = 0; d < layout_->disturbed.size(); ++d) {
            auto const target = layout_->disturbed[d];
            if (target < rate.size()) rate[target] += disturbance(d, t);
        }
    }
    void evaluate(double t, std::vector<double> const& x, stage& s) {
        auto const& f = model_->rate();
        auto const n = model_->states();
        auto& memory = sensitive_ ? memory_ : value_memory_;
        auto const& program = sensitive_ ? f.expansion : f.values;
        write_arguments(memory, t, x);
        program.run(memory);
        for (std::size_t i = 0; i < n; ++i) s.rate[i] = memory[program.output(i)];
        add_disturbance(t, s.rate);
        if (sensitive_) linearise(t, s.linear);
    }
    void linearise(double t, linear_stage& s) const {
        auto const& f = model_->rate();
        for (std::size_t k = 0; k < f.by_state.size(); ++k) {
            s.by_state[k] = memory_[f.by_state[k].slot];
        }
        for (std::size_t k = 0; k < f.by_parameter.size(); ++k) {
            s.by_parameter[k] = memory_[f.by_parameter[k].slot];
        }
        for (std::size_t k = 0; k < f.by_input.size(); ++k) {
            s.by_input[k] = memory_[f.by_input[k].slot];
        }
        linearise_piece(t, s);
    }
    /// What of a stage depends on the piece, which may change while the state does not.
    void linearise_piece(double t, linear_stage& s) const {
        auto const& f = model_->rate();
        s.late_share = share(t);
        std::size_t first = 0;
        for (auto const& d : model_->input_delays()) {
            if (!d.unknown) continue;
            for (std::size_t i = 0; i < model_->states(); ++i) s.by_delay[first + i] = 0;
            for (std::size_t k = 0; k < f.by_input.size(); ++k) {
                auto const& e = f.by_input[k];
                if (e.column != d.index) continue;
                s.by_delay[first + e.row] = -s.by_input[k] * mesh_.slope(piece_, d.index);
            }
            first += model_->states();
        }
    }
    /// A hold input that acts later by dt keeps its old value for so long.
    void shift_by_jumps(std::size_t k) {
        auto const& program = model_->rate().values;
        double const t = mesh_.time(k);
        for (auto const& d : model_->input_delays()) {
            if (!d.unknown || !mesh_.jumps(d.index)) continue;
            auto const c = layout_->parameter_column[d.parameter];
            double const before = mesh_.input(k - 1, d.index, t);
            double const after = mesh_.input(k, d.index, t);
            if (c == sensitivity_layout::none || before == after) continue;
            write_arguments(value_memory_, t, x_);
            for (double const side : {after, before}) {
                value_memory_[model_->shape().input() + d.index] = side;
                program.run(value_memory_);
                for (std::size_t i = 0; i < x_.size(); ++i) {
                    double const f = value_memory_[program.output(i)];
                    sensitivity_.row(i)[c] += side == after ? -f : f;
                }
            }
        }
    }
    /// The outputs that are requested at a point of the mesh.
    void look(std::size_t k, simulated_outputs& out) {
        auto const& f = model_->observe();
        auto& memory = sensitive_ ? observe_memory_ : observe_value_memory_;
        auto const& program = sensitive_ ? f.expansion : f.values;
        double const t = mesh_.time(k);
        auto const at = piece_;
        piece_ = k; // the inputs after a jump
        write_arguments(memory, t, x_);
        piece_ = at;
        program.run(memory);
        for (auto const r : mesh_.observed(k)) {
            out.values[r] = memory[program.output(mesh_.requests()[r].channel)];
        }
        if (!sensitive_) return;
        auto const stride = layout_->columns;
        for (auto const r : mesh_.observed(k)) {
            auto const channel = mesh_.requests()[r].channel;
            double* row = out.jacobian.data() + r * stride;
            out.reach[r] = active_;
            for (auto const& e : f.by_state) {
                if (e.row != channel) continue;
                double const a = memory[e.slot];
                double const* s = sensitivity_.row(e.column);
                for (std::size_t c = 0; c < active_; ++c) row[c] += a * s[c];
            }
            for (auto const& e : f.by_parameter) {
                auto const c = layout_->parameter_column[e.column];
                if (e.row == channel && c != sensitivity_layout::none) row[c] += memory[e.slot];
            }
            look_through_inputs(channel, t, row);
            look_late(mesh_.requests()[r], t, row);
        }
    }
    void look_through_inputs(std::size_t channel, double t, double* row) const {
        auto const count = layout_->disturbed.size();
        for (std::size_t d = 0; d < count; ++d) {
            for (auto const& e : model_->observe().by_input) {
                if (e.row != channel || e.column + model_->states() != layout_->disturbed[d])
                    continue;
                auto const c = layout_->first_disturbance + hat_ * count + d;
                row[c] += (1 - share(t)) * observe_memory_[e.slot];
                if (hat_ + 1 < knots_.size()) row[c + count] += share(t) * observe_memory_[e.slot];
            }
        }
    }
    /// d y(t - tau) / d tau = -y'(t - tau), and likewise through a late input.
    void look_late(output_request const& request, double t, double* row) {
        auto const& f = model_->observe();
        auto const& memory = observe_memory_;
        for (auto const& d : model_->input_delays()) {
            if (!d.unknown) continue;
            auto const c = layout_->parameter_column[d.parameter];
            for (auto const& e : f.by_input) {
                if (e.row != request.channel || e.column != d.index) continue;
                if (c == sensitivity_layout::none) continue;
                row[c] -= memory[e.slot] * mesh_.slope(piece_, d.index);
            }
        }
        for (auto const& d : model_->channel_delays()) {
            if (!d.unknown || d.index != request.channel) continue;
            auto const c = layout_->parameter_column[d.parameter];
            if (c == sensitivity_layout::none || !(t > mesh_.time(0))) continue;
            if (!fresh_) evaluate(t, x_, stages_[0]);
            fresh_ = true;
            double slope = 0;
            for (auto const& e : f.by_state) {
                if (e.row == request.channel) slope += memory[e.slot] * stages_[0].rate[e.column];
            }
            for (auto const& e : f.by_time) {
                if (e.row == request.channel) slope += memory[e.slot];
            }
            for (auto const& e : f.by_input) {
                if (e.row != request.channel) continue;
                slope += memory[e.slot] * mesh_.slope(piece_, e.column);
            }
            row[c] -= slope;
        }
    }
    void record(std::size_t k, simulated_trace& trace) {
        if (!fresh_) evaluate(mesh_.time(k), x_, stages_[0]);
        fresh_ = true;
        trace.times.push_back(mesh_.time(k));
        trace.states.push_back(x_);
        trace.rates.push_back(stages_[0].rate);
        auto& u = trace.inputs.emplace_back(model_->shape().inputs, 0.0);
        for (auto const i : model_->used_inputs()) u[i] = mesh_.input(k, i, mesh_.time(k));
    }

    /// From one point of the mesh to the next.
    [[nodiscard]] bool cross(double from, double to, double& suggested) {
        double const whole = to - from;
        double t = from;
        double h = std::min(whole, suggested);
        double const least = whole / (steps_ > 100000 ? 16 : 16384);
        auto const n = x_.size();
        while (t < to) {
            bool last = t + h * (1 + 1e-9) >= to;
            if (last) h = to - t;
            if (!fresh_) evaluate(t, x_, stages_[0]);
            fresh_ = true;
            if (++steps_ > 400000 || (steps_ % 64 == 0 && keep_going_ && !keep_going_()))
                return false;
            auto const advance = [&](double step, stage const& s) {
                for (std::size_t i = 0; i < n; ++i) trial_[i] = x_[i] + step * s.rate[i];
            };
            advance(0.5 * h, stages_[0]);
            evaluate(t + 0.5 * h, trial_, stages_[1]);
            advance(0.5 * h, stages_[1]);
            evaluate(t + 0.5 * h, trial_, stages_[2]);
            advance(h, stages_[2]);
            evaluate(t + h, trial_, stages_[3]);
            for (std::size_t i = 0; i < n; ++i) {
                trial_[i] = x_[i] + h / 6 *
                                        (stages_[0].rate[i] + 2 * stages_[1].rate[i] +
                                         2 * stages_[2].rate[i] + stages_[3].rate[i]);
            }
            double const end = last ? to : t + h;
            evaluate(end, trial_, stages_[4]);
            double error = 0;
            for (std::size_t i = 0; i < n; ++i) {
                double const e = h / 6 * std::abs(stages_[3].rate[i] - stages_[4].rate[i]);
                double const allowed = accuracy_ * (tolerances_[i] + 1e-6 * std::abs(trial_[i]));
                error = e <= std::numeric_limits<double>::max() ? std::max(error, e / allowed)
                                                                : HUGE_VAL;
            }
            if (!(error <= 1) && (h > least || !std::isfinite(error))) {
                if (h <= least * 1e-3) return false;
                h *=
                    std::isfinite(error) ? std::clamp(0.9 * std::pow(error, -0.25), 0.1, 0.5) : 0.1;
                suggested = h;
                continue;
            }
            if (sensitive_) {
                sensitivity_.step(h,
                                  {&stages_[0].linear, &stages_[1].linear, &stages_[2].linear,
                                   &stages_[3].linear},
                                  active_, hat_, knots_.size());
            }
            std::swap(x_, trial_);
            std::swap(stages_[0], stages_[4]);
            t = end;
            double const growth =
                error > 0 ? std::clamp(0.9 * std::pow(error, -0.25), 0.5, 4.0) : 4;
            if (!last || growth * h < whole) {
                suggested = std::max(growth * h, least);
            } else {
                suggested = std::numeric_limits<double>::infinity();
            }
            h = std::max(std::min(suggested, to - t), 0.0);
        }
        return true;
    }

    std::shared_ptr<plain_model const> model_;
    simulation_mesh mesh_;
    std::vector<double> tolerances_, knots_;
    std::vector<double> value_memory_, memory_, observe_value_memory_, observe_memory_;
    std::vector<double> x_, trial_;
    stage stages_[5];
    forward_sensitivity sensitivity_;
    sensitivity_layout const* layout_ = nullptr;
    std::vector<double> const* disturbance_ = nullptr;
    std::size_t active_ = 0, piece_ = 0, hat_ = 0, steps_ = 0;
    double accuracy_ = 1;
    std::function<bool()> keep_going_;
    bool sensitive_ = false, fresh_ = false;
};

} // namespace sivid

#endif
