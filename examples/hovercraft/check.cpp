// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "console/console.hpp"
#include "console/program.hpp"
#include "effects.hpp"
#include "posed_problem.hpp"

#include <sivid/io/dataset.hpp>
#include <sivid/io/dataset/dataset_digest.hpp>
#include <sivid/io/dataset_effects.hpp>
#include <sivid/io/diagnosis_reader.hpp>
#include <sivid/io/identification_reader.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/verifier/diagnosis_check.hpp>
#include <sivid/verifier/identification_check.hpp>
#ifdef SIVID_HAS_MPFI
#include <sivid/verifier/mp_identification_check.hpp>
#endif
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <string>
#include <system_error>
#include <vector>

namespace hovercraft_example {

namespace {

#ifdef SIVID_HAS_MPFI
constexpr auto exact_words = "40 digits";
constexpr auto fast_words = "doubles, elementary functions in 40 digits";
#else
constexpr auto exact_words = "doubles (built without MPFI)";
constexpr auto fast_words = exact_words;
#endif

using outcome = sivid::check_finding::outcome;

void print(sivid::check_finding const& f) {
    std::cout << "  " << std::left << std::setw(17) << f.what << " " << std::setw(14)
              << to_string(f.found) << " " << f.detail;
    if (f.seconds > 0.01)
        std::cout << (f.detail.empty() ? "" : ", ") << sivid::report::duration_text(f.seconds);
    std::cout << std::endl;
}

int exit_code_of(outcome o) {
    switch (o) {
    case outcome::verified:
    case outcome::nothing:
        return 0;
    case outcome::refuted:
        return console::refuted;
    case outcome::undecided:
    case outcome::sampled:
        break;
    }
    return console::undecided;
}

std::vector<sivid::check_finding> work(sivid::identification_problem const& problem,
                                       sivid::stored_identification const& stored,
                                       sivid::identification_check_options const& options,
                                       [[maybe_unused]] bool multiprecision) {
#ifdef SIVID_HAS_MPFI
    return multiprecision ? sivid::check_in_multiprecision(problem, stored, options, print)
                          : sivid::check_by_proven_functions(problem, stored, options, print);
#else
    using check = sivid::identification_check<sivid::interval, sivid::interval>;
    return check(problem, stored, options)(print);
#endif
}

/// Whether the data are those of a result, by name and digest.
sivid::check_finding source_of(std::filesystem::path const& folder, sivid::dataset const& data,
                               std::string const& name, std::string const& digest,
                               std::string const& done) {
    if (!digest.empty() && sivid::dataset_digest(folder) != digest)
        return {"data set", outcome::refuted, "not the one " + done};
    if (name != data.id)
        return {"data set", outcome::refuted,
                "the result names " + sivid::in_quotes(name) + ", the data set " +
                    sivid::in_quotes(data.id)};
    if (digest.empty())
        return {"data set", outcome::nothing, "no digest in the result: " + data.id + " taken"};
    return {"data set", outcome::verified, "the one " + done + ", by SHA-256"};
}

/// Names what lies in the folder and was not looked at: pictures, pages, other commands' results.
void print_unchecked(std::filesystem::path const& folder) {
    std::vector<std::string> names;
    std::error_code fault;
    for (auto const& entry : std::filesystem::directory_iterator(folder, fault)) {
        auto const name = entry.path().filename().string();
        constexpr std::array checked{"result.json",      "boxes.csv",   "products.csv",
                                     "certificates.csv", "outputs.csv", "diagnosis.json"};
        if (std::ranges::find(checked, name) == checked.end())
            names.push_back(sivid::printable_text(name, 60));
    }
    std::ranges::sort(names);
    constexpr std::size_t most = 20;
    auto const more = names.size() > most ? names.size() - most : 0;
    names.resize(names.size() - more);
    if (!names.empty())
        std::cout << "  not checked: " << sivid::joined(names, ", ")
                  << (more > 0 ? " and " + std::to_string(more) + " more" : std::string{}) << "\n";
}

/// The findings in a sentence, and the exit code.
int concluded(std::string const& title, std::vector<sivid::check_finding> const& findings,
              std::filesystem::path const& folder) {
    auto const verdict = overall(findings);
    double seconds = 0;
    std::string left;
    for (auto const& f : findings) {
        seconds += f.seconds;
        if (f.found == outcome::nothing && !f.detail.empty()) left += ", not the " + f.what;
    }
    print_unchecked(folder);
    std::cout << title << ": "
              << (verdict == outcome::refuted     ? "REFUTED"
                  : verdict == outcome::undecided ? "not verified within the budget"
                  : verdict == outcome::sampled
                      ? "sampled: nothing refuted, not verified; --all proves every claim"
                      : "verified, every claim")
              << (verdict == outcome::verified ? left : "") << " in "
              << sivid::report::duration_text(seconds) << "\n";
    return exit_code_of(verdict);
}

int check_identification(check_command const& c) {
    auto const stored = sivid::read_identification(c.result);
    if (c.dataset.empty() && stored.source_folder.empty())
        throw bad_request("the result does not say where its data set is: give --dataset");
    auto const folder = c.dataset.empty() ? c.result / stored.source_folder : c.dataset;
    auto const model = sivid::record_model(c.craft);
    auto const data = sivid::read_dataset(folder, sivid::names_of(model.about));
    auto problem = posed(data, model, stored.effects);
    auto const source = source_of(folder, data, stored.dataset, stored.source_digest, "identified");
    std::cout << "checking " << (c.result / "result.json").string() << " against "
              << folder.lexically_normal().string() << "\n";
    print(source);
    if (source.found == outcome::refuted) return console::refuted;
    sivid::require_same_problem(problem, stored, c.result / "result.json");
    bool own_budget = true;
    for (auto& e : problem.experiments) {
        own_budget = own_budget && e.outliers == stored.budget.at(e.name);
        e.outliers = stored.budget.at(e.name);
    }
    if (!own_budget)
        std::cout << "  note: the outlier budget is the result's, not the data set's\n";

    sivid::identification_check_options options;
    options.all = c.all;
    options.sample = c.sample;
    options.seed = c.seed;
    options.seconds = c.budget.value_or(c.all ? 3600 : 10);
    apply(c.how, options.certificate);
    options.further_assumptions = assumptions_of(data, model, stored.effects);
    options.certificate.keep_going = [] { return !console::interrupted(); };
    auto const findings = work(problem, stored, options, c.multiprecision);
    auto const by = c.how.method == "taylor" ? std::string{} : ", " + c.how.method;
    std::cout << "  witness and products in " << exact_words << "; boxes in "
              << (c.multiprecision ? exact_words : fast_words)
              << (c.all ? ": Taylor models in scalars, then first-order sets (Lohner" + by +
                              "), decided anew\n"
                        : ", by first-order sets (Lohner" + by +
                              "), not by the Taylor models that found them\n");
    return concluded(title_of(data, stored.effects), findings, c.result);
}

/// A diagnosis: every claim by its own prover, whatever --sample says.
int check_diagnosed(check_command const& c) {
    auto const stored = sivid::read_diagnosis(c.result);
    if (c.dataset.empty() && stored.source.folder.empty())
        throw bad_request("the diagnosis does not say where its data set is: give --dataset");
    auto const folder = c.dataset.empty() ? c.result / stored.source.folder : c.dataset;
    auto const model = sivid::record_model(c.craft);
    auto const data = sivid::read_dataset(folder, sivid::names_of(model.about));
    auto const base = sivid::problem_from_dataset(data, model);
    auto const source = source_of(folder, data, stored.dataset, stored.source.digest, "diagnosed");
    std::cout << "checking " << (c.result / "diagnosis.json").string() << " against "
              << folder.lexically_normal().string() << "\n";
    print(source);
    if (source.found == outcome::refuted) return console::refuted;
    auto const held_out = sivid::holdout_from_dataset(data, model.about);
    sivid::diagnosis_check_options options;
    options.seconds = c.budget.value_or(c.all ? 3600 : 60);
    options.held_out = &held_out;
    if (c.how.method != "taylor")
        throw bad_request("--method: a diagnosis is checked by Taylor models, which follow the "
                          "Taylor series; leave it out");
    options.test.keep_going = [] { return !console::interrupted(); };
    auto findings = sivid::check_diagnosis(base, sivid::chosen_effects(catalogue(), data), stored,
                                           options, print);
    findings.push_back(source);
    return concluded(data.id, findings, c.result);
}

} // namespace

int run(check_command const& c) {
    if (!c.how.set.empty())
        throw bad_request("--set: check proves by sets of its own, of first order, and with --all "
                          "by Taylor models before these; leave it out, whatever identify took");
    console::watch_interrupts(); // reading a large result takes a while, too
    std::error_code fault;
    bool const diagnosed = std::filesystem::exists(c.result / "diagnosis.json", fault);
    bool const identified = std::filesystem::exists(c.result / "result.json", fault);
    int const first = identified || !diagnosed ? check_identification(c) : console::done;
    int const second = diagnosed ? check_diagnosed(c) : console::done;
    for (int const code : {console::refuted, console::undecided})
        if (first == code || second == code) return code;
    return console::done;
}

} // namespace hovercraft_example
