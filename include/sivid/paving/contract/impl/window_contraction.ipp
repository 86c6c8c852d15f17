// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CONTRACT_IMPL_WINDOW_CONTRACTION_IPP
#define SIVID_PAVING_CONTRACT_IMPL_WINDOW_CONTRACTION_IPP

#include <sivid/paving/contract/window_contraction.hpp>

#include <sivid/compiled.hpp>
#include <sivid/enclosure/flow.hpp>
#include <sivid/measurement/record.hpp>
#include <sivid/model/structure/states_seen.hpp>
#include <sivid/paving/contract/detail/lifted_program.hpp>
#include <sivid/paving/response/local_response.hpp>
#include <sivid/paving/run/detail/experiment_run_class.hpp>
#include <sivid/paving/run/run_parts.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

class window_contractor {
    using traits = interval_traits<interval>;

public:
    window_contractor(identification_problem const& problem, window_options const& options)
        : problem_(&problem),
          options_(options),
          limit_(options.seconds, options.keep_going),
          model_(with_states_seen(problem.model)) {
        options_.run.keep_going = limit_;
        // Inputs held for a millisecond end as many steps, each with its own truncation.
        options_.run.relative_tolerance *= 0.01;
        result_.rest = problem.prior;
        for (auto const& e : problem.experiments) {
            result_.starts.push_back(e.initial);
            records_.push_back(sorted(e.measurements));
        }
    }

    [[nodiscard]] window_contraction operator()() {
        stopwatch const clock;
        auto const& run = options_.run;
        // else by other means than these
        bool const as_asked = run.set == carried_set::taylor_model && !run.method;
        if (as_asked && !problem_->model.has_memory() && problem_->model.added_states.empty()) {
            std::vector<window> chain;
            bool const left = !options_.equations || know(chain);
            for (std::size_t e = 0; left && e < records_.size() && !result_.empty(); ++e) {
                flows_.push_back(std::make_unique<flow const>(model_, problem_->choice,
                                                              problem_->experiments[e].inputs));
                if (problem_->experiments[e].outliers != 0) continue;
                options_.equations ? spread(e, chain) : follow(e, chain);
            }
            if (!result_.empty()) contract_together(some_of(std::move(chain)));
        }
        result_.seconds = clock.spent();
        return std::move(result_);
    }

private:
    struct window {
        std::size_t experiment;
        double from, to;
        box start; ///< holds the state at `from`
        std::shared_ptr<response const> answer = nullptr;
        double blur = 0; ///< the largest radius of an output against its bound
        /// Of the next run, and the longest it has had: to measurements that come so late.
        double length = 0, longest = 0;
    };

    void nothing_is_left() { result_.rest = empty_box(result_.rest.size()); }
    [[nodiscard]] std::size_t states() const { return problem_->model.about.states.size(); }
    [[nodiscard]] double last_sample(std::size_t e) const { return records_[e].back().time; }

    /// The measurements of a window. What is measured where it begins has contracted its start
    /// already, but for the first one.
    [[nodiscard]] record measured_in(window const& w) const {
        bool const first = w.from == problem_->experiments[w.experiment].begin;
        record part;
        for (auto const& m : records_[w.experiment]) {
            if (m.time <= w.to && (w.from < m.time || first)) part.push_back(m);
        }
        return part;
    }
    /// A window as an experiment, with the states at its end as outputs.
    [[nodiscard]] experiment part_of(window const& w) const {
        auto const& whole = problem_->experiments[w.experiment];
        experiment part{whole.name, {}, w.from, w.start, measured_in(w), 0};
        for (std::size_t i = 0; i < states(); ++i) {
            part.measurements.push_back(
                {w.to, problem_->model.about.channels.size() + i, traits::entire()});
        }
        return part;
    }
    /// Carries windows of one experiment over the parameters that are left.
    void run(std::vector<window*> const& windows) const {
        auto const e = windows.front()->experiment;
        auto options = options_.run;
        options.degree = degree_;
        static_cast<enclosure_options&>(options) = steps_for(problem_->experiments[e], options);
        std::vector<experiment> parts;
        for (auto const* w : windows) parts.push_back(part_of(*w));
        auto const answers = run_parts(*flows_[e], parts, result_.rest, options);
        for (std::size_t k = 0; k < windows.size(); ++k) {
            windows[k]->answer = answers[k];
            windows[k]->blur = answers[k]->blur();
        }
    }
    void run(window& w) const { run({&w}); }
    /// Contracts a window's start by its own measurements. @returns false when nothing is left
    [[nodiscard]] bool contract_start(window& w) const {
        response_list const alone{w.answer};
        lifted_program const program(alone, result_.rest, {w.start}, options_.share);
        for (std::size_t i = 0; i < w.start.size(); ++i) {
            auto const& side = w.answer->unknowns.initial[i];
            if (!(side.radius > 0) || !limit_()) continue;
            auto const unknown = program.unknowns().places[0][side.variable].unknown;
            auto const left = program.contracted(unknown, w.start[i]);
            if (is_empty(left)) return false;
            w.start[i] = left;
        }
        return true;
    }
    /// The states at the end of a window, unless there are none.
    [[nodiscard]] std::optional<box> end_of(window const& w) const {
        response_list const alone{w.answer};
        lifted_program const program(alone, result_.rest, {w.start}, options_.share);
        auto const ranges = output_ranges(*w.answer, result_.rest);
        std::vector<interval> end;
        for (std::size_t y = ranges.size() - states(); y < ranges.size(); ++y) {
            auto const channel = model_.observe.size() - (ranges.size() - y);
            auto const above = program.end_of(0, y, true), below = program.end_of(0, y, false);
            auto side = ranges[y];
            if (below <= above) side = traits::intersect(side, traits::bounds(below, above));
            for (auto const& m : records_[w.experiment]) { // seen without any remainder
                bool const seen =
                    m.time == w.to && model_.observe[m.channel] == model_.observe[channel];
                if (seen) side = traits::intersect(side, m.bound);
            }
            if (!(below <= above) || is_empty(side)) return std::nullopt;
            end.push_back(side);
        }
        return box(std::move(end));
    }

    /// Asks what is known beside windows. @returns false when nothing is left
    [[nodiscard]] bool know(std::vector<window>& windows) {
        known_ = options_.equations(result_.rest);
        result_.rest = known_.rest;
        if (result_.empty()) {
            nothing_is_left();
            return false;
        }
        for (auto& w : windows) {
            if (w.from == problem_->experiments[w.experiment].begin) continue;
            w.start = agreed(w.start, known_.states(w.experiment, w.from));
        }
        return true;
    }
    /// Windows all along a record, with gaps to grow into.
    void spread(std::size_t e, std::vector<window>& chain) {
        auto const& whole = problem_->experiments[e];
        degree_ = highest_degree();
        auto const count = std::max<std::size_t>(options_.windows / records_.size(), 1);
        double const apart = (last_sample(e) - whole.begin) / static_cast<double>(count);
        for (std::size_t k = 0; k < count && limit_(); ++k) {
            double const at = whole.begin + apart * static_cast<double>(k);
            double const from =
                k == 0 ? whole.begin : end_before(records_[e], whole.begin, at - whole.begin);
            window w{e, from, end_before(records_[e], from, 0.4 * apart),
                     k == 0 ? whole.initial : known_.states(e, from)};
            bool const held = std::all_of(w.start.begin(), w.start.end(),
                                          [](interval const& side) { return is_bounded(side); });
            if (held && w.from < w.to) chain.push_back(std::move(w));
        }
    }

    /// Windows one after the other, as long as the box carries.
    void follow(std::size_t e, std::vector<window>& chain) {
        auto const& whole = problem_->experiments[e];
        auto const& record = records_[e];
        double length = std::min({last_sample(e) - whole.begin, options_.longest, options_.first});
        double at = whole.begin;
        auto start = whole.initial;
        degree_ = highest_degree();
        for (std::size_t k = 0; k < options_.chained && at < last_sample(e) && limit_();) {
            window w{e, at, end_before(record, at, length), start};
            run(w);
            ++result_.windows;
            if (!(w.blur < too_blurred)) {
                double const carried = carried_until(w);
                double const next = std::min(0.7 * (w.to - at), carried - at);
                bool const shortest = !(end_before(record, at, next) < w.to);
                if (shortest) break;
                length = next;
                continue;
            }
            auto end = contract_start(w) ? end_of(w) : std::nullopt;
            if (!end) return nothing_is_left();
            start = std::move(*end);
            if (k == 0) result_.starts[e] = w.start;
            at = w.to;
            // Not from where it ended: samples may be further apart than it grows by.
            length = w.blur < 0.3 ? std::min(1.3 * length, options_.longest) : w.to - w.from;
            chain.push_back(std::move(w));
            ++k;
        }
    }
    /// The last time of a measurement in a window, or the first one. Lengths are often so many gaps
    /// between samples: what stamps are rounded by must not count.
    [[nodiscard]] static double end_before(record const& samples, double from, double length) {
        length *= 1 + 1e-9;
        double end = samples.back().time;
        bool any = false;
        for (auto const& m : samples) {
            if (!(m.time > from)) continue;
            if (any && m.time > from + length) break;
            end = m.time;
            any = true;
        }
        return end;
    }
    /// Until when the outputs of a window are sharp.
    [[nodiscard]] double carried_until(window const& w) const {
        auto const& r = *w.answer;
        double time = w.from;
        auto const samples = measured_in(w);
        for (std::size_t y = 0; y < std::min(r.outputs(), samples.size()); ++y) {
            if (r.radius[y] > 0.5 * too_blurred * 0.5 * width(r.bounds[y])) break;
            time = samples[y].time;
        }
        return time;
    }

    /// So many that one program takes them: of each part of the chain the longest that is sharp.
    [[nodiscard]] std::vector<window> some_of(std::vector<window> chain) const {
        auto const most = std::max<std::size_t>(options_.windows, 1);
        if (chain.size() <= most) return chain;
        auto const less = [](window const& a, window const& b) {
            auto const worth = [](window const& w) { return (w.to - w.from) / (1 + w.blur); };
            return worth(a) < worth(b);
        };
        std::vector<window> chosen;
        for (std::size_t k = 0; k < most; ++k) {
            auto const at = [&](std::size_t part) {
                return chain.begin() + static_cast<std::ptrdiff_t>(part * chain.size() / most);
            };
            chosen.push_back(*std::max_element(at(k), at(k + 1), less));
        }
        return chosen;
    }

    void contract_together(std::vector<window> windows) {
        constexpr std::size_t most_stretches = 3;
        std::size_t idle = 0, stretched = 0; // rounds in a row, in all
        for (auto& w : windows) w.length = w.longest = w.to - w.from;
        while (!windows.empty() && limit_()) {
            if (options_.equations && result_.rounds > 0 && !know(windows)) return;
            auto const before = result_.rest;
            carry(windows);
            if (!limit_()) return; // what was carried may be cut short
            contract_parameters(windows);
            ++result_.rounds;
            if (result_.empty() || !contract_starts(windows)) return nothing_is_left();
            bool const grown = grow(windows);
            double const blur = median_blur(windows);
            if (blur < 0.02) degree_ = 2;
            if (!(blur < 0.5)) degree_ = highest_degree();
            double const volume = relative_volume(result_.rest, before).upper();
            double const side = std::pow(volume, 1 / static_cast<double>(before.size()));
            idle = side > 1 - options_.gain && !grown ? idle + 1 : 0;
            if (idle < options_.patience) continue;
            if (stretched == most_stretches || !stretch(windows)) break;
            ++stretched;
            idle = 0;
        }
    }
    /// Runs all windows, eight of one experiment at a time.
    void carry(std::vector<window>& windows) {
        std::vector<std::vector<window*>> together;
        for (auto& w : windows) {
            w.to = end_before(records_[w.experiment], w.from, w.length);
            bool const joins = !together.empty() && together.back().size() < 8 &&
                               together.back().front()->experiment == w.experiment;
            if (!joins) together.emplace_back();
            together.back().push_back(&w);
        }
        options_.workers(together.size(), [&](std::size_t k) { run(together[k]); });
        result_.windows += windows.size();
    }
    /// Contracts the parameters by all windows at once.
    void contract_parameters(std::vector<window> const& windows) {
        response_list known;
        std::vector<box> starts;
        for (auto const& w : windows) {
            known.push_back(w.answer);
            starts.push_back(w.start);
            result_.longest = std::max(result_.longest, w.to - w.from);
        }
        auto const before = result_.rest;
        lifted_program const program(known, before, starts, options_.share);
        options_.workers(before.size(), [&](std::size_t j) {
            if (!(rad(before[j]) > 0) || !limit_()) return;
            result_.rest[j] = program.contracted(j, before[j]);
        });
        if (options_.keep_responses) {
            result_.responses = known;
            result_.from = starts;
        }
    }
    /// Contracts each window's start by itself. @returns false when nothing is left of one
    [[nodiscard]] bool contract_starts(std::vector<window>& windows) {
        std::vector<char> left(windows.size(), 1);
        options_.workers(windows.size(), [&](std::size_t k) {
            if (limit_()) left[k] = contract_start(windows[k]) ? 1 : 0;
        });
        for (std::size_t k = 0; k < windows.size(); ++k) {
            auto const& w = windows[k];
            if (left[k] == 0) return false;
            if (w.from == problem_->experiments[w.experiment].begin) {
                result_.starts[w.experiment] = w.start;
            }
        }
        return true;
    }
    /// Lengthens the windows that are sharp and shortens those that are not. @returns whether one
    /// becomes longer than it ever was
    [[nodiscard]] bool grow(std::vector<window>& windows) const {
        bool grown = false;
        for (auto& w : windows) {
            bool const ends = !(w.to < last_sample(w.experiment));
            if (w.blur < 1 && !ends && w.length < options_.longest) {
                w.length = std::min((w.blur < 0.5 ? 2 : 1.35) * w.length, options_.longest);
                // Shrunk by a fifth, then stretched: 8 % more each time is no growth.
                grown = grown || w.length > 1.1 * w.longest;
                w.longest = std::max(w.longest, w.length);
            } else if (!(w.blur < 4)) {
                w.length *= 0.8;
            }
        }
        return grown;
    }
    /// Longer windows see more, and may be worth their blur. @returns false when none can be longer
    [[nodiscard]] bool stretch(std::vector<window>& windows) const {
        bool any = false;
        for (auto& w : windows) {
            if (!(w.blur < 4) || !(w.to < last_sample(w.experiment))) continue;
            w.length = std::min(1.35 * (w.to - w.from), options_.longest);
            any = true;
        }
        return any;
    }
    [[nodiscard]] static double median_blur(std::vector<window> const& windows) {
        std::vector<double> blurs;
        for (auto const& w : windows) blurs.push_back(w.blur);
        auto const middle = blurs.begin() + static_cast<std::ptrdiff_t>(blurs.size() / 2);
        std::nth_element(blurs.begin(), middle, blurs.end());
        return *middle;
    }

    /// Terms of degree 3 grow with the cube of the unknowns. Windows that follow others begin in
    /// boxes of states; a growing one is carried alone and can afford more.
    [[nodiscard]] std::size_t highest_degree() const {
        bool const growing = options_.chained == 1;
        std::size_t starts = growing ? 0 : states();
        for (auto const& e : problem_->experiments) {
            starts = std::max(starts, normalised_unknowns(e.initial, {}).variables);
        }
        std::size_t const affordable =
            problem_->prior.size() + starts <= (growing ? 18U : 14U) ? 3 : 2;
        return std::min(affordable, options_.degree);
    }
    static constexpr double too_blurred = 8;

    identification_problem const* problem_;
    window_options options_;
    work_limit limit_;
    recorded_model model_;
    std::vector<record> records_;
    std::vector<std::unique_ptr<flow const>> flows_;
    std::size_t degree_ = 3;
    window_contraction result_;
    known_motions known_; ///< where equations are asked
};

} // namespace paving_detail

SIVID_DECL window_contraction contract_by_windows(identification_problem const& problem,
                                                  window_options const& options) {
    problem.require_valid();
    return paving_detail::window_contractor(problem, options)();
}

} // namespace sivid

#endif
