// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_RESULT_DETAIL_IDENTIFIABILITY_JSON_HPP
#define SIVID_IO_RESULT_DETAIL_IDENTIFIABILITY_JSON_HPP

#include <sivid/io/text/json_writer.hpp>
#include <sivid/paving/identifiability.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace sivid {

/// Writes what data can tell as one value, the member "identifiability" of a result file:
///   `at`: the parameters and starts over which the proofs hold, the very doubles; `rank`: proved
///   from both sides, and in floating point; `free`, `fixed`: motions and formulas, each with
///   whether it is proved; `hardly_noticed`, `nearly_fixed`, `directions`: computed, not proved.
inline void write_identifiability(json_writer& json, identifiability const& found) {
    using layout = json_writer::layout;
    auto const name = [&](std::size_t c) { return found.unknowns[c].name; };
    json.begin_object().key("at").begin_object(layout::one_line);
    for (std::size_t c = 0; c < found.unknowns.size(); ++c) {
        auto const& q = found.unknowns[c];
        auto const& side =
            q.experiment ? found.starts[*q.experiment][q.index] : found.parameters[q.index];
        json.key(q.name).begin_array(layout::one_line);
        json.nearest(side.lower()).nearest(side.upper()).end_array();
    }
    json.end_object().key("unknowns").begin_array(layout::one_line);
    for (auto const& q : found.unknowns) json.string(q.name);
    json.end_array().key("outputs").integer(found.outputs);
    json.key("outputs_not_reached").integer(found.missing);
    json.key("rank").begin_object(layout::one_line).key("least").integer(found.least_rank);
    json.key("most").integer(found.most_rank);
    json.key("approximate").integer(found.approximate_rank).end_object();

    auto const motions = [&](std::string const& key, std::vector<free_motion> const& list) {
        json.key(key).begin_array();
        for (auto const& m : list) {
            json.begin_object(layout::one_line).key("kind");
            json.string(m.kind == motion_kind::scaling ? "scaling" : "translation");
            json.key("weights").begin_object(layout::one_line);
            for (std::size_t c = 0; c < m.weights.size(); ++c) {
                if (m.weights[c] != 0) json.key(name(c)).integer(m.weights[c]);
            }
            json.end_object().key("noticed").nearest(m.noticed);
            json.key("proved").boolean(m.proved).end_object();
        }
        json.end_array();
    };
    auto const formulas = [&](std::string const& key, std::vector<fixed_formula> const& list) {
        json.key(key).begin_array();
        for (auto const& f : list) {
            json.begin_object(layout::one_line).key("formula").string(f.formula);
            json.key("proved").boolean(f.proved).end_object();
        }
        json.end_array();
    };
    motions("free", found.free);
    formulas("fixed", found.fixed);
    motions("hardly_noticed", found.nearly_free);
    formulas("nearly_fixed", found.nearly_fixed);
    json.key("directions").begin_array();
    for (auto const& d : found.directions) {
        json.begin_object(layout::one_line).key("noticed").nearest(d.noticed);
        json.key("components").begin_object(layout::one_line);
        for (std::size_t c = 0; c < d.components.size(); ++c) {
            json.key(name(c)).nearest(d.components[c]);
        }
        json.end_object().end_object();
    }
    json.end_array().end_object();
}

} // namespace sivid

#endif
