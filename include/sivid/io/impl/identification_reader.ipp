// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_IDENTIFICATION_READER_IPP
#define SIVID_IO_IMPL_IDENTIFICATION_READER_IPP

#include <sivid/io/identification_reader.hpp>

#include <sivid/compiled.hpp>
#include <sivid/io/dataset/mapping_entries.hpp>
#include <sivid/io/explaining_motion.hpp>
#include <sivid/io/result/certificates_csv.hpp>
#include <sivid/io/result/detail/stored_values.hpp>
#include <sivid/io/result/stored_identification.hpp>
#include <sivid/io/text/csv_table.hpp>
#include <sivid/io/text/json_document.hpp>
#include <sivid/io/text/text_file.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/number/text/sha256.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

namespace sivid {

namespace io_detail {

inline stored_identification::shown_motion read_shown(json_value const& entry) {
    stored_identification::shown_motion result;
    auto const& of = entry.at("of");
    if (of.type() == json_value::kind::null) return result;
    result.source = to_string(
        one_of(of, {motion_source::inside_box, motion_source::witness, motion_source::best_guess}));
    result.parameters = by_name(entry.at("parameters"), exact_ends);
    result.initial = by_name(entry.at("initial"),
                             [](json_value const& start) { return by_name(start, exact_ends); });
    return result;
}

inline stop_reason stop_reason_of(json_value const& entry) {
    for (int k = 0; !to_string(static_cast<stop_reason>(k)).empty(); ++k) {
        auto const reason = static_cast<stop_reason>(k);
        if (entry.string() == to_string(reason)) return reason;
    }
    entry.fail(text_of("unknown word ", in_quotes(entry.string())), "see the format");
}

/// Of what the result is: data set, model and problem.
inline void read_subject(json_value const& root, stored_identification& result) {
    result.dataset = root.at("dataset").any_string();
    if (auto const* source = root.find("source")) {
        result.source_folder = source->at("folder").any_string();
        result.source_digest = source->at("sha256").string();
    }
    if (auto const* problem = root.find("problem")) result.problem = problem->string();
    if (auto const* effects = root.find("effects")) {
        for (auto const& name : effects->elements()) result.effects.push_back(name.string());
    }
    auto const bounds = [](json_value const& list) {
        allowed_disturbances::bounds all;
        for (std::size_t k = 0; k < list.members().size(); ++k)
            all.emplace_back(list.name_of(k), list.members()[k].number());
        return all;
    };
    if (auto const* allowed = root.find("disturbances"))
        result.disturbances = {bounds(allowed->at("equations")), bounds(allowed->at("channels"))};
}

/// The verdict, and why and how the search ended.
inline void read_verdict(json_value const& root, stored_identification& result) {
    result.verdict = one_of(root.at("verdict"),
                            {verdict::consistent, verdict::inconsistent, verdict::undecided});
    result.reason = stop_reason_of(root.at("stop_reason"));
    result.searched = root.find("search") != nullptr;
    if (auto const* enclosures = root.find("enclosures"))
        result.tolerance = nearest_number(enclosures->at("tolerance"));
}

/// Hulls, and the paving of products if they are of one.
inline void read_hulls(json_value const& root, stored_identification& result) {
    auto const& parameters = root.at("parameters");
    for (std::size_t j = 0; j < parameters.members().size(); ++j) {
        auto const& own = parameters.members()[j];
        result.parameters.push_back(
            {parameters.name_of(j), outward(own.at("hull")), own.at("unit").any_string()});
    }
    auto const* const products = root.find("products");
    if (products == nullptr) return;
    result.products.emplace();
    for (auto const& side : products->at("sides").elements())
        result.products->sides.push_back(side.string());
}

inline stored_identification::witness_point read_witness(json_value const& w) {
    auto const read_numbers = [](json_value const& list) { return by_name(list, nearest_number); };
    return {read_numbers(w.at("parameters")), by_name(w.at("initial"), read_numbers)};
}

/// Which outliers are allowed, needed and forced.
inline void read_outliers(json_value const& outliers, stored_identification& result) {
    result.budget = by_name(outliers.at("budget"), count);
    auto const read_count = [](json_value const& entry) {
        proved_count const c{count(entry.at("least")), count(entry.at("most"))};
        if (c.least > c.most) entry.fail("least is above most", "correct it");
        return c;
    };
    if (auto const* fewest = outliers.find("fewest")) {
        result.fewest = read_count(fewest->at("total"));
        result.fewest_alone = by_name(fewest->at("alone"), read_count);
    }
    for (auto const& f : outliers.at("forced").elements())
        result.forced.push_back(
            {f.at("scenario").string(), nearest_number(f.at("t")), f.at("channel").string()});
}

inline void read_result(json_value const& root, stored_identification& result) {
    mapping_entries::require_format(root, "sivid-identification-1");
    root.allow_only({"format",       "dataset",         "source",
                     "problem",      "time_unit",       "effects",
                     "disturbances", "verdict",         "verdict_rests_on",
                     "stop_reason",  "journal",         "reach",
                     "divisors",     "search",          "enclosures",
                     "files",        "outputs",         "parameters",
                     "combinations", "volume",          "rows",
                     "products",     "witness",         "assumptions",
                     "outliers",     "identifiability", "boxes",
                     "integrations", "seconds",         "by_clock"});
    read_subject(root, result);
    read_verdict(root, result);
    for (auto const& a : root.at("assumptions").elements())
        result.assumptions.push_back(a.any_string());
    read_hulls(root, result);
    if (auto const& w = root.at("witness"); w.type() != json_value::kind::null)
        result.witness = read_witness(w);
    read_outliers(root.at("outliers"), result);
    if (auto const* told = root.find("identifiability"))
        result.identifiable_at = by_name(told->at("at"), exact_ends);
    if (auto const* outputs = root.find("outputs")) result.shown = read_shown(*outputs);
    result.stated = what_follows(root);
}

/// The very box of a row. What the proof covers was printed inward for an inside box, else outward:
/// read the other way round, whoever wrote it, a row says no less than its decimals.
inline interval side_of(csv_table const& table, csv_table::row const& row, std::size_t column,
                        bool inside) {
    std::array<interval, 2> ends;
    for (std::size_t end = 0; end < 2; ++end) {
        auto const value = parse_decimal(row.cells[column + end]);
        if (!value)
            table.fail(row.line, column + end, in_quotes(row.cells[column + end]) + " is no number",
                       "write a decimal");
        ends[end] = *value;
    }
    double const low = inside ? ends[0].lower() : ends[0].upper();
    double const high = inside ? ends[1].upper() : ends[1].lower();
    if (low > high || ends[0].lower() > ends[1].upper())
        table.fail(row.line, column, "lower is above upper", "correct the row");
    return interval_traits<interval>::bounds(low, high);
}

inline std::vector<paved_box> read_rows(csv_table const& table,
                                        std::vector<std::string> const& names) {
    std::vector<paved_box> rows;
    if (joined(table.headings(), ",") != paving_headings(names))
        table.fail(table.heading_line(),
                   "the columns are not those of the parameters in "
                   "result.json",
                   "take both files from one identification");
    for (auto const& row : table.rows()) {
        paved_box next{box(names.size()), box_verdict::pending};
        bool known = false;
        for (auto const v : {box_verdict::inside, box_verdict::undecided, box_verdict::pending}) {
            if (row.cells[0] != to_string(v)) continue;
            next.verdict = v;
            known = true;
        }
        if (!known)
            table.fail(row.line, 0, in_quotes(row.cells[0]) + " is no verdict",
                       "known: inside, undecided, pending");
        for (std::size_t j = 0; j < next.set.size(); ++j)
            next.set[j] = side_of(table, row, 1 + 2 * j, next.verdict == box_verdict::inside);
        rows.push_back(std::move(next));
    }
    return rows;
}

} // namespace io_detail

SIVID_DECL stored_identification read_identification(std::filesystem::path const& folder) {
    stored_identification result;
    io_detail::read_result(read_json(folder / "result.json"), result);
    std::vector<std::string> names;
    for (auto const& p : result.parameters) names.push_back(p.name);
    result.rows = io_detail::read_rows(csv_table::read(folder / "boxes.csv"), names);
    if (result.products)
        result.products->rows =
            io_detail::read_rows(csv_table::read(folder / "products.csv"), result.products->sides);
    auto const is_there = [&folder](char const* name) {
        std::error_code fault;
        return std::filesystem::symlink_status(folder / name, fault).type() !=
               std::filesystem::file_type::not_found;
    };
    if (is_there("certificates.csv"))
        result.proof = read_certificates(csv_table::read(folder / "certificates.csv"));
    if (is_there("outputs.csv")) result.outputs = read_text(folder / "outputs.csv");
    return result;
}

} // namespace sivid

#endif
