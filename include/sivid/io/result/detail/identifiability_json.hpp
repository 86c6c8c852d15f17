// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_RESULT_DETAIL_IDENTIFIABILITY_JSON_HPP
#define SIVID_IO_RESULT_DETAIL_IDENTIFIABILITY_JSON_HPP

#include <sivid/io/text/json_writer.hpp>
#include <sivid/paving/identifiability.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace sivid {

/// Writes what data can tell as one value, the member "identifiability" of a result file:
///   `at`: the parameters and starts over which the proofs hold, the very doubles; `rank`: proved
///   from both sides, and in floating point; `free`, `fixed`: motions and formulas, each with
///   whether it is proved; `hardly_noticed`, `nearly_fixed`, `directions`: computed, not proved.
inline void write_identifiability(json_writer& json, identifiability const& found) {
    constexpr auto one_line = json_writer::layout::one_line;
    json.begin_object().named("at", found.unknowns, [&](unknown_quantity const& q) {
        auto const& side =
            q.experiment ? found.starts[*q.experiment][q.index] : found.parameters[q.index];
        return std::array{side.lower(), side.upper()};
    });
    json.list("unknowns", found.unknowns, &unknown_quantity::name);
    json.members("outputs", found.outputs, "outputs_not_reached", found.missing);
    json.key("rank").object("least", found.least_rank, "most", found.most_rank, "approximate",
                            found.approximate_rank);

    auto const motions = [&](char const* key, std::vector<free_motion> const& all) {
        json.list(key, all, [&](free_motion const& m) {
            json.begin_object(one_line);
            json.members("kind", m.kind == motion_kind::scaling ? "scaling" : "translation");
            json.key("weights").begin_object();
            for (std::size_t c = 0; c < m.weights.size(); ++c) {
                if (m.weights[c] != 0) json.members(found.unknowns[c].name, m.weights[c]);
            }
            json.end_object().members("noticed", m.noticed, "proved", m.proved).end_object();
        });
    };
    auto const formulas = [&](char const* key, std::vector<fixed_formula> const& all) {
        json.list(key, all, [&](fixed_formula const& f) {
            json.object("formula", f.formula, "proved", f.proved);
        });
    };
    motions("free", found.free);
    formulas("fixed", found.fixed);
    motions("hardly_noticed", found.nearly_free);
    formulas("nearly_fixed", found.nearly_fixed);
    json.list("directions", found.directions, [&](sensitive_direction const& d) {
        json.begin_object(one_line).members("noticed", d.noticed);
        json.named("components", found.unknowns, d.components).end_object();
    });
    json.end_object();
}

} // namespace sivid

#endif
