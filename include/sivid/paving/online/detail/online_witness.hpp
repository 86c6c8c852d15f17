// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_ONLINE_DETAIL_ONLINE_WITNESS_HPP
#define SIVID_PAVING_ONLINE_DETAIL_ONLINE_WITNESS_HPP

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/run/detail/doubleton_continuation.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// A witness whose trajectories are carried on with the measurements: each new one is tested by the
/// proved output at its time, and the witness is lost when more than the budget may be violated.
class online_witness {
public:
    /// @param problem  holds all measurements so far whenever a member is called
    online_witness(identification_problem const& problem, feasibility_test_options const& options)
        : problem_(&problem), options_(options.witness) {
        for (auto const& e : problem.experiments) {
            flows_.push_back(
                std::make_unique<flow>(problem.model, problem.choice, nominal(e.inputs)));
        }
    }

    [[nodiscard]] bool exists() const { return witness_.has_value(); }
    /// With `violated` in the order of time.
    [[nodiscard]] std::optional<verified_witness> get() const {
        if (!witness_) return std::nullopt;
        auto result = *witness_;
        result.violated.clear();
        for (std::size_t e = 0; e < tested_.size(); ++e) {
            auto own = tested_[e];
            std::stable_sort(own.begin(), own.end(), [](auto const& a, auto const& b) {
                return a.time < b.time || (a.time == b.time && a.channel < b.channel);
            });
            auto& violated = result.violated.emplace_back();
            for (auto const& t : own) violated.push_back(t.violated);
        }
        return result;
    }

    /// Tests the present witness by new measurements of an experiment.
    void add(std::size_t e, record const& samples) {
        if (!witness_) return;
        for (auto const& m : sorted(samples)) {
            bool const late = m.time < time_[e]; // a run of its own, then back to the front
            auto front = late ? std::exchange(runs_[e], nullptr) : nullptr;
            double const time = time_[e];
            if (late) begin(e);
            if (!test(e, m)) return;
            if (!late) continue;
            runs_[e] = std::move(front);
            time_[e] = time;
        }
    }

    /// Proposes a point by a fit to all measurements, from the last one, and verifies it.
    /// @param keep_going  as of `approximate_fitter`; a fit that is cut short is what the next one
    /// begins with
    /// @cost  grows with the number of measurements, unlike `add`
    void find(std::function<bool()> const& keep_going) {
        auto known = *problem_;
        std::erase_if(known.experiments,
                      [](experiment const& e) { return e.measurements.empty(); });
        if (known.experiments.empty()) return;
        approximate_fitter fit(known, keep_going);
        auto guess = fit({last_});
        if (!(guess.inflation < 1) && !last_.empty()) guess = fit();
        if (guess.parameters.empty()) return;
        last_ = guess.parameters;
        std::vector<std::vector<double>> starts;
        std::size_t next = 0;
        for (auto const& e : problem_->experiments) {
            starts.push_back(e.measurements.empty() ? mid(e.initial) : guess.starts[next++]);
        }
        guess_ = std::move(guess);
        if (guess_->inflation <= 1) verify(last_, starts);
    }
    [[nodiscard]] std::optional<approximate_fit> const& guess() const { return guess_; }

private:
    struct tested_sample {
        double time = 0;
        std::size_t channel = 0;
        bool violated = false; ///< not proved to hold
    };

    void verify(std::vector<double> const& parameters,
                std::vector<std::vector<double>> const& starts) {
        auto const count = problem_->experiments.size();
        parameters_ = point_within(problem_->prior, parameters);
        starts_.clear();
        witness_ = verified_witness{mid(parameters_), {}, {}};
        for (std::size_t e = 0; e < count; ++e) {
            starts_.push_back(point_within(problem_->experiments[e].initial, starts[e]));
            witness_->starts.push_back(mid(starts_[e]));
        }
        runs_.clear();
        runs_.resize(count);
        time_.assign(count, 0);
        tested_.assign(count, {});
        violated_.assign(count, 0);
        for (std::size_t e = 0; e < count; ++e) {
            begin(e);
            for (auto const& m : sorted(problem_->experiments[e].measurements)) {
                if (!test(e, m)) return;
            }
        }
    }
    void begin(std::size_t e) {
        auto const& own = problem_->experiments[e];
        runs_[e] = std::make_unique<paving_detail::doubleton_continuation>(
            *flows_[e], own.begin, paving_detail::steps_for(own, options_));
        time_[e] = own.begin;
        (void)runs_[e]->begin(starts_[e], parameters_);
    }
    /// @returns false when the witness is lost
    bool test(std::size_t e, measurement const& m) {
        using traits = interval_traits<interval>;
        auto const seen = runs_[e]->read({0}, m.time, {m.channel});
        time_[e] = m.time;
        bool holds = false;
        if (!seen[0].empty()) {
            auto const& y = seen[0][0];
            holds = y.coefficients.size() == 1 && std::isfinite(y.radius) &&
                    traits::subset(traits::add(traits::point(y.coefficients[0]),
                                               traits::bounds(-y.radius, y.radius)),
                                   m.bound);
        }
        tested_[e].push_back({m.time, m.channel, !holds});
        violated_[e] += holds ? 0 : 1;
        if (violated_[e] <= problem_->experiments[e].outliers) return true;
        witness_.reset();
        return false;
    }

    identification_problem const* problem_;
    run_options options_;
    std::vector<std::unique_ptr<flow>> flows_;
    std::vector<std::unique_ptr<continued_run>> runs_;
    std::vector<double> time_;
    std::vector<std::vector<tested_sample>> tested_;
    std::vector<std::size_t> violated_;
    std::optional<verified_witness> witness_;
    box parameters_; ///< of the witness: points within the decimal boxes
    std::vector<box> starts_;
    std::optional<approximate_fit> guess_;
    std::vector<double> last_; ///< where the next fit begins
};

} // namespace sivid

#endif
