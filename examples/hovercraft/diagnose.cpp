// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "console/console.hpp"
#include "effects.hpp"
#include "manoeuvres.hpp"

#include <sivid/diagnosis/diagnose.hpp>
#include <sivid/io/dataset.hpp>
#include <sivid/io/diagnosis_json.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/io/text_file.hpp>
#include <sivid/report/diagnosis_page.hpp>
#include <sivid/report/diagnosis_report.hpp>

#include <iostream>

namespace hovercraft_example {

namespace {

namespace report = sivid::report;

/// Misfits, missing rates and trajectories for the page.
report::diagnosis_plot_data plot_data(sivid::diagnosis_run const& run, sivid::holdout const& kept) {
    auto const& base = run.candidates.front();
    auto const& answer = run.candidates[run.answer];
    bool const improved = run.answer != 0;
    report::diagnosis_plot_data data;
    data.scenarios = report::compared_scenarios(run.base, base.fit,
                                                improved ? answer.fit : sivid::approximate_fit{});
    if (run.holdout_before) {
        auto more = report::compared_scenarios(
            kept.judged_by(base, run.base, run.catalogue), run.holdout_before->run,
            run.holdout_after ? run.holdout_after->run : sivid::approximate_fit{}, true);
        data.scenarios.insert(data.scenarios.end(), more.begin(), more.end());
    }
    for (auto const& p : run.places.places) {
        if (p.kind == sivid::place_kind::sensor) continue;
        for (auto const& r : p.rates) {
            report::missing_rate_data d{p.name,   r.scenario,   p.unit, r.times,
                                        r.values, r.deviations, {}};
            for (auto const& f : run.findings) {
                if (f.name != p.name || !f.missing || f.missing->window.scenario != r.scenario) {
                    continue;
                }
                d.windows.push_back(
                    {f.missing->window.from, f.missing->window.to, f.missing->value});
            }
            data.missing_rates.push_back(std::move(d));
        }
    }
    return data;
}

report::range range_of(sivid::interval const& x) { return {x.lower(), x.upper()}; }

/// A share in percent, as a range where its bounds differ to the eye.
std::string percent(sivid::interval const& share) {
    auto const text = [](double v) {
        return report::rounded_text(100 * v, report::rounding::nearest);
    };
    auto const low = text(share.lower());
    auto const high = text(share.upper());
    return low == high ? low + " %" : low + " to " + high + " %";
}

std::string joined(std::vector<std::string> const& all) {
    std::string text;
    for (auto const& s : all) text += (text.empty() ? "" : " + ") + s;
    return text;
}

void print_summary(sivid::diagnosis const& d, std::string const& id,
                   std::filesystem::path const& out) {
    std::cout << id << ": gap " << to_string(d.gap) << ", inflation "
              << report::outward_text(range_of(d.inflation)) << "\n";
    for (auto const& p : d.where) {
        std::cout << "  where: " << p.kind << " " << p.name << (p.proved ? " (proved)" : "")
                  << (p.law.empty() ? "" : ", like ") << p.law << "\n";
    }
    std::cout << "  answer: "
              << (d.answer == sivid::answer_kind::effects ? joined(d.effects)
                                                          : std::string{to_string(d.answer)});
    if (!d.causes.empty() && d.answer == sivid::answer_kind::effects) {
        std::cout << " (" << to_string(d.causes.front().verdict) << ")";
        for (auto const& p : d.causes.front().parameters) {
            std::cout << " " << p.name << " = "
                      << report::rounded_text(p.value, report::rounding::nearest) << " " << p.unit;
        }
    }
    std::cout << "\n";
    for (auto const& other : d.indistinguishable) {
        std::cout << "  not told apart from it: " << joined(other) << "\n";
    }
    if (d.shrink_holdout) {
        std::cout << "  on data that chose nothing the gap shrinks by "
                  << percent(*d.shrink_holdout) << "\n";
    }
    std::cout << "  " << report::duration_text(d.seconds)
              << "; written: " << (out / "report.html").string()
              << " and diagnosis.json beside it\n";
}

} // namespace

int run(diagnose_command const& c) {
    auto const model = sivid::record_model(c.craft);
    auto const data = sivid::read_dataset(c.dataset, sivid::names_of(model.about));
    auto const problem = sivid::problem_from_dataset(data, model);
    auto const further = sivid::assumptions_of(data);
    prepare_folder(c.out);

    console::watch_interrupts();
    console::progress_line progress(c.quiet);
    sivid::diagnosis_options options;
    options.seconds = c.budget;
    options.menu = recorded_manoeuvres(problem);
    for (auto& m : new_manoeuvres()) options.menu.push_back(std::move(m));
    options.progress = [&](std::string const& what) {
        progress.show(what);
        return !console::interrupted();
    };
    options.first_sentence = [&](std::string const& text) { progress.note(text); };
    auto run = sivid::diagnose(problem, catalogue(), options);
    progress.finish();
    progress.note("judging by data that chose nothing");
    auto const kept = sivid::holdout_from_dataset(data, model.about);
    sivid::judge_by_holdout(run, kept);
    auto& d = run.result;
    d.assumptions.insert(d.assumptions.end(), further.begin(), further.end());
    sivid::write_atomically(c.out / "diagnosis.json", sivid::diagnosis_json(d, data.id));
    report::diagnosis_report_options page;
    page.dataset = data.id;
    page.model = model.about.name;
    page.date = console::today();
    page.machine = console::machine_text();
    page.command = c.command_line;
    report::describe(run.catalogue, page);
    if (!run.candidates.empty()) page.base_fitted = run.candidates.front().figures.inflation;
    auto const drawn =
        run.candidates.empty() ? report::diagnosis_plot_data{} : plot_data(run, kept);
    sivid::write_atomically(c.out / "report.html",
                            report::diagnosis_page(report::view_of(d, drawn, page)).str());
    print_summary(d, data.id, c.out);
    return 0;
}

} // namespace hovercraft_example
