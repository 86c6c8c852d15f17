// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_OBSERVER_INTERVAL_OBSERVER_HPP
#define SIVID_PAVING_OBSERVER_INTERVAL_OBSERVER_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/arithmetic.hpp>
#include <sivid/model/graph/program.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/pack.hpp>
#include <sivid/number/rounding.hpp>
#include <sivid/paving/relation/input_range.hpp>
#include <sivid/paving/response/misfit.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// Bounds of the states that measurements narrow again and again: an interval observer. It needs no
/// smoothness, starts may be wide, and it stays bounded as long as the model forgets; its width is
/// of first order in the parameters' box.
///
/// Between knots each state lies between two lines, \f$ x_i^-(t) \le x_i(t) \le x_i^+(t) \f$, where
/// \f$ \dot x_i^+ \ge f_i \f$ on the upper face (\f$ x_i = x_i^+ \f$, the other states anywhere
/// between theirs, parameters anywhere in the box), and the lower one likewise. At a measurement
/// the states are cut down to what the measured bound, grown by the inflation asked for, allows.
/// @guarantee  a refuted box contains no parameter that explains the experiment with its bounds
///             grown by `level`, whatever the start and the errors of the inputs in their bounds
/// @cost  about four evaluations of the rates for each slice of time, eight boxes at once
/// @ref   M. Müller, Über das Fundamentaltheorem in der Theorie der gewöhnlichen
///        Differentialgleichungen, Math. Z. 26 (1927); the faces are widened a little, so that it
///        holds without a Lipschitz condition
class interval_observer {
public:
    static constexpr std::size_t width = 8;
    using number = pack<width>;
    using traits = interval_traits<number>;
    using mask = traits::mask;
    using lane_values = std::array<double, width>;

    /// @given  a valid problem whose model has no delays (checked)
    interval_observer(identification_problem const& problem, std::size_t index)
        : experiment_(&problem.experiments[index]),
          model_(bind(problem.model, problem.choice, experiment_->inputs)),
          samples_(sorted(experiment_->measurements)) {
        auto const n = model_.state_count();
        auto const all = program::marked(model_.g, std::vector<bool>(model_.g.size(), true));
        memory_ = all.memory<arithmetic>();
        for (auto const& leaf : all.leaves()) {
            auto& list = leaf.op == operation::time       ? times_
                         : leaf.op == operation::state    ? states_
                         : leaf.op == operation::constant ? parameters_
                                                          : inputs_;
            list.emplace_back(leaf.target, leaf.index);
        }
        for (std::size_t i = 0; i < n; ++i) rates_.push_back(program_of({model_.rate[i]}));
        for (std::size_t y = 0; y < model_.channel_count(); ++y) {
            outputs_.push_back(program_of({model_.observe[y]}));
            slopes_.push_back(program_of(model_.observe_dx[y]));
            auto const& steps = outputs_.back().code.steps();
            is_smooth_.push_back(std::none_of(
                steps.begin(), steps.end(), [](auto const& s) { return s.op == operation::sign; }));
        }
        for (auto const& rows : model_.rate_dp) influences_.push_back(program_of(rows));
        for (auto* bounds : {&low_, &high_, &rise_low_, &rise_high_}) bounds->resize(n);
        box_.resize(n);
        find_ticks();
    }

    /// Asked now and then; false ends a run with what is refuted by then.
    std::function<bool()> keep_going{};
    /// What was found out about up to eight boxes.
    struct finding {
        mask refuted{};
        /// Per parameter and box: how much of the rates its width moves, on the average over time.
        std::vector<lane_values> influence;
        /// Of the boxes that are refuted: the measurements that were looked at for it.
        std::array<std::size_t, width> samples{};
    };

    /// @param parameters  at most `width` boxes
    /// @param level       inflation of the measured bounds
    /// @param most        so many measurements at most, the first ones
    [[nodiscard]] finding operator()(std::vector<box> const& parameters, double level,
                                     std::size_t most = std::numeric_limits<std::size_t>::max()) {
        begin(parameters);
        finding result;
        result.influence.resize(model_.parameter_count(), lane_values{});
        std::array<std::size_t, width> failed{};
        std::size_t next = 0;
        auto const look = [&](double t) {
            for (; next < samples_.size() && samples_[next].time == t; ++next) {
                auto const hopeless = live_ & measure(samples_[next], t, level);
                for (std::size_t l = 0; l < width; ++l) {
                    if ((hopeless >> l & 1u) == 0 || ++failed[l] <= experiment_->outliers) continue;
                    result.refuted |= mask{1} << l;
                    result.samples[l] = next + 1;
                    live_ &= ~(mask{1} << l);
                }
            }
        };
        look(experiment_->begin);
        for (std::size_t k = 0; k + 1 < ticks_.size() && live_ != 0 && next < most; ++k) {
            if (k % 8 == 0) add_influence(ticks_[k], parameters, result);
            if (k % 32 == 0 && keep_going && !keep_going()) break;
            cross(ticks_[k], ticks_[k + 1]);
            look(ticks_[k + 1]);
        }
        return result;
    }

private:
    using arithmetic = proven_arithmetic<number>;
    struct formula {
        program code;
        std::vector<node_id> outputs;
    };
    [[nodiscard]] formula program_of(std::vector<node_id> const& outputs) const {
        return {program(model_.g, outputs), outputs};
    }
    /// @returns where something is not defined
    mask run(formula const& f) { return f.code.run<arithmetic>(memory_); }
    /// Nodes that are written, and which state, input or parameter each is.
    using leaf_list = std::vector<std::pair<node_id, std::size_t>>;
    template <class Value>
    void write(leaf_list const& leaves, Value const& value) {
        for (auto const& [node, index] : leaves) memory_[node] = value(index);
    }
    /// The times of measurements and of the inputs' knots between.
    void find_ticks() {
        ticks_.push_back(experiment_->begin);
        for (auto const& m : samples_) ticks_.push_back(m.time);
        add_knots(ticks_, experiment_->inputs, experiment_->begin, samples_.back().time);
        std::sort(ticks_.begin(), ticks_.end());
        ticks_.erase(std::unique(ticks_.begin(), ticks_.end()), ticks_.end());
    }
    void begin(std::vector<box> const& parameters) {
        auto const last = parameters.size() - 1;
        live_ = (mask{2} << last) - 1;
        write(parameters_, [&](std::size_t j) {
            return packed([&](std::size_t l) {
                auto const& side = parameters[std::min(l, last)][j];
                return std::pair{side.lower(), side.upper()};
            });
        });
        for (std::size_t i = 0; i < low_.size(); ++i) {
            low_[i].fill(experiment_->initial[i].lower());
            high_[i].fill(experiment_->initial[i].upper());
            rise_low_[i].fill(0);
            rise_high_[i].fill(0);
        }
    }
    /// Times and inputs, with their errors, from t0 to t1, within one piece of every input.
    void write_inputs(double t0, double t1) {
        auto const t = traits::bounds(t0, t1);
        write(times_, [&](std::size_t) { return t; });
        write(inputs_, [&](std::size_t i) {
            auto const& u = std::get<sampled_signal>(experiment_->inputs[i]);
            auto const k = u.piece(t0);
            double const e = std::max(u.error_bound(k, t0), u.error_bound(k, t1));
            return traits::add(u.template value<number>(k, t), traits::bounds(-e, e));
        });
    }
    /// From one tick to the next, in slices that are short against the bounds' own width.
    void cross(double from, double to) {
        double fastest = 0; // slices per second
        for (std::size_t i = 0; i < low_.size(); ++i) {
            for (std::size_t l = 0; l < width; ++l) {
                if ((live_ >> l & 1u) == 0) continue;
                double const speed =
                    std::max(std::abs(rise_low_[i][l]), std::abs(rise_high_[i][l]));
                double const size = high_[i][l] - low_[i][l];
                if (speed > 0) fastest = std::max(fastest, slices_across * speed / size);
            }
        }
        auto slices = static_cast<std::size_t>(
            std::clamp(std::ceil((to - from) * fastest), 1.0, double{most_slices}));
        for (double t = from; t < to && live_ != 0;) {
            auto const length = (to - t) / static_cast<double>(slices);
            double const next = slices > 1 ? t + length : to;
            auto const proved = advance(t, next);
            if ((live_ & ~proved) != 0 && slices < most_halved) {
                slices *= 2; // of what is left; nobody has moved
                continue;
            }
            live_ &= proved; // the others get lost: nothing is known of them from now on
            accept(t, next);
            t = next;
            slices = std::max<std::size_t>(slices - 1, 1);
        }
    }
    static double up(double x) { return detail::next_up(x); }
    static double down(double x) { return -up(-x); }
    /// The end of a line, rounded up.
    static double end_above(double x, double slope, double t0, double t1) {
        return detail::add_up(x, detail::mul_up(slope, slope >= 0 ? up(t1 - t0) : down(t1 - t0)));
    }
    static double end_below(double x, double slope, double t0, double t1) {
        return -end_above(-x, -slope, t0, t1);
    }
    /// Between two values and a little around them.
    static std::pair<double, double> around(double a, double b) {
        double const more = 1e-13 * (std::abs(a) + std::abs(b)) + 1e-290;
        return {down(std::min(a, b) - more), up(std::max(a, b) + more)};
    }
    template <class Ends>
    static number packed(Ends const& ends) {
        lane_values lo{}, hi{};
        for (std::size_t l = 0; l < width; ++l) std::tie(lo[l], hi[l]) = ends(l);
        return number::load(lo.data(), hi.data());
    }
    /// Looks for slopes with which the lines bound all states from t0 to t1.
    /// @returns  the boxes for which the present slopes are proved to do so
    [[nodiscard]] mask advance(double t0, double t1) {
        write_inputs(t0, t1);
        auto const n = low_.size();
        mask proved{};
        for (int round = 0; round < 6; ++round) {
            for (std::size_t i = 0; i < n; ++i) {
                box_[i] = packed([&](std::size_t l) {
                    return around(
                        std::min(low_[i][l], end_below(low_[i][l], rise_low_[i][l], t0, t1)),
                        std::max(high_[i][l], end_above(high_[i][l], rise_high_[i][l], t0, t1)));
                });
            }
            proved = live_;
            for (std::size_t i = 0; i < n; ++i) {
                lane_values lo{}, hi{};
                mask undefined = face(i, packed([&](std::size_t l) {
                                          double const x = high_[i][l];
                                          return around(x, end_above(x, rise_high_[i][l], t0, t1));
                                      }));
                memory_[model_.rate[i]].store(lo.data(), hi.data());
                proved &= ~undefined & settle(rise_high_[i], hi, 1, round == 0);
                undefined = face(i, packed([&](std::size_t l) {
                                     double const x = low_[i][l];
                                     return around(x, end_below(x, rise_low_[i][l], t0, t1));
                                 }));
                memory_[model_.rate[i]].store(lo.data(), hi.data());
                proved &= ~undefined & settle(rise_low_[i], lo, -1, round == 0);
            }
            if ((live_ & ~proved) == 0) break;
        }
        return proved;
    }
    mask face(std::size_t i, number const& x) {
        write(states_, [&](std::size_t j) { return j == i ? x : box_[j]; });
        return run(rates_[i]);
    }
    /// Where the slopes bound what was found. The others, and guesses that were not made for this
    /// slice, move a little beyond it.
    static mask settle(lane_values& slope, lane_values const& found, int sign, bool guessed) {
        mask good{};
        for (std::size_t l = 0; l < width; ++l) {
            if (!std::isfinite(found[l])) continue;
            double const more = sign * (found[l] - slope[l]);
            if (more <= 0 && !guessed) {
                good |= mask{1} << l;
            } else {
                slope[l] =
                    found[l] + sign * (0.05 * std::abs(more) + 1e-6 * std::abs(found[l]) + 1e-250);
            }
        }
        return good;
    }
    void accept(double t0, double t1) {
        for (std::size_t i = 0; i < low_.size(); ++i) {
            for (std::size_t l = 0; l < width; ++l) {
                if ((live_ >> l & 1u) == 0) continue;
                low_[i][l] = end_below(low_[i][l], rise_low_[i][l], t0, t1);
                high_[i][l] = end_above(high_[i][l], rise_high_[i][l], t0, t1);
            }
        }
    }
    [[nodiscard]] number middle_of(std::size_t i) const {
        return packed([&](std::size_t l) {
            double const x = 0.5 * low_[i][l] + 0.5 * high_[i][l];
            return std::pair{x, x};
        });
    }
    /// Cuts the states down to what a measurement allows.
    /// @returns  the boxes where no state fulfils it
    [[nodiscard]] mask measure(measurement const& m, double t, double level) {
        write_inputs(t, t);
        auto const allowed = number(grown(m.bound, level));
        auto const n = low_.size();
        std::vector<number> whole(n), middle(n), off(n);
        for (std::size_t i = 0; i < n; ++i) {
            whole[i] = number::load(low_[i].data(), high_[i].data());
            middle[i] = middle_of(i);
            off[i] = traits::sub(whole[i], middle[i]);
        }
        auto const& output = outputs_[m.channel];
        write(states_, [&](std::size_t i) { return whole[i]; });
        auto const undefined = run(output) | run(slopes_[m.channel]);
        auto hopeless = traits::disjoint(memory_[output.outputs[0]], allowed) & ~undefined;
        if (experiment_->outliers > 0 || !is_smooth_[m.channel]) return hopeless;
        std::vector<number> slope(n);
        for (std::size_t i = 0; i < n; ++i) slope[i] = memory_[slopes_[m.channel].outputs[i]];
        // y = g(middle) + sum G_i (x_i - middle_i)
        write(states_, [&](std::size_t i) { return middle[i]; });
        auto const nowhere = undefined | run(output);
        auto const at_middle = memory_[output.outputs[0]];
        for (std::size_t i = 0; i < n; ++i) {
            auto rest = traits::sub(allowed, at_middle);
            for (std::size_t j = 0; j < n; ++j) {
                if (j != i) rest = traits::sub(rest, traits::mul(slope[j], off[j]));
            }
            mask no_quotient = traits::contains(slope[i], 0.0);
            mask divided{};
            auto const cut = traits::intersect(
                whole[i], traits::add(middle[i], traits::div(rest, slope[i], divided)));
            no_quotient |= divided | nowhere;
            auto const empty = traits::is_empty(cut);
            hopeless |= empty & ~no_quotient;
            lane_values lo{}, hi{};
            cut.store(lo.data(), hi.data());
            for (std::size_t l = 0; l < width; ++l) {
                if (((no_quotient | empty) >> l & 1u) != 0) continue;
                low_[i][l] = lo[l];
                high_[i][l] = hi[l];
            }
        }
        return hopeless;
    }
    /// Which parameters' widths move the rates most; estimates.
    void add_influence(double t, std::vector<box> const& parameters, finding& result) {
        write_inputs(t, t);
        for (std::size_t i = 0; i < low_.size(); ++i) {
            write(states_, [&](std::size_t j) { return middle_of(j); });
            (void)run(influences_[i]);
            for (std::size_t j = 0; j < result.influence.size(); ++j) {
                auto const& d = memory_[influences_[i].outputs[j]];
                lane_values lo{}, hi{};
                d.store(lo.data(), hi.data());
                for (std::size_t l = 0; l < parameters.size(); ++l) {
                    double const size = high_[i][l] - low_[i][l];
                    double const moved = 0.5 * std::abs(lo[l] + hi[l]) * rad(parameters[l][j]);
                    if (std::isfinite(moved) && size > 0 && (live_ >> l & 1u) != 0)
                        result.influence[j][l] += moved / model_.about.states[i].limit;
                }
            }
        }
    }
    static constexpr double slices_across = 2; ///< so many while a bound moves by its own width
    static constexpr std::size_t most_slices = 16, most_halved = 1024;

    experiment const* experiment_;
    bound_model model_;
    record samples_;
    std::vector<double> ticks_;
    std::vector<number> memory_;
    leaf_list times_, states_, inputs_, parameters_;
    std::vector<formula> rates_, outputs_, slopes_, influences_;
    std::vector<bool> is_smooth_; ///< per channel: the mean value theorem holds
    std::vector<lane_values> low_, high_, rise_low_, rise_high_; ///< bounds of the states, slopes
    std::vector<number> box_;                                    ///< the states during a slice
    mask live_{};
};

} // namespace sivid

#endif
