// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "console/diagnosis_output.hpp"
#include "console/program.hpp"
#include "console/sensitivity.hpp"
#include "console/threads.hpp"
#include "effects.hpp"

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/diagnosis/verification.hpp>
#include <sivid/paving/inflation.hpp>
#include <sivid/paving/inflation/observer_refutation.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/page.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <optional>

namespace tanks {

namespace {

namespace report = sivid::report;

using console::text_of;

std::vector<std::string> assumptions_of(diagnose_command const& c) {
    return {"pump voltage held between samples",
            "level within " + c.bound.text() +
                " V of every sample (sensor noise stays below 0.17 V)",
            "upper level, not measured, starts between 0 and " + c.upper_start.text() +
                " V, the lower one within " + c.lower_start.text() + " V of its first sample",
            "outflow k x/(x^2 + s^2)^(1/4) with s = 0.01 V, in place of k sqrt(x)"};
}

/// A model with its least squares, and where its misfit sits.
struct chain_link {
    std::vector<std::string> effects;
    double estimation = 0, validation = std::nan("");
    double near = 0, rest = 0; ///< of the estimation record, near the sensor's upper end or not [V]
};

/// Least squares from where the candidate was fitted and from the centre, the better one.
sivid::approximate_fit squares_of(sivid::identification_problem const& problem,
                                  std::vector<double> const& from) {
    sivid::approximate_fitter fit(problem);
    auto best = fit({from}, sivid::fit_norm::squares);
    auto other = sivid::fit(problem, sivid::fit_norm::squares);
    return other.squares < best.squares ? other : best;
}

/// RMS within -160 to 240 s of levels above 9.5 V, and elsewhere.
std::pair<double, double> near_and_rest(sivid::experiment const& e,
                                        std::vector<double> const& residuals) {
    auto const data = sivid::sorted(e.measurements);
    double sums[2] = {0, 0}, counts[2] = {0, 0};
    for (std::size_t k = 0; k < data.size() && k < residuals.size(); ++k) {
        bool const near = std::any_of(data.begin(), data.end(), [&](auto const& m) {
            return sivid::mid(m.bound) > 9.5 && data[k].time > m.time - 160 &&
                   data[k].time < m.time + 240;
        });
        double const off = residuals[k] * sivid::rad(data[k].bound);
        sums[near ? 0 : 1] += off * off;
        counts[near ? 0 : 1] += 1;
    }
    return {std::sqrt(sums[0] / counts[0]), std::sqrt(sums[1] / counts[1])};
}

std::vector<chain_link> chain_of(sivid::diagnosis_run const& run, sivid::holdout const& kept) {
    std::vector<std::vector<std::string>> steps{
        {}, {"outlet_offset"}, {"overflow"}, {"overflow", "outlet_offset"}};
    if (run.result.remainder) steps.push_back(run.result.remainder->effects);
    std::vector<chain_link> chain;
    for (auto const& names : steps) {
        auto const* known = console::candidate_of(run, names);
        bool const repeated = std::any_of(chain.begin(), chain.end(), [&](auto const& link) {
            return std::is_permutation(link.effects.begin(), link.effects.end(), names.begin(),
                                       names.end());
        });
        if (known == nullptr || repeated) continue;
        auto const fit = squares_of(known->problem, known->fit.parameters);
        if (fit.residuals.empty()) continue;
        chain_link link{names, console::root_mean_square(known->problem, fit)};
        std::tie(link.near, link.rest) =
            near_and_rest(known->problem.experiments[0], fit.residuals[0]);
        if (!kept.empty()) {
            auto judged = kept.judged_by(*known, run.base, run.catalogue);
            for (std::size_t j = 0; j < fit.parameters.size(); ++j) {
                judged.prior[j] = sivid::interval(fit.parameters[j]);
            }
            link.validation = console::root_mean_square(
                judged, sivid::fit(judged, sivid::fit_norm::squares, {fit.parameters}));
        }
        chain.push_back(std::move(link));
    }
    return chain;
}

void add_chain(report::page& page, sivid::diagnosis_run const& run,
               std::vector<chain_link> const& chain) {
    page.section("One effect after the other");
    report::table t{.columns = {{"model", report::column_kind::symbol},
                                {"estimation [V]", report::column_kind::number},
                                {"validation [V]", report::column_kind::number},
                                {"near full [V]", report::column_kind::number},
                                {"elsewhere [V]", report::column_kind::number},
                                {"inflation", report::column_kind::text}},
                    .rows = {},
                    .caption =
                        "Root mean square of the level's misfit over the whole record, by "
                        "least squares (estimates). The validation record is held out but for "
                        "its own starts. Near full: from 160 s before to 240 s after a "
                        "level above 9.5 V, estimation record. Inflation: proved range of "
                        "the factor by which the bound would have to grow."};
    for (auto const& link : chain) {
        t.rows.push_back({console::model_words(link.effects), text_of("%.3f", link.estimation),
                          std::isfinite(link.validation) ? text_of("%.3f", link.validation) : "-",
                          text_of("%.3f", link.near), text_of("%.3f", link.rest),
                          console::inflation_words(run, link.effects)});
    }
    page.add(t);
}

/// Until when the model as it is explains the record from its begin.
struct validity {
    double holds_until = 0;           ///< proved: a witness explains everything before
    double fitted_until = 0;          ///< the same, by fits
    std::optional<double> refuted_by; ///< proved: nothing explains everything before
};

sivid::identification_problem until(sivid::identification_problem const& problem, double time) {
    return sivid::restricted_to(
        problem, [time](std::size_t, sivid::measurement const& m) { return m.time <= time; });
}

validity validity_of(sivid::identification_problem const& problem, double seconds) {
    sivid::observer_effort each;
    each.boxes = 4000;
    each.seconds = seconds / 5;
    each.only_verdict = true;
    validity result;
    auto const& e = problem.experiments.front();
    std::vector<double> times;
    for (auto const& m : e.measurements) times.push_back(m.time);
    std::size_t low = 0, high = times.size() - 1; // explained until low; not until high
    while (high - low > 1) {
        auto const middle = (low + high) / 2;
        (sivid::approximate_fitter(until(problem, times[middle]))().inflation <= 0.99 ? low
                                                                                      : high) =
            middle;
    }
    result.fitted_until = times[low];
    for (std::size_t back = 0; back < 3; ++back) {
        auto const part = until(problem, times[low - std::min(low, 5 * back)]);
        if (sivid::verify_at(part, sivid::approximate_fitter(part)()).range.upper() > 1) continue;
        result.holds_until = part.experiments[0].measurements.back().time;
        break;
    }
    for (double const longer : {1.05, 1.15, 1.3, 1.6, 2.0}) {
        auto const part = until(problem, e.begin + longer * (times[low] - e.begin));
        if (!(sivid::inflation_refuted_by_observers(part, 2, each).lower > 1)) continue;
        result.refuted_by = part.experiments[0].measurements.back().time;
        break;
    }
    return result;
}

std::string validity_words(validity const& v) {
    std::string text =
        "From the start of the record the model as it is explains all samples until " +
        text_of("%g", v.fitted_until) + " s in the best fits found (estimate)";
    if (v.holds_until > 0) text += "; until " + report::exact_text(v.holds_until) + " s (proved)";
    text += v.refuted_by ? "; no parameters explain all samples until " +
                               report::exact_text(*v.refuted_by) + " s (proved)"
                         : std::string{};
    return text + ".";
}

} // namespace

int run(diagnose_command const& c) {
    console::progress_line progress(c.quiet); // its clock is that of the budget
    auto const left = [&] { return std::max(0.0, c.budget - progress.elapsed()); };
    auto const problem = tank_problem(read_experiment(c.folder / c.file, c));
    sivid::holdout kept;
    if (std::filesystem::exists(c.folder / c.holdout_file)) {
        kept = sivid::holdout({read_experiment(c.folder / c.holdout_file, c)});
    }
    console::prepare_folder(c.out);

    progress.note("diagnosing two tanks without rims; Ctrl-C stops early");
    sivid::diagnosis_options options;
    // The rest is for the hold-out record and the tables.
    options.seconds = 0.75 * left();
    options.test.workers = console::threads_for(0);
    // Boxes end a step; the shares of the time only do on a machine that is far too slow. With
    // starts as wide as these, observers prove something and sets of trajectories little.
    options.gap.observers = {4000, 0.15};
    options.answer = {10, 0.1};
    options.exclusion = {8000, 0.1};
    options.exclusions = {16000, 0.2};
    options.screening.most_effects = 3;
    console::watch(options, progress);
    auto run = sivid::diagnose(problem, catalogue(), options);
    progress.finish();
    for (auto const& a : assumptions_of(c)) run.result.assumptions.push_back(a);
    auto const id = "cascaded tanks, " + c.file;
    // Whatever happens to what follows, which only adds to it.
    console::write_diagnosis(run.result, id, {}, console::page_options(run, id, c.command_line),
                             c.out, [](report::page&) {});
    if (!console::interrupted()) {
        progress.note("judging by the validation record");
        sivid::judge_by_holdout(run, kept, std::min(left(), 0.08 * c.budget), options.test, 20);
    }
    std::optional<validity> valid;
    if (left() > 0 && !console::interrupted() && !run.result.interrupted &&
        run.result.gap != sivid::gap_verdict::none) {
        progress.note("finding the time until which the model holds");
        valid = validity_of(problem, std::min(left(), 0.08 * c.budget));
    }
    std::vector<chain_link> chain;
    if (run.candidates.size() > 1 && left() > 0 && !console::interrupted()) {
        chain = chain_of(run, kept);
    }
    std::signal(SIGINT, SIG_DFL);
    console::stated_bound const bound{*nearest(c.bound), "V"};
    auto const meaning = "The level's bound of " + c.bound.text() +
                         " V covers the sensor's noise, which stays below 0.17 V; what lies above "
                         "that is model error that is accepted.";
    console::write_diagnosis(run.result, id, console::plot_data(run, kept),
                             console::page_options(run, id, c.command_line), c.out,
                             [&](report::page& page) {
                                 if (valid) {
                                     page.section("How long the model holds");
                                     page.prose(validity_words(*valid));
                                 }
                                 console::add_sensitivity(page, run, bound, meaning);
                                 if (!chain.empty()) add_chain(page, run, chain);
                             });
    console::print_summary(run.result, id, c.out);
    if (valid) std::cout << "  " << validity_words(*valid) << "\n";
    for (auto const& link : chain) {
        std::cout << "  " << console::model_words(link.effects) << ": RMS "
                  << text_of("%.3f", link.estimation) << " V, validation "
                  << text_of("%.3f", link.validation) << " V\n";
    }
    return console::exit_code_of(run.result);
}

} // namespace tanks
