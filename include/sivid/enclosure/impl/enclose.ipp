// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_IMPL_ENCLOSE_IPP
#define SIVID_ENCLOSURE_IMPL_ENCLOSE_IPP

#include <sivid/enclosure/enclose.hpp>

#include <sivid/enclosure/observation.hpp>
#include <sivid/enclosure/set/detail/fresh_starts.hpp>
#include <sivid/enclosure/suggested_degree.hpp>
#include <sivid/enclosure/taylor/parametric_flow.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

namespace enclosure_detail {

/// A family by Taylor models. Sets are kept on the way. What is said of a time between them is a
/// short run of its own from the one before, which ends there: as tight as at the ends of steps.
class taylor_motion final : public motion_between_spans {
    using run_type = parametric_flow<>;
    using set_type = run_type::set_type;

public:
    taylor_motion(std::shared_ptr<flow const> f, box initial, box parameters, double from,
                  enclosure_options const& options)
        : flow_(std::move(f)),
          initial_(std::move(initial)),
          parameters_(std::move(parameters)),
          from_(from),
          options_(options) {}

    [[nodiscard]] static enclosed_motion run(std::shared_ptr<flow const> f, box const& initial,
                                             box const& parameters, double from, double to,
                                             enclosure_options const& options) {
        auto const first = std::make_shared<taylor_motion>(f, initial, parameters, from,
                                                           for_span(options, to - from));
        first->carry(first->begin(from), to);
        auto best = first;
        for (auto const& again : {first->once_more(to), first->regardless(to)})
            if (again && again->last_.time > best->last_.time) best = again;
        carried_spans carried{best->last_.time, std::nullopt, std::nullopt};
        if (std::isfinite(best->fresh_)) carried.fresh_starts = best->fresh_;
        auto failure = best->failure_; // no degree is the caller's to choose
        if (failure && failure->help == advice::higher_degree) failure->help = advice::smaller_box;
        return {best, best->spans_, best->last_.time, failure, carried};
    }

    [[nodiscard]] box at(double t) const override {
        auto const& set = kept_before(t);
        if (!(set.time < t)) return states_at(t, &set);
        auto const run = run_to(t);
        return states_at(t, run ? &run->set() : nullptr);
    }
    [[nodiscard]] box observe_at(double t) const override {
        ensemble<interval> const family(initial_, parameters_);
        observer<interval> look(*flow_);
        look.set_ensemble(family);
        auto const run = run_to(t);
        auto seen = look.over(t, interval(t), states_at(t, run ? &run->set() : nullptr));
        if (!run) return seen;
        auto const outputs = run->outputs(); // as functions of the unknowns
        for (std::size_t y = 0; y < seen.size(); ++y) {
            if (std::isfinite(outputs[y].norm())) seen[y] = intersect(seen[y], range(outputs[y]));
        }
        return seen;
    }
    [[nodiscard]] box over(double from, double to) const override {
        auto const& whole = swept_at(to);
        auto const run = run_to(from);
        if (!run) return whole;
        auto result = run->set().hull();
        while (run->time() < to) {
            if (!run->step(to)) return whole;
            result = hull(result, run->swept());
        }
        return intersect(result, whole);
    }

private:
    /// Sets that are kept at most; when there are more, every second one is left out.
    static constexpr std::size_t most_kept = 64;
    /// A set is worn when what it has lost exceeds this share of what its polynomials span: the
    /// flow's derivative over it is then mainly that of a box, whose effects intervals only add up.
    static constexpr double worn_share = 0.25;
    /// A second run is not made where its polynomials have more than so many times the terms.
    static constexpr std::size_t most_terms = 8;

    /// Steps until the end, or a failure.
    void carry(std::unique_ptr<run_type> run, double to) {
        while (run->time() < to) {
            if (run->time() >= fresh_ && worn(run->set())) run->resume(fresh(run->set()));
            keep(run->set());
            double const before = run->time();
            if (!run->step(to)) break;
            spans_.push_back({before, run->time(), run->swept()});
        }
        last_ = run->set();
        failure_ = run->failure();
    }
    /// The same from the last set that was not worn, as a family of starts of its own, and so again
    /// whenever that is worn.
    /// @returns  nothing where that cannot help
    [[nodiscard]] std::shared_ptr<taylor_motion> once_more(double to) const {
        if (!failure_ || failure_->reason == failure_reason::cancelled ||
            failure_->reason == failure_reason::step_limit)
            return nullptr;
        if (fresh_shape().terms > most_terms * shape_of(starts_and_parameters()).terms)
            return nullptr;
        std::size_t k = kept_.size();
        while (k > 1 && worn(kept_[k - 1])) --k;
        if (k <= 1) return nullptr; // the first one is the box of starts itself
        auto const again = std::make_shared<taylor_motion>(*this);
        auto const& set = kept_[--k];
        again->fresh_ = set.time;
        again->spans_.resize(k * every_);
        again->kept_.resize(k);
        auto run = again->begin(set.time);
        run->resume(again->fresh(set));
        again->carry(std::move(run), to);
        return again;
    }
    /// The same to the end whatever polynomials lose, where they lose it for good, by an exponent
    /// that is not known for instance: states within their own ranges still say something.
    /// @returns  nothing where that cannot help
    [[nodiscard]] std::shared_ptr<taylor_motion> regardless(double to) const {
        if (!failure_ || failure_->reason != failure_reason::too_wide) return nullptr;
        auto const again = std::make_shared<taylor_motion>(*this);
        again->options_.remainder_share = std::numeric_limits<double>::infinity();
        auto run = again->begin(last_.time);
        run->resume(last_);
        again->carry(std::move(run), to);
        return again;
    }
    [[nodiscard]] bool worn(set_type const& set) const {
        auto const& states = flow_->model().about.states;
        std::size_t most = 0;
        for (std::size_t i = 1; i < states.size(); ++i) {
            if (set.reach[i] / states[i].limit > set.reach[most] / states[most].limit) most = i;
        }
        return !(set.reach[most] <= worn_share * set.centre[most].spread());
    }
    [[nodiscard]] set_type fresh(set_type const& set) const {
        return with_fresh_starts(set, parameters_with_width(), fresh_shape());
    }
    [[nodiscard]] std::size_t parameters_with_width() const {
        return normalised_unknowns(box{}, parameters_).variables;
    }
    [[nodiscard]] std::size_t starts_and_parameters() const {
        return normalised_unknowns(initial_, parameters_).variables;
    }
    [[nodiscard]] static model_shape<double> const& shape_of(std::size_t unknowns) {
        return model_shape<double>::of(unknowns, suggested_degree(unknowns));
    }
    /// Of sets whose states all have a variable.
    [[nodiscard]] model_shape<double> const& fresh_shape() const {
        return shape_of(parameters_with_width() + initial_.size());
    }

    /// The set before the next step, where it is one to be kept.
    void keep(set_type const& set) {
        if (spans_.size() % every_ != 0) return;
        if (kept_.size() == most_kept) {
            for (std::size_t k = 1; 2 * k < most_kept; ++k) kept_[k] = std::move(kept_[2 * k]);
            kept_.resize(most_kept / 2);
            every_ *= 2;
        }
        kept_.push_back(set);
    }
    /// @param set  the set at time t; null where no run ends there
    [[nodiscard]] box states_at(double t, set_type const* set) const {
        if (spans_.empty()) return set->hull();
        return set ? intersect(set->hull(), swept_at(t)) : swept_at(t);
    }
    /// @param time  of the sets that it is for
    [[nodiscard]] std::unique_ptr<run_type> begin(double time) const {
        auto const& shape = time >= fresh_ ? fresh_shape() : shape_of(starts_and_parameters());
        auto run = std::make_unique<run_type>(*flow_, options_, shape.variables, shape.degree);
        run->begin(from_, initial_, parameters_);
        return run;
    }
    /// A run at time t; nothing where no other steps than those that were made are proved.
    [[nodiscard]] std::unique_ptr<run_type> run_to(double t) const {
        auto const& set = kept_before(t);
        auto run = begin(set.time);
        run->resume(set);
        while (run->time() < t) {
            if (!run->step(t)) return nullptr;
        }
        return run;
    }
    /// The last set that is kept, at t or before.
    [[nodiscard]] set_type const& kept_before(double t) const {
        if (!(t >= from_ && t <= last_.time))
            throw std::out_of_range("enclosed_motion: time " + nearest_text(t) +
                                    " outside the proved span from " + nearest_text(from_) +
                                    " to " + nearest_text(last_.time));
        if (t == last_.time) return last_;
        auto const next =
            std::upper_bound(spans_.begin(), spans_.end(), t,
                             [](double time, swept_span const& s) { return time < s.to; });
        return kept_[static_cast<std::size_t>(next - spans_.begin()) / every_];
    }
    [[nodiscard]] box const& swept_at(double t) const {
        return std::lower_bound(spans_.begin(), spans_.end(), t,
                                [](swept_span const& s, double time) { return s.to < time; })
            ->states;
    }

    std::shared_ptr<flow const> flow_;
    box initial_, parameters_;
    double from_;
    enclosure_options options_;
    std::vector<swept_span> spans_;
    /// Steps from one set that is kept to the next: a copy takes less than a tenth of a step.
    std::size_t every_ = 4;
    std::vector<set_type> kept_;
    set_type last_;
    std::optional<enclosure_failure> failure_;
    /// From here on sets have variables of their own for their starts.
    double fresh_ = std::numeric_limits<double>::infinity();
};

/// A motion that is proved twice: what is said of a time is what both proofs say that reach it.
class motion_proved_twice final : public motion_between_spans {
public:
    motion_proved_twice(enclosed_motion one, enclosed_motion other)
        : one_(std::move(one)), other_(std::move(other)) {}

    [[nodiscard]] static enclosed_motion of(enclosed_motion const& taylor,
                                            enclosed_motion const& first_order) {
        auto const& further = first_order.end_time() > taylor.end_time() ? first_order : taylor;
        auto carried = taylor.carried();
        carried.first_order = first_order.end_time();
        auto failure = further.failure();
        if (failure && failure->help == advice::other_set) failure->help = advice::smaller_box;
        return {std::make_shared<motion_proved_twice>(taylor, first_order),
                spans(taylor.spans(), first_order.spans()), further.end_time(), failure, carried};
    }
    [[nodiscard]] box at(double t) const override {
        return said(t, [t](enclosed_motion const& m) { return m.at(t); });
    }
    [[nodiscard]] box observe_at(double t) const override {
        return said(t, [t](enclosed_motion const& m) { return m.observe_at(t); });
    }
    [[nodiscard]] box over(double from, double to) const override {
        return said(to, [=](enclosed_motion const& m) { return m.over(from, to); });
    }
    /// Each by its own steps: those of both together are swept from other times.
    [[nodiscard]] std::optional<box> over_spans(double from, double to) const override {
        if (to > std::min(one_.end_time(), other_.end_time())) return {};
        return over(from, to);
    }

private:
    template <class Say>
    [[nodiscard]] box said(double t, Say const& say) const {
        if (t > one_.end_time()) return say(other_);
        if (t > other_.end_time()) return say(one_);
        return intersect(say(one_), say(other_));
    }
    /// Wherever a step of either ends, a span does.
    [[nodiscard]] static std::vector<swept_span> spans(std::vector<swept_span> const& one,
                                                       std::vector<swept_span> const& other) {
        std::vector<swept_span> result;
        auto a = one.begin(), b = other.begin();
        while (a != one.end() && b != other.end()) {
            double const to = std::min(a->to, b->to);
            result.push_back({std::max(a->from, b->from), to, intersect(a->states, b->states)});
            if (!(a->to > to)) ++a;
            if (!(b->to > to)) ++b;
        }
        for (auto const& [rest, end] : {std::pair{a, one.end()}, std::pair{b, other.end()}}) {
            for (auto s = rest; s != end; ++s) {
                double const from = result.empty() ? s->from : std::max(s->from, result.back().to);
                result.push_back({from, s->to, s->states});
            }
        }
        return result;
    }

    enclosed_motion one_, other_;
};

/// By Taylor models, and where these are sets about a single point, or end early, by sets of first
/// order, too: over points they lose less to roundings as often as not, and over boxes there are
/// functions that polynomials fail where slopes do not. They get twice the steps.
[[nodiscard]] inline enclosed_motion enclose_by_all(std::shared_ptr<flow const> const& f,
                                                    box const& initial, box const& parameters,
                                                    double from, double to,
                                                    enclosure_options const& options) {
    auto motion = taylor_motion::run(f, initial, parameters, from, to, options);
    bool const point = normalised_unknowns(initial, parameters).variables == 0;
    bool const stopped = motion.failure() && motion.failure()->reason == failure_reason::cancelled;
    if (stopped || (motion.complete() && !point)) return motion;
    auto limited = options;
    limited.maximum_steps = std::min(options.maximum_steps, 2 * motion.spans().size() + 200);
    enclosed_motion const other(f, initial, parameters, from, to, limited);
    if (!point && !(other.end_time() > motion.end_time())) return motion;
    return motion_proved_twice::of(motion, other);
}

} // namespace enclosure_detail

SIVID_DECL enclosed_motion enclose(std::shared_ptr<flow const> f, box const& initial,
                                   box const& parameters, double from, double to, carried_set set,
                                   enclosure_options const& options) {
    using namespace enclosure_detail;
    if (set == carried_set::doubleton) {
        return {std::move(f), initial, parameters, from, to, options};
    }
    if (!(from <= to))
        throw std::invalid_argument("enclose: the end, " + nearest_text(to) +
                                    ", lies before the begin, " + nearest_text(from));
    if (options.method)
        throw std::invalid_argument(
            "enclose: Taylor models follow the Taylor series, not the method '" +
            options.method->name + "'; sets of first order (carried_set::doubleton) take it");
    return enclose_by_all(f, initial, parameters, from, to, options);
}

SIVID_DECL enclosed_motion enclose(recorded_model const& model, parameter_choice const& choice,
                                   box const& initial, box const& parameters, double from,
                                   double to, carried_set set, enclosure_options const& options,
                                   std::vector<signal> const& inputs) {
    return enclose(std::make_shared<flow const>(model, choice, inputs), initial, parameters, from,
                   to, set, for_method(options));
}

} // namespace sivid

#endif
