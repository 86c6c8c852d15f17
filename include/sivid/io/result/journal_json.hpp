// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_RESULT_JOURNAL_JSON_HPP
#define SIVID_IO_RESULT_JOURNAL_JSON_HPP

#include <sivid/io/text/json_writer.hpp>
#include <sivid/paving/strategy/contractor.hpp>

namespace sivid {

/// "journal": what was tried before a search, why, and what came of it; nothing where nothing was.
inline void write_journal(json_writer& json, contraction_journal const& journal) {
    if (journal.empty()) return;
    json.list("journal", journal, [&](contraction_record const& r) {
        json.begin_object(json_writer::layout::one_line).members("by", r.by);
        json.members("outcome", to_string(r.how), "why", r.why);
        if (r.asked()) {
            json.members("left", r.left, "integrations", r.integrations, "seconds", r.seconds);
            for (auto const& [name, value] : r.figures) json.members(name, value);
        }
        json.end_object();
    });
}

} // namespace sivid

#endif
