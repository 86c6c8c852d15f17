// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_DETAIL_FLEET_SUMMARY_HPP
#define SIVID_APP_DETAIL_FLEET_SUMMARY_HPP

#include <sivid/app/detail/fleet_task.hpp>
#include <sivid/app/program.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/text/json_document.hpp>
#include <sivid/io/text/json_writer.hpp>
#include <sivid/io/text/printable_text.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>
#include <vector>

namespace sivid::app {

/// One line of the summary.
struct fleet_row {
    std::string name;
    std::string state;               ///< result, failed, missing
    std::string found;               ///< in words
    std::string low = "", high = ""; ///< bounds of what `about` says, as the result has them
    std::string about = "";          ///< "not excluded", "inflation"
    fleet_note note = {};
};

namespace detail {

/// A number as the file has it: bounds must not be rounded on the way.
inline std::string number_text(json_value const& j) {
    return j.type() == json_value::kind::number ? j.number().text() : std::string{};
}

inline void read_identification(fleet_row& row, json_value const& j) {
    row.found = j.at("verdict").string() + " (" + j.at("stop_reason").string() + ")";
    row.about = "not excluded";
    row.low = number_text(j.at("volume").at("inner").elements().at(0));
    row.high = number_text(j.at("volume").at("outer").elements().at(1));
}
inline void read_diagnosis(fleet_row& row, json_value const& j) {
    auto const& answer = j.at("answer").at("kind").string();
    row.found = "gap " + j.at("gap").at("verdict").string() + ", answer " + answer;
    auto const& causes = j.at("causes").elements();
    if (answer == "effects" && !causes.empty()) {
        std::string names;
        for (auto const& e : causes.front().at("effects").elements())
            names += (names.empty() ? ": " : " + ") + e.string();
        row.found += names + " (" + causes.front().at("verdict").string() + ")";
    }
    row.about = "inflation";
    auto const& bounds = j.at("gap").at("inflation");
    if (bounds.type() != json_value::kind::array) return;
    row.low = number_text(bounds.elements().at(0));
    row.high = number_text(bounds.elements().at(1));
}

inline fleet_row row_of(fleet_task const& task) {
    fleet_row row{task.name(), "missing", "no result yet"};
    auto const note = task.note();
    if (!note) return row;
    row.note = *note;
    row.state = task.is_finished() ? "result" : "failed";
    row.found =
        "ended with " + std::to_string(note->code) + ": see " + (task.out() / "log.txt").string();
    if (row.state == "failed") return row;
    try {
        if (std::filesystem::exists(task.out() / "diagnosis.json")) {
            read_diagnosis(row, read_json(task.out() / "diagnosis.json"));
        } else {
            read_identification(row, read_json(task.out() / "result.json"));
        }
    } catch (input_error const& e) {
        row.state = "failed";
        row.found = e.what();
    }
    return row;
}

inline std::string in_csv(std::string const& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (char const c : text) quoted += c == '"' ? std::string{"\"\""} : std::string{c};
    return quoted + '"';
}

} // namespace detail

/// Writes the summary of all data sets of the list, whoever worked on them, and prints it.
/// @returns an exit code
/// @throws output_error
inline int write_fleet_summary(std::vector<fleet_task> const& list,
                               std::filesystem::path const& out) {
    std::vector<fleet_row> rows;
    for (auto const& task : list) rows.push_back(detail::row_of(task));
    std::string csv = "dataset,state,found,bounds_of,lower,upper,exit_code,seconds\n";
    json_writer json;
    json.begin_object().members("format", "sivid-fleet-summary-1").key("datasets").begin_array();
    std::map<std::string, std::size_t> counts;
    double seconds = 0;
    int code = done;
    for (auto const& r : rows) {
        bool const ran = r.state != "missing";
        csv += detail::in_csv(r.name) + "," + r.state + "," + detail::in_csv(r.found) + "," +
               r.about + "," + r.low + "," + r.high + "," +
               (ran ? std::to_string(r.note.code) : "") + "," +
               (ran ? text_of("%.3f", r.note.seconds) : "") + "\n";
        json.begin_object(json_writer::layout::one_line);
        json.members("dataset", r.name, "state", r.state, "found", r.found);
        if (ran) json.members("exit_code", r.note.code, "seconds", r.note.seconds);
        json.end_object();
        ++counts[r.state == "result" ? r.found : r.state];
        seconds += r.note.seconds;
        if (r.state == "failed" && code != internal_error && code != bad_input)
            code = r.note.code == bad_input ? bad_input : internal_error;
        if (r.state == "missing" && code == done) code = undecided;
    }
    json.end_array().named("counts", counts).members("seconds", seconds).end_object();
    file_set files(out);
    files.add("fleet.csv", csv);
    files.add("fleet.json", json.text());
    files.commit();
    std::size_t widest = 0;
    for (auto const& r : rows) widest = std::max(widest, r.name.size());
    for (auto const& r : rows) {
        auto name = printable_text(r.name, 200);
        name.resize(std::max(name.size(), widest), ' ');
        std::cout << name << "  " << printable_text(r.found, 400);
        if (!r.high.empty()) std::cout << "; " << r.about << " [" << r.low << ", " << r.high << "]";
        std::cout << "\n";
    }
    std::cout << rows.size() << (rows.size() == 1 ? " data set" : " data sets");
    for (auto const& [what, count] : counts)
        std::cout << "; " << count << " " << printable_text(what, 200);
    std::cout << "\n"
              << text_of("%.3g", seconds)
              << " s of the programs; written: " << (out / "fleet.csv").string()
              << " and fleet.json\n";
    return code;
}

} // namespace sivid::app

#endif
