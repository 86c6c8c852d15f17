// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_IDENTIFICATION_JSON_IPP
#define SIVID_IO_IMPL_IDENTIFICATION_JSON_IPP

#include <sivid/io/identification_json.hpp>

namespace sivid {

SIVID_DECL std::string identification_json(identification_problem const& problem,
                                           identification const& found,
                                           identification_json_options const& options) {
    using layout = json_writer::layout;
    auto const& about = problem.model.about;
    auto const& names = problem.choice.unknown;
    auto const unit_of = [&](std::string const& name) {
        return about.constants[index_of(about.constants, name, "constant")].unit;
    };
    json_writer json;
    json.begin_object();
    json.key("format").string("sivid-identification-1").key("dataset").string(options.dataset);
    if (!options.source_digest.empty()) {
        json.key("source").begin_object().key("folder").string(options.source_folder);
        json.key("sha256").string(options.source_digest).end_object();
    }
    json.key("problem").string(problem_digest(problem));
    if (!options.effects.empty()) {
        json.key("effects").begin_array(layout::one_line);
        for (auto const& name : options.effects) json.string(name);
        json.end_array();
    }
    json.key("verdict").string(to_string(found.verdict));
    bool const inside = found.paving.count(box_verdict::inside) > 0 ||
                        share_of_whole(found.paving.inner_volume()).lower() > 0;
    json.key("verdict_rests_on");
    json.string(
        to_string(grounds_for(found.witness.has_value(), inside, found.paving.has_outer())));
    json.key("stop_reason").string(to_string(found.reason));
    if (found.windows) { // what contracted the prior before the search
        auto const& w = *found.windows;
        json.key("windows").begin_object(layout::one_line).key("carried").integer(w.windows);
        json.key("longest").nearest(w.longest).key("seconds").nearest(w.seconds);
        json.key("left").nearest(w.left);
        if (w.input_period > 0) json.key("input_period").nearest(w.input_period);
        json.end_object();
    }
    write_reach(json, found.reach);
    write_divisors(json, found.divisors);
    if (found.effort) { // what the reason follows from
        auto const& e = *found.effort;
        json.key("search").begin_object(layout::one_line);
        json.key("seconds").nearest(e.seconds).key("most_seconds").nearest(e.most_seconds);
        json.key("boxes").integer(e.boxes).key("most_boxes").integer(e.most_boxes);
        json.key("most_bytes");
        if (e.most_bytes) {
            json.integer(*e.most_bytes);
        } else {
            json.null();
        }
        if (e.sufficient_ratio) json.key("sufficient_ratio").nearest(*e.sufficient_ratio);
        if (e.hull_gain) json.key("hull_gain").nearest(*e.hull_gain);
        json.end_object();
    }
    json.key("enclosures").begin_object(layout::one_line); // of the search, for certificates.csv
    json.key("set").string(found.run.set == carried_set::taylor_model ? "taylor-model"
                                                                      : "first-order");
    if (found.run.enclosure.method) {
        json.key("method").string(found.run.enclosure.method->name);
    }
    json.key("order").integer(found.run.enclosure.order);
    json.key("tolerance").nearest(found.run.enclosure.tolerance);
    json.key("relative_tolerance").nearest(found.run.enclosure.relative_tolerance);
    json.key("minimum_step").nearest(found.run.enclosure.minimum_step).end_object();
    json.key("files").begin_object();
    json.key("boxes.csv").string(sha256(boxes_csv(problem, found)));
    if (found.products) json.key("products.csv").string(sha256(products_csv(found)));
    json.end_object();

    json.key("parameters").begin_object();
    for (std::size_t j = 0; j < names.size(); ++j) {
        json.key(names[j]).begin_object(layout::one_line).key("hull").bounds(found.hull[j]);
        json.key("unit").string(unit_of(names[j])).end_object();
    }
    json.end_object();
    json.key("combinations").begin_array();
    for (auto const& c : found.combinations) {
        json.begin_object(layout::one_line).key("formula").string(c.what.formula);
        json.key("hull").bounds(c.hull).key("unit").string(c.what.unit).end_object();
    }
    json.end_array();

    json.key("volume").begin_object(layout::one_line);
    json.key("inner").bounds(share_of_whole(found.paving.inner_volume()));
    json.key("outer").bounds(share_of_whole(found.paving.outer_volume()));
    json.key("of").string(found.volumes == volume_source::boxes ? "boxes" : "products");
    json.end_object();

    json.key("rows").begin_object(layout::one_line); // of boxes.csv
    for (auto const v : {box_verdict::inside, box_verdict::undecided, box_verdict::pending})
        json.key(to_string(v)).integer(found.paving.count(v));
    json.end_object();

    if (found.products) { // in products.csv
        json.key("products").begin_object().key("sides").begin_array(layout::one_line);
        for (auto const& name : found.products->map.side_names()) json.string(name);
        json.end_array().key("rows").begin_object(layout::one_line);
        for (auto const v : {box_verdict::inside, box_verdict::undecided, box_verdict::pending})
            json.key(to_string(v)).integer(found.products->paving.count(v));
        json.end_object().end_object();
    }

    json.key("witness");
    if (found.witness) {
        json.begin_object().key("parameters").begin_object(layout::one_line);
        for (std::size_t j = 0; j < names.size(); ++j) {
            json.key(names[j]).nearest(found.witness->parameters[j]);
        }
        json.end_object().key("initial").begin_object();
        for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
            json.key(problem.experiments[s].name).begin_object(layout::one_line);
            for (std::size_t i = 0; i < about.states.size(); ++i) {
                json.key(about.states[i].name).nearest(found.witness->starts[s][i]);
            }
            json.end_object();
        }
        json.end_object().end_object();
    } else {
        json.null();
    }

    json.key("assumptions").begin_array();
    for (auto const& a : found.assumptions) json.string(a);
    for (auto const& a : options.further_assumptions) json.string(a);
    json.end_array();

    json.key("outliers").begin_object().key("budget").begin_object(layout::one_line);
    for (auto const& s : problem.experiments) json.key(s.name).integer(s.outliers);
    json.end_object();
    if (found.fewest) {
        auto const write = [&](std::string const& key, proved_count const& c) {
            json.key(key).begin_object(layout::one_line).key("least").integer(c.least);
            json.key("most").integer(c.most).end_object();
        };
        json.key("fewest").begin_object();
        write("total", found.fewest->total);
        json.key("alone").begin_object();
        for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
            write(problem.experiments[s].name, found.fewest->alone[s]);
        }
        json.end_object().end_object();
    }
    json.key("forced").begin_array();
    for (auto const& f : found.forced) {
        auto const samples = sorted(problem.experiments[f.experiment].measurements);
        auto const& m = samples[f.measurement];
        json.begin_object(layout::one_line);
        json.key("scenario").string(problem.experiments[f.experiment].name);
        json.key("t").nearest(m.time);
        json.key("channel").string(about.channels[m.channel].name).end_object();
    }
    json.end_array().end_object();

    if (options.identifiability != nullptr) {
        json.key("identifiability");
        write_identifiability(json, *options.identifiability);
    }

    json.key("boxes").integer(found.boxes).key("integrations").integer(found.integrations);
    json.key("seconds").nearest(found.seconds).end_object();
    return json.text();
}

} // namespace sivid

#endif
