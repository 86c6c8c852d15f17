// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_IDENTIFICATION_JSON_IPP
#define SIVID_IO_IMPL_IDENTIFICATION_JSON_IPP

#include <sivid/io/identification_json.hpp>

#include <sivid/paving/excluded_between.hpp>

namespace sivid {

namespace io_detail {

/// Which table of outputs belongs to the result, and of what motion it is: its very doubles.
inline void write_shown(json_writer& json, identification_problem const& problem,
                        identification_json_options const& options) {
    auto const* const motion = options.motion;
    auto const sides = [&](std::string_view key, auto const& names, box const& x) {
        std::vector<std::array<double, 2>> ends;
        for (auto const& side : x) ends.push_back({side.lower(), side.upper()});
        json.named(key, names, ends);
    };
    json.key("outputs").begin_object().members(
        "sha256", sha256(*options.outputs), "of",
        motion == nullptr ? std::nullopt : std::optional{to_string(motion->source)});
    if (motion != nullptr) {
        sides("parameters", problem.choice.unknown, motion->parameters);
        json.key("initial").begin_object();
        for (std::size_t e = 0; e < problem.experiments.size(); ++e)
            sides(problem.experiments[e].name, problem.model.about.states, motion->starts[e]);
        json.end_object();
    }
    json.end_object();
}

/// What disturbances are allowed for, in the digits that were told.
inline void write_allowed(json_writer& json, allowed_disturbances const& allowed) {
    json.key("disturbances").begin_object();
    for (auto const& [key, all] :
         {std::pair{"equations", &allowed.equations}, std::pair{"channels", &allowed.channels}}) {
        json.key(key).begin_object();
        for (auto const& [name, most] : *all) json.members(name, most);
        json.end_object();
    }
    json.end_object();
}

/// What the reason for stopping follows from.
inline void write_effort(json_writer& json, search_effort const& e) {
    json.key("search").begin_object(json_writer::layout::one_line);
    json.members("seconds", e.seconds, "most_seconds", e.most_seconds, "boxes", e.boxes);
    json.members("most_boxes", e.most_boxes, "most_bytes", e.most_bytes);
    if (e.sufficient_ratio) json.members("sufficient_ratio", *e.sufficient_ratio);
    if (e.hull_gain) json.members("hull_gain", *e.hull_gain);
    json.end_object();
}

/// How the search enclosed motions: certificates.csv rests on it.
inline void write_enclosures(json_writer& json, run_options const& run) {
    bool const taylor = run.set == carried_set::taylor_model;
    json.key("enclosures").begin_object(json_writer::layout::one_line);
    json.members("set", taylor ? "taylor-model" : "first-order");
    if (run.method) json.members("method", run.method->name);
    json.members("order", run.order, "tolerance", run.tolerance);
    json.members("relative_tolerance", run.relative_tolerance);
    json.members("minimum_step", run.minimum_step).end_object();
}

/// The digests of the tables beside the result.
inline void write_files(json_writer& json, identification_problem const& problem,
                        identification const& found) {
    json.key("files").begin_object();
    json.members("boxes.csv", sha256(boxes_csv(problem, found)));
    if (found.products) json.members("products.csv", sha256(products_csv(found)));
    json.end_object();
}

/// Hulls of parameters and of combinations.
inline void write_hulls(json_writer& json, identification_problem const& problem,
                        identification const& found) {
    auto const& names = problem.choice.unknown;
    auto const& constants = problem.model.about.constants;
    json.key("parameters").begin_object();
    for (std::size_t j = 0; j < names.size(); ++j) {
        auto const& constant = constants[index_of(constants, names[j], "constant")];
        // Between the ends of the hull: at least this share of the prior's range.
        json.key(names[j]).object("hull", found.hull[j], "unit", constant.unit, "excluded_between",
                                  excluded_between(found.paving, found.hull, j));
    }
    json.end_object().list("combinations", found.combinations, [&](combination_hull const& c) {
        json.object("formula", c.what.formula, "hull", c.hull, "unit", c.what.unit);
    });
}

/// Volumes of the paving, and how many rows its tables have of each kind.
inline void write_paving(json_writer& json, identification const& found) {
    json.key("volume").object("inner", share_of_whole(found.paving.inner_volume()), "outer",
                              share_of_whole(found.paving.outer_volume()), "of",
                              found.volumes == volume_source::boxes ? "boxes" : "products");
    auto const rows = [&](auto const& paving) {
        json.key("rows").begin_object(json_writer::layout::one_line);
        for (auto const v : {box_verdict::inside, box_verdict::undecided, box_verdict::pending})
            json.members(to_string(v), paving.count(v));
        json.end_object();
    };
    rows(found.paving);   // of boxes.csv
    if (found.products) { // in products.csv
        json.key("products").begin_object().members("sides", found.products->map.side_names());
        rows(found.products->paving);
        json.end_object();
    }
}

inline void write_witness(json_writer& json, identification_problem const& problem,
                          identification const& found) {
    json.maybe("witness", found.witness, [&](auto const& w) {
        json.begin_object().named("parameters", problem.choice.unknown, w.parameters);
        json.key("initial").begin_object();
        for (std::size_t s = 0; s < problem.experiments.size(); ++s)
            json.named(problem.experiments[s].name, problem.model.about.states, w.starts[s]);
        json.end_object().end_object();
    });
}

/// How many outliers are allowed, how many are needed, and which measurements are proved to be.
inline void write_outliers(json_writer& json, identification_problem const& problem,
                           identification const& found) {
    json.key("outliers").begin_object();
    json.named("budget", problem.experiments, &experiment::outliers);
    if (found.fewest) {
        auto const write = [&](std::string const& key, proved_count const& c) {
            json.key(key).object("least", c.least, "most", c.most);
        };
        json.key("fewest").begin_object();
        write("total", found.fewest->total);
        json.key("alone").begin_object();
        for (std::size_t s = 0; s < problem.experiments.size(); ++s)
            write(problem.experiments[s].name, found.fewest->alone[s]);
        json.end_object();
        json.members("reason", to_string(found.fewest->reason)).end_object();
    }
    json.list("forced", found.forced, [&](auto const& f) {
        auto const samples = sorted(problem.experiments[f.experiment].measurements);
        auto const& m = samples[f.measurement];
        json.object("scenario", problem.experiments[f.experiment].name, "t", m.time, "channel",
                    problem.model.about.channels[m.channel].name);
    });
    json.end_object();
}

} // namespace io_detail

SIVID_DECL std::string identification_json(identification_problem const& problem,
                                           identification const& found,
                                           identification_json_options const& options) {
    json_writer json;
    json.begin_object().members("format", "sivid-identification-1", "dataset", options.dataset);
    if (!options.source_digest.empty())
        json.key("source").object("folder", options.source_folder, "sha256", options.source_digest);
    json.members("problem", problem_digest(problem), "time_unit", problem.model.about.time_unit);
    if (!options.effects.empty()) json.members("effects", options.effects);
    if (!options.disturbances.empty()) io_detail::write_allowed(json, options.disturbances);
    bool const inside = found.paving.count(box_verdict::inside) > 0 ||
                        share_of_whole(found.paving.inner_volume()).lower() > 0;
    auto const grounds = grounds_for(found.witness.has_value(), inside, found.paving.has_outer());
    json.members("verdict", to_string(found.verdict), "verdict_rests_on", to_string(grounds));
    json.members("stop_reason", to_string(found.reason));
    write_journal(json, found.journal);
    write_reach(json, found.reach);
    write_divisors(json, found.divisors);
    if (found.effort) io_detail::write_effort(json, *found.effort);
    io_detail::write_enclosures(json, found.run);
    io_detail::write_files(json, problem, found);
    if (options.outputs != nullptr) io_detail::write_shown(json, problem, options);

    io_detail::write_hulls(json, problem, found);
    io_detail::write_paving(json, found);
    io_detail::write_witness(json, problem, found);

    auto assumptions = found.assumptions;
    for (auto const& a : options.further_assumptions) assumptions.push_back(a);
    json.members("assumptions", assumptions);
    io_detail::write_outliers(json, problem, found);
    if (options.identifiability != nullptr) {
        json.key("identifiability");
        write_identifiability(json, *options.identifiability);
    }
    json.members("boxes", found.boxes, "integrations", found.integrations);
    json.members("seconds", found.seconds);
    if (found.by_clock) json.members("by_clock", true);
    json.end_object();
    return json.text();
}

} // namespace sivid

#endif
