// SPDX-License-Identifier: MIT
// Small mappings in a temporary folder, to be imported or spoilt.
#ifndef SIVID_TESTS_IO_IMPORT_SUPPORT_HPP
#define SIVID_TESTS_IO_IMPORT_SUPPORT_HPP

#include <sivid/importing/import_writer.hpp>
#include <sivid/io/dataset.hpp>

#include "io/support.hpp"
#include "support/catch.hpp"

#include <string>
#include <vector>

namespace io_support {

inline sivid::exact_decimal dec(std::string_view text) {
    auto const value = sivid::exact_decimal::parse(text);
    if (!value) throw std::logic_error{"not a decimal: " + std::string{text}};
    return *value;
}

inline constexpr std::string_view csv_mapping = R"({
  "format": "sivid-mapping-1", "id": "small", "model": "tank",
  "parameters": { "k": {"prior": [0.1, 0.2], "unit": "1/s"} },
  "fixed": { "g": 9.81 },
  "max_outlier_fraction": 0,
  "scenarios": [
    { "name": "A", "role": "fit", "file": "a.csv",
      "source": { "kind": "csv" },
      "time": { "column": "time", "unit": "ms", "offset": 0 },
      "interpolation": "linear",
      "inputs": { "u": { "column": "pump" } },
      "channels": { "h": { "column": "level", "factor": 0.01, "error": 0.02 } },
      "initial": { "h": [0, 1] } } ]
}
)";
inline constexpr std::string_view small_table = "time,pump,level,bound\n"
                                                "0,1.5,100,1\n"
                                                "100,1.5,101,2\n"
                                                "200,2.5,,3\n"
                                                "300,2.5,103.5,4\n";

inline constexpr std::string_view serial_mapping = R"({
  "format": "sivid-mapping-1", "id": "small", "model": "tank",
  "parameters": { "k": {"prior": [0.1, 0.2], "unit": "1/s"} },
  "max_outlier_fraction": 0,
  "scenarios": [
    { "name": "A", "role": "fit", "file": "a.log",
      "source": { "kind": "serial", "fields": ["t_ms", "pwm", "enc"], "longest_gap": 0.05 },
      "time": { "column": "t_ms", "unit": "ms", "counter_bits": 16, "offset": "first" },
      "interpolation": "hold",
      "inputs": { "u": { "column": "pwm" } },
      "channels": { "x": { "column": "enc", "error": 1 } },
      "initial": {} } ]
}
)";

/// Lines `t,pwm,enc` every 10 ms.
inline std::string serial_lines(unsigned from, unsigned count, unsigned bits = 16) {
    std::string text;
    for (unsigned i = 0; i < count; ++i) {
        auto const t = (from + 10 * i) % (1u << bits);
        text += std::to_string(t) + "," + std::to_string(i) + "," + std::to_string(100 + i) + "\n";
    }
    return text;
}

/// Imports what lies in the folder, and reads the written data set back.
inline sivid::imported_dataset import_in(temporary_folder const& folder,
                                         sivid::import_tools const& tools = {}) {
    auto const mapping = sivid::read_import_mapping(folder.path() / "mapping.json");
    auto result = sivid::import_dataset(mapping, tools);
    sivid::write_import(result, folder.path() / "out");
    (void)sivid::read_dataset(folder.path() / "out", result.names);
    return result;
}

inline sivid::imported_dataset import_csv(std::string_view mapping, std::string_view table,
                                          sivid::import_tools const& tools = {}) {
    temporary_folder const folder;
    folder.write("mapping.json", mapping);
    folder.write("a.csv", table);
    return import_in(folder, tools);
}
inline sivid::imported_dataset import_serial(std::string_view mapping, std::string_view log) {
    temporary_folder const folder;
    folder.write("mapping.json", mapping);
    folder.write("a.log", log);
    return import_in(folder);
}

/// The message of the input_error that the import ends with.
inline std::string refusal(std::string_view mapping, std::string_view file,
                           sivid::import_tools const& tools = {}) {
    temporary_folder const folder;
    folder.write("mapping.json", mapping);
    folder.write("a.csv", file);
    folder.write("a.log", file);
    try {
        (void)import_in(folder, tools);
    } catch (sivid::input_error const& e) {
        CHECK_FALSE(fs::exists(folder.path() / "out"));
        CHECK_FALSE(e.remedy().empty());
        return e.what();
    }
    return "no error";
}

/// The lines that a note with this text in its reason names.
inline std::vector<std::size_t> noted(sivid::import_protocol const& protocol,
                                      std::string const& reason) {
    std::vector<std::size_t> lines;
    for (auto const& n : protocol.notes())
        if (n.reason.find(reason) != std::string::npos)
            lines.insert(lines.end(), n.lines.begin(), n.lines.end());
    return lines;
}
inline bool has_note(sivid::import_protocol const& protocol, std::string const& reason) {
    for (auto const& n : protocol.notes())
        if (n.reason.find(reason) != std::string::npos) return true;
    return false;
}

} // namespace io_support

#endif // SIVID_TESTS_IO_IMPORT_SUPPORT_HPP
