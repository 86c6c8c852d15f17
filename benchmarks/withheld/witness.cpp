// SPDX-License-Identifier: MIT
// A cause that is proved to explain the data names parameters and starts that do. They are
// simulated here, by other code than that which proved them.
#include "witness.hpp"
#include "catalogue.hpp"
#include "confined.hpp"
#include "instruments.hpp"
#include "judge.hpp"
#include "measure.hpp"
#include "reading.hpp"
#include "simulate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace withheld {

std::optional<world> world_of(recording const& data, json const& cause, json const& witness) {
    world w;
    w.c = data.fixed;
    if (!witness.contains("parameters")) return std::nullopt;
    auto const& parameters = witness.at("parameters");
    for (auto const& u : data.unknown) {
        if (!parameters.contains(u.name)) return std::nullopt;
        auto const value = value_in(parameters.at(u.name));
        if (!value) return std::nullopt;
        w.c.*constant_named(u.name) = *value;
    }
    for (auto const& name : cause.at("effects")) {
        auto const* known = effect_named(name.get<std::string>());
        if (auto const fault = fault_in(name.get<std::string>())) {
            bool const set = set_fault(w.instruments, *fault, [&](std::string const& full) {
                return parameters.contains(full) ? value_in(parameters.at(full)) : std::nullopt;
            });
            if (!set) return std::nullopt;
            continue;
        }
        if (known == nullptr) return std::nullopt;
        for (auto const& p : known->parameters) {
            auto const full = name.get<std::string>() + '.' + std::string{p.name};
            if (!parameters.contains(full)) return std::nullopt;
            auto const value = value_in(parameters.at(full));
            if (!value) return std::nullopt;
            w.e.*p.member = *value;
        }
    }
    return w;
}

channels start_of(scenario const& plan, json const& witness) {
    channels start{};
    for (std::size_t k = 0; k < channel_count; ++k) {
        start[k] = plan.initial[k].middle();
        auto const pointer =
            json::json_pointer{"/initial/" + plan.name + '/' + std::string{channel_names[k]}};
        if (!witness.contains(pointer)) continue;
        if (auto const value = value_in(witness.at(pointer))) start[k] = *value;
    }
    return start;
}

namespace {

/// Effects that act in some scenarios only are none in the others, and begin and end where they are
/// said to.
void switch_off(world& w, json const& cause, std::string const& scenario) {
    for (auto const& name : names_in(member(cause, "effects"))) {
        auto const when = episode_in(name, scenario);
        if (when.always()) continue;
        if (!when.never()) {
            act_within(w, when); // such an effect stands alone
            continue;
        }
        for (auto const& p : effect_named(name)->parameters)
            w.e.*p.member = effect_values{}.*p.member;
    }
}

double inflation_at(recording const& data, world const& all, json const& cause, bool holdout) {
    auto const witness = member(cause, "witness");
    double most = 0;
    for (auto const& s : data.scenarios) {
        if (s.plan.holdout != holdout) continue;
        auto w = all;
        switch_off(w, cause, s.plan.name);
        w.motor = s.plan.motor;
        w.rudder = s.plan.rudder;
        auto const model =
            readings(w, start_of(s.plan, witness), s.plan.sample_times, careful_step);
        auto missed = misfits(s, model, w.instruments.modulus);
        most = std::max(most, inflation_of(missed, s.budget));
    }
    return most;
}

/// Hold-out starts are nuisances; a value is comparable only where there is nothing to choose.
bool holdout_starts_known(recording const& data) {
    bool any = false;
    for (auto const& s : data.scenarios) {
        if (!s.plan.holdout) continue;
        any = true;
        for (auto const& box : s.plan.initial)
            if (box.lo < box.hi) return false;
    }
    return any;
}

/// Everything that the witness names lies where it was allowed to.
bool within_priors(recording const& data, world const& w, json const& cause, json const& witness) {
    auto const inside = [](double x, double lo, double hi) {
        double const slack = 1e-9 * (1 + std::abs(x));
        return lo - slack <= x && x <= hi + slack;
    };
    bool all = true;
    for (auto const& u : data.unknown)
        all = all && inside(w.c.*constant_named(u.name), u.prior.lo, u.prior.hi);
    for (auto const& name : names_in(member(cause, "effects")))
        if (auto const* known = effect_named(name))
            for (auto const& p : known->parameters) all = all && inside(w.e.*p.member, p.lo, p.hi);
    for (auto const& s : data.scenarios) {
        if (s.plan.holdout) continue;
        auto const start = start_of(s.plan, witness);
        for (std::size_t k = 0; k < channel_count; ++k)
            all = all && inside(start[k], s.plan.initial[k].lo, s.plan.initial[k].hi);
    }
    return all;
}

/// What is proved of hold-out data must leave room for their inflation at the witness, which is one
/// of all fits. Where hold-out starts are open, another one than here may do better.
void check_holdout(recording const& data, world const& w, json const& cause, judgement& j) {
    auto const holdout = member(cause, "holdout");
    bool const known_starts = holdout_starts_known(data);
    std::optional<double> value;
    for (auto const* key : {"inflation_after", "over_fits_after"}) {
        auto const range = bounds_in(member(holdout, key));
        if (!range) continue;
        if (!value) value = inflation_at(data, w, cause, true);
        bool const above = known_starts && *value > range->upper * (1 + 1e-3);
        bool const below = *value < range->lower * (1 - 1e-3);
        j.proof(!above && !below, "holdout",
                joined(names_in(member(cause, "effects"))) + ' ' + key + ' ' + text_of(*range) +
                    ", simulated " + short_text(*value));
    }
}

} // namespace

void check_witnesses(recording const& data, json const& diagnosis, judgement& j) {
    auto const check = [&](json const& cause) {
        if (!member(cause, "witness").is_object()) return;
        auto const& witness = cause.at("witness");
        auto const w = world_of(data, cause, witness);
        if (!w) return;
        auto const effects = joined(names_in(member(cause, "effects")));
        ++j.witnesses_checked;
        j.proof(within_priors(data, *w, cause, witness), "witness",
                effects + ", outside of the priors");
        // A validated run proves the upper end. Witnesses that stand on the bound itself must
        // survive the printing of their digits.
        bool const explains = member(cause, "verdict") == "explains";
        double const said = number(member(cause, "inflation"), 1)
                                .value_or(explains ? 1 : std::numeric_limits<double>::infinity());
        double const most = explains ? std::min(said, 1.0) : said;
        double const value = inflation_at(data, *w, cause, false);
        j.proof(value <= most * (1 + 1e-3), "witness",
                effects + " at most " + short_text(most) + ", simulated " + short_text(value));
        check_holdout(data, *w, cause, j);
    };
    for (auto const& cause : member(diagnosis, "causes")) check(cause);
    // The model without effects, where its witness is given.
    auto base = member(diagnosis, "gap");
    if (!base.is_object()) return;
    base["effects"] = json::array();
    base["verdict"] = member(base, "verdict") == "none" ? "explains" : "undecided";
    check(base);
    // Parts that stand alone: with their bounds as wide as is said, the model explains all data.
    for (auto const& part : member(member(diagnosis, "gap"), "confined")) {
        auto const factor = number(member(part, "factor"), 1);
        auto const witness = member(part, "witness");
        base["witness"] = witness;
        auto const w = world_of(data, base, witness);
        j.proof(factor && w && within_priors(data, *w, base, witness) &&
                    inflation_at(loosened(data, part, *factor), *w, base, false) <= 1 + 1e-3,
                "confined", confined_text(part) + ", its witness");
        if (!member(part, "grows").is_object()) continue;
        auto const other = member(member(part, "grows"), "witness");
        auto const upper = number(member(member(part, "grows"), "coefficient"), 1);
        base["witness"] = other;
        auto const there = world_of(data, base, other);
        auto const wider = grown(data, part, upper.value_or(0) * (1 + 1e-3));
        j.proof(there && wider && within_priors(data, *there, base, other) &&
                    inflation_at(*wider, *there, base, false) <= 1 + 1e-3,
                "confined", confined_text(part) + ", the witness of what it grows with");
    }
}

} // namespace withheld
