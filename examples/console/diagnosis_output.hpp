// SPDX-License-Identifier: MIT
// What the example programs write after a diagnosis: report.html, diagnosis.json, a summary.
#ifndef EXAMPLES_CONSOLE_DIAGNOSIS_OUTPUT_HPP
#define EXAMPLES_CONSOLE_DIAGNOSIS_OUTPUT_HPP

#include "console.hpp"
#include "program.hpp"

#include <sivid/diagnosis/diagnose.hpp>
#include <sivid/io/diagnosis_json.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/report/diagnosis_page.hpp>
#include <sivid/report/diagnosis_words.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace console {

namespace detail {

inline std::vector<sivid::report::missing_rate>
missing_rates(sivid::place_estimate const& places,
              std::vector<sivid::relation_finding> const& findings, std::string const& time_unit) {
    std::vector<sivid::report::missing_rate> result;
    for (auto const& p : places.places) {
        if (p.kind == sivid::place_kind::sensor) continue;
        for (auto const& r : p.rates) {
            sivid::report::channel_series d{.unit = p.unit, .time_unit = time_unit};
            for (std::size_t k = 0; k < r.times.size(); ++k) {
                double const v = r.values[k], off = r.deviations[k];
                d.after.push_back({r.times[k], v});
                d.band.push_back({r.times[k], r.times[k], {v - off, v + off}});
            }
            for (auto const& f : findings) {
                if (f.name != p.name || !f.place || !f.place->missing) continue;
                auto const& [window, value, unit] = *f.place->missing;
                if (window.scenario != r.scenario) continue;
                d.windows.push_back({window.from, window.to, value});
            }
            result.push_back({p.name, r.scenario, std::move(d)});
        }
    }
    return result;
}

/// A value with its unit.
inline std::string value_words(sivid::named_estimate const& e) {
    namespace report = sivid::report;
    return e.name + " = " + report::rounded_text(e.value, report::rounding::nearest) +
           (e.unit.empty() || e.unit == "1" ? "" : " " + e.unit);
}

/// The effects' parameters of a cause: at the witness where it explains the data.
inline std::vector<sivid::named_estimate> stated_parameters(sivid::cause const& c) {
    auto result = c.parameters;
    if (c.verdict != sivid::cause_verdict::explains || !c.witness) return result;
    for (auto& p : result) {
        for (auto const& w : c.witness->parameters) {
            if (w.name == p.name) p.value = w.value;
        }
    }
    return result;
}

/// All constants of the model of the answer.
inline void print_constants(sivid::diagnosis const& d) {
    if (d.constants.empty()) return;
    bool const answered =
        d.answer == sivid::answer_kind::effects || d.answer == sivid::answer_kind::none;
    std::cout << (d.constants_verified ? "  verified to explain the data:"
                  : answered           ? "  best fit (not proved):"
                                       : "  closest so far (not proved):");
    for (auto const& c : d.constants) std::cout << " " << value_words(c);
    std::cout << "\n";
}

/// Products that the data tell better than their factors.
inline void print_combinations(sivid::diagnosis const& d) {
    for (auto const& c : d.combinations) {
        auto const& p = c.about;
        std::cout << "  told together: " << value_words(p) << ", within "
                  << sivid::report::outward_text(*p.hull) << " (proved)\n";
    }
}

/// When the effect of the answer begins and ends in each scenario in which it does so midway.
inline void print_times(sivid::diagnosis const& d) {
    if (d.answer != sivid::answer_kind::effects || d.causes.empty()) return;
    auto const print = [](char const* what, std::vector<sivid::named_estimate> const& times) {
        for (auto const& o : times) {
            bool const known = o.hull && o.prior && width(*o.hull) < width(*o.prior);
            std::cout << what << value_words(o)
                      << (known ? ", within " + sivid::report::outward_text(*o.hull) + " " +
                                      o.unit + " (proved)"
                                : std::string{"; no bound of it is proved"})
                      << "\n";
        }
    };
    print("  it begins in ", d.causes.front().onsets);
    print("  it ends in ", d.causes.front().ends);
}

inline void print_holdout(sivid::diagnosis const& d) {
    namespace report = sivid::report;
    if (d.answer != sivid::answer_kind::effects || d.causes.empty() || !d.causes.front().holdout)
        return;
    auto const& h = *d.causes.front().holdout;
    std::cout << "  inflation on the held-out data: " << report::inflation_text(h.inflation_before)
              << " without it, " << report::inflation_text(h.inflation_after) << " with it";
    if (d.shrink_holdout && std::isfinite(d.shrink_holdout->lower()))
        std::cout << ": the gap shrinks by " << report::shrink_text(*d.shrink_holdout);
    if (d.shrink_over_fits && d.shrink_over_fits->lower() > 0)
        std::cout << "; for every parameter that explains the other data, by "
                  << report::shrink_text(*d.shrink_over_fits);
    std::cout << "\n";
}

/// "open: 8 of 36 candidates tried, no pair"
inline std::string answer_words(sivid::diagnosis const& d) {
    if (d.answer == sivid::answer_kind::effects) return sivid::joined(d.effects, " + ");
    auto const tried = sivid::report::tried_text(d.tried);
    return std::string{to_string(d.answer)} + (tried.empty() ? "" : ": " + tried);
}

} // namespace detail

/// Misfits, missing rates and trajectories for the page.
inline sivid::report::diagnosis_plot_data plot_data(sivid::diagnosis_run const& run,
                                                    sivid::holdout const& kept) {
    namespace report = sivid::report;
    report::diagnosis_plot_data data;
    if (run.candidates.empty()) return data;
    auto const& base = run.candidates.front();
    auto const& answer = run.candidates[run.answer];
    bool const improved = run.answer != 0;
    data.scenarios = report::compared_scenarios(run.base, base.fit,
                                                improved ? answer.fit : sivid::approximate_fit{});
    if (run.holdout_before) {
        auto more = report::compared_scenarios(
            kept.judged_by(base, run.base, run.catalogue), run.holdout_before->run,
            run.holdout_after ? run.holdout_after->run : sivid::approximate_fit{}, true);
        data.scenarios.insert(data.scenarios.end(), more.begin(), more.end());
    }
    auto const& time_unit = run.base.model.about.time_unit;
    data.missing_rates = detail::missing_rates(run.places, run.findings, time_unit);
    data.remaining_rates = detail::missing_rates(run.remaining_places, {}, time_unit);
    return data;
}

/// Root mean square of the misfit, in the unit of the channels; not proved.
inline double root_mean_square(sivid::identification_problem const& p,
                               sivid::approximate_fit const& f) {
    double sum = 0, count = 0;
    for (std::size_t e = 0; e < f.residuals.size(); ++e) {
        auto const data = sivid::sorted(p.experiments[e].measurements);
        for (std::size_t k = 0; k < data.size(); ++k) {
            double const off = f.residuals[e][k] * sivid::rad(data[k].bound);
            sum += off * off;
            count += 1;
        }
    }
    return count > 0 ? std::sqrt(sum / count) : std::nan("");
}

/// The effects of a catalogue that have these names.
inline std::vector<sivid::effect> named_effects(std::vector<sivid::effect> const& catalogue,
                                                std::vector<std::string> const& names) {
    std::vector<sivid::effect> result;
    for (auto const& e : catalogue) {
        if (std::find(names.begin(), names.end(), e.name) != names.end()) result.push_back(e);
    }
    return result;
}

/// The candidate with exactly these effects; null when it was not tried.
inline sivid::screened const* candidate_of(sivid::diagnosis_run const& run,
                                           std::vector<std::string> const& names) {
    for (auto const& s : run.candidates) {
        std::vector<std::string> own;
        for (auto const e : s.figures.effects) own.push_back(run.catalogue[e].name);
        if (std::is_permutation(own.begin(), own.end(), names.begin(), names.end())) return &s;
    }
    return nullptr;
}

/// What is proved of a model's inflation, as a range.
inline std::string inflation_words(sivid::diagnosis_run const& run,
                                   std::vector<std::string> const& effects) {
    auto known = effects.empty() ? run.result.inflation : sivid::unknown_inflation();
    for (auto const& c : run.result.causes) {
        if (!effects.empty() &&
            std::is_permutation(c.effects.begin(), c.effects.end(), effects.begin(), effects.end()))
            known = c.inflation;
    }
    return sivid::report::outward_text(known);
}

/// "as it is" or "+ overflow + offset"
inline std::string model_words(std::vector<std::string> const& effects) {
    return effects.empty() ? "as it is" : "+ " + sivid::joined(effects, " + ");
}

/// What a program ends with: undecided where candidates were left untried, or it was ended early.
inline exit_code exit_code_of(sivid::diagnosis const& d) {
    bool const early = d.interrupted || interrupted() || d.answer == sivid::answer_kind::open;
    return early ? undecided : done;
}

inline void print_summary(sivid::diagnosis const& d, std::string const& id,
                          std::filesystem::path const& out) {
    namespace report = sivid::report;
    std::cout << id << ": gap " << to_string(d.gap) << ", inflation "
              << (report::says_something(d.inflation) ? report::inflation_text(d.inflation)
                                                      : std::string{"not bounded"})
              << "\n";
    for (auto const& words : report::view_of(d).why) std::cout << "  " << words << "\n";
    for (auto const& c : d.confined) std::cout << "  " << report::confined_clause(c) << "\n";
    for (auto const& p : d.where) {
        std::cout << "  where: " << p.kind << " " << p.name << (p.proved ? " (proved)" : "")
                  << (p.law.empty() ? "" : ", like ") << p.law << "\n";
    }
    std::cout << "  answer: " << detail::answer_words(d);
    if (!d.causes.empty() && d.answer == sivid::answer_kind::effects) {
        std::cout << " (" << to_string(d.causes.front().verdict) << ")";
        for (auto const& p : detail::stated_parameters(d.causes.front())) {
            std::cout << " " << detail::value_words(p);
        }
    }
    std::cout << "\n";
    detail::print_times(d);
    detail::print_constants(d);
    detail::print_combinations(d);
    for (auto const& e : d.at_ends) {
        std::cout << "  " << report::end_words(e) << "\n";
    }
    if (d.remainder) {
        std::cout << "  unexplained remainder: "
                  << (d.remainder->effects.empty()
                          ? std::string{"the model as it is"}
                          : "with " + sivid::joined(d.remainder->effects, " + "))
                  << ", inflation " << report::inflation_text(d.remainder->inflation) << "\n";
    }
    for (auto const& other : d.indistinguishable) {
        std::cout << "  not told apart from it: " << sivid::joined(other, " + ") << "\n";
    }
    detail::print_holdout(d);
    for (auto const& line : d.change.lines) std::cout << "  in a simulator: " << line << "\n";
    if (exit_code_of(d) == undecided)
        std::cout << "  ended early: what is open may be known with more time (--budget)\n";
    std::cout << "  " << report::duration_text(d.seconds)
              << "; written: " << (out / "report.html").string()
              << " and diagnosis.json beside it\n";
}

/// Progress and Ctrl-C for a diagnosis. The line outlives it.
inline void watch(sivid::diagnosis_options& options, progress_line& progress) {
    watch_interrupts();
    options.test = sivid::limited(options.test, [] { return !interrupted(); });
    options.progress = [&progress](std::string const& what) {
        progress.show(what);
        return !interrupted();
    };
    options.first_sentence = [&progress](std::string const& text) { progress.note(text); };
}

/// The page's options, but for what the program itself has to say.
inline sivid::report::diagnosis_report_options
page_options(sivid::diagnosis_run const& run, std::string dataset, std::string command) {
    sivid::report::diagnosis_report_options page;
    page.dataset = std::move(dataset);
    page.model = run.base.model.about.name;
    page.date = today();
    page.machine = machine_text();
    page.command = std::move(command);
    sivid::report::describe(run.catalogue, page);
    if (!run.candidates.empty()) page.base_fitted = run.candidates.front().figures.inflation;
    return page;
}

/// Writes diagnosis.json and report.html, both or none.
/// @param further  adds sections of the program's own: further(page)
/// @param source   of which data it is, for who checks it
/// @throws sivid::output_error
template <class Further>
void write_diagnosis(sivid::diagnosis const& d, std::string const& id,
                     sivid::report::diagnosis_plot_data const& plots,
                     sivid::report::diagnosis_report_options const& options,
                     std::filesystem::path const& out, Further&& further,
                     sivid::diagnosis_source const& source = {}) {
    auto page = sivid::report::diagnosis_page(sivid::report::view_of(d, plots, options));
    further(page);
    sivid::file_set files(out);
    files.add("diagnosis.json", sivid::diagnosis_json(d, id, source));
    files.add("report.html", page.str());
    files.commit();
}

} // namespace console

#endif
