// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPL_REPORT_IPP
#define SIVID_APP_IMPL_REPORT_IPP

#include <sivid/app/commands.hpp>

#include <sivid/app/console.hpp>
#include <sivid/app/detail/posed_problem.hpp>
#include <sivid/app/names.hpp>
#include <sivid/app/program.hpp>
#include <sivid/io/dataset/dataset_digest.hpp>
#include <sivid/io/diagnosis_reader.hpp>
#include <sivid/io/explaining_motion.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/io/identification_reader.hpp>
#include <sivid/io/result/same_problem.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/report/diagnosis_page.hpp>
#include <sivid/report/diagnosis_words.hpp>
#include <sivid/report/identification_page.hpp>
#include <sivid/report/identification_report.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace sivid::app {

namespace detail {

/// @throws input_error  where a folder holds other data than those of a result
inline void require_data_of(std::filesystem::path const& folder, std::string const& digest) {
    if (!digest.empty() && dataset_digest(folder) != digest)
        throw input_error{{.file = folder.string()},
                          "this is not the data set of the result (SHA-256)",
                          "give the right one by --dataset"};
}

/// The values of these names, in their order; fewer where one is not there.
template <class List>
[[nodiscard]] std::vector<double> values_of(std::map<std::string, double> const& values,
                                            List const& names) {
    std::vector<double> result;
    for (auto const& name : names) {
        auto const found = values.find(name);
        if (found != values.end()) result.push_back(found->second);
    }
    return result;
}

/// What a stored result says of a witness, in the order of the problem.
inline std::optional<verified_witness> witness_of(stored_identification const& stored,
                                                  identification_problem const& problem) {
    if (!stored.witness) return std::nullopt;
    auto const& names = problem.choice.unknown;
    verified_witness w;
    w.parameters = values_of(stored.witness->parameters, names);
    bool whole = w.parameters.size() == names.size();
    for (auto const& e : problem.experiments) {
        auto const start = stored.witness->initial.find(e.name);
        auto const states = names_in(problem.model.about.states);
        w.starts.push_back(start == stored.witness->initial.end()
                               ? std::vector<double>{}
                               : values_of(start->second, states));
        whole = whole && w.starts.back().size() == states.size();
    }
    return whole ? std::optional{std::move(w)} : std::nullopt;
}

/// The measurements that a stored result calls outliers.
inline std::vector<forced_outlier> forced_of(stored_identification const& stored,
                                             identification_problem const& problem) {
    std::vector<forced_outlier> result;
    for (auto const& o : stored.forced) {
        for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
            if (problem.experiments[e].name != o.scenario) continue;
            auto const samples = sorted(problem.experiments[e].measurements);
            for (std::size_t k = 0; k < samples.size(); ++k) {
                auto const& channel = problem.model.about.channels[samples[k].channel].name;
                if (samples[k].time == o.time && channel == o.channel) result.push_back({e, k});
            }
        }
    }
    return result;
}

/// A stored identification as one that was just found, as far as its files say it: not how long it
/// took, nor the products in which it ran. @given  it is of this problem
inline identification recalled(stored_identification const& stored,
                               identification_problem const& problem) {
    identification found(problem.prior);
    found.verdict = stored.verdict;
    found.reason = stored.reason;
    found.effort = stored.effort;
    for (auto const& row : stored.rows) found.paving.add(row.set, row.verdict);
    for (std::size_t j = 0; j < problem.choice.unknown.size(); ++j) {
        for (auto const& p : stored.parameters)
            if (p.name == problem.choice.unknown[j]) found.hull[j] = p.range;
    }
    found.witness = witness_of(stored, problem);
    found.forced = forced_of(stored, problem);
    found.proof = stored.proof;
    found.assumptions = stored.assumptions;
    return found;
}

inline void report_identification(robot const& r, report_command const& c,
                                  std::filesystem::path const& out) {
    auto const stored = read_identification(c.result);
    auto const folder = data_of_result(c.result, c.dataset, stored.source_folder);
    auto const data = read_data(r, folder);
    require_data_of(folder, stored.source_digest);
    auto problem = posed(r, data, stored.effects);
    require_same_problem(problem, stored, c.result / "result.json");
    for (auto& e : problem.experiments) {
        if (auto const own = stored.budget.find(e.name); own != stored.budget.end())
            e.outliers = own->second;
    }
    auto const found = recalled(stored, problem);
    work_limit const limit(20, wanted);
    auto const motion = find_explaining_motion(problem, found, 240, limit);
    auto view = report::view_of(problem, found, motion ? &*motion : nullptr,
                                {.dataset = title_of(data, stored.effects),
                                 .meanings = r.meanings,
                                 .plane = r.plane,
                                 .date = today(),
                                 .machine = machine_text(),
                                 .command = c.command_line,
                                 .keep_going = limit});
    for (auto const& k : stored.combinations)
        view.combinations.push_back({k.name, k.unit, k.range, {}, "as the result states it"});
    view.warnings.push_back("This page was made anew from a stored result, which nobody has proved "
                            "again meanwhile; `check` does.");
    file_set files(out);
    files.add("report.html", report::identification_page(view).str());
    files.commit();
}

inline void report_diagnosis(robot const& r, report_command const& c,
                             std::filesystem::path const& out) {
    auto const stored = read_diagnosis(c.result);
    report::diagnosis_report_options page;
    page.dataset = stored.dataset;
    page.model = r.model.about.name;
    page.date = today();
    page.machine = machine_text();
    page.command = c.command_line;
    report::describe(r.effects, page);
    file_set files(out);
    files.add("report.html",
              report::diagnosis_page(report::view_of(stored.claims, {}, page)).str());
    files.commit();
}

} // namespace detail

SIVID_DECL int run(robot const& r, report_command const& c) {
    watch_interrupts();
    auto const& out = c.out.empty() ? c.result : c.out;
    std::error_code fault;
    bool const diagnosed = std::filesystem::exists(c.result / "diagnosis.json", fault);
    if (!c.out.empty()) prepare_folder(c.out);
    (diagnosed ? detail::report_diagnosis : detail::report_identification)(r, c, out);
    std::cout << "written: " << (out / "report.html").string()
              << ", as the result states it: `check` proves it anew\n";
    return done;
}

} // namespace sivid::app

#endif
