// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_IMPL_DIAGNOSIS_RUN_IPP
#define SIVID_DIAGNOSIS_IMPL_DIAGNOSIS_RUN_IPP

#include <sivid/diagnosis/diagnosis_run.hpp>

#include <sivid/compiled.hpp>
#include <sivid/diagnosis/hold_out/detail/holdout_judgement.hpp>
#include <sivid/diagnosis/holdout.hpp>
#include <sivid/model/disturbance.hpp>
#include <sivid/model/unit.hpp>
#include <sivid/paving/least_disturbance.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>

namespace sivid {

namespace diagnosis_detail {

/// Whether the answer is a cause that can be posed in the hold-out experiments. Whether effects of
/// some scenarios act there nobody knows, and perhaps not how often their readings had wrapped.
/// Without effects the answer is the model itself, no cause.
inline bool holdout_tells_answer(diagnosis_run const& run, holdout const& data) {
    if (run.answer == 0 || run.result.causes.empty()) return false;
    auto const& answer = run.candidates[run.answer];
    auto const partial = [](effect const& e) { return !e.only_in.empty(); };
    if (std::ranges::any_of(holdout::effects_of(answer, run.catalogue), partial)) return false;
    try {
        (void)data.judged_by(answer, run.base, run.catalogue);
        return true;
    } catch (std::invalid_argument const&) {
        return false;
    }
}

/// What the model and the answer say of the hold-out experiments, side by side.
inline holdout_figures figures_of(holdout_judgement const& before, holdout_judgement const& after,
                                  model_description const& about) {
    holdout_figures figures;
    figures.inflation_before = before.at_witness;
    figures.inflation_after = after.at_witness;
    figures.over_fits_before = before.over_fits;
    figures.over_fits_after = after.over_fits;
    for (auto const& c : about.channels) figures.channels.push_back(c.name);
    figures.rmse_before = before.rmse;
    figures.rmse_after = after.rmse;
    figures.covered_before = before.covered;
    figures.covered_after = after.covered;
    figures.width_before = before.width;
    figures.width_after = after.width;
    return figures;
}

} // namespace diagnosis_detail

SIVID_DECL void judge_by_holdout(diagnosis_run& run, holdout const& data, double seconds,
                                 feasibility_test_options const& test, std::size_t boxes) {
    if (data.empty() || run.candidates.empty()) return;
    auto const posed = data.judged_by(run.candidates.front(), run.base, run.catalogue);
    posed.require_valid_campaign();
    if (auto const words = bridging_words(posed.experiments); !words.empty())
        run.result.assumptions.push_back("of the held-out data" + words);
    stopwatch const clock;
    bool const answered = diagnosis_detail::holdout_tells_answer(run, data);
    bool const one_by_one = test.workers.threads <= 1;
    auto const judge = [&](screened const& candidate, verified_inflation const& bound,
                           explained_hull const& explaining, double share) {
        auto const judged = data.judged_by(candidate, run.base, run.catalogue);
        std::optional<fitted_set> over;
        if (explaining.parameters.size() == judged.prior.size())
            over = data.judged_over(candidate, run.base, run.catalogue, explaining);
        inflation_options search;
        // What the answer leaves open is worth more than what the model without it does.
        bool const before = answered && candidate.figures.effects.empty();
        search.seconds = (before ? 0.15 : 0.8) * seconds;
        search.boxes = (before ? boxes / 8 : boxes / 2) *
                       (run.base.experiments.size() + judged.experiments.size() + 1);
        search.test = limited(test, work_limit(share * seconds, test.keep_going));
        return judge_by_holdout(candidate, bound, explaining, judged, over, search);
    };
    test.workers(answered ? 2 : 1, [&](std::size_t k) {
        if (k == 0) {
            double const share = answered && one_by_one ? 0.2 : 1;
            run.holdout_before = judge(run.candidates.front(), run.base_bound, {}, share);
        } else {
            run.holdout_after =
                judge(run.candidates[run.answer], run.answer_bound, run.answer_hull, 1);
        }
    });
    run.result.seconds += clock.spent();
    if (!answered) return;
    auto figures =
        diagnosis_detail::figures_of(*run.holdout_before, *run.holdout_after, run.base.model.about);
    run.result.shrink_holdout = shrink(figures.inflation_before, figures.inflation_after);
    if (run.answer_bound.range.upper() <= 1 && figures.over_fits_after) {
        run.result.shrink_over_fits = shrink(figures.inflation_before, *figures.over_fits_after);
    }
    run.result.causes.front().holdout = std::move(figures);
}

SIVID_DECL needed_disturbance disturbance_needed(identification_problem const& base,
                                                 std::size_t equation, double seconds,
                                                 feasibility_test_options const& test) {
    auto const& about = base.model.about;
    auto const& state = about.states[equation];
    disturbance_set const set{{{equation, 1}}, {}};
    least_disturbance_options options;
    options.seconds = seconds;
    options.test = test;
    options.keep_going = test.keep_going;
    auto const found = least_disturbance(base, set, options);
    needed_disturbance result{state.equation_name(),
                              rate_unit(state.unit, about.time_unit),
                              found.size,
                              {},
                              {},
                              {},
                              seconds};
    auto const window = [&](disturbed_stretch const& s) {
        return time_window{base.experiments[s.experiment].name, s.from, s.to};
    };
    for (auto const& s : found.needed) result.reached.push_back(window(s));
    auto strong = strong_stretches(set, found);
    strong.resize(std::min<std::size_t>(strong.size(), 3));
    for (auto const& s : strong) result.strongest.push_back(window(s));
    return result;
}

SIVID_DECL void bound_disturbances(diagnosis_run& run, double seconds,
                                   feasibility_test_options const& test) {
    auto& d = run.result;
    auto const& base = run.base;
    auto const lenient = [](experiment const& e) { return e.outliers > 0; };
    if (d.answer != answer_kind::unexplained || base.model.has_memory() ||
        std::ranges::any_of(base.experiments, lenient))
        return;
    auto const place_of = [&](std::size_t i) {
        return std::ranges::find_if(d.where, [&](suspected_place const& p) {
            return p.kind == "equation" && p.name == base.model.about.states[i].equation_name();
        });
    };
    auto equations = driven_equations(base.model);
    std::ranges::stable_sort(equations, {},
                             [&](std::size_t i) { return place_of(i) - d.where.begin(); });
    work_limit const limit(seconds, test.keep_going);
    std::vector<needed_disturbance> all;
    for (std::size_t k = 0; k < equations.size() && limit(); ++k) {
        double const own = limit.left() / static_cast<double>(equations.size() - k);
        auto next = disturbance_needed(base, equations[k], own, limited(test, limit));
        if (auto const p = place_of(equations[k]); p != d.where.end()) next.regime = p->regime;
        bool const says = next.size.lower() > 0 || std::isfinite(next.size.upper());
        if (says) all.push_back(std::move(next));
    }
    d.by_clock = d.by_clock || limit.late();
    if (all.empty()) return;
    if (!d.remainder) d.remainder = unexplained_remainder{{}, d.inflation, d.where};
    d.remainder->disturbances = std::move(all);
}

} // namespace sivid

#endif
