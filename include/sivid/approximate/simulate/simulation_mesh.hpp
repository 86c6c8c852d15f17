// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_SIMULATE_SIMULATION_MESH_HPP
#define SIVID_APPROXIMATE_SIMULATE_SIMULATION_MESH_HPP

#include <sivid/approximate/simulate/approximate_model.hpp>
#include <sivid/approximate/simulate/late_signal.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// One scalar that a simulation shall return: a channel at a time.
struct output_request {
    double time = 0;
    std::size_t channel = 0;
};

/// The times at which a simulation has to stop: knots of the inputs (late ones where the delay puts
/// them, those of a play or a rate limit where it turns), of disturbances, and the times at which
/// the requested outputs are looked at. Between neighbours every input is a straight line.
class simulation_mesh {
public:
    simulation_mesh(approximate_model const& model, std::vector<signal> const& inputs, double begin,
                    std::vector<output_request> requests, std::vector<double> const& knots)
        : model_(&model), begin_(begin), requests_(std::move(requests)), knots_(knots) {
        for (auto const& u : inputs) signals_.emplace_back(u, begin);
        input_late_.assign(inputs.size(), {});
        play_.assign(inputs.size(), 0.0);
        limit_.assign(inputs.size(), late_signal::no_limit);
        for (auto const i : model.used_inputs()) jumps_ = jumps_ || signals_[i].jumps();
        for (auto const* list : {&model.input_memory(), &model.channel_delays()}) {
            for (auto const& d : *list) moves_ = moves_ || d.unknown;
        }
    }

    [[nodiscard]] std::vector<output_request> const& requests() const { return requests_; }
    /// For these parameters; cheap when no unknown delay moves it.
    void place(std::vector<double> const& parameters) {
        if (!times_.empty() && !moves_) return;
        bool const changed = measure_memories(parameters);
        if (!changed && !times_.empty()) return;
        double end = begin_;
        for (auto const& r : requests_) end = std::max(end, r.time);
        if (requests_.empty() && !knots_.empty()) end = std::max(end, knots_.back());
        play_inputs(end);
        cut(end);
        draw_lines(end);
    }

    [[nodiscard]] std::size_t pieces() const { return times_.size() - 1; }
    [[nodiscard]] double time(std::size_t k) const { return times_[k]; }
    /// Requests that are looked at at time(k).
    [[nodiscard]] std::vector<std::size_t> const& observed(std::size_t k) const {
        return observed_[k];
    }
    /// Input `i` on piece k; k = pieces() is the last point alone.
    [[nodiscard]] double input(std::size_t k, std::size_t i, double t) const {
        auto const& l = lines_[k * signals_.size() + i];
        return l.value + l.slope * (t - times_[k]);
    }
    [[nodiscard]] double slope(std::size_t k, std::size_t i) const {
        return lines_[k * signals_.size() + i].slope;
    }
    /// Slope of the input by the size of a memory of this kind.
    [[nodiscard]] double slope_by(memory_kind kind, std::size_t k, std::size_t i, double t) const {
        auto const& l = lines_[k * signals_.size() + i];
        return kind == memory_kind::play         ? l.by_play
               : kind == memory_kind::rate_limit ? l.by_limit + l.limit_change * (t - times_[k])
                                                 : -l.slope * knots_moved_by(kind, i, t);
    }
    /// How far a knot that is seen at t moves with the size of a dead time of its input.
    [[nodiscard]] double knots_moved_by(memory_kind kind, std::size_t i, double t) const {
        double const pace = 1 - input_late_[i].drift;
        return (kind == memory_kind::drift ? t - begin_ : 1) / pace;
    }
    /// The same of the time at which an output that is requested leaves the model.
    [[nodiscard]] double moved_by(memory_kind kind, output_request const& r) const {
        return kind == memory_kind::drift ? r.time - begin_ : 1;
    }
    /// Whether some input jumps between its pieces.
    [[nodiscard]] bool jumps() const { return jumps_; }
    [[nodiscard]] bool jumps(std::size_t i) const { return signals_[i].jumps(); }
    /// Whether a delay of channels acts on the output that is requested.
    [[nodiscard]] bool shows_late(plain_memory const& d, output_request const& r) const {
        return d.index == r.channel && (!d.when || signals_[*d.when].recorded_at(r.time) != 0);
    }
    /// When the output that is requested leaves the model.
    [[nodiscard]] double seen(output_request const& r) const {
        dead_time late;
        for (std::size_t k = 0; k < channel_late_.size(); ++k) {
            if (!shows_late(model_->channel_delays()[k], r)) continue;
            late.delay += channel_late_[k].delay;
            late.drift += channel_late_[k].drift;
        }
        return late.source(r.time, begin_);
    }

private:
    /// How large dead times, plays and limits are. @returns whether any differs from before
    [[nodiscard]] bool measure_memories(std::vector<double> const& parameters) {
        std::vector<dead_time> inputs(input_late_.size()), channels;
        std::vector<double> play(play_.size(), 0.0), limit(limit_.size(), late_signal::no_limit);
        // One behind the other: delays add up, and so do plays; of two limits the smaller, nearly.
        for (auto const& m : model_->input_memory()) {
            if (is_dead_time(m.kind)) m.add_to(inputs[m.index], parameters);
            if (m.kind == memory_kind::play) play[m.index] += std::max(0.0, m.value(parameters));
            if (m.kind == memory_kind::rate_limit) {
                double const now =
                    std::max(std::numeric_limits<double>::min(), m.value(parameters));
                limit[m.index] = std::min(limit[m.index], now);
            }
        }
        for (auto const& d : model_->channel_delays())
            d.add_to(channels.emplace_back(), parameters);
        bool const changed =
            inputs != input_late_ || channels != channel_late_ || play != play_ || limit != limit_;
        input_late_ = std::move(inputs);
        channel_late_ = std::move(channels);
        play_ = std::move(play);
        limit_ = std::move(limit);
        return changed;
    }
    /// Inputs behind plays and rate limits, until the end.
    void play_inputs(double end) {
        auto const& all = model_->input_memory();
        std::vector<bool> done(signals_.size(), false);
        for (auto const& m : all) {
            auto const i = m.index;
            if (is_dead_time(m.kind) || done[i]) continue;
            bool const plays = std::any_of(all.begin(), all.end(), [i](plain_memory const& other) {
                return other.index == i && other.kind == memory_kind::play;
            });
            signals_[i].remember(limit_[i], plays ? std::optional(play_[i]) : std::nullopt, end);
            done[i] = true;
        }
    }
    /// Finds the times to stop at, and which requests are looked at there.
    void cut(double end) {
        times_ = {begin_, end};
        auto const within = [&](double t) {
            if (begin_ < t && t < end) times_.push_back(t);
        };
        for (auto const& r : requests_) within(seen(r));
        for (auto const t : knots_) within(t);
        for (auto const i : model_->used_inputs()) {
            signals_[i].knots(input_late_[i], begin_, end, times_);
            if (!signals_[i].is_formula()) continue;
            for (int k = 1; k < late_signal::fine; ++k)
                within(begin_ + (end - begin_) * k / late_signal::fine);
        }
        std::sort(times_.begin(), times_.end());
        // Times that differ by rounding only are one.
        double const close = 1e-12 * std::max(std::abs(begin_), std::abs(end));
        times_.erase(std::unique(times_.begin(), times_.end(),
                                 [close](double a, double b) { return b - a <= close; }),
                     times_.end());
        observed_.assign(times_.size(), {});
        for (std::size_t k = 0; k < requests_.size(); ++k) {
            auto const at =
                std::lower_bound(times_.begin(), times_.end(), seen(requests_[k]) - close);
            observed_[static_cast<std::size_t>(at - times_.begin())].push_back(k);
        }
    }
    void draw_lines(double end) {
        auto const n = signals_.size();
        lines_.assign(times_.size() * n, {});
        for (auto const i : model_->used_inputs()) {
            for (std::size_t k = 0; k + 1 < times_.size(); ++k) {
                lines_[k * n + i] = signals_[i].on(input_late_[i], times_[k], times_[k + 1]);
            }
            lines_[pieces() * n + i] = {signals_[i].at(input_late_[i], end), 0, 0};
        }
    }

    approximate_model const* model_;
    double begin_;
    std::vector<output_request> requests_;
    std::vector<double> knots_;
    std::vector<late_signal> signals_;
    std::vector<double> play_, limit_, times_;
    std::vector<dead_time> input_late_;
    std::vector<dead_time> channel_late_; ///< one for each of the model's delays
    std::vector<std::vector<std::size_t>> observed_;
    std::vector<late_signal::line> lines_; ///< [piece * inputs + input]
    bool jumps_ = false, moves_ = false;
};

} // namespace sivid

#endif
