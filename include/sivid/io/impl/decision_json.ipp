// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_DECISION_JSON_IPP
#define SIVID_IO_IMPL_DECISION_JSON_IPP

#include <sivid/io/decision_json.hpp>

#include <sivid/compiled.hpp>
#include <sivid/io/identification_csv.hpp>
#include <sivid/io/text/json_writer.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace sivid {

namespace io_detail {

inline void write_head(json_writer& json, char const* format, stored_prediction const& about,
                       decision_json_options const& options) {
    json.key("format").string(format);
    json.key("dataset").string(options.dataset);
    json.key("result").begin_object();
    json.key("folder").string(options.source_folder);
    json.key("sha256").string(options.source_digest).end_object();
    json.key("scenario").string(options.scenario);
    json.key("duration").nearest(about.problem.end);
    json.key("set").begin_object();
    for (auto const& [name, range] : options.set) json.key(name).bounds(range);
    json.end_object();
    if (!options.law.empty()) {
        json.key("law").string(options.law).key("sensors").begin_object();
        for (auto const& [channel, bound] : options.sensors) json.key(channel).upper_bound(bound);
        json.end_object();
        if (options.sampled > 0)
            json.key("sampled").nearest(options.sampled).key("delay").nearest(options.delay);
    }
    json.key("coordinates").begin_array(json_writer::layout::one_line);
    for (auto const& side : about.sides) json.string(side);
    json.end_array();
    if (!about.not_in_products.empty()) json.key("not_in_products").string(about.not_in_products);
    json.key("boxes").integer(about.problem.sets.size());
    json.key("assumptions").begin_array();
    for (auto const& a : about.assumptions) json.string(a);
    json.end_array();
}

inline void write_box(json_writer& json, std::vector<std::string> const& names, box const& x) {
    json.begin_object(json_writer::layout::one_line);
    for (std::size_t i = 0; i < x.size(); ++i) json.key(names[i]).bounds(x[i]);
    json.end_object();
}

inline void write_bounds(json_writer& json, double low, double high) {
    json.begin_array(json_writer::layout::one_line).lower_bound(low).upper_bound(high).end_array();
}

inline std::vector<std::string> names_of_states(model_description const& about) {
    std::vector<std::string> names;
    for (auto const& s : about.states) names.push_back(s.name);
    return names;
}

/// A motion that violates, with its parameters.
inline void write_motion(json_writer& json, stored_prediction const& about,
                         violating_motion const& w) {
    auto const states = names_of_states(about.direct.model.about);
    json.begin_object();
    json.key("parameters").begin_object(json_writer::layout::one_line);
    for (std::size_t j = 0; j < w.parameters.size(); ++j)
        json.key(about.direct.choice.unknown[j]).nearest(w.parameters[j]);
    json.end_object();
    json.key("initial").begin_object(json_writer::layout::one_line);
    for (std::size_t i = 0; i < w.start.size(); ++i) json.key(states[i]).nearest(w.start[i]);
    json.end_object();
    json.key("robustness");
    io_detail::write_bounds(json, w.found.low, w.found.high);
    json.key("time").nearest(w.time);
    json.key("feasible")
        .string("proved by validated runs through the data" +
                (about.feasible_with.empty() ? "" : ", of which " + about.feasible_with));
    json.end_object();
}

inline void write_worth(json_writer& json, identification_problem const& about,
                        measurement_ranking const& found) {
    json.begin_object();
    json.key("explained").string(to_string(found.explained)).key("volume");
    write_bounds(json, found.volume.lower(), found.volume.upper());
    json.key("coordinates").begin_array(json_writer::layout::one_line);
    for (auto const& c : found.coordinates) json.string(c);
    json.end_array().key("complete").boolean(found.complete).key("without").begin_array();
    for (auto const& g : found.groups) {
        auto const& what = g.what;
        json.begin_object(json_writer::layout::one_line);
        if (what.channel)
            json.key("channel").string(about.model.about.channels[*what.channel].name);
        if (what.experiment)
            json.key("experiment").string(about.experiments[*what.experiment].name);
        if (std::isfinite(what.from)) json.key("from").nearest(what.from);
        if (std::isfinite(what.to)) json.key("to").nearest(what.to);
        json.key("measurements").integer(g.measurements).key("growth");
        write_bounds(json, g.growth.lower(), g.growth.upper());
        json.end_object();
    }
    json.end_array().key("integrations").integer(found.integrations);
    json.key("seconds").nearest(found.seconds).end_object();
}

} // namespace io_detail

SIVID_DECL std::string prediction_json(stored_prediction const& about, prediction const& found,
                                       decision_json_options const& options) {
    json_writer json;
    json.begin_object();
    io_detail::write_head(json, "sivid-prediction-1", about, options);
    json.key("complete").boolean(found.complete);
    json.key("reached").nearest(found.reached);
    json.key("excess").upper_bound(found.excess);
    json.key("tubes").string("tubes.csv");
    json.key("at_end").begin_object();
    for (auto const& tube : found.channels) {
        json.key(tube.name);
        io_detail::write_bounds(json, tube.low.back(), tube.high.back());
    }
    json.end_object();
    json.key("parts").integer(found.parts);
    json.key("integrations").integer(found.integrations);
    json.key("seconds").nearest(found.seconds).end_object();
    return json.text();
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
    json_writer json;
    json.begin_object();
    io_detail::write_head(json, "sivid-verification-1", about, options);
    json.key("requirement").string(asked.text);
    json.key("answer").string(to_string(found.answer));
    json.key("robustness");
    io_detail::write_bounds(json, found.found.low, found.found.high);
    json.key("reached").nearest(found.reached);
    auto const states = io_detail::names_of_states(about.direct.model.about);
    json.key("witness");
    if (found.witness) {
        io_detail::write_motion(json, about, *found.witness);
    } else {
        json.null();
    }
    json.key("open_boxes").integer(found.open.size());
    json.key("open").begin_array();
    for (std::size_t k = 0; k < found.open.size() && k < 1000; ++k) {
        auto const& b = found.open[k];
        json.begin_object();
        json.key("parameters");
        io_detail::write_box(json, about.sides, b.parameters);
        json.key("initial");
        io_detail::write_box(json, states, b.initial);
        json.key("robustness");
        io_detail::write_bounds(json, b.found.low, b.found.high);
        json.key("reached").nearest(b.reached);
        json.key("why").string(to_string(b.why)).end_object();
    }
    json.end_array();
    json.key("parts").integer(found.parts);
    json.key("integrations").integer(found.integrations);
    json.key("instants").integer(found.times.size());
    json.key("seconds").nearest(found.seconds).end_object();
    return json.text();
}

SIVID_DECL std::string control_json(stored_prediction const& about, requirement const& asked,
                                    gain_set const& found, verification const* proof,
                                    decision_json_options const& options) {
    json_writer json;
    json.begin_object();
    io_detail::write_head(json, "sivid-control-1", about, options);
    json.key("requirement").string(asked.text);
    json.key("gains").begin_array(json_writer::layout::one_line);
    for (auto const& name : found.names) json.string(name);
    json.end_array();
    auto const& paving = found.paving.paving;
    json.key("answer").string(found.some_proved()   ? "proved"
                              : found.none_exists() ? "none"
                                                    : "open");
    json.key("reason").string(to_string(found.paving.reason));
    json.key("proved_share").lower_bound(std::max(0.0, paving.inner_volume().lower()));
    json.key("left_share").upper_bound(std::min(1.0, paving.outer_volume().upper()));
    json.key("boxes_file").string("gains.csv");
    json.key("suggested");
    if (found.suggested) {
        json.begin_object(json_writer::layout::one_line);
        for (std::size_t k = 0; k < found.names.size(); ++k)
            json.key(found.names[k]).nearest((*found.suggested)[k]);
        json.end_object();
    } else {
        json.null();
    }
    json.key("tolerance");
    if (found.tolerance.size() > 0) {
        json.begin_object(json_writer::layout::one_line);
        for (std::size_t k = 0; k < found.names.size(); ++k) {
            json.key(found.names[k]).begin_array(json_writer::layout::one_line);
            json.nearest(found.tolerance[k].lower()).nearest(found.tolerance[k].upper());
            json.end_array();
        }
        json.end_object();
    } else {
        json.null();
    }
    if (proof != nullptr) {
        json.key("answer_for_suggested").string(to_string(proof->answer));
        json.key("robustness");
        io_detail::write_bounds(json, proof->found.low, proof->found.high);
    }
    json.key("against").begin_array();
    for (auto const& w : found.against) io_detail::write_motion(json, about, w);
    json.end_array();
    json.key("parts").integer(found.parts);
    json.key("integrations").integer(found.integrations);
    json.key("seconds").nearest(found.seconds).end_object();
    return json.text();
}

namespace io_detail {

inline void write_manoeuvre(json_writer& json, tried_manoeuvre const& m) {
    json.begin_object();
    json.key("shape").string(m.name).key("settings").begin_object();
    for (std::size_t k = 0; k < m.about.size(); ++k)
        json.key(m.about[k].name).nearest(m.settings[k]);
    json.end_object();
    json.key("estimate").nearest(m.estimate);
    json.key("share");
    if (m.promised) {
        json.upper_bound(m.factor());
    } else {
        json.null();
    }
    json.key("limits");
    if (m.limits) {
        json.string(to_string(*m.limits));
    } else {
        json.null();
    }
    json.end_object();
}

} // namespace io_detail

SIVID_DECL std::string design_json(stored_prediction const& about, design_answer const& found,
                                   decision_json_options const& options) {
    json_writer json;
    json.begin_object();
    io_detail::write_head(json, "sivid-design-1", about, options);
    auto const* const best = found.found.best();
    bool const goals = !found.goals.empty();
    json.key("answer").string(found.impossible           ? "hidden"
                              : found.met()              ? "met"
                              : best != nullptr && goals ? "less"
                                                         : "open");
    if (!goals)
        json.key("first")
            .string(found.first)
            .key("second")
            .string(found.second)
            .key("second_sha256")
            .string(options.against_digest);
    json.key("target").nearest(found.target).key("jointly").boolean(found.jointly);
    if (best != nullptr && goals) json.key("share_of_volume").upper_bound(best->factor());
    json.key("limits").string(found.limits);
    json.key("hidden").string(found.hidden).key("instead").begin_array();
    for (auto const& text : found.instead) json.string(text);
    json.end_array();
    json.key("goals").begin_array();
    for (std::size_t g = 0; g < found.goals.size(); ++g) {
        json.begin_object(json_writer::layout::one_line).key("goal").string(found.goals[g].text);
        if (best != nullptr) {
            auto const& w = best->promised->goals[g];
            json.key("before").lower_bound(w.before).key("after").upper_bound(w.after);
            json.key("share").upper_bound(w.factor());
        }
        json.end_object();
    }
    json.end_array();
    json.key("errors").begin_object(json_writer::layout::one_line);
    auto const& channels = about.problem.model.about.channels;
    for (std::size_t c = 0; c < channels.size() && c < found.plan.errors.size(); ++c) {
        if (found.plan.errors[c] > 0) json.key(channels[c].name).nearest(found.plan.errors[c]);
    }
    json.end_object().key("times").begin_array(json_writer::layout::one_line);
    for (double const t : found.plan.times) json.nearest(t);
    json.end_array().key("varied").begin_object();
    for (auto const& u : found.varied) {
        json.key(u.name).begin_array(json_writer::layout::one_line);
        json.nearest(u.lower).nearest(u.upper).end_array();
    }
    json.end_object().key("tried").begin_array();
    for (auto const& m : found.found.tried) io_detail::write_manoeuvre(json, m);
    json.end_array();
    json.key("looked_at").integer(found.found.simulated);
    json.key("integrations").integer(found.found.integrations);
    json.key("seconds").nearest(found.found.seconds).end_object();
    return json.text();
}

SIVID_DECL std::string gains_csv(gain_set const& found) {
    return io_detail::paving_csv(found.names, found.paving.paving);
}

SIVID_DECL std::string ranking_json(identification_problem const& about, ranking const& found,
                                    decision_json_options const& options,
                                    measurement_ranking const* measurements) {
    auto const& names = about.choice.unknown;
    json_writer json;
    json.begin_object();
    json.key("format").string("sivid-ranking-1");
    json.key("dataset").string(options.dataset);
    json.key("scenario").string(options.scenario);
    json.key("prior");
    io_detail::write_box(json, names, about.prior);
    json.key("assumptions").begin_array();
    json.string(input_assumption(about.experiments)).end_array();
    json.key("complete").boolean(found.complete);
    json.key("channels").begin_array();
    for (auto const& c : found.channels) {
        json.begin_object();
        json.key("experiment").string(about.experiments[c.experiment].name);
        json.key("channel").string(about.model.about.channels[c.channel].name);
        json.key("effects").begin_array();
        for (auto const j : c.order()) {
            auto const& e = c.effects[j];
            auto const place = c.place_of(j);
            json.begin_object(json_writer::layout::one_line);
            json.key("parameter").string(names[j]);
            json.key("acts").boolean(e.acts).key("effect");
            io_detail::write_bounds(json, e.low, e.high);
            json.key("place").begin_array().integer(place.best).integer(place.worst).end_array();
            if (e.low > 0) {
                json.key("time").nearest(e.time).key("from").nearest(e.from);
                json.key("to").nearest(e.to).key("at").begin_object();
                for (std::size_t i = 0; i < names.size(); ++i)
                    if (i != j) json.key(names[i]).nearest(e.at[i]);
                json.end_object().key("initial").begin_object();
                for (std::size_t i = 0; i < e.start.size(); ++i)
                    json.key(about.model.about.states[i].name).nearest(e.start[i]);
                json.end_object();
            }
            json.end_object();
        }
        json.end_array().end_object();
    }
    json.end_array();
    json.key("only_in_products").begin_array(json_writer::layout::one_line);
    for (auto const j : found.combinations.entangled) json.string(names[j]);
    json.end_array().key("products").begin_array(json_writer::layout::one_line);
    for (auto const& c : found.combinations.combinations) json.string(c.formula);
    json.end_array();
    if (measurements != nullptr) {
        json.key("measurements");
        io_detail::write_worth(json, about, *measurements);
    }
    json.key("parts").integer(found.parts);
    json.key("integrations").integer(found.integrations);
    json.key("seconds").nearest(found.seconds).end_object();
    return json.text();
}

} // namespace sivid

#endif
