// SPDX-License-Identifier: MIT
#include "balance.hpp"
#include "command.hpp"
#include "model.hpp"
#include "windows.hpp"

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/judge/witness.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

namespace servo {

namespace {

using sivid::box;
using sivid::exact_decimal;
using sivid::interval;

struct prior_side {
    char const* name;
    char const* lower;
    char const* upper;
    double literature;
};
constexpr std::array<prior_side, 4> prior_sides{{{"M", "50", "200", 95.1089},
                                                 {"F_v", "50", "500", 203.5034},
                                                 {"F_c", "0", "50", 20.3935},
                                                 {"offset", "-20", "20", -3.1648}}};

std::vector<window> windows_of(sivid::identification_problem const& problem) {
    std::vector<window> result;
    for (auto const& e : problem.experiments) {
        auto const& force = std::get<sivid::sampled_signal>(e.inputs[0]);
        window w{e.name, force.times(), force.values(), {e.initial[0]}, e.initial[1]};
        for (auto const& m : e.measurements) w.position.push_back(m.bound);
        result.push_back(std::move(w));
    }
    return result;
}

interval epsilon() { return sivid::enclose(servo_axis::constants[4].nominal); }

/// The best fit found with the starts where the filter has them and, while that does not explain
/// the data, with better ones within their boxes: parameters and start velocities in turn.
class start_fitter {
public:
    explicit start_fitter(sivid::identification_problem const& problem)
        : problem_(problem), points_(problem) {
        for (auto& e : points_.experiments) e.initial = sivid::point_box(sivid::mid(e.initial));
    }

    [[nodiscard]] sivid::approximate_fit operator()() {
        auto best = sivid::approximate_fitter(points_)({sivid::mid(problem_.prior)});
        for (int round = 0; round < 4 && best.inflation > 0.98; ++round) {
            if (best.parameters.empty()) break;
            move_starts(best.parameters);
            auto next = sivid::approximate_fitter(points_)({best.parameters});
            if (!(next.inflation < best.inflation)) break;
            bool const little = next.inflation > 0.97 * best.inflation;
            best = std::move(next);
            if (little) break;
        }
        return best;
    }

private:
    /// The start velocity of each window that makes its largest misfit smallest (golden section).
    void move_starts(std::vector<double> const& parameters) {
        for (std::size_t e = 0; e < points_.experiments.size(); ++e) {
            auto one = points_;
            one.experiments = {points_.experiments[e]};
            auto const axis = std::make_shared<sivid::approximate_model const>(
                one.model, one.choice, one.experiments[0].inputs);
            auto const& side = problem_.experiments[e].initial[1];
            auto const largest = [&](double v) {
                return misfit_of(axis, one.experiments[0], parameters, v);
            };
            // A little within, so that the point stays in the box whatever the rounding.
            double low = side.lower() + 1e-3 * sivid::width(side);
            double high = side.upper() - 1e-3 * sivid::width(side);
            double const ratio = (std::sqrt(5.0) - 1) / 2;
            double a = high - ratio * (high - low), b = low + ratio * (high - low);
            double at_a = largest(a), at_b = largest(b);
            for (int step = 0; step < 14; ++step) {
                if (at_a < at_b) {
                    high = b;
                    b = a;
                    at_b = at_a;
                    a = high - ratio * (high - low);
                    at_a = largest(a);
                } else {
                    low = a;
                    a = b;
                    at_a = at_b;
                    b = low + ratio * (high - low);
                    at_b = largest(b);
                }
            }
            points_.experiments[e].initial[1] = interval(at_a < at_b ? a : b);
        }
    }
    static double misfit_of(std::shared_ptr<sivid::approximate_model const> const& axis,
                            sivid::experiment const& e, std::vector<double> const& parameters,
                            double v) {
        std::vector<double> times;
        for (auto const& m : e.measurements) times.push_back(m.time);
        auto const line = sivid::simulate(axis, e.inputs, {sivid::mid(e.initial[0]), v}, parameters,
                                          e.begin, times, {1e-7});
        double worst = 0;
        for (std::size_t i = 0; i < times.size(); ++i) {
            worst =
                std::max(worst, std::abs(line.outputs[i][0] - sivid::mid(e.measurements[i].bound)));
        }
        return worst;
    }

    sivid::identification_problem const& problem_;
    sivid::identification_problem points_;
};

} // namespace

std::vector<double> literature() {
    std::vector<double> result;
    for (auto const& side : prior_sides) result.push_back(side.literature);
    return result;
}

posed_problem pose(recording const& r, command const& c) {
    posed_problem posed;
    auto const file = c.folder / c.file;
    posed.used = cut_windows(r, c.windows, file);
    posed.filter_half = c.windows.filter_half;
    for (auto const& w : posed.used) {
        posed.share_used += (r.time[w.to] - r.time[w.from]) / (r.time.back() - r.time.front());
    }
    auto& problem = posed.problem;
    problem.model = sivid::record_model(servo_axis{});
    problem.prior = box(prior_sides.size());
    for (std::size_t j = 0; j < prior_sides.size(); ++j) {
        auto const& side = prior_sides[j];
        problem.choice.unknown.emplace_back(side.name);
        problem.prior[j] =
            *sivid::enclose(*exact_decimal::parse(side.lower), *exact_decimal::parse(side.upper));
    }
    window_bounds const bounds{c.bounds.model_error, c.bounds.start_position,
                               c.bounds.start_velocity};
    for (auto const& w : posed.used) {
        problem.experiments.push_back(window_experiment(r, w, c.windows.filter_half, bounds));
        auto const half = c.windows.filter_half;
        auto const narrow = std::max<std::size_t>(2, half * 3 / 5);
        posed.filter_difference =
            std::max(posed.filter_difference, std::abs(approximate_velocity(r, w.from, half) -
                                                       approximate_velocity(r, w.from, narrow)));
    }
    // The gaps between the windows, in windows of the same length.
    auto gaps = c.windows;
    gaps.every = c.windows.length;
    gaps.first = std::fmod(c.windows.first, c.windows.length);
    for (auto const& w : cut_windows(r, gaps, file)) {
        bool const free = std::none_of(posed.used.begin(), posed.used.end(), [&](auto const& u) {
            return w.from < u.to && u.from < w.to;
        });
        if (free) posed.kept_back.push_back(w);
    }
    return posed;
}

std::vector<misfit> approximate_misfits(posed_problem const& posed, recording const& r,
                                        std::vector<sample_range> const& windows,
                                        std::vector<double> const& parameters) {
    std::vector<misfit> result;
    std::vector<sivid::signal> const inputs{
        sivid::sampled_signal(r.time, r.force, sivid::interpolation::linear)};
    auto const axis = std::make_shared<sivid::approximate_model const>(
        posed.problem.model, posed.problem.choice, inputs);
    for (auto const& w : windows) {
        std::vector<double> times;
        for (auto k = w.from + 1; k <= w.to; ++k) times.push_back(r.time[k]);
        std::vector<double> const start{r.nearest_position[w.from],
                                        approximate_velocity(r, w.from, posed.filter_half)};
        auto const line = sivid::simulate(axis, inputs, start, parameters, r.time[w.from], times);
        misfit m{.start = r.time[w.from]};
        for (std::size_t i = 0; i < times.size(); ++i) {
            double const e = line.outputs[i][0] - r.nearest_position[w.from + 1 + i];
            m.largest = std::max(m.largest, std::abs(e));
            m.mean_square += e * e / static_cast<double>(times.size());
        }
        m.samples = times.size();
        result.push_back(m);
    }
    return result;
}

bool refutes(posed_problem const& posed, std::vector<double> const& parameters) {
    balance_test test(windows_of(posed.problem), epsilon());
    return test(sivid::point_box(parameters)).verdict == sivid::box_verdict::outside;
}

sivid::identification
identify_axis(posed_problem const& posed, double accuracy, double budget,
              std::function<void(std::string const&)> const& note,
              std::function<bool(sivid::paving_progress const&)> const& progress) {
    auto const& problem = posed.problem;
    problem.require_valid();
    sivid::stopwatch const clock;
    sivid::identification result(problem.prior);
    result.assumptions.emplace_back("inputs exact");

    note("fitting by plain simulation");
    auto guess = start_fitter(problem)();
    // Point runs through the kink of the dry friction need short steps, but no wide sets.
    sivid::feasibility_test_options fine;
    fine.tolerance = 1e-9;
    fine.relative_tolerance = 1e-3;
    fine.minimum_step = 1e-6;
    fine.set = sivid::carried_set::doubleton;
    sivid::feasibility_test verifier(problem, fine);
    if (!guess.parameters.empty()) {
        note("verifying the fit by validated integration");
        result.witness = sivid::verify_witness(verifier, problem, guess.parameters, guess.starts);
        result.guess = std::move(guess);
    }

    balance_test test(windows_of(problem), epsilon());
    sivid::inversion_options search;
    search.accuracy = accuracy;
    search.seconds = std::max(0.0, budget - clock.spent());
    search.progress = progress;
    auto found = sivid::invert(test, problem.prior, search);
    result.paving = std::move(found.paving);
    result.reason = found.reason;
    result.boxes = found.tested;
    result.integrations = verifier.integrations();
    result.hull = result.paving.outer_hull();
    if (result.witness) {
        result.verdict = sivid::verdict::consistent;
    } else if (!result.paving.has_outer()) {
        result.verdict = sivid::verdict::inconsistent;
    }
    result.seconds = clock.spent();
    return result;
}

} // namespace servo
