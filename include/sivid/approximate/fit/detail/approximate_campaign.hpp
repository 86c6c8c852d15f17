// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_FIT_DETAIL_APPROXIMATE_CAMPAIGN_HPP
#define SIVID_APPROXIMATE_FIT_DETAIL_APPROXIMATE_CAMPAIGN_HPP

#include <sivid/approximate/detail/residuals.hpp>
#include <sivid/approximate/fit/detail/arrow_system.hpp>
#include <sivid/approximate/simulate/approximate_simulator.hpp>
#include <sivid/executor.hpp>
#include <sivid/model/problem.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// All experiments of a problem as one smooth function of their variables, in plain doubles.
///   Globals: the parameters of non-zero width that are not held. Locals of an experiment: its
///   uncertain start states, then the values of the disturbances d(t) at its knots, if any.
class approximate_campaign {
public:
    using jacobian =
        Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> const>;

    /// @param knots  per experiment, of the disturbances; empty when there are none
    explicit approximate_campaign(identification_problem const& problem,
                                  std::vector<std::vector<double>> knots = {})
        : problem_(&problem) {
        std::shared_ptr<approximate_model const> shared;
        for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
            auto const& s = problem.experiments[e];
            bool const formulas = std::any_of(s.inputs.begin(), s.inputs.end(), [](auto const& u) {
                return std::holds_alternative<analytic_signal>(u);
            });
            if (!shared || formulas) {
                auto own = std::make_shared<approximate_model const>(problem.model, problem.choice,
                                                                     s.inputs);
                shared = formulas ? nullptr : own;
                models_.push_back(std::move(own));
            } else {
                models_.push_back(shared);
            }
            auto const data = sorted(s.measurements);
            std::vector<output_request> requests;
            auto& centres = centres_.emplace_back();
            auto& radii = radii_.emplace_back();
            for (auto const& m : data) {
                requests.push_back({m.time, m.channel});
                centres.push_back(mid(m.bound));
                radii.push_back(std::max(rad(m.bound), std::numeric_limits<double>::min()));
            }
            outliers_.push_back(s.outliers);
            shown_.push_back(states_shown(e, requests));
            std::vector<double> sizes;
            for (auto const& state : problem.model.about.states) sizes.push_back(state.limit);
            simulators_.emplace_back(models_.back(), s.inputs, s.begin, std::move(requests),
                                     tolerances(e, sizes),
                                     knots.empty() ? std::vector<double>{} : knots[e]);
        }
        sized_.assign(simulators_.size(), 0);
        outputs_.resize(simulators_.size());
        release({}, std::vector<bool>(problem.prior.size(), true));
    }

    [[nodiscard]] identification_problem const& problem() const { return *problem_; }
    [[nodiscard]] approximate_model const& model(std::size_t e) const { return *models_[e]; }
    [[nodiscard]] std::size_t experiments() const { return simulators_.size(); }
    [[nodiscard]] std::vector<std::size_t> const& outliers() const { return outliers_; }
    [[nodiscard]] std::vector<double> const& knots(std::size_t e) const {
        return simulators_[e].knots();
    }
    [[nodiscard]] std::vector<output_request> const& requests(std::size_t e) const {
        return simulators_[e].requests();
    }
    [[nodiscard]] std::vector<double> const& centres(std::size_t e) const { return centres_[e]; }
    [[nodiscard]] std::vector<double> const& radii(std::size_t e) const { return radii_[e]; }
    /// By how much each state may be off where the channels that show it stay within the finest of
    /// their bounds; infinite where none does.
    [[nodiscard]] std::vector<double> const& shown_within(std::size_t e) const { return shown_[e]; }

    /// Chooses the variables: equations with a disturbance, and which parameters may vary; the
    /// others stand where `hold` puts them.
    void release(std::vector<std::size_t> disturbed, std::vector<bool> const& free) {
        free_.clear();
        for (std::size_t j = 0; j < problem_->prior.size(); ++j) {
            if (free[j] && width_of(problem_->prior[j]) > 0) free_.push_back(j);
        }
        layouts_.clear();
        lower_ = upper_ = {};
        auto const globals = static_cast<Eigen::Index>(free_.size());
        lower_.global.resize(globals);
        upper_.global.resize(globals);
        for (std::size_t k = 0; k < free_.size(); ++k) {
            within(problem_->prior[free_[k]], lower_.global, upper_.global,
                   static_cast<Eigen::Index>(k));
        }
        if (held_.empty()) held_ = mid(problem_->prior);
        for (std::size_t e = 0; e < simulators_.size(); ++e) {
            auto const& x0 = problem_->experiments[e].initial;
            sensitivity_layout layout;
            layout.parameter_column.assign(problem_->prior.size(), sensitivity_layout::none);
            for (std::size_t k = 0; k < free_.size(); ++k) layout.parameter_column[free_[k]] = k;
            layout.start_column.assign(x0.size(), sensitivity_layout::none);
            std::size_t next = free_.size();
            for (std::size_t i = 0; i < x0.size(); ++i) {
                if (width_of(x0[i]) > 0) layout.start_column[i] = next++;
            }
            auto const starts = next - free_.size();
            layout.disturbed = disturbed;
            layout.first_disturbance = next;
            layout.columns = next + disturbed.size() * simulators_[e].knots().size();
            auto const locals = static_cast<Eigen::Index>(layout.columns - free_.size());
            lower_.local.emplace_back(
                Eigen::VectorXd::Constant(locals, -std::numeric_limits<double>::infinity()));
            upper_.local.emplace_back(
                Eigen::VectorXd::Constant(locals, std::numeric_limits<double>::infinity()));
            Eigen::Index k = 0;
            for (std::size_t i = 0; i < x0.size(); ++i) {
                if (layout.start_column[i] == sensitivity_layout::none) continue;
                within(x0[i], lower_.local[e], upper_.local[e], k++);
            }
            starts_.resize(simulators_.size());
            starts_[e] = starts;
            layouts_.push_back(std::move(layout));
        }
    }
    /// Values of the parameters that are not released.
    void hold(std::vector<double> parameters) { held_ = std::move(parameters); }

    [[nodiscard]] arrow_vector const& lower() const { return lower_; }
    [[nodiscard]] arrow_vector const& upper() const { return upper_; }
    [[nodiscard]] std::vector<std::size_t> const& free_parameters() const { return free_; }
    [[nodiscard]] std::size_t free_starts(std::size_t e) const { return starts_[e]; }
    [[nodiscard]] sensitivity_layout const& layout(std::size_t e) const { return layouts_[e]; }
    [[nodiscard]] std::vector<Eigen::Index> local_sizes() const {
        std::vector<Eigen::Index> sizes;
        for (auto const& l : lower_.local) sizes.push_back(l.size());
        return sizes;
    }

    [[nodiscard]] std::vector<double> parameters(arrow_vector const& z) const {
        auto p = held_;
        for (std::size_t k = 0; k < free_.size(); ++k) {
            p[free_[k]] = z.global[static_cast<Eigen::Index>(k)];
        }
        return p;
    }
    [[nodiscard]] std::vector<double> start(std::size_t e, arrow_vector const& z) const {
        auto x0 = mid(problem_->experiments[e].initial);
        Eigen::Index k = 0;
        for (std::size_t i = 0; i < x0.size(); ++i) {
            if (layouts_[e].start_column[i] != sensitivity_layout::none) x0[i] = z.local[e][k++];
        }
        return x0;
    }
    /// The variables at these parameters and starts, no disturbances.
    [[nodiscard]] arrow_vector variables(std::vector<double> const& parameters,
                                         std::vector<std::vector<double>> const& starts) const {
        auto z = arrow_vector::like(lower_, 0);
        for (std::size_t k = 0; k < free_.size(); ++k) {
            z.global[static_cast<Eigen::Index>(k)] = parameters[free_[k]];
        }
        for (std::size_t e = 0; e < starts.size(); ++e) {
            auto const& columns = layouts_[e].start_column;
            Eigen::Index k = 0;
            for (std::size_t i = 0; i < columns.size(); ++i) {
                if (columns[i] != sensitivity_layout::none) z.local[e][k++] = starts[e][i];
            }
        }
        return z;
    }
    /// [knot * disturbed equations + equation]
    [[nodiscard]] std::vector<double> disturbance(std::size_t e, arrow_vector const& z) const {
        auto const first = static_cast<std::ptrdiff_t>(starts_[e]);
        return {z.local[e].data() + first, z.local[e].data() + z.local[e].size()};
    }

    /// Scales the accuracy of the simulations: 1 is meant for descents.
    void set_accuracy(double factor) {
        for (auto& s : simulators_) s.set_accuracy(factor);
    }
    /// False ends what is being simulated, which then counts as failed; all later runs fail at
    /// once. Asked by any thread.
    void set_keep_going(std::function<bool()> keep_going) {
        for (auto& s : simulators_) s.set_keep_going(keep_going);
        keep_going_ = std::move(keep_going);
    }
    [[nodiscard]] bool cancelled() const { return keep_going_ && !keep_going_(); }
    /// Simulates the experiments at once; they say the same with any.
    void set_workers(executor workers) { workers_ = std::move(workers); }
    /// @returns false when a simulation fails
    [[nodiscard]] bool residuals(arrow_vector const& z, residual_lists& r) {
        return run(z, r, false);
    }
    /// The same and the derivatives by (globals, locals), which stay valid until the next call.
    [[nodiscard]] bool linearise(arrow_vector const& z, residual_lists& r) {
        return run(z, r, true);
    }
    [[nodiscard]] jacobian derivatives(std::size_t e) const {
        return {outputs_[e].jacobian.data(),
                static_cast<Eigen::Index>(simulators_[e].requests().size()),
                static_cast<Eigen::Index>(layouts_[e].columns)};
    }
    /// Adds J' diag(root^2) J to the lower triangle of a square part of a matrix. Disturbances act
    /// on what comes later only, so early rows are short.
    template <class Square>
    void add_gram(std::size_t e, Eigen::VectorXd const& root, Square&& to) {
        auto const j = derivatives(e);
        auto const& reach = outputs_[e].reach;
        Eigen::Index const together = 48;
        for (Eigen::Index first = 0; first < j.rows(); first += together) {
            auto const rows = std::min(together, j.rows() - first);
            auto const begin = reach.begin() + first;
            auto const n = static_cast<Eigen::Index>(*std::max_element(begin, begin + rows));
            if (n == 0) continue; // Eigen takes the address of the first entry
            scaled_ = root.segment(first, rows).asDiagonal() * j.block(first, 0, rows, n);
            to.topLeftCorner(n, n).template selfadjointView<Eigen::Lower>().rankUpdate(
                scaled_.transpose());
        }
    }
    [[nodiscard]] bool trace(std::size_t e, arrow_vector const& z, simulated_trace& seen) {
        simulated_outputs out;
        return simulators_[e](start(e, z), parameters(z), disturbance(e, z), layouts_[e], false,
                              out, &seen);
    }

private:
    [[nodiscard]] static double width_of(interval const& x) { return x.upper() - x.lower(); }
    /// Strictly within, so that a guess lies in the decimal prior and not only in its enclosure.
    static void within(interval const& side, Eigen::VectorXd& lo, Eigen::VectorXd& hi,
                       Eigen::Index k) {
        lo[k] = std::nextafter(side.lower(), side.upper());
        hi[k] = std::max(lo[k], std::nextafter(side.upper(), side.lower()));
    }
    [[nodiscard]] bool run(arrow_vector const& z, residual_lists& r, bool sensitive) {
        r.resize(simulators_.size());
        auto const p = parameters(z);
        std::atomic<bool> failed = false;
        workers_(simulators_.size(), [&](std::size_t e) {
            if (!failed && !run(e, z, p, r[e], sensitive)) failed = true;
        });
        return !failed;
    }
    [[nodiscard]] bool run(std::size_t e, arrow_vector const& z, std::vector<double> const& p,
                           std::vector<double>& r, bool sensitive) {
        auto& out = outputs_[e];
        if (sized_[e] == 0) sized_[e] = size_tolerances(e, z) ? 1 : 0;
        if (!simulators_[e](start(e, z), p, disturbance(e, z), layouts_[e], sensitive, out)) {
            return false;
        }
        r.resize(centres_[e].size());
        for (std::size_t k = 0; k < r.size(); ++k) {
            r[k] = (out.values[k] - centres_[e][k]) / radii_[e][k];
            if (!std::isfinite(r[k])) return false;
            if (!sensitive) continue;
            double* row = out.jacobian.data() + k * layouts_[e].columns;
            double const scale = 1 / radii_[e][k];
            for (std::size_t c = 0; c < layouts_[e].columns; ++c) row[c] *= scale;
        }
        return true;
    }
    /// See `shown_within`, at the middle of start and prior. A channel of which all that a state
    /// may be fills a twentieth of a bound does not show it.
    [[nodiscard]] std::vector<double>
    states_shown(std::size_t e, std::vector<output_request> const& requests) const {
        auto const& model = *models_[e];
        constexpr double none = std::numeric_limits<double>::infinity();
        std::vector<double> result(model.states(), none), finest(model.channels(), none);
        for (std::size_t k = 0; k < requests.size(); ++k) {
            finest[requests[k].channel] = std::min(finest[requests[k].channel], radii_[e][k]);
        }
        auto const& f = model.observe();
        auto memory = f.expansion.memory();
        auto const x0 = mid(problem_->experiments[e].initial);
        auto const p = mid(problem_->prior);
        std::copy(x0.begin(), x0.end(), memory.begin() + 1);
        std::copy(p.begin(), p.end(),
                  memory.begin() + static_cast<std::ptrdiff_t>(model.shape().constant()));
        f.expansion.prepare(memory);
        f.expansion.run(memory);
        for (auto const& d : f.by_state) {
            double const within = finest[d.row] / std::abs(memory[d.slot]);
            if (within < 20 * problem_->model.about.states[d.column].limit)
                result[d.column] = std::min(result[d.column], within);
        }
        return result;
    }
    /// A small share of the error bounds for states that are measured directly, else of their size.
    [[nodiscard]] std::vector<double> tolerances(std::size_t e,
                                                 std::vector<double> const& sizes) const {
        std::vector<double> result;
        for (std::size_t i = 0; i < sizes.size(); ++i)
            result.push_back(std::isfinite(shown_[e][i]) ? 5e-5 * shown_[e][i] : 1e-6 * sizes[i]);
        return result;
    }
    /// Own ranges of states may be far larger than the states: where no channel shows one, its
    /// tolerance becomes a share of what it is along this motion.
    /// @returns false when the simulation fails
    [[nodiscard]] bool size_tolerances(std::size_t e, arrow_vector const& z) {
        if (std::all_of(shown_[e].begin(), shown_[e].end(), [](double x) { return x < HUGE_VAL; }))
            return true;
        simulated_trace seen;
        if (!trace(e, z, seen)) return false;
        auto const& states = problem_->model.about.states;
        std::vector<double> sizes(states.size(), 0.0);
        for (auto const& x : seen.states)
            for (std::size_t i = 0; i < sizes.size(); ++i)
                sizes[i] = std::max(sizes[i], std::abs(x[i]));
        for (std::size_t i = 0; i < sizes.size(); ++i)
            if (!(sizes[i] > 0)) sizes[i] = states[i].limit;
        simulators_[e].set_tolerances(tolerances(e, sizes));
        return true;
    }

    identification_problem const* problem_;
    std::vector<std::shared_ptr<approximate_model const>> models_;
    std::vector<approximate_simulator> simulators_;
    std::vector<std::vector<double>> centres_, radii_, shown_;
    std::vector<char> sized_; ///< whether tolerances of an experiment follow a motion
    std::vector<std::size_t> outliers_, free_, starts_;
    std::vector<sensitivity_layout> layouts_;
    std::vector<double> held_;
    arrow_vector lower_, upper_;
    std::vector<simulated_outputs> outputs_;
    executor workers_{};
    std::function<bool()> keep_going_;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> scaled_;
};

} // namespace sivid

#endif
