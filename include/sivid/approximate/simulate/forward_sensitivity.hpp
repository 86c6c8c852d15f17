// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_SIMULATE_FORWARD_SENSITIVITY_HPP
#define SIVID_APPROXIMATE_SIMULATE_FORWARD_SENSITIVITY_HPP

#include <sivid/approximate/simulate/plain_model.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace sivid {

/// With respect to what outputs are differentiated, and where disturbances act.
struct sensitivity_layout {
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> parameter_column; ///< one per parameter, `none` when held
    std::vector<std::size_t> start_column;     ///< one per state, `none` when held
    /// What has an additive d(t), piecewise linear between the simulator's knots: the rate of a
    /// state (by its index), or an input (state count + its index; late inputs after the delay).
    /// The columns of knot k follow `first_disturbance` + k * disturbed.size().
    std::vector<std::size_t> disturbed;
    std::size_t first_disturbance = 0;
    std::size_t columns = 0;
};

/// What a Runge-Kutta stage tells the sensitivities.
struct linear_stage {
    std::vector<double> by_state, by_parameter, by_input; ///< values of the non-zero derivatives
    std::vector<double> by_delay;                         ///< per unknown delay and state
    double late_share = 0;                                ///< of the later of the two hats
};

/// S = d x / d (columns) along the classical Runge-Kutta method: S' = A S + B, stage by stage.
class forward_sensitivity {
public:
    void start(plain_model const& model, sensitivity_layout const& layout) {
        model_ = &model;
        layout_ = &layout;
        stride_ = layout.columns;
        for (auto* v : {&s_, &point_, &slope_, &sum_}) v->assign(model.states() * stride_, 0.0);
        for (std::size_t i = 0; i < model.states(); ++i) {
            auto const c = layout.start_column[i];
            if (c != sensitivity_layout::none) s_[i * stride_ + c] = 1;
        }
    }

    [[nodiscard]] double* row(std::size_t state) { return s_.data() + state * stride_; }
    [[nodiscard]] std::size_t stride() const { return stride_; }

    /// @param active  columns from there on are still zero
    /// @param hat     the first of the two knots on whose hats the step lies
    void step(double h, linear_stage const* const (&stages)[4], std::size_t active, std::size_t hat,
              std::size_t knots) {
        active_ = active;
        hat_ = hat;
        knots_ = knots;
        slope(*stages[0], s_);
        for_all([](double& sum, double k) { sum = k; }, sum_, slope_);
        move(0.5 * h);
        slope(*stages[1], point_);
        for_all([](double& sum, double k) { sum += 2 * k; }, sum_, slope_);
        move(0.5 * h);
        slope(*stages[2], point_);
        for_all([](double& sum, double k) { sum += 2 * k; }, sum_, slope_);
        move(h);
        slope(*stages[3], point_);
        double const sixth = h / 6;
        for (std::size_t i = 0; i < model_->states(); ++i) {
            double* s = s_.data() + i * stride_;
            double const* a = sum_.data() + i * stride_;
            double const* b = slope_.data() + i * stride_;
            for (std::size_t c = 0; c < active_; ++c) s[c] += sixth * (a[c] + b[c]);
        }
    }

private:
    template <class F>
    void for_all(F const& f, std::vector<double>& to, std::vector<double> const& from) const {
        for (std::size_t i = 0; i < model_->states(); ++i) {
            double* a = to.data() + i * stride_;
            double const* b = from.data() + i * stride_;
            for (std::size_t c = 0; c < active_; ++c) f(a[c], b[c]);
        }
    }
    /// point = s + h slope
    void move(double h) {
        for (std::size_t i = 0; i < model_->states(); ++i) {
            double* p = point_.data() + i * stride_;
            double const* s = s_.data() + i * stride_;
            double const* k = slope_.data() + i * stride_;
            for (std::size_t c = 0; c < active_; ++c) p[c] = s[c] + h * k[c];
        }
    }
    /// slope = A at + B
    void slope(linear_stage const& stage, std::vector<double> const& at) {
        for (std::size_t i = 0; i < model_->states(); ++i) {
            double* k = slope_.data() + i * stride_;
            std::fill(k, k + active_, 0.0);
        }
        auto const& rate = model_->rate();
        for (std::size_t e = 0; e < rate.by_state.size(); ++e) {
            double const a = stage.by_state[e];
            double* k = slope_.data() + rate.by_state[e].row * stride_;
            double const* s = at.data() + rate.by_state[e].column * stride_;
            for (std::size_t c = 0; c < active_; ++c) k[c] += a * s[c];
        }
        for (std::size_t e = 0; e < rate.by_parameter.size(); ++e) {
            auto const c = layout_->parameter_column[rate.by_parameter[e].column];
            if (c == sensitivity_layout::none) continue;
            slope_[rate.by_parameter[e].row * stride_ + c] += stage.by_parameter[e];
        }
        std::size_t k = 0;
        for (auto const& d : model_->input_delays()) {
            if (!d.unknown) continue;
            auto const c = layout_->parameter_column[d.parameter];
            for (std::size_t i = 0; i < model_->states(); ++i, ++k) {
                if (c != sensitivity_layout::none) slope_[i * stride_ + c] += stage.by_delay[k];
            }
        }
        auto const count = layout_->disturbed.size();
        for (std::size_t d = 0; d < count; ++d) {
            auto const target = layout_->disturbed[d];
            auto const c = layout_->first_disturbance + hat_ * count + d;
            auto const push = [&](std::size_t row, double a) {
                slope_[row * stride_ + c] += a * (1 - stage.late_share);
                if (hat_ + 1 < knots_) slope_[row * stride_ + c + count] += a * stage.late_share;
            };
            if (target < model_->states()) {
                push(target, 1);
                continue;
            }
            for (std::size_t e = 0; e < rate.by_input.size(); ++e) {
                if (rate.by_input[e].column != target - model_->states()) continue;
                push(rate.by_input[e].row, stage.by_input[e]);
            }
        }
    }

    plain_model const* model_ = nullptr;
    sensitivity_layout const* layout_ = nullptr;
    std::size_t stride_ = 0, active_ = 0, hat_ = 0, knots_ = 0;
    std::vector<double> s_, point_, slope_, sum_;
};

} // namespace sivid

#endif
