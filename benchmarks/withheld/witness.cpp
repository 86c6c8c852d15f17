// SPDX-License-Identifier: MIT
// A cause that is proved to explain the data names parameters and starts that do. They are
// simulated here, by other code than that which proved them.
#include "catalogue.hpp"
#include "judge.hpp"
#include "measure.hpp"
#include "simulate.hpp"

#include <map>

namespace withheld {

namespace {

using json = nlohmann::json;

/// A number, or the middle of an interval.
std::optional<double> value_of(json const& j) {
    if (j.is_number()) return j.get<double>();
    if (j.is_array() && j.size() == 2 && j[0].is_number() && j[1].is_number())
        return (j[0].get<double>() + j[1].get<double>()) / 2;
    return std::nullopt;
}

/// The model that the witness describes; nothing when a value is left open.
std::optional<world> world_of(recording const& data, json const& cause, json const& witness) {
    world w;
    w.c = data.fixed;
    if (!witness.contains("parameters")) return std::nullopt;
    auto const& parameters = witness.at("parameters");
    for (auto const& u : data.unknown) {
        if (!parameters.contains(u.name)) return std::nullopt;
        auto const value = value_of(parameters.at(u.name));
        if (!value) return std::nullopt;
        w.c.*constant_named(u.name) = *value;
    }
    for (auto const& name : cause.at("effects")) {
        auto const* known = effect_named(name.get<std::string>());
        if (known == nullptr) return std::nullopt;
        for (auto const& p : known->parameters) {
            auto const full = std::string{known->name} + '.' + std::string{p.name};
            if (!parameters.contains(full)) return std::nullopt;
            auto const value = value_of(parameters.at(full));
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
        if (auto const value = value_of(witness.at(pointer))) start[k] = *value;
    }
    return start;
}

double inflation_at(recording const& data, world w, json const& witness, bool holdout) {
    double most = 0;
    for (auto const& s : data.scenarios) {
        if (s.plan.holdout != holdout) continue;
        w.motor = s.plan.motor;
        w.rudder = s.plan.rudder;
        auto const model =
            readings(w, start_of(s.plan, witness), s.plan.sample_times, careful_step);
        auto all = misfits(s, model);
        most = std::max(most, inflation_of(all, s.budget));
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

/// The certified hold-out inflation must hold its value at the witness.
void check_holdout(recording const& data, world const& w, json const& cause, judgement& j) {
    auto const place = json::json_pointer{"/holdout/inflation_after"};
    if (!cause.contains(place) || !holdout_starts_known(data)) return;
    auto const& range = cause.at(place);
    if (!range.is_array() || range.size() != 2) return;
    ++j.proofs;
    double const value = inflation_at(data, w, cause.at("witness"), true);
    bool const above = range[1].is_number() && value > range[1].get<double>() * (1 + 1e-3);
    bool const below = range[0].is_number() && value < range[0].get<double>() * (1 - 1e-3);
    if (above || below) j.false_proofs.emplace_back("holdout");
}

} // namespace

void check_witnesses(recording const& data, json const& diagnosis, judgement& j) {
    if (!diagnosis.contains("causes")) return;
    for (auto const& cause : diagnosis.at("causes")) {
        if (cause.value("verdict", "") != "explains" || !cause.contains("witness")) continue;
        auto const& witness = cause.at("witness");
        auto const w = world_of(data, cause, witness);
        if (!w) continue;
        ++j.witnesses_checked;
        ++j.proofs;
        // Witnesses that stand on the bound itself must survive the printing of their digits.
        if (inflation_at(data, *w, witness, false) > 1 + 1e-3)
            j.false_proofs.emplace_back("witness");
        check_holdout(data, *w, cause, j);
    }
}

} // namespace withheld
