// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPL_CHECK_IPP
#define SIVID_APP_IMPL_CHECK_IPP

#include <sivid/app/commands.hpp>

#include <sivid/app/console.hpp>
#include <sivid/app/detail/posed_problem.hpp>
#include <sivid/app/impl/confidence.ipp>
#include <sivid/app/impl/disturbance.ipp>
#include <sivid/app/program.hpp>
#include <sivid/io/dataset/dataset_digest.hpp>
#include <sivid/io/diagnosis_reader.hpp>
#include <sivid/io/identification_reader.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/io/result/detail/stored_values.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/io/text/durable_file.hpp>
#include <sivid/model/describe.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/verifier/certificate.hpp>
#include <sivid/verifier/diagnosis_check.hpp>
#include <sivid/verifier/disturbance_check.hpp>
#include <sivid/verifier/identification_check.hpp>
#ifdef SIVID_HAS_MPFI
#include <sivid/verifier/mp_identification_check.hpp>
#endif
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace sivid::app {

namespace detail {

#ifdef SIVID_HAS_MPFI
inline constexpr auto exact_words = "40 digits";
inline constexpr auto fast_words = "doubles, elementary functions in 40 digits";
#else
inline constexpr auto exact_words = "doubles (built without MPFI)";
inline constexpr auto fast_words = exact_words;
#endif

using outcome = check_finding::outcome;

inline void print(check_finding const& f) {
    result_stream() << "  " << std::left << std::setw(17) << f.what << " " << std::setw(14)
                    << to_string(f.found) << " " << f.detail;
    if (f.seconds > 0.01)
        result_stream() << (f.detail.empty() ? "" : ", ") << report::duration_text(f.seconds);
    result_stream() << std::endl;
}

inline int exit_code_of(outcome o) {
    switch (o) {
    case outcome::verified:
    case outcome::nothing:
        return 0;
    case outcome::refuted:
        return refuted;
    case outcome::undecided:
    case outcome::sampled:
        break;
    }
    return undecided;
}

inline std::vector<check_finding> work(identification_problem const& problem,
                                       stored_identification const& stored,
                                       identification_check_options const& options,
                                       [[maybe_unused]] bool multiprecision) {
#ifdef SIVID_HAS_MPFI
    return multiprecision ? check_in_multiprecision(problem, stored, options, print)
                          : check_by_proven_functions(problem, stored, options, print);
#else
    return check_identification(problem, stored, options, print);
#endif
}

/// Whether the data are those of a result, by name and digest.
inline check_finding source_of(std::filesystem::path const& folder, dataset const& data,
                               std::string const& name, std::string const& digest,
                               std::string const& done) {
    if (!digest.empty() && dataset_digest(folder) != digest)
        return {"data set", outcome::refuted, "not the one " + done};
    if (name != data.id)
        return {"data set", outcome::refuted,
                "the result names " + in_quotes(name) + ", the data set " + in_quotes(data.id)};
    if (digest.empty())
        return {"data set", outcome::nothing, "no digest in the result: " + data.id + " taken"};
    return {"data set", outcome::verified, "the one " + done + ", by SHA-256"};
}

/// Names what lies in the folder and was not looked at: pictures, pages, tables of no result here.
/// @param used  tables of this one
inline void print_unchecked(std::filesystem::path const& folder,
                            std::vector<std::string> const& used) {
    std::vector<std::string> names;
    std::error_code fault;
    for (auto const& entry : std::filesystem::directory_iterator(folder, fault)) {
        auto const name = entry.path().filename().string();
        constexpr std::array results{"result.json", "diagnosis.json", "confidence.json",
                                     "disturbance.json"};
        if (std::ranges::find(results, name) == results.end() &&
            std::ranges::find(used, name) == used.end())
            names.push_back(printable_text(name, 60));
    }
    std::ranges::sort(names);
    constexpr std::size_t most = 20;
    auto const more = names.size() > most ? names.size() - most : 0;
    names.resize(names.size() - more);
    if (!names.empty())
        result_stream() << "  not checked: " << joined(names, ", ")
                        << (more > 0 ? " and " + std::to_string(more) + " more" : std::string{})
                        << "\n";
}

/// The findings in a sentence, and the exit code.
inline int concluded(std::string const& title, std::vector<check_finding> const& findings,
                     std::filesystem::path const& folder, std::vector<std::string> const& used) {
    auto const verdict = overall(findings);
    double seconds = 0;
    std::string left;
    for (auto const& f : findings) {
        seconds += f.seconds;
        if (f.found == outcome::nothing && !f.detail.empty()) left += ", not the " + f.what;
    }
    print_unchecked(folder, used);
    result_stream() << title << ": "
                    << (verdict == outcome::refuted     ? "REFUTED"
                        : verdict == outcome::undecided ? "not verified within the budget"
                        : verdict == outcome::sampled
                            ? "sampled: nothing refuted, not verified; --all proves every claim"
                            : "verified, every claim")
                    << (verdict == outcome::verified ? left : "") << " in "
                    << report::duration_text(seconds) << "\n";
    return exit_code_of(verdict);
}

inline int check_identification(robot const& r, check_command const& c) {
    auto const stored = read_identification(c.result);
    auto const folder = data_of_result(c.result, c.dataset, stored.source_folder);
    auto const data = read_data(r, folder);
    auto problem = posed(r, data, stored.effects, stored.disturbances);
    auto const source = source_of(folder, data, stored.dataset, stored.source_digest, "identified");
    result_stream() << "checking " << (c.result / "result.json").string() << " against "
                    << folder.lexically_normal().string() << "\n";
    print(source);
    if (source.found == outcome::refuted) return refuted;
    require_same_problem(problem, stored, c.result / "result.json");
    bool own_budget = true;
    for (auto& e : problem.experiments) {
        own_budget = own_budget && e.outliers == stored.budget.at(e.name);
        e.outliers = stored.budget.at(e.name);
    }
    if (!own_budget)
        result_stream() << "  note: the outlier budget is the result's, not the data set's\n";

    identification_check_options options;
    options.all = c.all;
    options.sample = c.sample;
    options.seed = c.seed;
    options.seconds = c.budget.value_or(c.all ? 3600 : 10);
    apply(c.how, options.certificate);
    options.further_assumptions =
        assumptions_of(r, data, stored.effects, stored.disturbances, problem);
    options.certificate.keep_going = wanted;
    auto const findings = work(problem, stored, options, c.multiprecision);
    auto const by = c.how.method == "taylor" ? std::string{} : ", " + c.how.method;
    result_stream() << "  witness in " << exact_words << "; boxes in "
                    << (c.multiprecision ? exact_words : fast_words)
                    << (c.all ? ": the proofs of the result, then first-order sets (Lohner" + by +
                                    "), then the test of the search\n"
                              : ", by first-order sets (Lohner" + by +
                                    "), what they leave open by the test of the search\n");
    std::vector<std::string> used{"boxes.csv", "certificates.csv", "outputs.csv"};
    if (stored.products) used.emplace_back("products.csv");
    return concluded(title_of(data, stored.effects, stored.disturbances, problem.model), findings,
                     c.result, used);
}

/// A diagnosis: every claim by its own prover, whatever --sample says.
inline int check_diagnosed(robot const& r, check_command const& c) {
    auto const stored = read_diagnosis(c.result);
    auto const folder = data_of_result(c.result, c.dataset, stored.source.folder);
    auto const data = read_data(r, folder);
    auto const base = problem_from_dataset(data, r.model);
    auto const source = source_of(folder, data, stored.dataset, stored.source.digest, "diagnosed");
    result_stream() << "checking " << (c.result / "diagnosis.json").string() << " against "
                    << folder.lexically_normal().string() << "\n";
    print(source);
    if (source.found == outcome::refuted) return refuted;
    auto const held_out = holdout_from_dataset(data, r.model.about);
    diagnosis_check_options options;
    options.seconds = c.budget.value_or(c.all ? 3600 : 60);
    options.held_out = &held_out;
    if (c.how.method != "taylor")
        throw bad_request("--method: a diagnosis is checked by Taylor models, which follow the "
                          "Taylor series; leave it out");
    options.test.keep_going = wanted;
    auto findings = check_diagnosis(base, chosen_effects(r.effects, data), stored, options, print);
    findings.push_back(source);
    return concluded(data.id, findings, c.result, {});
}

/// The members of a file of results, and of its source.
inline std::vector<std::string> members_of(std::filesystem::path const& file,
                                           std::string const& text) {
    std::vector<std::string> names;
    if (file.extension() != ".json") return names;
    auto const root = parse_json(file.string(), text);
    for (auto const* object : {&root, &root.at("source")})
        for (std::size_t k = 0; k < object->members().size(); ++k)
            names.push_back(object->name_of(k));
    return names;
}
/// Whether a file is what the same work writes here, but for its seconds and where the data lie.
inline check_finding made_again(std::filesystem::path const& file, std::string const& made) {
    auto const lines = [](std::string const& text) {
        std::vector<std::string> all;
        std::istringstream in(text);
        for (std::string line; std::getline(in, line); all.push_back(line))
            if (line.starts_with("  \"seconds\"") || line.starts_with("  \"source\"")) line.clear();
        return all;
    };
    auto const text = read_text(file);
    auto const stored = lines(text), own = lines(made);
    auto const name = file.filename().string();
    if (members_of(file, text) != members_of(file, made))
        return {name, outcome::refuted, "it has other members than what is made anew"};
    if (stored == own) return {name, outcome::verified, "made anew, the same to the last digit"};
    auto const at = std::ranges::mismatch(stored, own).in1 - stored.begin();
    return {name, outcome::undecided,
            "line " + std::to_string(at + 1) + " is not what is made anew here"};
}

/// A result of `confidence` or `disturbance`, by the same work once more.
/// @param made  receives the command and the file, proves, and tells what it finds
template <class Command, class Made>
int check_by_making(robot const& r, check_command const& told, std::string const& file,
                    Made const& made) {
    auto const root = read_json(told.result / file);
    auto const& source = root.at("source");
    Command again;
    again.dataset = data_of_result(told.result, told.dataset, source.at("folder").any_string());
    again.effects = io_detail::texts(root.at("effects"));
    again.budget = io_detail::nearest_number(root.at("most_seconds"));
    result_stream() << "checking " << (told.result / file).string() << " against "
                    << again.dataset.lexically_normal().string() << "\n";
    auto const data = read_data(r, again.dataset);
    std::vector all{source_of(again.dataset, data, root.at("dataset").any_string(),
                              source.at("sha256").string(), "used")};
    print(all.front());
    if (all.front().found == outcome::refuted) return refuted;
    std::vector<std::string> used;
    stopwatch const clock;
    double before = 0;
    made(again, root, data, [&](check_finding f) {
        double const now = clock.spent();
        f.seconds = now - before;
        before = now;
        print(f);
        used.push_back(f.what);
        all.push_back(std::move(f));
    });
    return concluded(data.id, all, told.result, used);
}

inline int check_region(robot const& r, check_command const& c) {
    return check_by_making<confidence_command>(
        r, c, "confidence.json",
        [&](confidence_command& again, auto const& root, auto const& data, auto const& tell) {
            again.probability = io_detail::nearest_number(root.at("probability"));
            again.seed = io_detail::count(root.at("seed"));
            again.sums = io_detail::count(root.at("sums"));
            if (auto const& a = root.at("accuracy"); a.type() != json_value::kind::null)
                again.accuracy = io_detail::nearest_number(a);
            auto const problem = posed(r, data, again.effects, {});
            auto const nominal = io_detail::by_name(root.at("nominal"), io_detail::nearest_number);
            auto const region = region_of(r, again, data, problem, {.nominal = nominal});
            tell(made_again(c.result / "confidence.json",
                            confidence_json(again, problem, data.id, region)));
            tell(made_again(c.result / "confidence.csv",
                            io_detail::paving_csv(region.names, region.found.paving)));
        });
}

inline int check_least_disturbance(robot const& r, check_command const& c) {
    auto const scales = [](json_value const& list) {
        least_disturbance_answer::scales all;
        for (auto const& q : list.elements())
            all.emplace_back(q.at("name").string(), io_detail::nearest_number(q.at("scale")));
        return all;
    };
    return check_by_making<disturbance_command>(
        r, c, "disturbance.json",
        [&](disturbance_command& again, auto const& root, auto const&, auto const& tell) {
            again.curve = io_detail::count(root.at("curve"));
            least_disturbance_answer const a(r, again, scales(root.at("equations")),
                                             scales(root.at("channels")));
            bool const apart =
                is_empty(intersect(io_detail::outward(root.at("size")), a.found.size));
            if (apart) tell({"size", outcome::refuted, "it is proved to be another one"});
            tell(made_again(c.result / "disturbance.json", disturbance_json(again, a)));
            tell(made_again(c.result / "disturbance.csv", disturbance_csv(a.problem, a.found)));
            if (a.curve.size() > 0) tell(made_again(c.result / "curve.csv", curve_csv(a.curve)));
            tell(check_disturbance_witness(a.problem, a.set, a.found,
                                           work_limit(c.budget.value_or(60), wanted)));
        });
}

} // namespace detail

SIVID_DECL int run(robot const& r, check_command const& c) {
    if (!c.how.set.empty())
        throw bad_request("--set: check proves by sets of its own, of first order, and with --all "
                          "by Taylor models before these; leave it out, whatever identify took");
    watch_interrupts(); // reading a large result takes a while, too
    std::vector<int> codes;
    auto const check = [&](char const* file, auto const& how) {
        std::error_code fault;
        if (std::filesystem::exists(c.result / file, fault)) codes.push_back(how(r, c));
    };
    check("result.json", detail::check_identification);
    check("diagnosis.json", detail::check_diagnosed);
    check("confidence.json", detail::check_region);
    check("disturbance.json", detail::check_least_disturbance);
    if (codes.empty()) return detail::check_identification(r, c); // which says what is missing
    for (int const code : {refuted, undecided})
        if (std::ranges::find(codes, code) != codes.end()) return code;
    return done;
}

SIVID_DECL int run(robot const& r, certificate_command const& c) {
    watch_interrupts();
    auto const stored = read_identification(c.result);
    auto const folder = data_of_result(c.result, c.dataset, stored.source_folder);
    auto const data = read_data(r, folder);
    auto problem = posed(r, data, stored.effects, stored.disturbances);
    certificate_source source{folder, c.result / "result.json", "model", {}};
    require_same_problem(problem, stored, source.result);
    for (auto& e : problem.experiments) e.outliers = stored.budget.at(e.name);
    if (!stored.problem.empty() && stored.problem != problem_digest(problem))
        throw input_error{{.file = source.result.string()},
                          "another problem was identified (SHA-256)",
                          "give its model and data set, or identify anew"};
    bool const text = std::filesystem::is_regular_file(r.file);
    source.model_text = text ? read_text(r.file) : describe(problem.model);
    if (text) source.model_name = std::filesystem::path(r.file).filename().string();
    certificate_limits limits;
    limits.seconds = c.budget;
    limits.keep_going = wanted;
    auto const made = make_certificate(problem, data, stored, source, limits);
    auto const file = c.out.empty() ? c.result / "certificate.txt" : c.out;
    write_durably(file, made.text);
    result_stream() << title_of(data, stored.effects, stored.disturbances, problem.model)
                    << ": certificate of "
                    << (made.whole ? "the result\n" : "a part of the result\n");
    for (auto const& words : made.claimed)
        result_stream() << "  for the checker: " << words << "\n";
    for (auto const& words : made.unproved) result_stream() << "  not certified: " << words << "\n";
    result_stream() << "  " << made.excluded << " excluded boxes; written: " << file.string()
                    << "; check it by check_certificate, which does without sivid\n";
    return made.whole ? done : undecided;
}

} // namespace sivid::app

#endif
