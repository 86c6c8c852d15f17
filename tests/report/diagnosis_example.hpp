// SPDX-License-Identifier: MIT
#ifndef SIVID_TESTS_REPORT_DIAGNOSIS_EXAMPLE_HPP
#define SIVID_TESTS_REPORT_DIAGNOSIS_EXAMPLE_HPP

#include <sivid/report/diagnosis_page.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

/// A made-up diagnosis shaped like that of a hovercraft whose rudder lags. No number in it is
/// computed by the library; it only fills a page.
namespace sivid_tests {

struct diagnosis_example {
    sivid::diagnosis found;
    sivid::report::diagnosis_plot_data plots;
    sivid::report::diagnosis_report_options options;

    [[nodiscard]] sivid::report::diagnosis_view view() const {
        return sivid::report::view_of(found, plots, options);
    }
};

/// A yaw rate and its integral, answered by a rudder at once (tau = 0) or with a lag.
inline double example_output(std::size_t channel, double t, double phase, double tau) {
    double const w = 2.2, late = std::atan(w * tau) / w;
    double const gain = 1 / std::sqrt(1 + w * w * tau * tau);
    double const s = t - late;
    switch (channel) {
    case 0:
        return 1.4 + 0.5 * std::tanh(t) + 0.05 * std::sin(w * s + phase);
    case 1:
        return 0.3 * gain * std::sin(w * s + phase);
    case 2:
        return 0.8 * gain * std::cos(w * s + phase);
    case 3:
        return 1.6 * t;
    case 4:
        return 0.4 * t + 0.2 * gain * std::sin(w * s + phase);
    default:
        return 0.8 / w * gain * std::sin(w * s + phase);
    }
}

inline sivid::report::compared_scenario example_scenario(std::string name, bool holdout,
                                                         double phase, double duration) {
    static char const* const names[] = {"u", "v", "r", "x", "y", "psi"};
    static char const* const units[] = {"m/s", "m/s", "rad/s", "m", "m", "rad"};
    static double const bounds[] = {0.06, 0.05, 0.05, 0.05, 0.05, 0.03};
    sivid::report::compared_scenario out{.name = std::move(name), .holdout = holdout};
    for (std::size_t c = 0; c < 6; ++c) {
        sivid::report::channel_series d{.name = names[c], .unit = units[c]};
        double const e = bounds[c];
        for (int k = 0; k <= (c > 2 && c < 5 ? 20 : 40); ++k) {
            double const t = duration * k / (c > 2 && c < 5 ? 20 : 40);
            double const noise = 0.8 * std::sin(37.0 * k + 11.0 * static_cast<double>(c) + phase);
            double const y = example_output(c, t, phase, 0.17) + e * noise;
            bool const suspect = c == 1 && k == 17;
            d.measured.push_back({.time = t,
                                  .value = {y - e, y + e},
                                  .state = suspect ? sivid::report::sample_state::suspect
                                                   : sivid::report::sample_state::regular});
            if (suspect) continue;
            d.misfit_before.push_back({t, std::fabs(example_output(c, t, phase, 0) - y) / e});
            d.misfit_after.push_back({t, std::fabs(example_output(c, t, phase, 0.169) - y) / e});
        }
        for (int k = 0; k <= 200; ++k) {
            double const t = duration * k / 200, y = example_output(c, t, phase, 0.169);
            d.before.push_back({t, example_output(c, t, phase, 0)});
            d.after.push_back({t, y});
            if (holdout && !d.tube.empty()) d.tube.back().to = t;
            if (holdout) d.tube.push_back({t, t, {y - 0.4 * e, y + 0.4 * e}});
        }
        out.channels.push_back(std::move(d));
    }
    return out;
}

inline sivid::report::missing_rate example_rate(std::string equation, std::string scenario,
                                                double size, double phase) {
    sivid::report::channel_series c{.unit = size > 1 ? "rad/s^2" : "m/s^2"};
    for (int k = 0; k <= 60; ++k) {
        double const t = k / 12.0, y = size * std::sin(2.2 * t + phase);
        double const off = 0.15 * size + 0.5 * size * std::exp(-3 * t);
        c.after.push_back({t, y});
        c.band.push_back({t, t, {y - off, y + off}});
    }
    for (double const t : {0.3, 1.2, 2.4, 3.9}) {
        double const y = size * std::sin(2.2 * (t + 0.3) + phase);
        c.windows.push_back({t, t + 0.6, {y - 0.4 * size, y + 0.4 * size}});
    }
    return {std::move(equation), std::move(scenario), std::move(c)};
}

inline diagnosis_example hovercraft_diagnosis() {
    using sivid::interval;
    diagnosis_example e;
    sivid::diagnosis& d = e.found;
    d.gap = sivid::gap_verdict::certified;
    d.inflation = interval(3.1024, 3.1987);
    d.scenario_inflation = {{"S1", "", 1.2, interval(1.18, 1.21)},
                            {"S4", "", 3.15, interval(3.1024, 3.1987)},
                            {"S7", "", 2.02, std::nullopt}};
    d.channel_inflation = {{"r", "", 3.15, std::nullopt}, {"psi", "", 2.4, std::nullopt}};
    d.relations = {{"yaw",
                    {"r", "psi"},
                    true,
                    {"|r''| <= 40 rad/s^3", "inputs exact"},
                    {{"S4", 1.2, 2}, {"S4", 2.4, 3.1}}},
                   {"sway", {"u", "v", "r"}, false, {}, {{"S7", 0.4, 1.1}}}};
    d.where = {{"equation",
                "yaw",
                true,
                {"S4", 1.2, 2},
                interval(-0.4217, -0.1803),
                -0.3,
                "rad/s^2",
                "F_u * d(delta)/dt",
                "",
                {"input delta", "sensor r"}},
               {"equation",
                "sway",
                false,
                {"S7", 0.4, 1.1},
                std::nullopt,
                0.117,
                "m/s^2",
                "F_u * d(delta)/dt",
                "|delta| > 0.1 rad",
                {}},
               {"sensor", "psi", false, {"", 0, 0}, std::nullopt, std::nullopt, "rad", "", "", {}}};
    auto const add = [&](std::vector<std::string> effects, sivid::cause_verdict v, interval lambda,
                         double fitted, std::vector<sivid::named_estimate> parameters) {
        sivid::cause c;
        c.effects = std::move(effects);
        c.verdict = v;
        c.inflation = lambda;
        c.fitted_inflation = fitted;
        c.parameters = std::move(parameters);
        d.causes.push_back(std::move(c));
    };
    using enum sivid::cause_verdict;
    double const inf = std::numeric_limits<double>::infinity();
    add({"rudder_lag"}, explains, interval(0.9703, 0.9791), 0.972,
        {{"rudder_lag.tau", "s", 0.169, interval(0.1604, 0.1792), interval(0, 1)}});
    sivid::cause& lag = d.causes.back();
    lag.witness = sivid::named_witness{
        {{"Sv", "m^2", 0.2203, {}}, {"rudder_lag.tau", "s", 0.1690125, {}}},
        {{"S1", {{"u", "m/s", 0.1, {}}, {"v", "m/s", 0, {}}}}, {"S4", {{"u", "m/s", 2, {}}}}}};
    lag.assumptions = {"the rudder stands still at its commanded angle at t = 0"};
    auto& h = lag.holdout.emplace();
    h.inflation_before = interval(5.01, 5.08);
    h.inflation_after = interval(0.951, 1.07);
    h.over_fits_before = interval(4.6, 5.9);
    h.over_fits_after = interval(0.93, 1.21);
    h.channels = {"u", "v", "r", "x", "y", "psi"};
    h.rmse_before = {0.061, 0.093, 0.31, 0.12, 0.17, 0.14};
    h.rmse_after = {0.033, 0.028, 0.027, 0.03, 0.029, 0.017};
    h.covered_before = 0.412;
    h.covered_after = 0.978;
    h.width_before = 0.71;
    h.width_after = 0.84;
    add({"input_delay"}, undecided, interval(0.8, inf), 0.991,
        {{"input_delay.tau", "s", 0.144, std::nullopt, interval(0, 0.5)}});
    add({"rudder_lag", "quadratic_yaw_damping"}, undecided, sivid::unknown_inflation(), 0.966,
        {{"rudder_lag.tau", "s", 0.171, std::nullopt, interval(0, 1)},
         {"quadratic_yaw_damping.k", "N m s^2", 0.004, std::nullopt}});
    add({"rudder_deadband"}, excluded, interval(1.62, 1.71), 1.68,
        {{"rudder_deadband.b", "rad", 0.03, std::nullopt}});
    add({"motor_lag", "thrust_loss_with_speed"}, undecided, interval(0.61, inf), 1.94, {});
    add({"wind"}, excluded, interval(2.41, 2.63), 2.5,
        {{"wind.wx", "m/s", 0.71, std::nullopt, interval(-2, 2)},
         {"wind.wy", "m/s", -0.2, std::nullopt, interval(-2, 2)}});
    for (char const* const name : {"cg_offset", "ground_slope", "battery_sag", "payload",
                                   "dry_yaw_friction", "friction_anisotropy"}) {
        add({name}, undecided, sivid::unknown_inflation(),
            2.6 + 0.08 * static_cast<double>(d.causes.size()), {});
    }
    add({}, excluded, interval(3.1024, 3.1987), 3.15, {});
    d.answer = sivid::answer_kind::effects;
    d.effects = {"rudder_lag"};
    d.change = {
        {"a further state rudder_lag.delta starts at delta, with rudder_lag.delta' = (delta - "
         "rudder_lag.delta) / tau",
         "delta becomes rudder_lag.delta"},
        {{"rudder_lag.tau", "tau"}}};
    d.indistinguishable = {{"input_delay"}};
    d.unobservable = {"heading_bias"};
    d.shrink_fit = interval(0.99, 1.0);
    d.shrink_holdout = interval(0.9825, 1.0);
    d.next = sivid::next_experiment{
        "zigzag", {{"amplitude", "rad", 0.25, {}}, {"period", "s", 0.82, {}}}, 7.46, false};
    d.assumptions = {"inputs exact", "every measurement lies within its stated bound"};
    d.seconds = 48.2;

    for (auto const& [name, holdout, phase] :
         {std::tuple{"S1", false, 0.1}, {"S4", false, 0.9}, {"H1", true, 1.7}}) {
        e.plots.scenarios.push_back(example_scenario(name, holdout, phase, 5));
    }
    for (char const* const s : {"S1", "S4"}) {
        e.plots.missing_rates.push_back(example_rate("yaw", s, 1.4, s[1] * 0.5));
        e.plots.missing_rates.push_back(example_rate("sway", s, 0.2, s[1] * 0.3));
    }
    e.options.dataset = "dev000";
    e.options.model = "hovercraft";
    e.options.meanings = {{"rudder_lag", "a first-order lag of the rudder"},
                          {"input_delay", "a pure delay of the rudder command"}};
    e.options.date = "2026-01-31";
    e.options.machine = "2 cores";
    e.options.command = "hovercraft diagnose data/dev000 --out out";
    return e;
}

} // namespace sivid_tests

#endif
