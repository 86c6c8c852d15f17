// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_IMPL_EFFECT_HULLS_IPP
#define SIVID_DIAGNOSIS_CANDIDATE_IMPL_EFFECT_HULLS_IPP

#include <sivid/diagnosis/candidate/effect_hulls.hpp>

#include <sivid/diagnosis/affected_problem.hpp>
#include <sivid/diagnosis/candidate/input_slices.hpp>
#include <sivid/diagnosis/candidate/resolve_delays.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/judge/data_test.hpp>
#include <sivid/paving/products/dependence.hpp>
#include <sivid/paving/products/reduction.hpp>
#include <sivid/paving/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

namespace diagnosis_detail {

class hulls_by_slices {
public:
    hulls_by_slices(identification_problem const& base, std::vector<effect> const& effects,
                    effect_hull_options const& options)
        : base_(&base),
          effects_(&effects),
          options_(&options),
          limit_(options.seconds, options.keep_going) {}

    [[nodiscard]] box operator()() {
        auto const whole = affected(*base_, *effects_);
        auto const& model = whole.model;
        if (model.has_delays()) {
            if (model.channel_delays.empty() && model.input_delays.size() == 1) {
                return over_delays(whole, model.input_delays[0]);
            }
            return whole.prior;
        }
        return over_lags(whole);
    }

private:
    // Shares of the boxes and of the time that is left.
    static constexpr double of_late_slice = 1.0 / 32;
    static constexpr double of_quick_slice = 1.0 / 8;

    /// What a problem leaves of its prior; nothing when it explains nothing. Without a fit, which
    /// excludes nothing.
    /// @param share  of the boxes, and of the time that is left
    [[nodiscard]] std::optional<box> hull_of(identification_problem const& problem, double share) {
        if (problem.prior.size() == 0) return problem.prior;
        auto const map = reduction::find(problem, dependence_of(problem));
        auto const& posed = map ? map->problem() : problem;
        data_test test(posed, limited(options_->test, limit_));
        inversion_options search{
            .accuracy_of_hull = true, .hull_gain = 0.02, .keep_outside = false};
        search.seconds = share * limit_.seconds();
        search.boxes = static_cast<std::size_t>(share * static_cast<double>(options_->boxes));
        search.keep_going = limit_;
        auto const paving = invert(test, posed.prior, search).paving;
        if (!paving.has_outer()) return std::nullopt;
        auto const left = paving.outer_hull();
        return map ? map->backward(problem.prior, left) : left;
    }

    /// A box of all parameters from one without parameter `j`, and the range of that.
    [[nodiscard]] static box joined(box const& others, std::size_t j, interval const& range) {
        std::vector<interval> sides(others.begin(), others.end());
        sides.insert(sides.begin() + static_cast<std::ptrdiff_t>(j), range);
        return box(std::move(sides));
    }
    static void add(box& hulls, box const& more) {
        hulls = hulls.size() == 0 ? more : hull(hulls, more);
    }
    [[nodiscard]] static std::size_t index_of_parameter(identification_problem const& problem,
                                                        std::string const& name) {
        auto const& names = problem.choice.unknown;
        return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) -
                                        names.begin());
    }
    [[nodiscard]] static box nothing_of(box const& whole) {
        return box(std::vector<interval>(whole.size(), interval_traits<interval>::empty()));
    }

    /// Halves of the prior, the widest first, until they are excluded or narrow.
    [[nodiscard]] box over_delays(identification_problem const& whole, time_delay const& delay) {
        auto const& name = whole.model.about.constants[delay.constant].name;
        auto const j = index_of_parameter(whole, name);
        if (j == whole.prior.size()) return whole.prior; // a known delay
        for (auto const& e : whole.experiments) {
            if (!std::holds_alternative<sampled_signal>(e.inputs[delay.index])) return whole.prior;
        }
        struct slice {
            interval range;
            box others; ///< contains what the slice leaves
        };
        auto middle = mid(whole.prior);
        box const rest = resolve_delays(whole, middle).problem.prior;
        std::vector<slice> waiting;   // the widest first: in order of coming
        constexpr int begin_with = 8; // wider ones are rarely excluded
        auto const at = [&](int k) {
            double const way = static_cast<double>(k) / begin_with;
            auto const& all = whole.prior[j];
            return k == 0            ? all.lower()
                   : k == begin_with ? all.upper()
                                     : all.lower() + way * (all.upper() - all.lower());
        };
        for (int k = 0; k < begin_with; ++k) waiting.push_back({interval(at(k), at(k + 1)), rest});
        double const narrow = options_->accuracy * width(whole.prior[j]);
        box hulls;
        for (std::size_t next = 0; next < waiting.size(); ++next) {
            auto const now = waiting[next];
            if (!limit_()) {
                add(hulls, joined(now.others, j, now.range));
                continue;
            }
            middle[j] = mid(now.range);
            auto problem = resolve_delays(whole, middle).problem;
            problem.prior = now.others;
            for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
                auto const& as_recorded = whole.experiments[s];
                auto& e = problem.experiments[s];
                e.inputs[delay.index] =
                    delayed_within(std::get<sampled_signal>(as_recorded.inputs[delay.index]),
                                   e.begin, end_of(e), now.range);
            }
            start_added_states(problem);
            auto const left = hull_of(problem, of_late_slice);
            if (!left) continue;
            double const half = mid(now.range);
            bool const splits = now.range.lower() < half && half < now.range.upper();
            if (!(width(now.range) > narrow) || !splits) {
                add(hulls, joined(*left, j, now.range));
                continue;
            }
            using traits = interval_traits<interval>;
            waiting.push_back({traits::bounds(now.range.lower(), half), *left});
            waiting.push_back({traits::bounds(half, now.range.upper()), *left});
        }
        return hulls.size() == 0 ? nothing_of(whole.prior) : hulls;
    }
    [[nodiscard]] static double end_of(experiment const& e) {
        double end = e.begin;
        for (auto const& m : e.measurements) end = std::max(end, m.time);
        return end;
    }

    /// Where the time constant of a lag may be 0, short ones are excluded as inputs with errors, if
    /// possible: the lag's equation is for the others.
    [[nodiscard]] box over_lags(identification_problem whole) {
        box hulls;
        for (std::size_t k = 0; k < effects_->size(); ++k) {
            auto const& e = (*effects_)[k];
            if (!e.lags || !acts_first(k)) continue;
            auto const j = index_of_parameter(whole, e.name + "." + e.parameters[0].name);
            auto const prior = whole.prior[j];
            if (prior.lower() != 0) continue; // below 0 a lag is none
            for (double const share : {1.0 / 16, 1.0 / 64, 1.0 / 256}) {
                double const longest = share * prior.upper();
                auto const quick = without_lag(k, longest);
                if (!quick || !limit_()) break;
                auto const left = hull_of(*quick, of_quick_slice);
                if (left && share > 1.0 / 256) continue; // shorter ones may be excluded
                if (left) add(hulls, joined(*left, j, interval(prior.lower(), longest)));
                whole.prior[j] = interval(longest, prior.upper());
                break;
            }
        }
        if (auto const left = hull_of(whole, 1)) add(hulls, *left);
        return hulls.size() == 0 ? nothing_of(whole.prior) : hulls;
    }
    /// Whether what the lag sees is the recorded input.
    [[nodiscard]] bool acts_first(std::size_t k) const {
        auto const& own = (*effects_)[k];
        for (std::size_t i = 0; i < effects_->size(); ++i) {
            auto const& other = (*effects_)[i];
            if (i != k && other.on_inputs && other.order <= own.order) return false;
        }
        return true;
    }
    /// The problem for all time constants up to the longest; nothing where the input is a formula.
    [[nodiscard]] std::optional<identification_problem> without_lag(std::size_t k,
                                                                    double longest) const {
        auto const& lag = *(*effects_)[k].lags;
        auto others = *effects_;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
        auto late = *base_;
        auto const input = index_of(late.model.about.inputs, lag.input, "input");
        for (auto& e : late.experiments) {
            auto const* const recorded = std::get_if<sampled_signal>(&e.inputs[input]);
            if (recorded == nullptr) return std::nullopt;
            e.inputs[input] = lagged_within(*recorded, e.begin, end_of(e), longest, lag.rests);
        }
        return affected(late, others);
    }

    identification_problem const* base_;
    std::vector<effect> const* effects_;
    effect_hull_options const* options_;
    work_limit limit_;
};

} // namespace diagnosis_detail

SIVID_DECL box effect_hulls(identification_problem const& base, std::vector<effect> const& effects,
                            effect_hull_options const& options) {
    return diagnosis_detail::hulls_by_slices(base, effects, options)();
}

} // namespace sivid

#endif
