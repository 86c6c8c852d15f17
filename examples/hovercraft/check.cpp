// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "console/console.hpp"
#include "console/program.hpp"
#include "posed_problem.hpp"

#include <sivid/io/dataset.hpp>
#include <sivid/io/dataset/dataset_digest.hpp>
#include <sivid/io/identification_reader.hpp>
#include <sivid/verifier/identification_check.hpp>
#ifdef SIVID_HAS_MPFI
#include <sivid/verifier/mp_identification_check.hpp>
#endif
#include <sivid/report/number_text.hpp>

#include <iomanip>
#include <iostream>

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

} // namespace

int run(check_command const& c) {
    if (!c.how.set.empty())
        throw bad_request("--set: check proves by sets of its own, of first order, and with --all "
                          "by Taylor models before these; leave it out, whatever identify took");
    console::watch_interrupts(); // reading a large result takes a while, too
    auto const stored = sivid::read_identification(c.result);
    if (c.dataset.empty() && stored.source_folder.empty())
        throw bad_request("the result does not say where its data set is: give --dataset");
    auto const folder = c.dataset.empty() ? c.result / stored.source_folder : c.dataset;
    auto const model = sivid::record_model(c.craft);
    auto const data = sivid::read_dataset(folder, sivid::names_of(model.about));
    auto problem = posed(data, model, stored.effects);
    sivid::check_finding source{"data set", outcome::verified, "the one identified, by SHA-256"};
    if (stored.source_digest.empty()) {
        source = {"data set", outcome::nothing, "no digest in the result: " + data.id + " taken"};
    } else if (sivid::dataset_digest(folder) != stored.source_digest) {
        source = {"data set", outcome::refuted, "not the one identified"};
    }
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
    auto const verdict = overall(findings);
    double seconds = 0;
    std::string left;
    for (auto const& f : findings) {
        seconds += f.seconds;
        if (f.found == outcome::nothing && !f.detail.empty()) left += ", not the " + f.what;
    }
    auto const by = c.how.method == "taylor" ? std::string{} : ", " + c.how.method;
    std::cout << "  witness and products in " << exact_words << "; boxes in "
              << (c.multiprecision ? exact_words : fast_words)
              << (c.all ? ": Taylor models in scalars, then first-order sets (Lohner" + by +
                              "), decided anew\n"
                        : ", by first-order sets (Lohner" + by +
                              "), not by the Taylor models that found them\n")
              << title_of(data, stored.effects) << ": "
              << (verdict == outcome::refuted     ? "REFUTED"
                  : verdict == outcome::undecided ? "not verified within the budget"
                  : verdict == outcome::sampled
                      ? "sampled: nothing refuted, not verified; --all proves every claim"
                      : "verified, every claim")
              << (verdict == outcome::verified ? left : "") << " in "
              << sivid::report::duration_text(seconds) << "\n";
    return exit_code_of(verdict);
}

} // namespace hovercraft_example
