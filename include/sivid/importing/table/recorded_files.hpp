// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_TABLE_RECORDED_FILES_HPP
#define SIVID_IMPORTING_TABLE_RECORDED_FILES_HPP

#include <sivid/importing/table/detail/matlab_table.hpp>
#include <sivid/importing/table/detail/recorded_table.hpp>
#include <sivid/importing/table/detail/serial_log.hpp>
#include <sivid/io/text/text_file.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <list>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// How an import gets at what is in files.
struct import_tools {
    /// Reads MATLAB files: `read_matlab` (matlab_reader.hpp), where there is libmatio.
    std::function<matlab_file(std::filesystem::path const&)> read_matlab = nullptr;
    std::function<std::string(std::filesystem::path const&)> read = read_text;
};

/// What a recorded file holds.
struct recorded_stretches {
    scenario_mapping const* by = nullptr; ///< the first scenario that reads it so
    std::vector<recorded_table> stretches;
    std::vector<import_protocol::note> notes;
    std::size_t lines = 0;
};

/// Reads the files of a mapping, each once for all scenarios that take the same columns in the same
/// form, and keeps what a later one asks for.
class recorded_files {
public:
    /// @param mapping  outlives this
    recorded_files(import_mapping const& mapping, import_tools tools)
        : mapping_{mapping}, tools_{std::move(tools)} {}

    /// @param of  a scenario of the mapping; they are asked for in their order
    /// @param s   it, or a further file of it
    /// @returns  valid until another scenario asks
    /// @throws input_error
    [[nodiscard]] recorded_stretches const& read(scenario_mapping const& of,
                                                 scenario_mapping const& s) {
        std::erase_if(kept_, [&](recorded_stretches const& r) { // no scenario from here on asks
            auto const asks = [&](scenario_mapping const& file) { return same(file, *r.by); };
            return std::none_of(&of, mapping_.scenarios.data() + mapping_.scenarios.size(),
                                [&](auto const& later) {
                                    return asks(later) || std::ranges::any_of(later.further, asks);
                                });
        });
        for (auto const& r : kept_)
            if (same(*r.by, s)) return r;
        recorded_stretches result{&s, {}, {}, 0};
        import_protocol protocol;
        if (s.form.from == source_form::kind::matlab) {
            if (!tools_.read_matlab)
                throw input_error{{.file = s.file.string()},
                                  "a MATLAB file, and this program was built without libmatio",
                                  "install libmatio (Debian: libmatio-dev) and build again, or "
                                  "export a table"};
            result.stretches.push_back(read_matlab_table(s, tools_.read_matlab(s.file), protocol));
            result.lines = result.stretches.back().rows.size();
        } else {
            auto const text = tools_.read(s.file);
            if (s.form.from == source_form::kind::csv)
                result.stretches.push_back(read_recorded_table(s, text, protocol));
            else
                result.stretches = read_serial_log(s, text, protocol);
            result.lines = lines_of(text).size();
        }
        result.notes = protocol.notes();
        return kept_.emplace_back(std::move(result));
    }

    /// The first file of a scenario.
    [[nodiscard]] recorded_stretches const& read(scenario_mapping const& s) { return read(s, s); }

private:
    static bool same(scenario_mapping const& a, scenario_mapping const& b) {
        return a.file == b.file && a.form == b.form && a.time.column == b.time.column &&
               a.time.sample_time == b.time.sample_time && a.time.unit == b.time.unit &&
               a.time.form == b.time.form && a.time.counter_bits == b.time.counter_bits &&
               columns_of(a) == columns_of(b);
    }

    import_mapping const& mapping_;
    import_tools tools_;
    std::list<recorded_stretches> kept_;
};

} // namespace sivid

#endif // SIVID_IMPORTING_TABLE_RECORDED_FILES_HPP
