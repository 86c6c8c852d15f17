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
    json.key("reach").begin_array();
    for (auto const& r : reach) {
        json.begin_object(json_writer::layout::one_line);
        json.key("scenario").string(r.scenario);
        json.key("until").nearest(r.until).key("end").nearest(r.end);
        json.key("state").string(r.state);
        json.key("width").nearest(r.width).key("by").begin_object();
        for (auto const& c : r.causes)
            json.key((c.start ? "start of " : "") + c.name).nearest(c.share);
        json.end_object();
        json.key("moved").nearest(r.moved).key("spread").nearest(r.spread);
        json.key("lost").nearest(r.lost).key("interrupted").boolean(r.interrupted).end_object();
    }
    json.end_array();
}

/// "divisors": what the equations divide by that is, or may be, zero; nothing where there is none.
inline void write_divisors(json_writer& json, std::vector<divisor> const& divisors) {
    if (divisors.empty()) return;
    json.key("divisors").begin_array();
    for (auto const& d : divisors) {
        json.begin_object(json_writer::layout::one_line);
        json.key("formula").string(d.formula).key("equations").begin_array();
        for (auto const& e : d.equations) json.string(e);
        json.end_array().key("zeros").string(d.zeros == zeros::some ? "some" : "unknown");
        json.key("near").begin_object();
        for (auto const& [name, value] : d.near) json.key(name).nearest(value);
        json.end_object().end_object();
    }
    json.end_array();
}

} // namespace sivid

#endif
