// SPDX-License-Identifier: MIT
// What the example programs write after a diagnosis: report.html, diagnosis.json, a summary.
#ifndef EXAMPLES_CONSOLE_DIAGNOSIS_OUTPUT_HPP
#define EXAMPLES_CONSOLE_DIAGNOSIS_OUTPUT_HPP

#include "console.hpp"

#include <sivid/diagnosis/diagnose.hpp>
#include <sivid/io/diagnosis_json.hpp>
#include <sivid/io/text_file.hpp>
#include <sivid/report/diagnosis_page.hpp>
#include <sivid/report/diagnosis_report.hpp>

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

inline std::vector<sivid::report::missing_rate_data>
missing_rates(sivid::place_estimate const& places,
              std::vector<sivid::relation_finding> const& findings) {
    std::vector<sivid::report::missing_rate_data> result;
    for (auto const& p : places.places) {
        if (p.kind == sivid::place_kind::sensor) continue;
        for (auto const& r : p.rates) {
            sivid::report::missing_rate_data d{p.name,   r.scenario,   p.unit, r.times,
                                               r.values, r.deviations, {}};
            for (auto const& f : findings) {
                if (f.name != p.name || !f.place || !f.place->missing) continue;
                auto const& [window, value, unit] = *f.place->missing;
                if (window.scenario != r.scenario) continue;
                d.windows.push_back({window.from, window.to, value});
            }
            result.push_back(std::move(d));
        }
    }
    return result;
}

inline sivid::report::range range_of(sivid::interval const& x) { return {x.lower(), x.upper()}; }

/// A share in percent, as a range where its bounds differ to the eye.
inline std::string percent(sivid::interval const& share) {
    namespace report = sivid::report;
    auto const text = [](double v) {
        return report::rounded_text(100 * v, report::rounding::nearest);
    };
    auto const low = text(share.lower());
    auto const high = text(share.upper());
    return low == high ? low + " %" : low + " to " + high + " %";
}

/// All parameters of the answer where a validated run has verified them.
inline void print_witness(sivid::diagnosis const& d) {
    if (d.causes.empty() || d.answer == sivid::answer_kind::unexplained) return;
    auto const& answer = d.causes.front();
    auto const& found = answer.witness;
    if (!found) return;
    bool const verified = answer.verdict == sivid::cause_verdict::explains;
    std::cout << (verified ? "  verified to explain the data:" : "  closest that was verified:");
    for (auto const& p : found->parameters) {
        std::cout << " " << p.name << " = "
                  << sivid::report::rounded_text(p.value, sivid::report::rounding::nearest) << " "
                  << p.unit;
    }
    std::cout << "\n";
}

inline void print_holdout(sivid::diagnosis const& d) {
    namespace report = sivid::report;
    if (d.causes.empty() || !d.causes.front().holdout) return;
    auto const& h = *d.causes.front().holdout;
    std::cout << "  inflation on data that chose nothing: "
              << report::inflation_text(range_of(h.inflation_before)) << " without it, "
              << report::inflation_text(range_of(h.inflation_after)) << " with it";
    if (d.shrink_holdout && std::isfinite(d.shrink_holdout->lower()))
        std::cout << ": the gap shrinks by " << percent(*d.shrink_holdout);
    std::cout << "\n";
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
    data.missing_rates = detail::missing_rates(run.places, run.findings);
    data.remaining_rates = detail::missing_rates(run.remaining_places, {});
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
    return sivid::report::outward_text(detail::range_of(known));
}

inline std::string joined(std::vector<std::string> const& all) {
    std::string text;
    for (auto const& s : all) text += (text.empty() ? "" : " + ") + s;
    return text;
}

/// "as it is" or "+ overflow + offset"
inline std::string model_words(std::vector<std::string> const& effects) {
    return effects.empty() ? "as it is" : "+ " + joined(effects);
}

inline void print_summary(sivid::diagnosis const& d, std::string const& id,
                          std::filesystem::path const& out) {
    namespace report = sivid::report;
    std::cout << id << ": gap " << to_string(d.gap) << ", inflation "
              << report::outward_text(detail::range_of(d.inflation)) << "\n";
    for (auto const& p : d.where) {
        std::cout << "  where: " << p.kind << " " << p.name << (p.proved ? " (proved)" : "")
                  << (p.law.empty() ? "" : ", like ") << p.law << "\n";
    }
    bool const untried = d.gap != sivid::gap_verdict::none && d.causes.empty();
    std::cout << "  answer: "
              << (untried                                   ? "open, no effect was tried"
                  : d.answer == sivid::answer_kind::effects ? joined(d.effects)
                                                            : std::string{to_string(d.answer)});
    if (!d.causes.empty() && d.answer == sivid::answer_kind::effects) {
        std::cout << " (" << to_string(d.causes.front().verdict) << ")";
        for (auto const& p : d.causes.front().parameters) {
            std::cout << " " << p.name << " = "
                      << report::rounded_text(p.value, report::rounding::nearest) << " " << p.unit;
        }
    }
    std::cout << "\n";
    detail::print_witness(d);
    if (d.remainder) {
        std::cout << "  unexplained remainder: "
                  << (d.remainder->effects.empty() ? std::string{"the model as it is"}
                                                   : "with " + joined(d.remainder->effects))
                  << ", inflation "
                  << report::outward_text(detail::range_of(d.remainder->inflation)) << "\n";
    }
    for (auto const& other : d.indistinguishable) {
        std::cout << "  not told apart from it: " << joined(other) << "\n";
    }
    detail::print_holdout(d);
    if (d.interrupted || untried)
        std::cout << "  ended early: what is open may be known with more time (--budget)\n";
    std::cout << "  " << report::duration_text(d.seconds)
              << "; written: " << (out / "report.html").string()
              << " and diagnosis.json beside it\n";
}

/// Progress and Ctrl-C for a diagnosis. The line outlives it.
inline void watch(sivid::diagnosis_options& options, progress_line& progress) {
    watch_interrupts();
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

/// Writes diagnosis.json and report.html.
/// @param further  adds sections of the program's own: further(page)
/// @throws sivid::output_error
template <class Further>
void write_diagnosis(sivid::diagnosis const& d, std::string const& id,
                     sivid::report::diagnosis_plot_data const& plots,
                     sivid::report::diagnosis_report_options const& options,
                     std::filesystem::path const& out, Further&& further) {
    sivid::write_atomically(out / "diagnosis.json", sivid::diagnosis_json(d, id));
    auto page = sivid::report::diagnosis_page(sivid::report::view_of(d, plots, options));
    further(page);
    sivid::write_atomically(out / "report.html", page.str());
}

} // namespace console

#endif
