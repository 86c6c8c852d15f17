// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_RESULT_REACH_JSON_HPP
#define SIVID_IO_RESULT_REACH_JSON_HPP

#include <sivid/io/text/json_writer.hpp>
#include <sivid/paving/divisors.hpp>
#include <sivid/paving/run/run_reach.hpp>

#include <vector>

namespace sivid {

/// "reach": how far runs over what is left are carried, and what holds them back; nothing where
/// nobody looked.
inline void write_reach(json_writer& json, std::vector<run_reach> const& reach) {
    if (reach.empty()) return;
    json.list("reach", reach, [&](run_reach const& r) {
        json.begin_object(json_writer::layout::one_line).members("scenario", r.scenario);
        json.members("until", r.until, "end", r.end, "state", r.state, "width", r.width);
        json.key("by").begin_object();
        for (auto const& c : r.causes) json.members((c.start ? "start of " : "") + c.name, c.share);
        json.end_object().members("moved", r.moved, "spread", r.spread, "lost", r.lost);
        json.members("interrupted", r.interrupted).end_object();
    });
}

/// "divisors": what the equations divide by that is, or may be, zero; nothing where there is none.
inline void write_divisors(json_writer& json, std::vector<divisor> const& divisors) {
    if (divisors.empty()) return;
    json.list("divisors", divisors, [&](divisor const& d) {
        json.begin_object(json_writer::layout::one_line).members("formula", d.formula);
        json.members("equations", d.equations);
        json.members("zeros", d.zeros == zeros::some ? "some" : "unknown");
        json.named("near", d.near).end_object();
    });
}

} // namespace sivid

#endif
