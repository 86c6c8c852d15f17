// SPDX-License-Identifier: MIT
#include "influence.hpp"

#include <sivid/app/console.hpp>
#include <sivid/app/program.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/number/decimal_output.hpp>
#include <sivid/report/draw/charts.hpp>
#include <sivid/report/page.hpp>

#include <algorithm>

namespace hovercraft_example {

namespace {

namespace report = sivid::report;

/// Widened a little where the bounds agree to many digits, so that they read well.
report::range readable(sivid::interval const& x) {
    double const more = 2e-4 * x.upper();
    return width(x) > more ? report::range{x} : report::range{x.lower() - more, x.upper() + more};
}

std::string ranking_csv(std::vector<ranked_equation> const& ranking) {
    std::string text = "equation,unit,constant,prior_lower,prior_upper,effect_lower,effect_upper\n";
    for (auto const& e : ranking)
        for (auto const& p : e.effects) {
            if (!p.occurs) continue;
            text += e.state + "'," + e.unit + "," + p.constant + "," +
                    sivid::to_decimal_lower(p.prior.lower()) + "," +
                    sivid::to_decimal_upper(p.prior.upper()) + "," +
                    sivid::to_decimal_lower(p.effect.lower()) + "," +
                    sivid::to_decimal_upper(p.effect.upper()) + "\n";
        }
    return text;
}

partial_effect const* effect(std::vector<ranked_equation> const& ranking, std::string const& state,
                             std::string const& constant) {
    for (auto const& e : ranking)
        for (auto const& p : e.effects)
            if (e.state == state && p.constant == constant) return &p;
    return nullptr;
}

/// One entry of Table 2.2 against what is proved.
std::string judge(sivid::model_description const& about,
                  std::vector<ranked_equation> const& ranking, std::string const& state,
                  std::string const& constant) {
    auto const* const found = effect(ranking, state, constant);
    if (found == nullptr) {
        auto const k = sivid::index_of(about.constants, constant, "constant");
        return "is no constant of its own: " + constant + " = " + about.constants[k].formula;
    }
    auto const& p = *found;
    if (!p.occurs) return std::string{"does not occur in "} + state + "'";
    double most = 0;
    std::size_t rank = 1;
    for (auto const& e : ranking) {
        if (e.state != state) continue;
        most = e.effects.front().effect.upper();
        for (auto const& other : e.effects) rank += other.effect.lower() > p.effect.upper() ? 1 : 0;
    }
    return std::string{"effect in "} +
           report::outward_text(readable(p.effect), {.significant = 2}) + " " +
           report::unit_text(p.unit) + ": at best rank " + std::to_string(rank) + ", at most " +
           report::rounded_text(100 * (p.effect.upper() / most), report::rounding::up,
                                {.significant = 2}) +
           " % of the strongest one's bound";
}

std::vector<std::string> what_is_bounded(sivid::recorded_model const& model,
                                         std::vector<std::string> const& freed) {
    auto const ranges = default_ranges();
    std::vector<std::string> stated;
    for (std::size_t i = 0; i < ranges.states.size(); ++i)
        stated.push_back(model.about.states[i].name + " in " +
                         report::given_text(ranges.states[i]) + " " +
                         report::unit_text(model.about.states[i].unit));
    stated.push_back("W = " + report::given_text(ranges.thrust_speed) + " 1/s, delta in " +
                     report::given_text(ranges.rudder) + " rad");
    stated.push_back("priors: Sv, Sg and L those of Table 2.3, D11 in [0, 0.1] kg/s, every other "
                     "constant 10 % about its nominal value");
    for (auto const& d : model.about.constants) {
        if (d.formula.empty()) continue;
        bool const free = std::find(freed.begin(), freed.end(), d.name) != freed.end();
        stated.push_back(free ? d.name + " is free, although " + d.name + " = " + d.formula
                              : d.name + " = " + d.formula +
                                    ": its part is in the effects of the constants in it");
    }
    return stated;
}

/// Strongest first, drawn and printed.
report::figure bars_of(std::vector<ranked_equation> const& ranking) {
    report::figure figure{.panels = {},
                          .title = "Effects on the state equations, strongest first.",
                          .caption = "Constants that do not occur in an equation are left out; x', "
                                     "y' and psi' contain none.",
                          .layout = report::panel_layout::wide};
    for (auto const& e : ranking) {
        std::vector<report::bar> bars;
        for (auto const& p : e.effects)
            if (p.occurs) bars.push_back({.label = p.constant, .value = readable(p.effect)});
        if (bars.empty()) continue;
        figure.panels.push_back(report::draw_bar_chart(
            bars, {.title = e.state + "'", .quantity = "effect", .unit = e.unit}));
        sivid::app::result_stream() << e.state << "':";
        for (auto const& b : bars)
            sivid::app::result_stream()
                << " " << b.label << " " << report::outward_text(b.value, {.significant = 2});
        sivid::app::result_stream() << "\n";
    }
    return figure;
}

/// Table 2.2 against what is proved.
report::table compared(sivid::model_description const& about,
                       std::vector<ranked_equation> const& ranking) {
    report::table table{.columns = {{"equation", report::column_kind::symbol},
                                    {"constant", report::column_kind::symbol},
                                    {"the report says"},
                                    {"proved here", report::column_kind::note}},
                        .rows = {}};
    auto const compare = [&](std::string const& state, std::string const& says,
                             std::vector<std::string> const& constants) {
        for (auto const& name : constants)
            table.rows.push_back({state + "'", name, says, judge(about, ranking, state, name)});
    };
    compare("u", "important", {"Sv"});
    compare("u", "negligible", {"D11", "rho", "Cd", "Su"});
    compare("v", "negligible", {"D22", "rho", "Cd", "Sv", "A"});
    compare("r", "important", {"L", "Sg"});
    compare("r", "negligible", {"D22", "Iz", "A"});
    return table;
}

} // namespace

int influence(sivid::recorded_model const& model, std::filesystem::path const& out,
              std::vector<std::string> const& freed, std::string const& command_line) {
    auto const ranking = rank_constants(model, default_ranges(), freed);
    sivid::app::prepare_folder(out);
    report::page page{{.kind = "Influence of the constants",
                       .title = "Table 2.2 with proof",
                       .lead = "How much can each constant, moved through its prior, change each "
                               "state equation?"}};
    page.section("What is bounded");
    page.prose(
        "The effect of a constant c on an equation is the width of its prior times the "
        "largest size of the equation's partial derivative by c, over all states and inputs "
        "in the ranges below and all constants in their priors. The bar is full up to a "
        "lower bound and hatched up to an upper bound, both proved: from below by interval "
        "evaluation at points, from above by interval evaluation over boxes, which shrink to "
        "the ends of the priors in which the equation is affine.");
    page.bullets(what_is_bounded(model, freed));
    page.section("Ranking");
    page.add(bars_of(ranking));
    page.section("The report's Table 2.2 against this");
    auto const table = compared(model.about, ranking);
    page.add(table);
    page.footer(sivid::app::page_footer(command_line));
    for (auto const& row : table.rows)
        if (row[3].find("does not occur") == 0 || row[3].find("is no constant") == 0)
            sivid::app::result_stream() << "the report calls " << row[1] << " " << row[2] << " for "
                                        << row[0] << ", but it " << row[3] << "\n";
    sivid::file_set files(out);
    files.add("influence.csv", ranking_csv(ranking));
    files.add("influence.html", page.str());
    files.commit();
    sivid::app::result_stream() << "written: " << (out / "influence.html").string() << "\n";
    return sivid::app::done;
}

} // namespace hovercraft_example
