// SPDX-License-Identifier: MIT
#include "axis_effects.hpp"
#include "command.hpp"
#include "console/diagnosis_output.hpp"
#include "console/program.hpp"
#include "console/sensitivity.hpp"
#include "console/thorough_diagnosis.hpp"
#include "windows.hpp"

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/report/page.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <optional>

namespace servo {

namespace {

namespace report = sivid::report;

using console::in_millimetres;
using console::text_of;

/// A length in m, in mm, three digits.
std::string millimetres(double metres) { return text_of("%.3g", 1e3 * metres); }

std::vector<std::string> assumptions_of(diagnose_command const& c, std::size_t windows) {
    return {"force linear between samples",
            "position bound " + in_millimetres(c.bounds.model_error) +
                " stands for the model error over a window of " + text_of("%g", c.windows.length) +
                " s (the encoder is good to 2 um): every " + std::to_string(c.every_sample) +
                "th sample counts",
            std::to_string(windows) + " windows, each started within " +
                in_millimetres(c.bounds.start_position) + " of the measured position and within " +
                in_millimetres(c.bounds.start_velocity) +
                "/s of the velocity from a zero-phase low-pass filter (cubic over " +
                std::to_string(2 * c.windows.filter_half + 1) +
                " samples), the same for every model",
            "dry friction is smooth below 0.001 m/s"};
}

window_bounds bounds_of(diagnose_command const& c) {
    return {c.bounds.model_error, c.bounds.start_position, c.bounds.start_velocity, c.every_sample};
}

/// What the benchmark's own model has, by what it means here.
struct literature_value {
    char const* name;
    char const* unit;
    double value;
};
constexpr std::array<literature_value, 4> literature_values{{{"M", "kg", 95.1089},
                                                             {"F_v", "N s/m", 203.5034},
                                                             {"F_c", "N", 20.3935},
                                                             {"offset", "N", -3.1648}}};

/// A model of the chain from the linear one to the answer.
struct chain_link {
    std::vector<std::string> effects;
    std::vector<double> parameters;             ///< least squares over the windows used
    std::vector<double> estimation, validation; ///< RMS by window length [m]
};

/// Compares models over windows of several lengths, all from the same starts: the measured position
/// and the filter's velocity, nothing fitted but the parameters at one second.
class window_study {
public:
    static constexpr std::array<double, 4> lengths{0.2, 0.5, 1, 2};

    window_study(diagnose_command const& c, std::filesystem::path const& estimation,
                 std::optional<std::filesystem::path> const& validation)
        : used_(problems(c, estimation)), fitted_(problem_of(c, estimation, c.windows.length)) {
        if (validation) kept_ = problems(c, *validation);
    }

    [[nodiscard]] chain_link operator()(std::vector<sivid::effect> const& effects,
                                        std::vector<double> const& from) const {
        chain_link link;
        for (auto const& e : effects) link.effects.push_back(e.name);
        link.parameters =
            sivid::fit(sivid::affected(fitted_, effects), sivid::fit_norm::squares, {from})
                .parameters;
        for (auto const& p : used_) link.estimation.push_back(misses(p, effects, link.parameters));
        for (auto const& p : kept_) link.validation.push_back(misses(p, effects, link.parameters));
        return link;
    }

private:
    static sivid::identification_problem
    problem_of(diagnose_command const& c, std::filesystem::path const& file, double length) {
        auto choice = c.windows;
        choice.length = length;
        auto const record = read_recording(file);
        auto problem = linear_problem(window_experiments(record, cut_windows(record, choice, file),
                                                         choice.filter_half, bounds_of(c)));
        for (auto& e : problem.experiments) e.initial = sivid::point_box(sivid::mid(e.initial));
        return problem;
    }
    static std::vector<sivid::identification_problem> problems(diagnose_command const& c,
                                                               std::filesystem::path const& file) {
        std::vector<sivid::identification_problem> all;
        for (double const length : lengths) all.push_back(problem_of(c, file, length));
        return all;
    }
    static double misses(sivid::identification_problem const& p,
                         std::vector<sivid::effect> const& effects,
                         std::vector<double> const& parameters) {
        auto const problem = sivid::affected(p, effects);
        std::vector<std::vector<double>> starts;
        for (auto const& e : problem.experiments) starts.push_back(sivid::mid(e.initial));
        return console::root_mean_square(problem,
                                         sivid::approximate_fitter(problem).at(parameters, starts));
    }

    std::vector<sivid::identification_problem> used_, kept_;
    sivid::identification_problem fitted_;
};

/// The chain that friction, offset and direction make, as far as it was tried.
std::vector<chain_link> chain_of(sivid::diagnosis_run const& run, window_study const& study) {
    std::vector<std::vector<std::string>> steps{{},
                                                {"dry_friction"},
                                                {"offset"},
                                                {"dry_friction", "offset"},
                                                {"dry_friction", "directional_friction"},
                                                {"dry_friction", "offset", "directional_friction"}};
    if (std::find_if(steps.begin(), steps.end(), [&](auto const& s) {
            return std::is_permutation(s.begin(), s.end(), run.result.effects.begin(),
                                       run.result.effects.end());
        }) == steps.end()) {
        steps.push_back(run.result.effects);
    }
    std::vector<chain_link> chain;
    for (auto const& names : steps) {
        auto const* known = console::candidate_of(run, names);
        if (known == nullptr) continue;
        chain.push_back(study(console::named_effects(run.catalogue, names), known->fit.parameters));
    }
    return chain;
}

chain_link const* find(std::vector<chain_link> const& chain,
                       std::vector<std::string> const& effects) {
    for (auto const& link : chain) {
        if (std::is_permutation(link.effects.begin(), link.effects.end(), effects.begin(),
                                effects.end()))
            return &link;
    }
    return nullptr;
}

void add_chain(report::page& page, sivid::diagnosis_run const& run,
               std::vector<chain_link> const& chain) {
    auto const* base = find(chain, {});
    auto const* dry = find(chain, {"dry_friction"});
    auto const* both = find(chain, {"dry_friction", "offset"});
    auto const* all = find(chain, {"dry_friction", "offset", "directional_friction"});
    page.section("One effect after the other");
    if (base != nullptr && dry != nullptr && both != nullptr) {
        auto const left = [&](chain_link const& link, std::size_t length) {
            return text_of("%.0f", 100 * link.estimation[length] / base->estimation[length]) + " %";
        };
        std::string text = "Dry friction alone leaves " + left(*dry, 0) +
                           " of the misfit over 0.2 s, but " + left(*dry, 2) + " over 1 s and " +
                           left(*dry, 3) +
                           " over 2 s: an offset that is missing grows with the square of time and "
                           "outweighs it in long windows. Dry friction and offset together leave " +
                           left(*both, 2) + " over 1 s and " + left(*both, 3) + " over 2 s";
        if (all != nullptr) {
            text += "; friction that differs between the directions takes that down to " +
                    left(*all, 2) + " and " + left(*all, 3);
        }
        auto const* pair = find(chain, {"dry_friction", "directional_friction"});
        if (all != nullptr && pair != nullptr && pair->estimation[2] < 1.25 * all->estimation[2]) {
            text += ". Once friction may differ between the directions, the offset hardly matters: "
                    "over these motions the two are nearly the same force";
        }
        page.prose(text + ". These are estimates: least squares over all windows.");
    }
    report::table t{.columns = {{"model", report::column_kind::symbol}},
                    .rows = {},
                    .caption =
                        "Root mean square of the position's misfit [mm], estimation record "
                        "/ validation record (held out), windows of 0.2 to 2 s "
                        "from the same starts. Fitted to the windows of the estimation "
                        "record alone, by least squares. Inflation: proved range of the factor by "
                        "which the bound would have to grow, starts within theirs."};
    for (double const length : window_study::lengths) {
        t.columns.push_back({text_of("%g s", length), report::column_kind::number});
    }
    t.columns.push_back({"inflation", report::column_kind::text});
    for (auto const& link : chain) {
        std::vector<std::string> row{console::model_words(link.effects)};
        for (std::size_t i = 0; i < link.estimation.size(); ++i) {
            row.push_back(millimetres(link.estimation[i]) +
                          (i < link.validation.size() ? " / " + millimetres(link.validation[i])
                                                      : std::string{}));
        }
        row.push_back(console::inflation_words(run, link.effects));
        t.rows.push_back(std::move(row));
    }
    page.add(t);
}

/// The same fits with starts that are better or worse known.
void add_starts(report::page& page, sivid::diagnosis_run const& run,
                std::vector<chain_link> const& chain) {
    report::table t{.columns = {{"model", report::column_kind::symbol}},
                    .rows = {},
                    .caption = "The bound [mm] that the best fit needs, by the bound of a start's "
                               "velocity (estimates)."};
    constexpr std::array<double, 4> bounds{0.0005, 0.001, 0.002, 0.004};
    for (double const v : bounds) {
        t.columns.push_back({text_of("%g mm/s", 1e3 * v), report::column_kind::number});
    }
    for (auto const& link : chain) {
        auto problem =
            sivid::affected(run.base, console::named_effects(run.catalogue, link.effects));
        std::vector<std::string> row{console::model_words(link.effects)};
        for (double const v : bounds) {
            for (auto& e : problem.experiments) {
                double const centre = sivid::mid(e.initial[1]);
                e.initial[1] = sivid::interval(centre - v, centre + v);
            }
            auto const fit = sivid::approximate_fitter(problem)({link.parameters});
            double const bound = sivid::rad(problem.experiments.front().measurements[0].bound);
            row.push_back(millimetres(bound * fit.inflation));
        }
        t.rows.push_back(std::move(row));
    }
    page.add(t);
}

/// Beside the literature, in newtons.
void add_values(report::page& page, std::vector<chain_link> const& chain) {
    page.section("Beside the literature");
    report::table t{.columns = {{"model", report::column_kind::symbol}},
                    .rows = {},
                    .caption = "Least squares over the windows; an effect's parameter times M is "
                               "its force. The literature's model is the one with dry friction and "
                               "offset: A. Janot, M. Gautier, M. Brunot, Data Set and Reference "
                               "Models of EMPS, 2019."};
    for (auto const& v : literature_values) {
        t.columns.push_back(
            {std::string{v.name} + " [" + v.unit + "]", report::column_kind::number});
    }
    for (auto const& link : chain) {
        if (link.parameters.size() < 2) continue;
        double const mass = link.parameters[0];
        std::vector<std::string> row{console::model_words(link.effects), text_of("%.4g", mass),
                                     text_of("%.4g", link.parameters[1])};
        for (auto const* name : {"dry_friction", "offset"}) {
            auto const at = std::find(link.effects.begin(), link.effects.end(), name);
            bool const has = at != link.effects.end();
            auto const k = 2 + static_cast<std::size_t>(at - link.effects.begin());
            // The literature's offset is a force that is subtracted.
            double const sign = std::string{name} == "offset" ? -1 : 1;
            row.push_back(has ? text_of("%.3g", sign * mass * link.parameters[k]) : "-");
        }
        t.rows.push_back(std::move(row));
    }
    std::vector<std::string> row{"literature"};
    for (auto const& v : literature_values) row.push_back(text_of("%.6g", v.value));
    t.rows.push_back(std::move(row));
    page.add(t);
}

/// One scenario for all windows of a record: they follow one another in time.
void merge_windows(report::diagnosis_plot_data& data) {
    std::vector<report::compared_scenario> merged;
    auto const append = [](auto& to, auto const& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    for (auto const& s : data.scenarios) {
        if (merged.empty() || merged.back().holdout != s.holdout) {
            merged.push_back({s.holdout ? "validation record, window by window"
                                        : "estimation record, window by window",
                              s.holdout, s.channels});
            continue;
        }
        for (std::size_t i = 0; i < s.channels.size(); ++i) {
            auto& to = merged.back().channels[i];
            auto const& from = s.channels[i];
            append(to.measured, from.measured);
            append(to.before, from.before);
            append(to.after, from.after);
            append(to.misfit_before, from.misfit_before);
            append(to.misfit_after, from.misfit_after);
        }
    }
    data.scenarios = std::move(merged);
    for (auto* rates : {&data.missing_rates, &data.remaining_rates}) {
        std::vector<report::missing_rate> joined;
        for (auto const& r : *rates) {
            if (joined.empty() || joined.back().equation != r.equation) {
                joined.push_back(r);
                joined.back().scenario = "estimation record, window by window";
                continue;
            }
            auto& to = joined.back().rate;
            append(to.after, r.rate.after);
            append(to.band, r.rate.band);
            append(to.windows, r.rate.windows);
        }
        *rates = std::move(joined);
    }
}

} // namespace

int run(diagnose_command const& c) {
    console::progress_line progress(c.quiet); // its clock is that of the budget
    auto const left = [&] { return std::max(0.0, c.budget - progress.elapsed()); };
    auto const file = c.folder / c.file;
    auto const record = read_recording(file);
    auto const windows = cut_windows(record, c.windows, file);
    auto const problem =
        linear_problem(window_experiments(record, windows, c.windows.filter_half, bounds_of(c)));
    std::optional<std::filesystem::path> kept_file = c.folder / c.holdout_file;
    sivid::holdout kept;
    if (std::filesystem::exists(*kept_file)) {
        auto const other = read_recording(*kept_file);
        kept = sivid::holdout(window_experiments(other, cut_windows(other, c.windows, *kept_file),
                                                 c.windows.filter_half, bounds_of(c)));
    } else {
        kept_file.reset();
    }
    console::prepare_folder(c.out);

    progress.note("diagnosing M v' = F - F_v v on " + std::to_string(windows.size()) +
                  " windows; Ctrl-C stops early");
    // The rest is for the hold-out record and the tables.
    auto options = console::thorough_diagnosis(0.8 * left());
    console::watch(options, progress);
    auto run = sivid::diagnose(problem, axis_catalogue(), options);
    progress.finish();
    for (auto const& a : assumptions_of(c, windows.size())) run.result.assumptions.push_back(a);
    auto const id = "EMPS servo axis, " + c.file;
    // Whatever happens to what follows, which only adds to it.
    console::write_diagnosis(run.result, id, {}, console::page_options(run, id, c.command_line),
                             c.out, [](report::page&) {});
    if (!console::interrupted()) {
        progress.note("judging by the validation record");
        sivid::judge_by_holdout(run, kept, std::min(left(), 0.1 * c.budget), options.test, 120);
    }
    std::vector<chain_link> chain;
    if (run.candidates.size() > 1 && left() > 0 && !console::interrupted()) {
        chain = chain_of(run, window_study(c, file, kept_file));
    }
    std::signal(SIGINT, SIG_DFL);
    auto plots = console::plot_data(run, kept);
    merge_windows(plots);
    console::stated_bound const bound{1e3 * *nearest(c.bounds.model_error), "mm"};
    auto const meaning = "The position bound of " + in_millimetres(c.bounds.model_error) +
                         " is a choice: it says how much model error over " +
                         text_of("%g", c.windows.length) +
                         " s is accepted, for windows and starts as stated.";
    console::write_diagnosis(run.result, id, plots, console::page_options(run, id, c.command_line),
                             c.out, [&](report::page& page) {
                                 if (run.candidates.empty()) return;
                                 if (!chain.empty()) add_chain(page, run, chain);
                                 console::add_sensitivity(page, run, bound, meaning);
                                 if (chain.empty()) return;
                                 add_starts(page, run, chain);
                                 add_values(page, chain);
                             });
    console::print_summary(run.result, id, c.out);
    for (auto const& link : chain) {
        std::cout << "  " << console::model_words(link.effects) << ": RMS over 1 s "
                  << millimetres(link.estimation[2]) << " mm";
        if (link.validation.size() > 2) {
            std::cout << ", validation " << millimetres(link.validation[2]) << " mm";
        }
        std::cout << "\n";
    }
    return console::exit_code_of(run.result);
}

} // namespace servo
