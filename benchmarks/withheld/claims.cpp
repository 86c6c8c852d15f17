// SPDX-License-Identifier: MIT
// What a diagnosis proves about the truth itself, against a simulation of it.
#include "confined.hpp"
#include "judge.hpp"
#include "measure.hpp"
#include "reading.hpp"
#include "simulate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace withheld {

namespace {

/// Quadrature over a millisecond and the digits of the labels are finer.
constexpr double tolerance = 2e-4;

constexpr std::array<std::string_view, channel_count> equation_names{"surge", "sway", "yaw",
                                                                     "x",     "y",    "psi"};

template <class Names>
std::optional<std::size_t> index_in(Names const& all, std::string const& n) {
    auto const place = std::find(all.begin(), all.end(), n);
    if (place == all.end()) return std::nullopt;
    return static_cast<std::size_t>(place - all.begin());
}

/// The true motion over a window, every millisecond.
struct true_motion {
    world truth, base; // base: the model, at the true constants, without anything wrong
    channels start{};
    std::vector<double> t;
    std::vector<state> states;

    /// The mean of a function of the index over the window.
    template <class F>
    double mean(F const& f) const {
        double sum = 0;
        for (std::size_t i = 0; i + 1 < t.size(); ++i)
            sum += (f(i) + f(i + 1)) / 2 * (t[i + 1] - t[i]);
        return sum / (t.back() - t.front());
    }
    command recorded(std::size_t i) const { return {base.motor.at(t[i]), base.rudder.at(t[i])}; }
};

std::optional<true_motion> motion_over(label const& l, recording const& data,
                                       std::string const& scenario, double from, double to) {
    auto const place = std::find_if(data.scenarios.begin(), data.scenarios.end(),
                                    [&](auto const& s) { return s.plan.name == scenario; });
    if (place == data.scenarios.end() || !(from < to)) return std::nullopt;
    auto const& plan = place->plan;
    if (from < 0 || to > plan.duration + 1e-9) return std::nullopt;
    true_motion m;
    m.truth = true_world(l, data.fixed, plan);
    m.base.c = m.truth.c;
    m.base.motor = plan.motor;
    m.base.rudder = plan.rudder;
    for (std::size_t k = 0; k < channel_count; ++k) m.start[k] = plan.initial[k].middle();
    m.start = true_start(l, scenario).value_or(m.start);
    auto const cells = static_cast<int>(std::max(200.0, std::ceil((to - from) / 1e-3)));
    for (int i = 0; i <= cells; ++i) m.t.push_back(from + (to - from) * i / cells);
    m.states = states_at(m.truth, m.start, m.t, careful_step);
    return m;
}

/// What equation i lacks on the average: the true change less what the model's rate integrates to
/// along the true motion.
double missing_rate(true_motion const& m, std::size_t i) {
    double const change = m.states.back()[i] - m.states.front()[i];
    double const modelled = m.mean([&](std::size_t n) {
        return derivative(m.base, m.t[n], m.recorded(n), m.states[n], {})[i];
    });
    return change / (m.t.back() - m.t.front()) - modelled;
}

/// What the sensor shows beside its channel, on the average.
double sensor_offset(true_motion const& m, std::size_t k) {
    auto const shown = readings(m.truth, m.start, m.t, careful_step);
    return m.mean([&](std::size_t n) { return shown[n][k] - m.states[n][k]; });
}

/// What acts beside the recorded input, on the average.
double input_offset(true_motion const& m, bool rudder) {
    auto const& w = m.truth;
    auto const driven = driven_rudder(w);
    return m.mean([&](std::size_t n) {
        double const t = m.t[n], seen = std::max(t - w.e.input_delay, 0.0);
        bool const begun = w.acting.holds(t);
        world const neutral = m.base;
        command const now{w.motor.at(t), behind_deadband(begun ? driven.at(seen) : w.rudder.at(t),
                                                         begun ? w.e.rudder_deadband : 0)};
        auto const acts = effective(begun ? w : neutral, t, now, m.states[n]);
        auto const told = m.recorded(n);
        return rudder ? acts.rudder - told.rudder : acts.motor - told.motor;
    });
}

std::vector<double> true_values(true_motion const& m, std::string const& kind,
                                std::string const& name) {
    if (kind == "equation") {
        if (auto const i = index_in(equation_names, name)) return {missing_rate(m, *i)};
    } else if (kind == "sensor") {
        if (name == "position") return {sensor_offset(m, 3), sensor_offset(m, 4)};
        if (auto const k = index_in(channel_names, name)) return {sensor_offset(m, *k)};
    } else if (kind == "input") {
        return {input_offset(m, name == "delta")};
    }
    return {};
}

void check_missing(label const& l, recording const& data, json const& where, judgement& j) {
    for (auto const& w : where) {
        auto const missing = bounds_in(member(w, "missing"));
        if (!missing) continue;
        auto const from = member(w, "from"), to = member(w, "to");
        std::optional<true_motion> motion;
        if (from.is_number() && to.is_number())
            motion = motion_over(l, data, text_of(member(w, "scenario")), from.get<double>(),
                                 to.get<double>());
        if (!motion) {
            j.proof(false, "missing", place_text(w) + ": no such window");
            continue;
        }
        auto const truth =
            true_values(*motion, text_of(member(w, "kind")), text_of(member(w, "name")));
        ++j.rates_checked;
        bool const held = std::any_of(truth.begin(), truth.end(), [&](double x) {
            return missing->contains(x, tolerance * (1 + std::abs(x)));
        });
        j.proof(held, "missing",
                place_text(w) + " lacks " + text_of(*missing) + ", in truth " +
                    (truth.empty() ? "nothing of that name" : short_text(truth.front())));
    }
}

/// The inflation of the model without effects at these constants, over hold-out data or the others.
std::optional<double> base_inflation(label const& l, recording const& data,
                                     std::map<std::string, double> const& values, bool holdout) {
    if (values.empty()) return std::nullopt;
    world w;
    w.c = data.fixed;
    for (auto const& u : data.unknown) {
        if (!values.contains(u.name)) return std::nullopt;
        w.c.*constant_named(u.name) = values.at(u.name);
    }
    double most = 0;
    for (auto const& s : data.scenarios) {
        if (s.plan.holdout != holdout) continue;
        w.motor = s.plan.motor;
        w.rudder = s.plan.rudder;
        channels start{};
        for (std::size_t k = 0; k < channel_count; ++k) start[k] = s.plan.initial[k].middle();
        start = true_start(l, s.plan.name).value_or(start);
        auto all = misfits(s, readings(w, start, s.plan.sample_times, careful_step));
        most = std::max(most, inflation_of(all, s.budget));
    }
    return most;
}

/// Bounds of a part that must grow by no less: neither the true constants nor the label's fit do
/// with less.
void check_confined(label const& l, recording const& data, json const& d, judgement& j) {
    auto const parts = member(member(d, "gap"), "confined");
    if (!j.absorbed) j.part_right = is_confined_to(l, data, parts.empty() ? json{} : parts.front());
    for (auto const& part : parts) {
        // Where a claim names nothing that it can be held to, it is false.
        auto const refuses = [&](std::optional<recording> const& narrow, std::string const& what) {
            for (auto const& values : {l.constants_true, l.values("best_fit")}) {
                auto const attained =
                    narrow ? base_inflation(l, *narrow, values, false) : std::nullopt;
                j.proof(narrow && (!attained || *attained > 1), "confined",
                        confined_text(part) + what);
            }
        };
        double const lower = number(member(part, "factor"), 0).value_or(0);
        refuses(loosened(data, part, lower * (1 - 1e-3)), ", by less than " + short_text(lower));
        auto const grows = member(part, "grows");
        auto const least = number(member(grows, "coefficient"), 0);
        if (!least || !(*least > 0)) continue;
        refuses(grown(data, part, *least * (1 - 1e-3)), ", with less than " + short_text(*least) +
                                                            " of its " +
                                                            text_of(member(grows, "with")));
    }
}

/// Over all parameters that fit as well as is proved: the label's fit and the truth are among them
/// when they do.
void check_over_fits(label const& l, recording const& data, json const& d, judgement& j) {
    bool known_starts = true;
    for (auto const& s : data.scenarios)
        for (auto const& box : s.plan.initial)
            known_starts = known_starts && !(s.plan.holdout && box.lo < box.hi);
    auto const check = [&](std::optional<bounds> const& range, double value, std::string about) {
        if (!range) return;
        bool const above = known_starts && value > range->upper * (1 + 1e-3);
        bool const below = value < range->lower * (1 - 1e-3);
        j.proof(!above && !below, "holdout",
                about + ' ' + text_of(*range) + ", attained " + short_text(value));
    };
    auto const does_as_well = [](std::optional<double> const& fit, json const& inflation) {
        auto const upper = number(inflation, 1);
        return fit && upper && *fit <= *upper * (1 - 1e-4);
    };
    auto const held_by = l.held_by();
    std::optional<double> before;
    if (does_as_well(l.number("fit_base_best"), member(member(d, "gap"), "inflation")))
        before = base_inflation(l, data, l.values("best_fit"), true);
    for (auto const& c : member(d, "causes")) {
        auto const holdout = member(c, "holdout");
        if (before) check(bounds_in(member(holdout, "over_fits_before")), *before, "before");
        auto const after = l.number("holdout_true");
        // A candidate that acts in some fit scenarios only acts in none of the others.
        bool const truth =
            held_by && !l.partial() &&
            names_in(member(c, "effects")) == names{held_by->begin(), held_by->end()};
        // What explains the data counts, however well the witness does.
        bool const explains =
            member(c, "verdict") == "explains" && l.number("fit_true").value_or(1) <= 1 - 1e-6;
        if (after && truth &&
            (explains || does_as_well(l.number("fit_true"), member(c, "inflation"))))
            check(bounds_in(member(holdout, "over_fits_after")), *after, "after");
    }
}

} // namespace

void check_claims(label const& l, recording const& data, json const& d, judgement& j) {
    check_missing(l, data, member(d, "where"), j);
    check_over_fits(l, data, d, j);
    check_confined(l, data, d, j);
}

} // namespace withheld
