// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_DECISION_JSON_IPP
#define SIVID_IO_IMPL_DECISION_JSON_IPP

#include <sivid/io/decision_json.hpp>

#include <sivid/compiled.hpp>
#include <sivid/io/identification_csv.hpp>
#include <sivid/io/text/json_writer.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sivid {

namespace io_detail {

inline json_writer begun(char const* format, stored_prediction const& about,
                         decision_json_options const& options) {
    json_writer json;
    json.begin_object().members("format", format, "dataset", options.dataset);
    json.key("result").object("folder", options.source_folder, "sha256", options.source_digest);
    json.members("scenario", options.scenario, "duration", about.problem.end, "time_unit",
                 about.problem.model.about.time_unit);
    json.named("set", options.set);
    if (!options.law.empty()) {
        json.members("law", options.law).named("sensors", options.sensors, [&](auto const& sensor) {
            json.upper_bound(sensor.second);
        });
        if (options.sampled > 0) json.members("sampled", options.sampled, "delay", options.delay);
    }
    json.members("coordinates", about.sides);
    if (!about.not_in_products.empty()) json.members("not_in_products", about.not_in_products);
    json.members("boxes", about.problem.sets.size(), "assumptions", about.assumptions);
    return json;
}

inline std::string ended(json_writer& json, std::size_t integrations, double seconds) {
    return json.members("integrations", integrations, "seconds", seconds).end_object().text();
}

/// A motion that violates, with its parameters.
inline void write_motion(json_writer& json, stored_prediction const& about,
                         violating_motion const& w) {
    json.begin_object().named("parameters", about.direct.choice.unknown, w.parameters);
    json.named("initial", about.direct.model.about.states, w.start);
    json.key("robustness").bounds(w.found.low, w.found.high).members("time", w.time);
    json.members("feasible",
                 "proved by validated runs through the data" +
                     (about.feasible_with.empty() ? "" : ", of which " + about.feasible_with));
    json.end_object();
}

inline void write_worth(json_writer& json, identification_problem const& about,
                        measurement_ranking const& found) {
    json.begin_object().members("explained", to_string(found.explained), "volume", found.volume);
    json.members("coordinates", found.coordinates, "complete", found.complete);
    json.list("without", found.groups, [&](auto const& g) {
        auto const& what = g.what;
        json.begin_object(json_writer::layout::one_line);
        if (what.channel) json.members("channel", about.model.about.channels[*what.channel].name);
        if (what.experiment) json.members("experiment", about.experiments[*what.experiment].name);
        if (std::isfinite(what.from)) json.members("from", what.from);
        if (std::isfinite(what.to)) json.members("to", what.to);
        json.members("measurements", g.measurements, "growth", g.growth).end_object();
    });
    json.members("integrations", found.integrations, "seconds", found.seconds).end_object();
}

} // namespace io_detail

SIVID_DECL std::string prediction_json(stored_prediction const& about, prediction const& found,
                                       decision_json_options const& options) {
    auto json = io_detail::begun("sivid-prediction-1", about, options);
    json.members("complete", found.complete, "reached", found.reached);
    json.key("excess").upper_bound(found.excess).members("tubes", "tubes.csv");
    json.named("at_end", found.channels,
               [&](predicted_tube const& tube) { json.bounds(tube.low.back(), tube.high.back()); });
    json.members("parts", found.parts);
    return io_detail::ended(json, found.integrations, found.seconds);
}

SIVID_DECL std::string tubes_csv(prediction const& found) {
    std::string text = "from,to";
    std::vector<predicted_tube const*> all;
    for (auto const& tube : found.channels) all.push_back(&tube);
    for (auto const& tube : found.states) {
        bool same = false; // a channel that is the state itself
        for (auto const& c : found.channels)
            same = same || (c.name == tube.name && c.low == tube.low && c.high == tube.high);
        if (!same) all.push_back(&tube);
    }
    for (auto const* tube : all) text += "," + tube->name + "_lower," + tube->name + "_upper";
    text += "\n";
    auto const number = [](double x) { return exact_decimal::shortest(x).text(); };
    for (std::size_t s = 0; s + 1 < 2 * found.times.size(); ++s) {
        text += number(found.times[s / 2]) + "," + number(found.times[(s + 1) / 2]);
        for (auto const* tube : all) {
            text += ",";
            if (std::isfinite(tube->low[s])) text += to_decimal_lower(tube->low[s]);
            text += ",";
            if (std::isfinite(tube->high[s])) text += to_decimal_upper(tube->high[s]);
        }
        text += "\n";
    }
    return text;
}

SIVID_DECL std::string verification_json(stored_prediction const& about, requirement const& asked,
                                         verification const& found,
                                         decision_json_options const& options) {
    auto json = io_detail::begun("sivid-verification-1", about, options);
    json.members("requirement", asked.text, "answer", to_string(found.answer));
    json.key("robustness").bounds(found.found.low, found.found.high);
    json.members("reached", found.reached);
    json.maybe("witness", found.witness,
               [&](violating_motion const& w) { io_detail::write_motion(json, about, w); });
    json.members("open_boxes", found.open.size());
    std::span const shown{found.open.data(), std::min<std::size_t>(found.open.size(), 1000)};
    json.list("open", shown, [&](auto const& b) {
        json.begin_object().named("parameters", about.sides, b.parameters);
        json.named("initial", about.direct.model.about.states, b.initial);
        json.key("robustness").bounds(b.found.low, b.found.high);
        json.members("reached", b.reached, "why", to_string(b.why)).end_object();
    });
    json.members("parts", found.parts, "integrations", found.integrations);
    json.members("instants", found.times.size(), "seconds", found.seconds).end_object();
    return json.text();
}

SIVID_DECL std::string control_json(stored_prediction const& about, requirement const& asked,
                                    gain_set const& found, verification const* proof,
                                    decision_json_options const& options) {
    auto json = io_detail::begun("sivid-control-1", about, options);
    json.members("requirement", asked.text, "gains", found.names);
    auto const& paving = found.paving.paving;
    json.members("answer", found.some_proved() ? "proved" : found.none_exists() ? "none" : "open");
    json.members("reason", to_string(found.paving.reason));
    json.key("proved_share").lower_bound(std::max(0.0, paving.inner_volume().lower()));
    json.key("left_share").upper_bound(std::min(1.0, paving.outer_volume().upper()));
    json.members("boxes_file", "gains.csv");
    if (found.suggested) {
        json.named("suggested", found.names, *found.suggested);
    } else {
        json.key("suggested").null();
    }
    json.maybe(
        "tolerance", found.tolerance.size() > 0 ? &found.tolerance : nullptr,
        [&](box const& around) {
            json.begin_object(json_writer::layout::one_line);
            for (std::size_t k = 0; k < around.size(); ++k)
                json.members(found.names[k], std::array{around[k].lower(), around[k].upper()});
            json.end_object();
        });
    if (proof != nullptr) {
        json.members("answer_for_suggested", to_string(proof->answer));
        json.key("robustness").bounds(proof->found.low, proof->found.high);
    }
    json.list("against", found.against,
              [&](violating_motion const& w) { io_detail::write_motion(json, about, w); });
    json.members("parts", found.parts);
    return io_detail::ended(json, found.integrations, found.seconds);
}

namespace io_detail {

inline void write_manoeuvre(json_writer& json, tried_manoeuvre const& m) {
    json.begin_object().members("shape", m.name).named("settings", m.about, m.settings);
    json.members("estimate", m.estimate);
    json.maybe("share", m.promised, [&](promise const&) { json.upper_bound(m.factor()); });
    json.members("limits", m.limits ? std::optional{to_string(*m.limits)} : std::nullopt);
    json.end_object();
}

} // namespace io_detail

SIVID_DECL std::string design_json(stored_prediction const& about, design_answer const& found,
                                   decision_json_options const& options) {
    auto json = io_detail::begun("sivid-design-1", about, options);
    auto const* const best = found.found.best();
    bool const goals = !found.goals.empty();
    json.members("answer", found.impossible           ? "hidden"
                           : found.met()              ? "met"
                           : best != nullptr && goals ? "less"
                                                      : "open");
    if (!goals)
        json.members("first", found.first, "second", found.second, "second_sha256",
                     options.against_digest);
    json.members("target", found.target, "jointly", found.jointly);
    if (best != nullptr && goals) json.key("share_of_volume").upper_bound(best->factor());
    json.members("limits", found.limits, "hidden", found.hidden, "instead", found.instead);
    json.key("goals").begin_array();
    for (std::size_t g = 0; g < found.goals.size(); ++g) {
        json.begin_object(json_writer::layout::one_line).members("goal", found.goals[g].text);
        if (best != nullptr) {
            auto const& w = best->promised->goals[g];
            json.key("before").lower_bound(w.before).key("after").upper_bound(w.after);
            json.key("share").upper_bound(w.factor());
        }
        json.end_object();
    }
    json.end_array().key("errors").begin_object(json_writer::layout::one_line);
    auto const& channels = about.problem.model.about.channels;
    for (std::size_t c = 0; c < channels.size() && c < found.plan.errors.size(); ++c) {
        if (found.plan.errors[c] > 0) json.members(channels[c].name, found.plan.errors[c]);
    }
    json.end_object().members("times", found.plan.times);
    json.named("varied", found.varied, [](varied_input const& u) {
        return std::array{u.lower, u.upper};
    });
    json.list("tried", found.found.tried,
              [&](tried_manoeuvre const& m) { io_detail::write_manoeuvre(json, m); });
    json.members("looked_at", found.found.simulated);
    return io_detail::ended(json, found.found.integrations, found.found.seconds);
}

SIVID_DECL std::string gains_csv(gain_set const& found) {
    return io_detail::paving_csv(found.names, found.paving.paving);
}

SIVID_DECL std::string ranking_json(identification_problem const& about, ranking const& found,
                                    decision_json_options const& options,
                                    measurement_ranking const* measurements) {
    auto const& names = about.choice.unknown;
    json_writer json;
    auto const& model = about.model.about;
    json.begin_object().members("format", "sivid-ranking-1", "dataset", options.dataset);
    json.members("scenario", options.scenario, "time_unit", model.time_unit);
    json.named("prior", names, about.prior);
    json.members("assumptions", std::array{input_assumption(about.experiments)});
    json.members("complete", found.complete);
    json.list("channels", found.channels, [&](channel_effects const& c) {
        json.begin_object().members("experiment", about.experiments[c.experiment].name);
        json.members("channel", model.channels[c.channel].name);
        json.list("effects", c.order(), [&](std::size_t const j) {
            auto const& e = c.effects[j];
            auto const place = c.place_of(j);
            json.begin_object(json_writer::layout::one_line).members("parameter", names[j]);
            json.members("acts", e.acts).key("effect").bounds(e.low, e.high);
            json.members("place", std::array{place.best, place.worst});
            if (e.low > 0) {
                json.members("time", e.time, "from", e.from, "to", e.to).key("at").begin_object();
                for (std::size_t i = 0; i < names.size(); ++i)
                    if (i != j) json.members(names[i], e.at[i]);
                json.end_object().named("initial", model.states, e.start);
            }
            json.end_object();
        });
        json.end_object();
    });
    auto const& products = found.combinations;
    json.list("only_in_products", products.entangled, [&](std::size_t j) { return names[j]; });
    json.list("products", products.combinations, &combination::formula);
    if (measurements != nullptr) {
        json.key("measurements");
        io_detail::write_worth(json, about, *measurements);
    }
    json.members("parts", found.parts);
    return io_detail::ended(json, found.integrations, found.seconds);
}

} // namespace sivid

#endif
