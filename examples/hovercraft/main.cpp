// SPDX-License-Identifier: MIT
// hovercraft identify | check | predict | verify | diagnose | fleet | generate | simulate | rank |
// describe: the reference example on the command line.
#include "commands.hpp"
#include "console/decision_options.hpp"
#include "console/fleet.hpp"
#include "console/number_range.hpp"
#include "console/parameter_ranges.hpp"
#include "console/program.hpp"
#include "console/ranks.hpp"

#include <CLI/CLI.hpp>

#include <charconv>
#include <functional>
#include <map>
#include <optional>
#include <sivid/number/text/joined.hpp>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace {

using namespace hovercraft_example;
using sivid::exact_decimal;

exact_decimal decimal(std::string const& text, std::string const& what) {
    auto const value = exact_decimal::parse(text);
    if (!value || !sivid::enclose(*value))
        throw bad_request(what + ": " + sivid::in_quotes(text) + " is not a decimal number");
    return *value;
}

/// "name=value" as a pair.
std::pair<std::string, std::string> assignment(std::string const& text, std::string const& what) {
    auto const equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw bad_request(what + ": write name=value, not " + sivid::in_quotes(text));
    return {text.substr(0, equals), text.substr(equals + 1)};
}

std::map<std::string, exact_decimal> constants_from(std::vector<std::string> const& list) {
    std::map<std::string, exact_decimal> result;
    for (auto const& text : list) {
        auto const [name, value] = assignment(text, "--set");
        if (!result.emplace(name, decimal(value, std::string{"--set "} + name)).second)
            throw bad_request(std::string{"--set "} + name + " is given twice");
    }
    return result;
}

/// tenths * nominal / 10, exactly.
exact_decimal tenths(exact_decimal const& nominal, std::size_t n) {
    return *exact_decimal::parse(nominal.times(n).text() + "e-1");
}

/// The prior of an unknown constant: the report's, or 10 % about the nominal value.
unknown_parameter default_prior(std::string const& name) {
    if (name == "Sv") return {name, decimal("0.20", name), decimal("0.25", name)};
    if (name == "Sg") return {name, decimal("0.0042", name), decimal("0.0754", name)};
    if (name == "L") return {name, decimal("0.25", name), decimal("0.35", name)};
    for (auto const& c : hovercraft::constants) {
        if (c.name != name) continue;
        auto const nominal = exact_decimal::shortest(sivid::nearest(c.nominal));
        if (nominal.is_zero())
            throw bad_request(std::string{"--unknown "} + name +
                              ": its nominal value is 0, give a prior as " + name + "=lower:upper");
        return {name, tenths(nominal, 9), tenths(nominal, 11)};
    }
    throw bad_request(std::string{"unknown constant "} + sivid::in_quotes(name) +
                      "; the model has: " + sivid::joined_names(hovercraft::constants));
}

std::vector<unknown_parameter> unknown_from(std::vector<std::string> const& list) {
    std::vector<unknown_parameter> result;
    for (auto const& text : list) {
        if (text.find('=') == std::string::npos) {
            result.push_back(default_prior(text));
            continue;
        }
        auto const [name, range] = assignment(text, "--unknown");
        auto const colon = range.find(':');
        if (colon == std::string::npos)
            throw bad_request(std::string{"--unknown "} + name +
                              ": write the prior as lower:upper");
        result.push_back({name, decimal(range.substr(0, colon), std::string{"--unknown "} + name),
                          decimal(range.substr(colon + 1), std::string{"--unknown "} + name)});
        for (auto const& end : {result.back().lower, result.back().upper})
            if (mag(*sivid::enclose(end)) > sivid::farthest_range)
                throw bad_request(std::string{"--unknown "} + name + ": " + end.text() +
                                  " is beyond 1e100; state what is physically possible");
    }
    return result;
}

/// The options that several commands share.
struct shared_text {
    std::string lift = "as-printed", friction = "unit-vector";
    std::vector<std::string> set;

    [[nodiscard]] hovercraft craft() const {
        hovercraft result;
        if (lift == "rudder") result.lift = hovercraft::lift_area::rudder;
        if (friction == "as-printed") result.friction = hovercraft::friction_law::as_printed;
        return result;
    }
};

void add_variants(CLI::App& command, shared_text& shared) {
    command.add_option("--lift", shared.lift, "area in the rudder's lift of equation (2.2b)")
        ->check(CLI::IsMember({"as-printed", "rudder"}))
        ->capture_default_str();
    command.add_option("--friction", shared.friction, "direction of the dry friction")
        ->check(CLI::IsMember({"unit-vector", "as-printed"}))
        ->capture_default_str();
}

/// Takes the kind of sets out of a list that else assigns values to constants.
void take_set(std::vector<std::string>& list, enclosing& how) {
    for (auto const* const kind : {"first-order", "taylor-model"}) {
        if (std::erase(list, kind) > 0) how.set = kind;
    }
}

void add_method(CLI::App& command, enclosing& how, std::string const& what) {
    command
        .add_option("--method", how.method,
                    what + " follow the Taylor series or a validated Runge-Kutta method")
        ->check(CLI::IsMember(method_names()))
        ->capture_default_str();
}
void add_enclosing(CLI::App& command, enclosing& how) {
    add_method(command, how, "enclosures");
    command
        .add_option("--set", how.set,
                    "sets that are carried: of first order (doubletons), or Taylor models")
        ->check(CLI::IsMember({"first-order", "taylor-model"}))
        ->capture_default_str();
}

/// The program: what is parsed, then run by `action`.
class program {
public:
    program(std::string command_line, console::ranks const& ranks)
        : line_{std::move(command_line)}, ranks_{&ranks} {
        app_.require_subcommand(1);
        add_identify();
        add_check();
        add_decision("predict", console::decision::predict);
        add_decision("verify", console::decision::verify);
        add_decision("control", console::decision::control);
        add_decision("design", console::decision::design);
        add_diagnose();
        add_fleet();
        add_generate();
        add_simulate();
        add_rank();
        add_describe();
    }

    int operator()(int argc, char** argv) {
        try {
            app_.parse(argc, argv);
        } catch (CLI::ParseError const& e) {
            return app_.exit(e) == 0 ? 0 : static_cast<int>(console::bad_input);
        }
        auto const command = app_.get_subcommands().front()->get_name();
        if (ranks_->several() && command != "identify" && command != "diagnose" &&
            command != "fleet")
            throw bad_request(command + " runs in one process: start it without mpirun");
        return action_();
    }

private:
    void add_identify() {
        auto* const s = app_.add_subcommand(
            "identify", "which parameters can explain a recorded campaign, with proof");
        auto& c = identify_;
        s->add_option("dataset", c.dataset, "folder with dataset.json")->required();
        s->add_option("--out", c.out, "folder for report.html, result.json and tables")->required();
        s->add_option("--with", c.effects,
                      "effects to join to the model, separated by commas: their parameters are "
                      "identified, too")
            ->delimiter(',');
        s->add_option("--algorithm", c.algorithm, "contracting, or the report's Algorithm 1 or 2")
            ->check(CLI::IsMember({"contracting", "report-1", "report-2"}))
            ->capture_default_str();
        add_enclosing(*s, c.how);
        s->add_option("--accuracy", accuracy_,
                      "leave boxes undecided when no side is wider than this share of what is left "
                      "(report-1, report-2: of the prior). When given, nothing but a budget ends "
                      "the search before; without it (0.003), half of what is left being proved "
                      "inside does, too")
            ->check(console::number_between(1e-15, 1.0));
        s->add_option("--budget", c.budget, "seconds, from when the data are read")
            ->check(console::number_between(0.0, 1e9))
            ->capture_default_str();
        s->add_option("--boxes", c.boxes, "number of boxes to test, at most")
            ->check(console::number_between(0.0, 1e15)); // below 0 it would become very many
        s->add_option("--memory", c.memory,
                      "memory for boxes and what is known about them [MB], at most")
            ->check(console::number_between(0.0, 1e9));
        s->add_option("--checkpoint", c.checkpoint,
                      "seconds from one save of the search in OUT/checkpoint.txt to the next")
            ->check(console::number_between(0.0, 1e9));
        s->add_flag("--resume", c.resume,
                    "go on from OUT/checkpoint.txt, after a kill or with larger budgets; keeps "
                    "saving, every 10 s unless --checkpoint says otherwise");
        s->add_option("--threads", c.threads, "threads (0: all); the result does not depend on it")
            ->check(CLI::Range(0, 1024))
            ->capture_default_str();
        s->add_option(
             "--batches", c.batches,
             "sets of boxes that are enclosed at a time: more of them give work to more ranks or "
             "threads. The result depends on this number, not on ranks and threads")
            ->check(CLI::Range(1, 65536))
            ->capture_default_str();
        s->add_option("--outliers", outliers_,
                      "outliers allowed in each scenario, instead of the data set's own fraction; "
                      "auto: the fewest that explain the data, with proof that fewer do not");
        s->add_option("--threshold", threshold_,
                      "the outliers allowed as Algorithm 2 of the report prints them: with n "
                      "measurements ceil(n * threshold) - 1 in each scenario");
        s->add_flag("--compare", c.compare,
                    "spend 40 % of the budget on the report's Algorithm 1 and show both");
        s->add_flag("--verdict-only", c.verdict_only,
                    "stop as soon as it is proved whether any parameter explains the data");
        s->add_option("--picture", c.picture,
                      "a channel to draw on its own, in OUT/<scenario>.<channel>.svg");
        s->add_flag("--online", c.online,
                    "feed the measurements in the order of time, and print what each update took");
        s->add_flag("--identifiability", c.identifiability,
                    "also say which parameters such data can tell at all");
        s->add_flag("--quiet", c.quiet, "no progress");
        s->add_flag("--verbose", c.verbose, "what was tried before the search, and why");
        add_variants(*s, shared_);
        s->callback([this] {
            action_ = [this] {
                identify_.craft = shared_.craft();
                read_outliers();
                identify_.accuracy = accuracy_;
                identify_.command_line = line_;
                identify_.ranks = ranks_;
                return run(identify_);
            };
        });
    }

    void read_outliers() {
        if (!threshold_.empty()) {
            if (!outliers_.empty()) throw bad_request("give --outliers or --threshold, not both");
            if (identify_.algorithm == "report-1")
                throw bad_request("--threshold: Algorithm 1 allows no outlier; use report-2");
            auto const h = decimal(threshold_, "--threshold");
            if (!h.is_positive() || decimal("1", "") < h)
                throw bad_request("--threshold must be above 0 and at most 1: with 0 every box "
                                  "would be rejected");
            identify_.outliers = sivid::outlier_rule::threshold(h);
        }
        identify_.fewest_outliers = outliers_ == "auto";
        if (outliers_.empty() || identify_.fewest_outliers) return;
        std::size_t count = 0;
        auto const* const end = outliers_.data() + outliers_.size();
        auto const read = std::from_chars(outliers_.data(), end, count);
        if (read.ec != std::errc{} || read.ptr != end)
            throw bad_request(std::string{"--outliers: write a whole number or auto, not "} +
                              sivid::in_quotes(outliers_));
        identify_.outliers = sivid::outlier_rule(count);
    }

    void add_check() {
        auto* const s =
            app_.add_subcommand("check", "prove the result of `identify` or `diagnose` anew");
        auto& c = check_;
        s->add_option("result", c.result,
                      "folder with result.json and boxes.csv, or with diagnosis.json")
            ->required();
        s->add_option("--dataset", c.dataset, "its data set, if it is not where the result says");
        s->add_flag("--all", c.all, "every box instead of a sample");
        s->add_option("--sample", c.sample,
                      "number of inside boxes and of excluded boxes in the sample")
            ->capture_default_str();
        s->add_option("--seed", c.seed, "of the sample")->capture_default_str();
        add_method(*s, c.how, "first-order sets of the check");
        s->add_option("--set", c.how.set, "refused: the check has sets of its own");
        s->add_option("--budget", c.budget, "seconds (10, of a diagnosis 60, with --all 3600)")
            ->check(console::number_between(0.0, 1e9));
        s->add_flag("--multiprecision", c.multiprecision,
                    "boxes too in 40 digits: 20 times slower");
        s->footer(
            "Exit codes: 0 every claim proved anew (--all), 2 bad input, 3 neither verified nor "
            "refuted (a sample, or not within the budget), 5 refuted: the result is not what its "
            "data prove.");
        add_variants(*s, shared_);
        s->callback([this] {
            action_ = [this] {
                check_.craft = shared_.craft();
                return run(check_);
            };
        });
    }

    void add_decision(char const* name, console::decision what) {
        auto* const s = app_.add_subcommand(name, about(what));
        std::string names = "a JSON file, data:NAME for one of the data set, or one of:";
        for (auto const& b : built_in_scenarios()) names += std::string{" "} + std::string{b.name};
        console::add_options(*s, what, decision_, names);
        s->get_option("--set")->description(
            s->get_option("--set")->get_description() +
            "; or the sets that are carried: taylor-model (the default), first-order");
        add_method(*s, decision_how_, "enclosures of motions");
        add_variants(*s, shared_);
        s->callback([this, what] {
            action_ = [this, what] {
                take_set(decision_.set, decision_how_);
                apply(decision_how_, decision_.run);
                decision_.command_line = line_;
                return run_decision(what, shared_.craft(), decision_);
            };
        });
    }

    void add_diagnose() {
        auto* const s = app_.add_subcommand(
            "diagnose",
            "where model and robot disagree, which effect it is, how far the gap shrinks");
        auto& c = diagnose_;
        s->add_option("dataset", c.dataset, "folder with dataset.json")->required();
        s->add_option("--out", c.out, "folder for report.html and diagnosis.json")->required();
        add_enclosing(*s, c.how);
        s->add_option("--budget", c.budget, "seconds; it ends earlier when nothing is left to do")
            ->check(console::number_between(0.0, 1e9))
            ->capture_default_str();
        s->add_option("--threads", c.threads, "threads (0: all); the result does not depend on it")
            ->check(CLI::Range(0, 1024))
            ->capture_default_str();
        s->add_flag("--quiet", c.quiet, "no progress");
        add_variants(*s, shared_);
        s->callback([this] {
            action_ = [this] {
                diagnose_.craft = shared_.craft();
                diagnose_.command_line = line_;
                diagnose_.ranks = ranks_;
                return run(diagnose_);
            };
        });
    }

    void add_fleet() {
        auto* const s = app_.add_subcommand(
            "fleet", "identify or diagnose many data sets, each by a process of its own, with one "
                     "summary; what is finished is kept, so the same command goes on");
        auto& c = fleet_;
        s->add_option("what", fleet_of_, "identify or diagnose")
            ->required()
            ->check(CLI::IsMember({"identify", "diagnose"}));
        s->add_option("folders", c.folders, "data sets, or folders of data sets")->required();
        s->add_option("--out", c.out, "folder for fleet.csv, fleet.json and a folder for each")
            ->required();
        s->add_option("--jobs", c.jobs, "processes at once (of rank 0; the other ranks one each)")
            ->check(CLI::Range(1, 1024))
            ->capture_default_str();
        s->add_option("--task", fleet_task_,
                      "K/N: only every N-th data set, from the K-th on; for N machines or a job "
                      "array. The summary has all that have a result by then");
        s->add_option("--budget", fleet_budget_, "seconds for each data set")
            ->check(console::number_between(0.0, 1e9));
        s->add_option("--within", c.within, "seconds for all; what runs then is stopped")
            ->check(console::number_between(0.0, 1e9));
        s->add_option("--with-options", fleet_options_,
                      "further options of the command, in one text: \"--accuracy 0.01\"");
        s->add_flag("--again", c.again, "repeat what is finished, too");
        s->add_flag("--quiet", c.quiet, "no progress");
        s->callback([this] {
            action_ = [this] {
                fleet_.command = {fleet_of_};
                if (fleet_budget_) {
                    fleet_.options = {"--budget", console::text_of("%.17g", *fleet_budget_)};
                }
                std::istringstream words(fleet_options_);
                for (std::string word; words >> word;) fleet_.options.push_back(word);
                if (fleet_of_ == "diagnose" &&
                    fleet_options_.find("--threads") == std::string::npos)
                    fleet_.options.insert(fleet_.options.end(), {"--threads", "1"});
                if (!fleet_task_.empty()) fleet_.task = read_task();
                fleet_.all = ranks_;
                return console::run_fleet(fleet_);
            };
        });
    }
    [[nodiscard]] std::pair<std::size_t, std::size_t> read_task() const {
        std::size_t k = 0, n = 0;
        auto const* const end = fleet_task_.data() + fleet_task_.size();
        auto const first = std::from_chars(fleet_task_.data(), end, k);
        bool good = first.ec == std::errc{} && first.ptr != end && *first.ptr == '/';
        if (good) {
            auto const second = std::from_chars(first.ptr + 1, end, n);
            good = second.ec == std::errc{} && second.ptr == end && 1 <= k && k <= n;
        }
        if (!good)
            throw bad_request(std::string{"--task: write K/N with K from 1 to N, not "} +
                              sivid::in_quotes(fleet_task_));
        return {k, n};
    }

    void add_generate() {
        auto* const s = app_.add_subcommand(
            "generate", "a data set from the validated motion of known parameters (section 3.3)");
        auto& c = generate_;
        auto& o = c.options;
        add_scenario(*s, c.scenario, c.out);
        s->add_option("--id", o.id, "name of the data set")->capture_default_str();
        s->add_option("--seed", o.seed, "of the noise and the outliers")->capture_default_str();
        s->add_option("--rate", o.rate, "measurements a second")->capture_default_str();
        s->add_option("--input-rate", o.input_rate, "input samples a second")
            ->capture_default_str();
        s->add_flag("--hold", hold_, "inputs hold between samples instead of going straight");
        s->add_option("--relative", relative_, "bound as a share of the value");
        s->add_option("--absolute", absolute_,
                      "bound in the channel's unit: one for all, or one each for u v r x y psi")
            ->expected(1, 6);
        s->add_flag("--combined", combined_, "the sum of the relative and the absolute bound");
        s->add_option("--noise", o.noise, "largest noise as a share of the bound, 0 to 1")
            ->check(console::number_between(0.0, 1.0))
            ->capture_default_str();
        s->add_option("--outliers", o.outliers, "samples spoilt on purpose in each scenario");
        s->add_option("--outlier-size", o.outlier_size, "their distance from the truth, in bounds")
            ->check(console::number_between(1.0, 1e9))
            ->capture_default_str();
        s->add_option("--set", shared_.set,
                      "true values, such as Sg=0.05; or the sets by which the true motion is "
                      "enclosed: first-order (the default), taylor-model");
        s->add_option("--unknown", unknown_, "what is to be identified: Sv,Sg,L or m=1.2:1.4")
            ->delimiter(',');
        add_method(*s, o.how, "enclosures of the true motion");
        add_variants(*s, shared_);
        s->callback([this] { action_ = [this] { return run_generate(); }; });
    }

    int run_generate() {
        auto& o = generate_.options;
        generate_.craft = shared_.craft();
        generate_.command_line = line_;
        if (!relative_.empty() && !absolute_.empty() && !combined_)
            throw bad_request("--relative and --absolute together need --combined");
        if (combined_ && (relative_.empty() || absolute_.empty()))
            throw bad_request("--combined needs --relative and --absolute");
        if (!relative_.empty()) {
            o.relative = decimal(relative_, "--relative");
            if (!o.relative->is_positive() || !(*o.relative < decimal("1", "")))
                throw bad_request("--relative must be above 0 and below 1");
        }
        for (auto const& text : absolute_) {
            o.absolute.push_back(decimal(text, "--absolute"));
            if (!o.absolute.back().is_positive()) throw bad_request("--absolute must be above 0");
        }
        if (o.absolute.size() == 1) o.absolute.resize(hovercraft::channels.size(), o.absolute[0]);
        o.interpolation = hold_ ? sivid::interpolation::hold : sivid::interpolation::linear;
        take_set(shared_.set, o.how);
        o.set = constants_from(shared_.set);
        o.unknown = unknown_from(unknown_);
        return run(generate_);
    }

    void add_simulate() {
        auto* const s =
            app_.add_subcommand("simulate", "trajectories by Boost.Odeint, as CSV and pictures");
        auto& c = simulate_;
        add_scenario(*s, c.scenario, c.out);
        s->add_option("--set", shared_.set,
                      "values of constants, such as Sg=0.05, or ranges, such as Ff=0.3:0.7: the "
                      "line is that of the middle, the proven tube that of all; or the sets that "
                      "tubes carry: first-order (the default), taylor-model (the default of "
                      "ranges)");
        s->add_option("--rate", c.rate, "rows of the CSV a second")->capture_default_str();
        s->add_option(
             "--input-rate", c.input_rate,
             "samples of the inputs a second, as in `generate`; not given: their exact shapes")
            ->check(console::number_between(1e-3, 1e5));
        s->add_flag("--validated", c.validated, "the proven tube beside it");
        add_method(*s, c.how, "the proven tubes");
        add_variants(*s, shared_);
        s->callback([this] {
            action_ = [this] {
                simulate_.craft = shared_.craft();
                take_set(shared_.set, simulate_.how);
                simulate_.set = console::ranges_from(shared_.set, "--set");
                simulate_.command_line = line_;
                return run(simulate_);
            };
        });
    }

    void add_rank() {
        auto* const s = app_.add_subcommand(
            "rank", "how far each constant can move the measurements of a data set or scenario, "
                    "or each state equation, within proved bounds");
        auto* const dataset =
            s->add_option("dataset", rank_.dataset,
                          "a folder with dataset.json; without it and --scenario: the state "
                          "equations");
        s->add_option("--scenario", rank_.scenario,
                      "all (S1, S2, S3), the name of a built-in one, or a JSON file: measured at "
                      "20 Hz, within the bounds of h3")
            ->excludes(dataset);
        s->add_option("--unknown", rank_.unknown, "of a scenario: the constants to rank")
            ->delimiter(',')
            ->excludes(dataset);
        s->add_option("--out", rank_.out, "folder for ranking.html and ranking.json or .csv")
            ->required();
        s->add_option("--budget", rank_.budget, "seconds; it ends earlier when bounds are close")
            ->check(console::number_between(0.0, 1e9))
            ->capture_default_str();
        add_enclosing(*s, rank_.how);
        s->add_option("--free", rank_.free,
                      "of the equations: constants to rank although they follow from others, such "
                      "as A")
            ->delimiter(',');
        s->add_flag("--quiet", rank_.quiet, "no progress");
        add_variants(*s, shared_);
        s->callback([this] {
            action_ = [this] {
                rank_.craft = shared_.craft();
                rank_.command_line = line_;
                return run(rank_);
            };
        });
    }

    void add_describe() {
        auto* const s = app_.add_subcommand(
            "describe", "the model: names, units, and its equations as recorded, line by line");
        s->add_flag("--dot", describe_.dot, "the graph in the DOT language of Graphviz");
        s->add_option("--unknown", describe_.unknown,
                      "as bound for identification: these constants stay, the others are folded")
            ->delimiter(',');
        add_variants(*s, shared_);
        s->callback([this] {
            action_ = [this] {
                describe_.craft = shared_.craft();
                return run(describe_);
            };
        });
    }

    static void add_scenario(CLI::App& s, std::string& scenario, std::filesystem::path& out) {
        std::string names = "all (S1, S2, S3), a JSON file, or one of:";
        for (auto const& b : built_in_scenarios()) names += std::string{" "} + std::string{b.name};
        s.add_option("--scenario", scenario, names)->required();
        s.add_option("--out", out, "folder for the result")->required();
    }

    CLI::App app_{"Validated identification of a hovercraft"};
    std::string line_;
    console::ranks const* ranks_;
    shared_text shared_;
    identify_command identify_;
    check_command check_;
    console::decision_command decision_;
    enclosing decision_how_{.set = "taylor-model"};
    diagnose_command diagnose_;
    console::fleet_command fleet_;
    std::string fleet_of_, fleet_task_, fleet_options_;
    std::optional<double> fleet_budget_;
    generate_command generate_;
    simulate_command simulate_;
    rank_command rank_;
    describe_command describe_;
    std::string relative_, outliers_, threshold_;
    std::optional<double> accuracy_;
    std::vector<std::string> absolute_, unknown_{"Sv", "Sg", "L"};
    bool combined_ = false, hold_ = false;
    std::function<int()> action_;
};

} // namespace

int main(int argc, char** argv) {
    auto const line = console::command_line("hovercraft", argc, argv);
    return console::guarded_on_ranks("hovercraft", argc, argv, [&](console::ranks const& ranks) {
        return program(line, ranks)(argc, argv);
    });
}
