// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_DISTURBANCE_DETAIL_DISTURBANCE_WITNESS_HPP
#define SIVID_PAVING_DISTURBANCE_DETAIL_DISTURBANCE_WITNESS_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/model/disturbance.hpp>
#include <sivid/paving/disturbance/detail/disturbance_program.hpp>
#include <sivid/paving/disturbance/detail/disturbed_motion.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/judge/witness.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

/// Disturbances that are constant in segments, with parameters and starts.
struct disturbance_guess {
    std::vector<double> parameters;
    std::vector<std::vector<double>> starts;
    std::vector<std::vector<std::vector<double>>> values; ///< [experiment][equation][segment]
    double size = 0;      ///< of them, and of what disturbed channels need
    double violation = 0; ///< of other channels: beyond their bounds, in half widths
};

/// Seeks disturbances of the least size with which one parameter explains the data: programs along
/// trajectories, one after the other, each within a trust region.
class disturbance_witness {
    using traits = interval_traits<interval>;

public:
    disturbance_witness(identification_problem const& problem, disturbance_set const& set,
                        disturbed_motions const& motions, std::function<bool()> go_on)
        : problem_(&problem), set_(&set), motions_(&motions), go_on_(std::move(go_on)) {
        driven_ = with_disturbance(problem, set, 0);
    }

    /// Segments from one measured time to the next; each cell one where those are no more than
    /// `most`.
    [[nodiscard]] segment_begins segments(std::size_t most) const {
        std::size_t cells = 0;
        for (std::size_t s = 0; s < motions_->experiments(); ++s)
            cells += motions_->times(s).size();
        segment_begins result;
        for (std::size_t s = 0; s < motions_->experiments(); ++s) {
            auto const& times = motions_->times(s);
            auto& own = result.emplace_back(1, 0);
            auto next = motions_->measured(s).begin();
            for (std::size_t k = 0; k + 1 < times.size(); ++k) {
                bool measured = false;
                for (; next != motions_->measured(s).end() && next->time == times[k]; ++next)
                    measured = true;
                if (k > 0 && (measured || cells <= most)) own.push_back(k);
            }
        }
        return result;
    }
    /// A guess without disturbances.
    [[nodiscard]] disturbance_guess without(approximate_fit const& fit,
                                            segment_begins const& segments) {
        disturbance_guess result{fit.parameters, fit.starts, {}, 0, 0};
        for (auto const& own : segments)
            result.values.emplace_back(set_->equations.size(),
                                       std::vector<double>(own.size(), 0.0));
        return result;
    }
    /// Steps of parameters within a trust region, each with what disturbances and starts alone then
    /// keep the bounds with.
    /// @returns  the best guess on the way that keeps all bounds; else the one that violates least
    [[nodiscard]] disturbance_guess improve(disturbance_guess guess,
                                            segment_begins const& segments) {
        auto here = look(guess, segments);
        double trust = 1;
        for (int round = 0, idle = 0; round < 25 && idle < 3 && !here.empty(); ++round) {
            if (trust < 1e-4 || !go_on_()) break;
            auto next = step(guess, here, segments, trust);
            if (!next) break;
            auto there = look(*next, segments);
            for (int repair = 0; repair < 2 && next->violation > settled; ++repair) {
                auto const fixed = there.empty() ? std::nullopt : step(*next, there, segments, 0);
                if (!fixed) break;
                auto better = *fixed;
                auto at = look(better, segments);
                if (at.empty() || !(better.violation < next->violation)) break;
                next = std::move(better);
                there = std::move(at);
            }
            if (there.empty() || !is_better(*next, guess)) {
                trust /= 4;
                continue;
            }
            bool const held = guess.violation <= settled;
            idle = held && next->size > 0.997 * guess.size ? idle + 1 : 0;
            trust = std::min(1.0, 2 * trust);
            guess = std::move(*next);
            here = std::move(there);
        }
        return guess;
    }
    /// Proves by validated runs that a guess explains the data.
    /// @param size  receives what its disturbances need, rounded upward
    [[nodiscard]] std::optional<verified_witness> verify(disturbance_guess const& guess,
                                                         segment_begins const& segments,
                                                         feasibility_test_options const& options,
                                                         double& size) const {
        size = 0;
        for (auto const& own : guess.values) {
            for (std::size_t q = 0; q < own.size(); ++q) {
                for (double const d : own[q]) size = std::max(size, share(d, q));
            }
        }
        if (guess.size > 0 && !set_->channels.empty())
            size = std::max(size, detail::next_up(guess.size));
        auto const grown = with_disturbance(*problem_, *set_, size);
        auto known = driven_;
        for (std::size_t s = 0; s < known.experiments.size(); ++s) {
            auto& e = known.experiments[s];
            e.inputs = inputs_with(s, guess, segments);
            e.measurements = grown.experiments[s].measurements;
        }
        feasibility_test test(known, options);
        return verify_witness(test, known, guess.parameters, guess.starts);
    }

private:
    /// By this share bounds are shrunk, so that a validated run finds room.
    static constexpr double shrunk = 1e-3;
    static constexpr double settled = 0.5 * shrunk;

    /// |d| over its scale, rounded upward.
    [[nodiscard]] double share(double d, std::size_t q) const {
        bool undefined = false;
        return traits::div(traits::point(std::abs(d)), traits::point(set_->equations[q].scale),
                           undefined)
            .upper();
    }
    [[nodiscard]] static bool is_better(disturbance_guess const& a, disturbance_guess const& b) {
        bool const holds = a.violation <= settled, other = b.violation <= settled;
        if (holds != other) return holds;
        return holds ? a.size < b.size : a.violation < b.violation;
    }
    [[nodiscard]] std::vector<signal> inputs_with(std::size_t s, disturbance_guess const& guess,
                                                  segment_begins const& segments) const {
        auto inputs = problem_->experiments[s].inputs;
        auto const& times = motions_->times(s);
        for (auto const& d : guess.values[s]) {
            std::vector<double> knots;
            for (auto const k : segments[s]) knots.push_back(times[k]);
            inputs.push_back(sampled_signal(knots, d, interpolation::hold));
        }
        return inputs;
    }
    /// The motions along the trajectories of a guess, with bounds shrunk; its size and violation.
    /// Empty where it cannot be simulated.
    [[nodiscard]] std::vector<disturbed_motion> look(disturbance_guess& guess,
                                                     segment_begins const& segments) {
        std::vector<disturbed_motion> result;
        guess.size = guess.violation = 0;
        for (std::size_t s = 0; s < problem_->experiments.size(); ++s) {
            auto const inputs = nominal(inputs_with(s, guess, segments));
            try {
                auto const model = std::make_shared<approximate_model const>(
                    driven_.model, driven_.choice, inputs);
                auto run = simulate(model, inputs, guess.starts[s], guess.parameters,
                                    problem_->experiments[s].begin, motions_->times(s),
                                    {.keep_going = go_on_});
                result.push_back(motions_->along(s, std::move(run.states), guess.parameters));
            } catch (std::domain_error const&) {
                guess.violation = detail::infinity;
                return {};
            }
            for (std::size_t q = 0; q < guess.values[s].size(); ++q)
                for (double const d : guess.values[s][q])
                    guess.size = std::max(guess.size, share(d, q));
            for (auto& sample : result.back().samples) shrink(sample, guess);
        }
        return result;
    }
    void shrink(disturbed_sample& sample, disturbance_guess& guess) const {
        auto& rest = sample.rest;
        double const half = std::max(rad(rest), 1e-250);
        double const less = std::min(shrunk * half, 0.5 * half);
        rest = traits::bounds(rest.lower() + less, rest.upper() - less);
        double const beyond = std::max(rest.lower(), -rest.upper());
        for (auto const& q : set_->channels) {
            if (q.index != sample.channel) continue;
            guess.size = std::max(guess.size, beyond / q.scale);
            return;
        }
        guess.violation = std::max(guess.violation, beyond / half);
    }
    /// Where a program along a guess leads.
    [[nodiscard]] std::optional<disturbance_guess> step(disturbance_guess const& from,
                                                        std::vector<disturbed_motion> const& along,
                                                        segment_begins const& segments,
                                                        double trust) const {
        std::vector<plain_motion> plain;
        for (std::size_t s = 0; s < along.size(); ++s) {
            plain.emplace_back(along[s]);
            std::size_t segment = 0;
            for (std::size_t c = 0; c < plain[s].cells.size(); ++c) {
                while (segment + 1 < segments[s].size() && segments[s][segment + 1] <= c) ++segment;
                auto& defect = plain[s].cells[c].defect;
                defect.setZero(); // it is a trajectory, with the disturbances of the guess
                for (std::size_t q = 0; q < set_->equations.size(); ++q)
                    defect[static_cast<Eigen::Index>(set_->equations[q].index)] =
                        -from.values[s][q][segment];
            }
        }
        auto const room_about = [](double share, box const& range, std::vector<double> const& x) {
            box room(x.size());
            for (std::size_t j = 0; j < x.size(); ++j) {
                double const most = share * width(range[j]);
                room[j] = traits::bounds(std::min(0.0, std::max(range[j].lower() - x[j], -most)),
                                         std::max(0.0, std::min(range[j].upper() - x[j], most)));
            }
            return room;
        };
        program_room room;
        for (auto const& side : room_about(trust, problem_->prior, from.parameters))
            room.parameters.push_back(side);
        for (std::size_t s = 0; s < along.size(); ++s)
            room.starts.push_back(room_about(1, problem_->experiments[s].initial, from.starts[s]));
        auto const found = disturbance_program(along, plain, *set_, segments, room)(go_on_);
        if (!found.finite) return std::nullopt;
        auto next = from;
        auto const moved = [](std::vector<double>& x, std::vector<double> const& by,
                              box const& within) {
            for (std::size_t j = 0; j < x.size(); ++j)
                x[j] = std::clamp(x[j] + by[j], within[j].lower(), within[j].upper());
        };
        moved(next.parameters, found.parameters, problem_->prior);
        for (std::size_t s = 0; s < along.size(); ++s)
            moved(next.starts[s], found.starts[s], problem_->experiments[s].initial);
        next.values = found.disturbances;
        return next;
    }

    identification_problem const* problem_;
    disturbance_set const* set_;
    disturbed_motions const* motions_;
    std::function<bool()> go_on_;
    identification_problem driven_; ///< with an input for each disturbance
};

} // namespace sivid::paving_detail

#endif
