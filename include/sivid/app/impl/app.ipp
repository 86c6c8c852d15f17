// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPL_APP_IPP
#define SIVID_APP_IMPL_APP_IPP

#include <sivid/app/app.hpp>

#include <sivid/app/commands.hpp>
#include <sivid/app/detail/hosting.hpp>
#include <sivid/app/detail/parameter_ranges.hpp>
#include <sivid/app/import_files.hpp>
#include <sivid/app/names.hpp>
#include <sivid/app/program.hpp>
#include <sivid/app/ranks.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace sivid::app {

/// Checks that an option is a number from `least` to `most`; unlike CLI11's own range it refuses
/// nan.
inline CLI::Validator number_between(double least, double most) {
    std::ostringstream range;
    range << least << " to " << most;
    return {[least, most, words = range.str()](std::string const& text) {
                double value = 0;
                bool const fits =
                    CLI::detail::lexical_cast(text, value) && least <= value && value <= most;
                return fits ? std::string{} : text + " is not a number from " + words;
            },
            range.str(), "number_between"};
}

/// For the name of a folder that need not be given: an empty one is none.
inline CLI::Validator folder_name() {
    return {[](std::string const& text) {
                return text.empty() ? std::string{"--out is empty: give a folder for the results"}
                                    : std::string{};
            },
            "", "folder_name"};
}

namespace detail {

inline std::size_t whole_number(std::string const& text, std::string const& what) {
    std::size_t count = 0;
    auto const* const end = text.data() + text.size();
    auto const read = std::from_chars(text.data(), end, count);
    if (text.empty() || read.ec != std::errc{} || read.ptr != end)
        throw bad_request(what + ", not " + in_quotes(text));
    return count;
}

/// Takes the kind of sets out of a list that else assigns values to constants.
inline void take_set(std::vector<std::string>& list, enclosing& how) {
    for (auto const* const kind : {"first-order", "taylor-model"}) {
        if (std::erase(list, kind) > 0) how.set = kind;
    }
}

/// The prior of an unknown constant unless told: the robot's, or 10 % about the nominal value.
inline unknown_parameter usual_prior(robot const& r, std::string const& name) {
    for (auto const& u : r.prior)
        if (u.name == name) return u;
    auto const& constants = r.model.about.constants;
    require_known(name, names_in(constants), "constant");
    auto const nominal =
        exact_decimal::shortest(constants[index_of(constants, name, "constant")].nominal.nearest);
    if (nominal.is_zero())
        throw bad_request("--unknown " + name + ": its nominal value is 0, give a prior as " +
                          name + "=lower:upper");
    auto const tenths = [&](std::size_t n) {
        return *exact_decimal::parse(nominal.times(n).text() + "e-1");
    };
    auto lower = tenths(9), upper = tenths(11);
    if (upper < lower) std::swap(lower, upper);
    return {name, lower, upper};
}

/// "Sv,L" or "m=1.2:1.4"
inline std::vector<unknown_parameter> unknown_from(robot const& r,
                                                   std::vector<std::string> const& list) {
    std::vector<unknown_parameter> result;
    for (auto const& text : list) {
        if (text.find('=') == std::string::npos) {
            result.push_back(usual_prior(r, text));
            continue;
        }
        auto const [name, range] = assignment(text, "--unknown");
        require_known(name, names_in(r.model.about.constants), "constant");
        auto const what = "--unknown " + name;
        auto const colon = range.find(':');
        if (colon == std::string::npos)
            throw bad_request(what + ": write the prior as lower:upper");
        result.push_back({name, decimal_of(range.substr(0, colon), what),
                          decimal_of(range.substr(colon + 1), what)});
        for (auto const& end : {result.back().lower, result.back().upper})
            if (mag(*enclose(end)) > farthest_range)
                throw bad_request(what + ": " + end.text() +
                                  " is beyond 1e100; state what is physically possible");
    }
    if (result.empty())
        throw bad_request("--unknown: say what is to be identified, such as " +
                          r.model.about.constants.front().name);
    return result;
}

/// Shows the file of a model where the program takes it, behind each command.
class usage_with_model : public CLI::Formatter {
public:
    explicit usage_with_model(std::string file) : file_{std::move(file)} {}
    std::string make_usage(CLI::App const* app, std::string name) const override {
        bool const command = app->get_parent() != nullptr && !file_.empty();
        return Formatter::make_usage(app, command ? name + " " + file_ : name);
    }

private:
    std::string file_;
};

/// The program: what is parsed, then run by `action_`.
class program {
public:
    program(robot const& r, std::string command_line, ranks const& all)
        : of_{r}, line_{std::move(command_line)}, all_{&all}, app_{r.title, r.name} {
        app_.require_subcommand(1);
        app_.formatter(std::make_shared<usage_with_model>(of_.file));
        for (auto const& u : r.prior) unknown_.push_back(u.name);
        for (auto const& v : r.variants) chosen_.push_back(v.choices.front());
        add_import();
        add_simulate();
        add_generate();
        add_identify();
        add_online();
        add_confidence();
        add_check();
        add_certificate();
        add_diagnose();
        for (auto const what :
             {decision::predict, decision::verify, decision::control, decision::design})
            add_decision(what);
        add_rank();
        add_disturbance();
        add_report();
        add_export();
        add_describe();
        add_fleet();
        for (auto const& own : r.commands) app_.add_subcommand(own.name, own.about);
    }

    int operator()(int argc, char** argv) {
        if (argc > 1) {
            for (auto const& own : of_.commands)
                if (own.name == argv[1]) return own.run(argc - 1, argv + 1);
        }
        try {
            app_.parse(argc, argv);
        } catch (CLI::ParseError const& e) {
            if (e.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
                app_.exit(e, result_stream(), notice_stream()); // --help
                return done;
            }
            auto const near = guess(argc, argv);
            if (host_of_command != nullptr)
                throw bad_request(near.empty() ? e.what() : e.what() + ("; " + near));
            app_.exit(e, result_stream(), notice_stream());
            if (!near.empty()) notice_stream() << near << "\n";
            return bad_input;
        }
        auto const command = app_.get_subcommands().front()->get_name();
        bool const shares = command == "identify" || command == "diagnose" || command == "fleet";
        if (all_->several() && !shares)
            throw bad_request(command + " runs in one process: start it without mpirun");
        if (of_.variant) of_.model = of_.variant(chosen_);
        return action_();
    }

private:
    /// What was probably meant by a word that is no command, or no option of the command.
    [[nodiscard]] std::string guess(int argc, char** argv) const {
        std::vector<std::string> commands;
        for (auto const* s : app_.get_subcommands({})) commands.push_back(s->get_name());
        std::string const first = argc > 1 ? argv[1] : "";
        if (std::find(commands.begin(), commands.end(), first) == commands.end()) {
            auto const near = nearest_name(first, commands);
            return near.empty() ? "" : "Did you mean the command " + near + "?";
        }
        std::vector<std::string> options;
        for (auto const* o : app_.get_subcommand(first)->get_options())
            for (auto const& name : o->get_lnames()) options.push_back("--" + name);
        for (int i = 2; i < argc; ++i) {
            auto word = std::string{argv[i]};
            word = word.substr(0, word.find('='));
            bool const known = std::find(options.begin(), options.end(), word) != options.end();
            if (!word.starts_with("--") || known) continue;
            auto const near = nearest_name(word, options);
            if (!near.empty()) return "Did you mean " + near + "?";
        }
        return {};
    }

    /// A command with what all have, run by `work`, which may still change its values.
    template <class Command>
    CLI::App* add(Command& c, std::string const& name, std::string const& about,
                  std::string const& example, std::function<int()> work) {
        auto* const s = app_.add_subcommand(name, about);
        auto const file = of_.file.empty() ? "" : of_.file + " ";
        s->footer("Example: " + of_.name + " " + name + " " + file + example);
        s->add_flag("--quiet", c.quiet, "no progress");
        for (std::size_t k = 0; k < of_.variants.size(); ++k) {
            auto const& v = of_.variants[k];
            s->add_option("--" + v.option, chosen_[k], v.about)
                ->check(CLI::IsMember(v.choices))
                ->capture_default_str();
        }
        s->callback([this, &c, work = std::move(work)] {
            action_ = [this, &c, work] {
                c.command_line = line_;
                c.job = all_;
                return work();
            };
        });
        return s;
    }
    static void add_exit_codes(CLI::App& s, std::string const& codes) {
        s.footer(s.get_footer() + "\nExit codes: " + codes);
    }
    template <class Command>
    static CLI::Option* add_out(CLI::App& s, Command& c, std::string const& what) {
        return s.add_option("--out", c.out, "folder for " + what)->check(folder_name());
    }
    template <class Command>
    static void add_disturbances(CLI::App& s, Command& c) {
        s.add_option(
             "--disturbance", c.disturbed,
             "unknown functions of time beside equations, with their largest value in the "
             "state's unit per time: v=0.8; the answer is for all of them, and predict, "
             "verify, control and check take them from the result. In place of what the model "
             "itself states; 0: without")
            ->delimiter(',');
        s.add_option("--error", c.errors,
                     "channels whose readings may be so much further off than their bounds: y=0.1")
            ->delimiter(',');
    }
    static void add_budget(CLI::App& s, double& budget,
                           std::string const& about = "seconds; it ends earlier when nothing is "
                                                      "left to do") {
        s.add_option("--budget", budget, about)
            ->check(number_between(0.0, 1e9))
            ->capture_default_str();
    }
    static void add_threads(CLI::App& s, std::size_t& threads) {
        s.add_option("--threads", threads, "threads (0: all); the result does not depend on it")
            ->check(CLI::Range(0, 1024))
            ->capture_default_str();
    }
    static void add_method(CLI::App& s, enclosing& how, std::string const& what) {
        s.add_option("--method", how.method,
                     what + " follow the Taylor series or a validated Runge-Kutta method")
            ->check(CLI::IsMember(method_names()))
            ->capture_default_str();
    }
    static void add_enclosing(CLI::App& s, enclosing& how) {
        add_method(s, how, "enclosures");
        s.add_option("--set", how.set,
                     "sets that are carried: of first order (doubletons), or Taylor models")
            ->check(CLI::IsMember({"first-order", "taylor-model"}))
            ->capture_default_str();
    }
    /// @param others  what else may be given
    void add_scenario(CLI::App& s, std::string& scenario, std::string const& others) const {
        auto const names = names_in(of_.scenarios);
        auto const about = names.empty() ? std::string{} : ", or one of: " + joined(names, " ");
        s.add_option("--scenario", scenario, "a JSON file (sivid-scenario-1)" + others + about);
    }
    static void add_effects(CLI::App& s, std::vector<std::string>& effects,
                            std::string const& beside) {
        s.add_option("--with", effects,
                     "effects that act in the scenario" + beside +
                         ", separated by commas: wind for all that its prior allows, wind=0.2 or "
                         "wind=0.1:0.3; of one with several parameters by --set wind.k=0.2")
            ->delimiter(',');
    }
    [[nodiscard]] std::string a_scenario() const {
        return of_.scenarios.empty() ? "next.json" : of_.scenarios.front().name;
    }

    void add_import() {
        auto& c = import_;
        auto* const s =
            add(c, "import",
                "recorded files of any form into a data set; or a robot's URDF into a model",
                "mapping.json --out data", [this, &c] {
                    return is_robot(c.mapping)
                               ? import_robot(c.mapping, c.out, robot_, c.quiet)
                               : import_files(of_.model.about, c.mapping, c.out, c.quiet);
                });
        s->add_option("mapping", c.mapping,
                      "what the files hold (sivid-mapping-1); or robot.urdf, in place of a model")
            ->required();
        s->add_option("--within", robot_.within,
                      "of a robot: how far masses, first moments and moments of inertia may be off")
            ->capture_default_str();
        s->add_option("--fix", robot_.fixed, "of a robot: joints that are fixed at 0, with commas")
            ->delimiter(',');
        s->add_option("--gravity", robot_.gravity, "of a robot: x y z in its root link [m/s^2]")
            ->expected(3);
        add_out(*s, c, "the data set or robot.toml, and import.txt")->required();
    }

    void add_simulate() {
        auto& c = simulate_;
        auto* const s =
            add(c, "simulate", "trajectories by Boost.Odeint, as CSV and pictures",
                "--scenario " + a_scenario() + " --validated --out simulated", [this, &c] {
                    take_set(set_, c.how);
                    c.set = ranges_from(set_, "--set");
                    return run(of_, c);
                });
        add_scenario(*s, c.scenario, ", all");
        s->get_option("--scenario")->required();
        add_out(*s, c, "the result")->required();
        s->add_option("--set", set_,
                      "values of constants, such as Sg=0.05, or ranges, such as Ff=0.3:0.7: the "
                      "line is that of the middle, the proven tube that of all; or the sets that "
                      "tubes carry: first-order (the default), taylor-model (the default of "
                      "ranges)");
        add_effects(*s, c.effects, "");
        s->add_option("--rate", c.rate, "rows of the CSV a unit of time")->capture_default_str();
        s->add_option("--input-rate", c.input_rate,
                      "samples of the inputs a unit of time, as in `generate`; not given: their "
                      "exact shapes")
            ->check(number_between(1e-3, 1e5));
        s->add_flag("--validated", c.validated, "the proven tube beside it");
        add_method(*s, c.how, "the proven tubes");
    }

    void add_generate() {
        auto& c = generate_;
        auto& o = c.options;
        auto* const s =
            add(c, "generate", "a data set from the validated motion of known parameters",
                "--scenario " + a_scenario() + " --absolute 0.05 --out data",
                [this] { return run_generate(); });
        add_scenario(*s, c.scenario, ", all");
        s->get_option("--scenario")->required();
        add_out(*s, c, "the data set")->required();
        s->add_option("--id", o.id, "name of the data set")->capture_default_str();
        s->add_option("--seed", o.seed, "of the noise and the outliers")->capture_default_str();
        s->add_option("--rate", o.rate, "measurements a unit of time")->capture_default_str();
        s->add_option("--input-rate", o.input_rate, "input samples a unit of time")
            ->capture_default_str();
        s->add_flag("--hold", hold_, "inputs hold between samples instead of going straight");
        s->add_option("--relative", relative_, "bound as a share of the value");
        s->add_option("--absolute", absolute_,
                      "bound in the channel's unit: one for all, or one each for " +
                          joined_names(of_.model.about.channels, " "))
            ->expected(1, static_cast<int>(of_.model.about.channels.size()));
        s->add_flag("--combined", combined_, "the sum of the relative and the absolute bound");
        s->add_option("--noise", o.noise, "largest noise as a share of the bound, 0 to 1")
            ->check(number_between(0.0, 1.0))
            ->capture_default_str();
        s->add_option("--outliers", o.outliers, "samples spoilt on purpose in each scenario");
        s->add_option("--outlier-size", o.outlier_size, "their distance from the truth, in bounds")
            ->check(number_between(1.0, 1e9))
            ->capture_default_str();
        s->add_option("--set", set_,
                      "true values, such as Sg=0.05; or the sets by which the true motion is "
                      "enclosed: first-order (the default), taylor-model");
        add_unknown(*s, "what is to be identified: Sv,Sg,L or m=1.2:1.4");
        add_method(*s, o.how, "enclosures of the true motion");
    }
    CLI::Option* add_unknown(CLI::App& s, std::string const& about) {
        return s.add_option("--unknown", unknown_, about)->delimiter(',');
    }

    int run_generate() {
        auto& o = generate_.options;
        if (!relative_.empty() && !absolute_.empty() && !combined_)
            throw bad_request("--relative and --absolute together need --combined");
        if (combined_ && (relative_.empty() || absolute_.empty()))
            throw bad_request("--combined needs --relative and --absolute");
        if (!relative_.empty()) {
            o.relative = decimal_of(relative_, "--relative");
            if (!o.relative->is_positive() || !(*o.relative < decimal_of("1", "")))
                throw bad_request("--relative must be above 0 and below 1");
        }
        for (auto const& text : absolute_) {
            o.absolute.push_back(decimal_of(text, "--absolute"));
            if (!o.absolute.back().is_positive()) throw bad_request("--absolute must be above 0");
        }
        if (o.absolute.size() == 1)
            o.absolute.resize(of_.model.about.channels.size(), o.absolute[0]);
        o.interpolation = hold_ ? interpolation::hold : interpolation::linear;
        take_set(set_, o.how);
        for (auto const& text : set_) {
            auto const [name, value] = assignment(text, "--set");
            require_known(name, names_in(of_.model.about.constants), "constant");
            if (!o.set.emplace(name, decimal_of(value, "--set " + name)).second)
                throw bad_request("--set " + name + " is given twice");
        }
        o.unknown = unknown_from(of_, unknown_);
        return run(of_, generate_);
    }

    /// What `identify` and `online` share.
    void add_search(CLI::App& s, search_command& c) {
        s.add_option("dataset", c.dataset, "folder with dataset.json")->required();
        add_out(s, c, "report.html, result.json and tables")->required();
        s.add_option("--with", c.effects,
                     "effects to join to the model, separated by commas: their parameters are "
                     "identified, too")
            ->delimiter(',');
        add_disturbances(s, c);
        add_enclosing(s, c.how);
        s.add_option(
             "--accuracy", c.accuracy,
             "leave boxes undecided when no side is wider than this share of what is left "
             "(report-1, report-2: of the prior). When given, nothing but a budget, or boxes "
             "so small that decide nothing, ends the search before; without it (0.003), "
             "half of what is left being proved inside does, too")
            ->check(number_between(1e-15, 1.0));
        add_budget(s, c.budget, "seconds, from when the data are read");
        s.add_option("--boxes", c.boxes, "number of boxes to test, at most")
            ->check(number_between(0.0, 1e15)); // below 0 it would become very many
        s.add_option("--picture", c.picture,
                     "a channel to draw on its own, in OUT/<scenario>.<channel>.svg");
        s.add_flag("--identifiability", c.identifiability,
                   "also say which parameters such data can tell at all");
        s.add_flag("--verbose", c.verbose, "what was tried before the search, and why");
        add_exit_codes(s, "0 consistent, 2 bad input, 3 undecided, 4 inconsistent: no parameter of "
                          "the prior explains the data (proved).");
    }

    void add_identify() {
        auto& c = identify_;
        auto* const s =
            add(c, "identify", "which parameters can explain a recorded campaign, with proof",
                "data --out result --budget 60", [this, &c] {
                    read_outliers();
                    return run(of_, c);
                });
        add_search(*s, c);
        s->add_option("--outliers", outliers_,
                      "outliers allowed in each scenario, instead of the data set's own fraction; "
                      "auto: the fewest that explain the data, with proof that fewer do not");
        s->add_option("--threshold", threshold_,
                      "the outliers allowed as Algorithm 2 of the report prints them: with n "
                      "measurements ceil(n * threshold) - 1 in each scenario");
        s->add_option("--bound-probability", bounds_hold_,
                      "with which probability each bound holds, independently of the others, such "
                      "as 0.997");
        s->add_option("--outliers-for", outliers_for_,
                      "allow in each scenario as many outliers as such bounds have with this "
                      "probability, such as 0.99; proved");
        s->add_option("--algorithm", c.algorithm,
                      "contracting, or Algorithm 1 or 2 of the report of 2016, by bisection")
            ->check(CLI::IsMember({"contracting", "report-1", "report-2"}))
            ->capture_default_str();
        s->add_flag("--compare", c.compare,
                    "spend 40 % of the budget on the report's Algorithm 1 and show both");
        s->add_flag("--verdict-only", c.verdict_only,
                    "stop as soon as it is proved whether any parameter explains the data");
        s->add_flag("--by-bounds", c.by_bounds,
                    "spend 60 % of the budget on how wide the ranges would be with half and with "
                    "twice the error bounds of each channel: which of them decides");
        add_effort(*s, c);
    }
    static void add_effort(CLI::App& s, identify_command& c) {
        s.add_option("--memory", c.memory,
                     "memory for boxes and what is known about them [MB], at most")
            ->check(number_between(0.0, 1e9));
        s.add_option("--checkpoint", c.checkpoint,
                     "seconds from one save of the search in OUT/checkpoint.txt to the next")
            ->check(number_between(0.0, 1e9));
        s.add_flag("--resume", c.resume,
                   "go on from OUT/checkpoint.txt, after a kill or with larger budgets; keeps "
                   "saving, every 10 s unless --checkpoint says otherwise");
        add_threads(s, c.threads);
        s.add_option("--batches", c.batches,
                     "sets of boxes that are enclosed at a time: more of them give work to more "
                     "ranks or threads. The result depends on this number, not on ranks and "
                     "threads")
            ->check(CLI::Range(1, 65536))
            ->capture_default_str();
    }

    void read_outliers() {
        auto& c = identify_;
        if (!bounds_hold_.empty() || !outliers_for_.empty()) {
            if (bounds_hold_.empty() || outliers_for_.empty() || !outliers_.empty() ||
                !threshold_.empty())
                throw bad_request("--bound-probability and --outliers-for go together, without "
                                  "--outliers and --threshold");
            c.outliers = outlier_rule::chance(decimal_of(bounds_hold_, "--bound-probability"),
                                              decimal_of(outliers_for_, "--outliers-for"));
        }
        if (!threshold_.empty()) {
            if (!outliers_.empty()) throw bad_request("give --outliers or --threshold, not both");
            if (c.algorithm == "report-1")
                throw bad_request("--threshold: Algorithm 1 allows no outlier; use report-2");
            auto const h = decimal_of(threshold_, "--threshold");
            if (!h.is_positive() || decimal_of("1", "") < h)
                throw bad_request("--threshold must be above 0 and at most 1: with 0 every box "
                                  "would be rejected");
            c.outliers = outlier_rule::threshold(h);
        }
        c.fewest_outliers = outliers_ == "auto";
        if (outliers_.empty() || c.fewest_outliers) return;
        c.outliers =
            outlier_rule(whole_number(outliers_, "--outliers: write a whole number or auto"));
    }

    void add_online() {
        auto& c = online_;
        auto* const s = add(c, "online",
                            "identify measurement by measurement, in the order of time, as they "
                            "would arrive; a line for each update",
                            "data --out result", [this, &c] {
                                if (!outliers_.empty())
                                    c.outliers = outlier_rule(whole_number(
                                        outliers_, "--outliers: write a whole number"));
                                return run(of_, c);
                            });
        add_search(*s, c);
        s->add_option("--outliers", outliers_,
                      "outliers allowed in each scenario, instead of the data set's own fraction");
    }

    void add_confidence() {
        auto& c = confidence_;
        auto* const s =
            add(c, "confidence",
                "the region in which the truth is with a stated probability, without "
                "error bounds: for independent errors, symmetric about zero",
                "data --probability 0.95 --out region", [this, &c] { return run(of_, c); });
        s->add_option("dataset", c.dataset, "folder with dataset.json")->required();
        s->add_option("--probability", c.probability, "a fraction, of at most four digits")
            ->capture_default_str();
        s->add_option("--seed", c.seed, "of random signs: not to be chosen by what comes out")
            ->capture_default_str();
        s->add_option("--nominal", c.nominal,
                      "likely values of unknowns, such as k=0.5, known without these data: the "
                      "nearer the truth, the smaller the region. Else the middles of priors")
            ->delimiter(',');
        s->add_option("--sums", c.sums,
                      "sums that are compared, at least: the more, the less the "
                      "region depends on the seed")
            ->check(CLI::Range(2, 10'000))
            ->capture_default_str();
        add_out(*s, c, "confidence.html, confidence.json and confidence.csv")->required();
        s->add_option("--with", c.effects, "effects to join to the model, separated by commas")
            ->delimiter(',');
        add_enclosing(*s, c.how);
        s->add_option("--accuracy", c.accuracy,
                      "least width of boxes that are split, as a share of what is left")
            ->check(number_between(1e-15, 1.0));
        add_budget(*s, c.budget, "seconds");
        add_exit_codes(*s, "0 the search came to its end, 2 bad input, or a problem that the "
                           "theorem does not cover, 3 a budget ended it.");
    }

    void add_check() {
        auto& c = check_;
        auto* const s = add(c, "check",
                            "prove the result of a command anew: of identify, online, diagnose, "
                            "confidence, disturbance",
                            "result --all", [this, &c] { return run(of_, c); });
        s->add_option("result", c.result,
                      "folder with result.json and boxes.csv, or with diagnosis.json, "
                      "confidence.json or disturbance.json")
            ->required();
        s->add_option("--dataset", c.dataset, "its data set, if it is not where the result says");
        s->add_flag("--all", c.all, "every box instead of a sample");
        s->add_option("--sample", c.sample,
                      "number of inside boxes and of excluded boxes in the sample")
            ->capture_default_str();
        s->add_option("--seed", c.seed, "of the sample")->capture_default_str();
        add_method(*s, c.how, "first-order sets of the check");
        s->add_option("--set", c.how.set, "refused: the check has sets of its own");
        s->add_option("--budget", c.budget,
                      "seconds (10, of a diagnosis 60, with --all 3600; a region and "
                      "a disturbance are made anew with what they had)")
            ->check(number_between(0.0, 1e9));
        s->add_flag("--multiprecision", c.multiprecision,
                    "boxes too in 40 digits: 20 times slower");
        add_exit_codes(*s, "0 every claim proved anew (--all), 2 bad input, 3 neither verified nor "
                           "refuted (a sample, or not within the budget), 5 refuted: the result is "
                           "not what its data prove.");
    }

    void add_certificate() {
        auto& c = certificate_;
        auto* const s =
            add(c, "certificate", "the result of `identify` for a checker in C that needs no sivid",
                "result", [this, &c] { return run(of_, c); });
        s->add_option("result", c.result, "folder with result.json and boxes.csv")->required();
        s->add_option("--dataset", c.dataset, "its data set, if it is not where the result says");
        s->add_option("--out", c.out, "the file; not given: certificate.txt in that folder");
        add_budget(*s, c.budget);
        add_exit_codes(*s, "0 verdict and hull are certified, 2 bad input, or what no certificate "
                           "can hold, 3 only a part is.");
    }

    void add_diagnose() {
        auto& c = diagnose_;
        auto* const s =
            add(c, "diagnose",
                "where model and robot disagree, which effect it is, how far the gap shrinks; then "
                "the ranges of the parameters of the model that explains the data",
                "data --out out --budget 60", [this, &c] { return run(of_, c); });
        s->add_option("dataset", c.dataset, "folder with dataset.json")->required();
        add_out(*s, c, "report.html and diagnosis.json, and the identified model in OUT/model")
            ->required();
        add_enclosing(*s, c.how);
        add_budget(*s, c.budget);
        add_threads(*s, c.threads);
        s->add_flag("--verbose", c.verbose, "what was tried to bound the parameters, and why");
        add_exit_codes(*s,
                       "0 answered, whatever it is, 2 bad input, 3 candidates were left untried "
                       "or it was ended early.");
    }

    void add_decision(decision what) {
        auto& c = decision_;
        auto const texts = words_of(what);
        auto* const s = add(c, texts.name, texts.about,
                            "result --scenario " + a_scenario() + texts.example, [this, what, &c] {
                                take_set(c.set, decision_how_);
                                apply(decision_how_, c.run);
                                return run(of_, what, c);
                            });
        s->add_option("result", c.result,
                      "folder with result.json and boxes.csv, of an "
                      "identification")
            ->required();
        s->add_option("--dataset", c.dataset, "its data set, if it is not where the result says");
        add_scenario(*s, c.scenario, ", data:NAME for one of the data set that is not held out");
        s->get_option("--scenario")->required();
        s->add_option("--set", c.set,
                      "constants of the scenario, such as Ff=0.5, or ranges, such as Ff=0.3:0.7; "
                      "or the sets that are carried: taylor-model (the default), first-order");
        add_budget(*s, c.budget, "seconds");
        auto* const out = add_out(*s, c, "the report and the JSON file");
        add_method(*s, decision_how_, "enclosures of motions");
        if (what == decision::design) {
            add_design(*s);
            return;
        }
        add_effects(*s, c.effects, ", beside those of the result");
        add_law(*s, what);
        if (what == decision::predict) {
            out->required();
            return;
        }
        s->add_option("--require", c.requirement,
                      "such as \"eventually(abs(u) < 0.01) and x at end in [3, 7]\"")
            ->required();
        add_exit_codes(*s, what == decision::control
                               ? "0 some gains are proved, 2 bad input, 3 none is known, 5 none "
                                 "exist in the ranges that were given (proved)."
                               : "0 proved for all parameters, 2 bad input, 3 open, 5 refuted by a "
                                 "parameter that is proved to explain the data.");
    }
    struct decision_words {
        std::string name, about, example;
    };
    [[nodiscard]] decision_words words_of(decision what) const {
        auto const& about = of_.model.about;
        auto const y = about.channels.empty() ? "y" : about.channels.front().name;
        auto const u = about.inputs.empty() ? "u" : about.inputs.front().name;
        auto const p = about.constants.empty() ? "p" : about.constants.front().name;
        switch (what) {
        case decision::predict:
            return {"predict",
                    "tubes of a scenario over all parameters that an identification leaves",
                    " --out predicted"};
        case decision::verify:
            return {"verify",
                    "does a requirement hold for all parameters that an identification leaves?",
                    " --require \"always(" + y + " < 2)\""};
        case decision::control:
            return {"control",
                    "the gains of a control law that meet a requirement for all parameters that an "
                    "identification leaves",
                    " --law \"" + u + " = K * (1 - " + y + ")\" --gain K=0:5 --require \"" + y +
                        " at end in [0, 2]\""};
        case decision::design:
            break;
        }
        return {"design",
                "the experiment whose data narrow down a parameter most, whatever the truth among "
                "those that an identification leaves",
                " --vary " + u + "=0:1 --halve " + p + " --out next"};
    }

    /// What `predict`, `verify` and `control` are told of a control law.
    void add_law(CLI::App& s, decision what) {
        auto& c = decision_;
        auto* const law = s.add_option("--law", c.law,
                                       "what commands inputs, such as \"W = clamp(K * (2 - u), 0, "
                                       "250)\"; separate several inputs by ;");
        auto* const gain = s.add_option("--gain", c.gain, "of the law: K=3, or a range, K=0:50");
        s.add_option("--sensor", c.sensor,
                     "error bounds of measured(...) in the law, such as u=0.02");
        s.add_option("--sampled", c.sampled,
                     "longest time between samples of the law, which holds its value between them, "
                     "in the model's unit of time; not given: it acts at every instant")
            ->check(number_between(0.0, 1e9));
        s.add_option("--delay", c.delay,
                     "longest time from a sample to its effect on the input, in that unit")
            ->check(number_between(0.0, 1e9));
        s.add_option("--slew", c.slew,
                     "how fast a sampled law may change an input, such as delta=2, in its unit per "
                     "unit of time; proved with the rest");
        if (what != decision::control) return;
        law->required();
        gain->required();
        s.add_option("--boxes", c.boxes, "boxes of gains that are tested, at most")
            ->check(number_between(1.0, 1e15))
            ->capture_default_str();
    }

    /// What `design` is told.
    void add_design(CLI::App& s) {
        auto& c = decision_;
        auto* const halve = s.add_option(
            "--halve", c.goal,
            "what is to become known better: a parameter, or an expression of parameters such as "
            "\"L * Sg\"; several: each of them; volume: all of them together");
        auto* const against =
            s.add_option("--against", c.against,
                         "another result for the same data, with other effects: the experiment is "
                         "to refute one of the two models, whichever it is");
        halve->excludes(against);
        s.add_option("--share", c.target,
                     "the share of its width, or of the volume, that may be left")
            ->check(number_between(0.0, 1.0))
            ->capture_default_str();
        s.add_option("--vary", c.vary,
                     "inputs that may be chosen, and their limits, such as W=0:100")
            ->required();
        s.add_option("--within", c.requirement,
                     "what has to hold of the motion for all parameters, such as "
                     "\"always(abs(psi) < 1)\"");
        s.add_option("--name", c.name,
                     "of the experiment, in scenario.json; not given: that of the scenario and "
                     "\"-design\"");
        s.add_option("--measure", c.measure,
                     "what is measured and with which error at most, such as psi=0.01; not given: "
                     "the channels of the data, with their largest error");
        s.add_option("--duration", c.duration,
                     "of the experiment, in the model's unit of time; not given: the scenario's, "
                     "which also gives the start and the inputs that are not varied")
            ->check(number_between(0.0, 1e9));
        s.add_option("--period", c.period,
                     "of the measurements, in the model's unit of time; not given: as in the data")
            ->check(number_between(0.0, 1e9));
        add_exit_codes(s, "0 an experiment with that promise is found, 2 bad input, 3 none is "
                          "found, or one that promises less, 5 no experiment can, as the equations "
                          "hide the goal and the prior does not help (proved).");
    }

    void add_rank() {
        auto& c = rank_;
        auto* const s = add(c, "rank",
                            "how far each parameter alone can move the measurements of a data set "
                            "or scenario, within proved bounds",
                            "data --out ranked", [this, &c] {
                                if (!c.scenario.empty()) c.unknown = unknown_from(of_, unknown_);
                                return run(of_, c);
                            });
        auto* const dataset = s->add_option("dataset", c.dataset, "folder with dataset.json");
        s->add_option("--with", c.effects, "of a data set: effects to join to the model")
            ->delimiter(',');
        add_scenario(*s, c.scenario, ", all: instead of a data set");
        s->get_option("--scenario")->excludes(dataset)->excludes("--with");
        add_unknown(*s, "of a scenario: the constants to rank")->excludes(dataset);
        s->add_option("--measure", c.measure,
                      "of a scenario: what is measured and within which error bound, such as "
                      "psi=0.01")
            ->excludes(dataset);
        s->add_option("--rate", c.rate, "of a scenario: measurements a unit of time")
            ->check(number_between(1e-9, 1e5))
            ->capture_default_str();
        add_disturbances(*s, c);
        add_out(*s, c, "ranking.html and ranking.json")->required();
        add_budget(*s, c.budget, "seconds; it ends earlier when all bounds are close");
        add_enclosing(*s, c.how);
    }

    void add_disturbance() {
        auto& c = disturbance_;
        auto* const s =
            add(c, "disturbance",
                "the least unknown disturbance of equations and channels with which "
                "the model explains a data set, within proved bounds",
                "data --on EQUATION=SCALE --out disturbed", [this, &c] { return run(of_, c); });
        s->add_option("dataset", c.dataset, "folder with dataset.json")->required();
        s->add_option("--on", c.on,
                      "equations that are disturbed, and how much a size of 1 means there, in the "
                      "state's unit per time: v=0.01");
        s->add_option("--error", c.errors,
                      "channels that may be further off than their bounds, and how much a size of "
                      "1 means there: psi=0.01");
        s->add_option("--with", c.effects, "effects of the catalogue, joined to the model")
            ->delimiter(',');
        s->add_option("--curve", c.curve,
                      "points of the trade-off between sizes of equations and of channels, in "
                      "curve.csv")
            ->check(CLI::Range(2, 100));
        add_out(*s, c, "disturbance.html, disturbance.json and disturbance.csv")->required();
        add_budget(*s, c.budget, "seconds; it ends earlier when the bounds are close");
        add_exit_codes(*s, "0 bounded from both sides, within a factor of 2, 2 bad input, 3 not "
                           "within that.");
    }

    void add_report() {
        auto& c = report_;
        auto* const s = add(c, "report", "the pages of a stored result of any command anew",
                            "result --out page", [this, &c] { return run(of_, c); });
        s->add_option("result", c.result, "folder with files *.page.json")->required();
        add_out(*s, c, "the pages; not given: that of the result");
    }

    void add_export() {
        auto& c = export_;
        auto* const s = add(c, "export",
                            "a parameter that is proved to explain the data, in a simulator's file",
                            "result --to mjcf --into arm.xml --map map.json --out arm_fitted.xml",
                            [this, &c] { return run(of_, c); });
        s->add_option("result", c.result, "folder with result.json, or with diagnosis.json")
            ->required();
        s->add_option("--to", c.to, "what is written")
            ->required()
            ->check(CLI::IsMember({"mjcf", "urdf", "isaaclab", "json"}));
        s->add_option("--into", c.into, "the MJCF or URDF file to change; it stays as it is");
        s->add_option("--map", c.map, "which constant is which attribute (sivid-export-1)");
        s->add_option("--out", c.out,
                      "the file to write; OUT.note.txt and OUT.ranges.json stand beside it")
            ->required();
        s->add_option("--dataset", c.dataset, "its data set, if it is not where the result says");
        add_exit_codes(*s, "0 written, 2 bad input, 3 no parameter is proved to explain the data, "
                           "4 none does (proved), 5 refuted: the result is not what its data "
                           "prove.");
    }

    void add_describe() {
        auto& c = describe_;
        auto* const s = add(c, "describe",
                            "the model: names, units, and its equations as recorded, line by line",
                            "", [this, &c] { return run(of_, c); });
        s->add_flag("--dot", c.dot, "the graph in the DOT language of Graphviz");
        s->add_option("--unknown", c.unknown,
                      "as bound for identification: these constants stay, the others are folded")
            ->delimiter(',');
    }

    void add_fleet() {
        auto& c = fleet_;
        auto* const s = add(
            c, "fleet",
            "identify or diagnose many data sets, each by a process of its own, with one summary; "
            "what is finished is kept, so the same command goes on",
            "diagnose data1 data2 --out fleet --jobs 2", [this] { return run_fleet_of_robot(); });
        s->add_option("what", fleet_of_, "identify or diagnose")
            ->required()
            ->check(CLI::IsMember({"identify", "diagnose"}));
        s->add_option("folders", c.folders, "data sets, or folders of data sets")->required();
        add_out(*s, c, "fleet.csv, fleet.json and a folder for each")->required();
        s->add_option("--jobs", c.jobs, "processes at once (of rank 0; the other ranks one each)")
            ->check(CLI::Range(1, 1024))
            ->capture_default_str();
        s->add_option("--task", fleet_task_,
                      "K/N: only every N-th data set, from the K-th on; for N machines or a job "
                      "array. The summary has all that have a result by then");
        s->add_option("--budget", fleet_budget_, "seconds for each data set")
            ->check(number_between(0.0, 1e9));
        s->add_option("--within", c.within, "seconds for all; what runs then is stopped")
            ->check(number_between(0.0, 1e9));
        s->add_option("--with-options", fleet_options_,
                      "further options of the command, in one text: \"--accuracy 0.01\"");
        s->add_flag("--again", c.again, "repeat what is finished, too");
    }
    int run_fleet_of_robot() {
        auto& c = fleet_;
        c.words = {fleet_of_};
        if (!of_.file.empty()) c.words.push_back(of_.file);
        if (fleet_budget_) c.options = {"--budget", nearest_text(*fleet_budget_)};
        std::istringstream words(fleet_options_);
        for (std::string word; words >> word;) c.options.push_back(word);
        if (fleet_of_ == "diagnose" && fleet_options_.find("--threads") == std::string::npos)
            c.options.insert(c.options.end(), {"--threads", "1"});
        if (!fleet_task_.empty()) {
            std::string const what = "--task: write K/N with K from 1 to N";
            auto const slash = std::min(fleet_task_.find('/'), fleet_task_.size() - 1);
            auto const k = whole_number(fleet_task_.substr(0, slash), what);
            auto const n = whole_number(fleet_task_.substr(slash + 1), what);
            if (k < 1 || k > n) throw bad_request(what + ", not " + in_quotes(fleet_task_));
            c.task = {k, n};
        }
        return run_fleet(c);
    }

    robot of_;
    std::string line_;
    ranks const* all_;
    CLI::App app_;
    std::vector<std::string> chosen_; ///< of the variants
    import_command import_;
    robot_import robot_;
    simulate_command simulate_;
    generate_command generate_;
    identify_command identify_;
    online_command online_;
    confidence_command confidence_;
    check_command check_;
    certificate_command certificate_;
    diagnose_command diagnose_;
    decision_command decision_;
    enclosing decision_how_{.set = "taylor-model"};
    rank_command rank_;
    disturbance_command disturbance_;
    report_command report_;
    export_command export_;
    describe_command describe_;
    fleet_command fleet_;
    std::string fleet_of_, fleet_task_, fleet_options_;
    std::optional<double> fleet_budget_;
    std::string relative_, outliers_, threshold_, bounds_hold_, outliers_for_;
    std::vector<std::string> absolute_, unknown_, set_;
    bool combined_ = false, hold_ = false;
    std::function<int()> action_;
};

/// The command as it was given, the file of a model included.
inline std::string line_of(robot const& r, int argc, char** argv) {
    std::vector<char*> told(argv, argv + argc);
    auto file = r.file;
    if (!file.empty() && argc > 1) told.insert(told.begin() + 2, file.data());
    return command_line(r.name, static_cast<int>(told.size()), told.data());
}

} // namespace detail

SIVID_DECL command_answer run_within(host const& h, robot const& r,
                                     std::vector<std::string> const& words) {
    auto all = words;
    all.insert(all.begin(), r.name);
    std::vector<char*> argv;
    for (auto& word : all) argv.push_back(word.data());
    argv.push_back(nullptr);
    int const argc = static_cast<int>(all.size());
    ranks const one{};
    detail::hosting const hosted(h);
    std::ostringstream results, notices;
    outputs const to{results, notices};
    detail::speaking const there(to);
    detail::program program(r, detail::line_of(r, argc, argv.data()), one);
    int const code = program(argc, argv.data());
    return {code, results.str(), notices.str()};
}

SIVID_DECL int run(robot const& r, int argc, char** argv, outputs const& to,
                   cluster::job_start start) {
    auto const line = detail::line_of(r, argc, argv);
    return guarded_on_ranks(r.name, start, argc, argv, to, [&](ranks const& all) {
        return detail::program(r, line, all)(argc, argv);
    });
}

} // namespace sivid::app

#endif
