// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_SIMULATE_DETAIL_SENSITIVE_RATE_HPP
#define SIVID_APPROXIMATE_SIMULATE_DETAIL_SENSITIVE_RATE_HPP

#include <sivid/approximate/simulate/approximate_model.hpp>
#include <sivid/approximate/simulate/simulation_mesh.hpp>
#include <sivid/approximate/simulate/stepping.hpp>
#include <sivid/work_clock.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

/// With respect to what outputs are differentiated, and where disturbances act.
struct sensitivity_layout {
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> parameter_column; ///< one per parameter, `none` when held
    std::vector<std::size_t> start_column;     ///< one per state, `none` when held
    /// What has an additive d(t), piecewise linear between the simulator's knots: the rate of a
    /// state (by its index), or an input (state count + its index; inputs with a memory behind it).
    /// The columns of knot k follow `first_disturbance` + k * disturbed.size().
    std::vector<std::size_t> disturbed;
    std::size_t first_disturbance = 0;
    std::size_t columns = 0;
};

/// The system that a simulation integrates, in plain doubles: x' = f(t, x, p, u(t)) + d(t) and,
/// when asked for, S' = A S + B for the derivatives S = d x / d (columns), on one piece of the mesh
/// after the other. States come first; then the columns of S, four at a time, which share the
/// instructions of a vector register. Columns of disturbances that have not acted yet are left out.
/// @cost  the program of the rate, and non-zeros of A times active columns
class sensitive_rate final : public rate_function {
public:
    static constexpr std::size_t lanes = 4;

    sensitive_rate(std::shared_ptr<approximate_model const> model, std::vector<double> knots)
        : model_(std::move(model)),
          knots_(std::move(knots)),
          value_memory_(model_->rate().values.memory()),
          memory_(model_->rate().expansion.memory()) {
        auto const& entries = model_->rate().by_state;
        for (std::size_t i = 0, k = 0; i < model_->states(); ++i) {
            while (k < entries.size() && entries[k].row == i) ++k;
            row_end_.push_back(k);
        }
        values_.resize(entries.size());
        for (auto const& d : model_->input_memory()) late_inputs_ = late_inputs_ || d.unknown;
    }

    [[nodiscard]] approximate_model const& model() const { return *model_; }
    [[nodiscard]] std::vector<double> const& knots() const { return knots_; }
    [[nodiscard]] bool sensitive() const { return sensitive_; }
    /// Columns from there on are zero on this piece and before.
    [[nodiscard]] std::size_t active() const { return active_; }
    [[nodiscard]] sensitivity_layout const& layout() const { return *layout_; }
    [[nodiscard]] std::size_t hat() const { return hat_; }

    /// Where d x_i / d (column c) stands in the state.
    [[nodiscard]] Eigen::Index at(std::size_t i, std::size_t c) const {
        auto const n = model_->states();
        return static_cast<Eigen::Index>(padded(n) + (c / lanes * n + i) * lanes + c % lanes);
    }

    /// Begins a run. @param mesh, layout, disturbance  kept by reference until it ends
    void begin(simulation_mesh const& mesh, std::vector<double> const& parameters,
               std::vector<double> const& disturbance, sensitivity_layout const& layout,
               bool sensitive, std::vector<double> const& start, simulation_state& x) {
        mesh_ = &mesh;
        layout_ = &layout;
        disturbance_ = &disturbance;
        sensitive_ = sensitive;
        hat_ = 0;
        write_parameters(model_->rate().values, parameters, value_memory_);
        if (sensitive_) write_parameters(model_->rate().expansion, parameters, memory_);
        piece_ = 0;
        choose_active();
        x.setZero(static_cast<Eigen::Index>(size()));
        for (std::size_t i = 0; i < start.size(); ++i) {
            x[static_cast<Eigen::Index>(i)] = start[i];
            auto const c = layout.start_column[i];
            if (sensitive_ && c != sensitivity_layout::none) x[at(i, c)] = 1;
        }
    }
    /// Goes on to piece k: columns that become active are appended to x.
    /// @returns whether S' is another there than at the end of the piece before
    [[nodiscard]] bool enter(std::size_t k, simulation_state& x) {
        piece_ = k;
        auto const hat = hat_;
        double const middle = 0.5 * (mesh_->time(k) + mesh_->time(k + 1));
        while (hat_ + 2 < knots_.size() && knots_[hat_ + 1] <= middle) ++hat_;
        choose_active();
        auto const before = x.size();
        auto const now = static_cast<Eigen::Index>(size());
        if (now != before) {
            x.conservativeResize(now);
            x.tail(now - before).setZero();
        }
        return late_inputs_ || hat_ != hat;
    }
    /// For a look at the inputs of another piece.
    [[nodiscard]] std::size_t exchange_piece(std::size_t k) { return std::exchange(piece_, k); }
    [[nodiscard]] std::size_t piece() const { return piece_; }

    void operator()(simulation_state const& x, simulation_state& dx, double t) override {
        auto const n = model_->states();
        auto& memory = sensitive_ ? memory_ : value_memory_;
        auto const& program = sensitive_ ? model_->rate().expansion : model_->rate().values;
        write_arguments(memory, t, x);
        program.run(memory);
        for (std::size_t i = 0; i < n; ++i) {
            dx[static_cast<Eigen::Index>(i)] = memory[program.output(i)];
        }
        for (auto i = n; i < padded(n); ++i) dx[static_cast<Eigen::Index>(i)] = 0;
        for (std::size_t d = 0; d < layout_->disturbed.size(); ++d) {
            auto const target = layout_->disturbed[d];
            if (target < n) dx[static_cast<Eigen::Index>(target)] += disturbance(d, t);
        }
        if (sensitive_) differentiate(x, dx, t);
    }
    /// S' alone, where x was evaluated last; on another piece it may differ while x' does not.
    void differentiate(simulation_state const& x, simulation_state& dx, double t) {
        auto const n = model_->states();
        auto const& rate = model_->rate();
        for (std::size_t k = 0; k < values_.size(); ++k) {
            values_[k] = memory_[rate.by_state[k].slot];
        }
        using four = Eigen::Array<double, lanes, 1>;
        auto const blocks = (active_ + lanes - 1) / lanes;
        work_clock::count(blocks * (values_.size() + n), 0.2);
        double const* s = x.data() + padded(n);
        double* out = dx.data() + padded(n);
        for (std::size_t b = 0; b < blocks; ++b, s += n * lanes, out += n * lanes) {
            for (std::size_t i = 0, k = 0; i < n; ++i) {
                four sum = four::Zero();
                for (; k < row_end_[i]; ++k) {
                    sum += values_[k] * Eigen::Map<four const>(s + rate.by_state[k].column * lanes);
                }
                Eigen::Map<four>(out + i * lanes) = sum;
            }
        }
        for (auto const& e : rate.by_parameter) {
            auto const c = layout_->parameter_column[e.column];
            if (c != sensitivity_layout::none) dx[at(e.row, c)] += memory_[e.slot];
        }
        for (auto const& d : model_->input_memory()) {
            if (!d.unknown) continue;
            auto const c = layout_->parameter_column[d.parameter];
            if (c == sensitivity_layout::none) continue;
            for (auto const& e : rate.by_input) {
                if (e.column != d.index) continue;
                dx[at(e.row, c)] += memory_[e.slot] * mesh_->slope_by(d.kind, piece_, d.index, t);
            }
        }
        auto const count = layout_->disturbed.size();
        double const late = count > 0 ? share(t) : 0;
        for (std::size_t d = 0; d < count; ++d) {
            auto const target = layout_->disturbed[d];
            auto const c = layout_->first_disturbance + hat_ * count + d;
            auto const push = [&](std::size_t row, double a) {
                dx[at(row, c)] += a * (1 - late);
                if (hat_ + 1 < knots_.size()) dx[at(row, c + count)] += a * late;
            };
            if (target < n) {
                push(target, 1);
                continue;
            }
            for (auto const& e : rate.by_input) {
                if (e.column == target - n) push(e.row, memory_[e.slot]);
            }
        }
    }

    /// A hold input that acts later by dt keeps its old value for so long: what its jump at the
    /// begin of piece k adds to S.
    void shift_by_jumps(std::size_t k, simulation_state& x) {
        auto const& program = model_->rate().values;
        double const t = mesh_->time(k);
        for (auto const& d : model_->input_memory()) {
            if (!d.unknown || !is_dead_time(d.kind) || !mesh_->jumps(d.index)) continue;
            auto const c = layout_->parameter_column[d.parameter];
            double const before = mesh_->input(k - 1, d.index, t);
            double const after = mesh_->input(k, d.index, t);
            if (c == sensitivity_layout::none || before == after) continue;
            double const moved = mesh_->knots_moved_by(d.kind, d.index, t);
            write_arguments(value_memory_, t, x);
            for (double const side : {after, before}) {
                value_memory_[model_->shape().input() + d.index] = side;
                program.run(value_memory_);
                for (std::size_t i = 0; i < model_->states(); ++i) {
                    double const f = value_memory_[program.output(i)];
                    x[at(i, c)] += moved * (side == after ? -f : f);
                }
            }
        }
    }

    void write_parameters(approximate_program const& program, std::vector<double> const& p,
                          std::vector<double>& memory) const {
        std::copy(p.begin(), p.end(),
                  memory.begin() + static_cast<std::ptrdiff_t>(model_->shape().constant()));
        program.prepare(memory);
    }
    void write_arguments(std::vector<double>& memory, double t, simulation_state const& x) const {
        auto const n = model_->states();
        memory[0] = t;
        std::copy(x.data(), x.data() + n, memory.begin() + 1);
        auto const at = model_->shape().input();
        for (auto const i : model_->used_inputs()) memory[at + i] = mesh_->input(piece_, i, t);
        for (std::size_t d = 0; d < layout_->disturbed.size(); ++d) {
            auto const target = layout_->disturbed[d];
            if (target >= n) memory[at + target - n] += disturbance(d, t);
        }
    }
    /// Share of the later of the two hats that stand on this piece.
    [[nodiscard]] double share(double t) const {
        if (hat_ + 1 >= knots_.size()) return 0;
        return std::clamp((t - knots_[hat_]) / (knots_[hat_ + 1] - knots_[hat_]), 0.0, 1.0);
    }

private:
    [[nodiscard]] static std::size_t padded(std::size_t n) {
        return (n + lanes - 1) / lanes * lanes;
    }
    [[nodiscard]] std::size_t size() const {
        auto const n = model_->states();
        return padded(n) + (sensitive_ ? (active_ + lanes - 1) / lanes * lanes * n : 0);
    }
    void choose_active() {
        active_ = layout_->columns;
        if (layout_->disturbed.empty()) return;
        active_ = layout_->first_disturbance +
                  std::min(hat_ + 2, knots_.size()) * layout_->disturbed.size();
    }
    /// Value of disturbance number d of the layout.
    [[nodiscard]] double disturbance(std::size_t d, double t) const {
        auto const count = layout_->disturbed.size();
        double const late = share(t);
        double const early = (1 - late) * (*disturbance_)[hat_ * count + d];
        return late > 0 ? early + late * (*disturbance_)[(hat_ + 1) * count + d] : early;
    }

    std::shared_ptr<approximate_model const> model_;
    std::vector<double> knots_, value_memory_, memory_, values_;
    std::vector<std::size_t> row_end_; ///< of the non-zero derivatives by states
    simulation_mesh const* mesh_ = nullptr;
    sensitivity_layout const* layout_ = nullptr;
    std::vector<double> const* disturbance_ = nullptr;
    std::size_t active_ = 0, piece_ = 0, hat_ = 0;
    bool sensitive_ = false, late_inputs_ = false;
};

} // namespace sivid

#endif
