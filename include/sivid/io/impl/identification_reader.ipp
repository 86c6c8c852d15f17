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

/// A whole number of either sign.
inline long whole(json_value const& entry) {
    auto const x = entry.number();
    auto const size = (x.is_negative() ? -x : x).whole();
    if (!size || *size > 1'000'000)
        entry.fail(x.text() + " is no weight of a motion", "write a whole number up to 1e6");
    return x.is_negative() ? -static_cast<long>(*size) : static_cast<long>(*size);
}

inline stored_identification::shown_motion read_shown(json_value const& entry) {
    stored_identification::shown_motion result;
    result.digest = entry.at("sha256").string();
    auto const& of = entry.at("of");
    if (of.type() == json_value::kind::null) return result;
    result.source = to_string(
        one_of(of, {motion_source::inside_box, motion_source::witness, motion_source::best_guess}));
    result.parameters = by_name(entry.at("parameters"), exact_ends);
    result.initial = by_name(entry.at("initial"),
                             [](json_value const& start) { return by_name(start, exact_ends); });
    return result;
}

inline stored_identification::identifiability_claims read_claims(json_value const& entry) {
    stored_identification::identifiability_claims result;
    result.at = by_name(entry.at("at"), exact_ends);
    for (auto const& name : entry.at("unknowns").elements())
        result.unknowns.push_back(name.string());
    result.least_rank = count(entry.at("rank").at("least"));
    result.most_rank = count(entry.at("rank").at("most"));
    auto const proved = [](json_value const& claim) { return claim.at("proved").boolean(); };
    for (auto const& m : entry.at("free").elements()) {
        if (!proved(m)) continue;
        result.proved.push_back(
            motion_claim(m.at("kind").string(), by_name(m.at("weights"), whole)));
    }
    for (auto const& f : entry.at("fixed").elements())
        if (proved(f)) result.proved.push_back("fixed " + f.at("formula").string());
    return result;
}

inline stop_reason stop_reason_of(json_value const& entry) {
    for (int k = 0; !to_string(static_cast<stop_reason>(k)).empty(); ++k) {
        auto const reason = static_cast<stop_reason>(k);
        if (entry.string() == to_string(reason)) return reason;
    }
    entry.fail(text_of("unknown word ", in_quotes(entry.string())), "see the format");
}

/// What the search spent and what it might have spent.
inline search_effort read_effort(json_value const& search) {
    auto const& bytes = search.at("most_bytes");
    search_effort result{nearest_number(search.at("seconds")),
                         nearest_number(search.at("most_seconds")),
                         count(search.at("boxes")),
                         count(search.at("most_boxes")),
                         {}};
    if (bytes.type() != json_value::kind::null) result.most_bytes = count(bytes);
    if (auto const* ratio = search.find("sufficient_ratio"))
        result.sufficient_ratio = nearest(ratio->number());
    if (auto const* gain = search.find("hull_gain")) result.hull_gain = nearest(gain->number());
    return result;
}

/// Of what the result is: data set, model and problem.
inline void read_subject(json_value const& root, stored_identification& result) {
    result.dataset = root.at("dataset").any_string();
    if (auto const* source = root.find("source")) {
        result.source_folder = source->at("folder").any_string();
        result.source_digest = source->at("sha256").string();
    }
    if (auto const* problem = root.find("problem")) result.problem = problem->string();
    if (auto const* unit = root.find("time_unit")) result.time_unit = unit->string();
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

/// The verdict with its grounds, and why and how the search ended.
inline void read_verdict(json_value const& root, stored_identification& result) {
    result.verdict = one_of(root.at("verdict"),
                            {verdict::consistent, verdict::inconsistent, verdict::undecided});
    if (auto const* grounds = root.find("verdict_rests_on")) {
        result.grounds = to_string(
            one_of(*grounds, {verdict_grounds::witness, verdict_grounds::inside_boxes,
                              verdict_grounds::excluded_boxes, verdict_grounds::nothing}));
    }
    result.reason = stop_reason_of(root.at("stop_reason"));
    if (auto const* search = root.find("search")) result.effort = read_effort(*search);
    if (auto const* late = root.find("by_clock")) result.by_clock = late->boolean();
    if (auto const* enclosures = root.find("enclosures"))
        result.tolerance = nearest_number(enclosures->at("tolerance"));
}

/// Ranges of parameters and of combinations.
inline void read_hulls(json_value const& root, stored_identification& result) {
    auto const& parameters = root.at("parameters");
    for (std::size_t j = 0; j < parameters.members().size(); ++j) {
        auto const& own = parameters.members()[j];
        result.parameters.push_back(
            {parameters.name_of(j), outward(own.at("hull")), own.at("unit").any_string()});
        if (auto const* share = own.find("excluded_between"))
            result.parameters.back().excluded_between = nearest_number(*share);
    }
    for (auto const& c : root.at("combinations").elements())
        result.combinations.push_back(
            {c.at("formula").string(), outward(c.at("hull")), c.at("unit").any_string()});
}

/// Volumes, and the paving of products if they are of one.
inline void read_volumes(json_value const& root, stored_identification& result) {
    auto const& volume = root.at("volume");
    result.inner = outward(volume.at("inner"));
    result.outer = outward(volume.at("outer"));
    auto const* const of = volume.find("of");
    auto const* const products = root.find("products");
    auto const source = of != nullptr ? of->string() : "boxes";
    if (source != "boxes" && source != "products")
        of->fail(text_of("unknown word ", in_quotes(source)), "known: boxes, products");
    if ((source == "products") != (products != nullptr))
        volume.fail("volumes of products need the paving of products, and only they",
                    "identify again");
    if (products == nullptr) return;
    result.products.emplace();
    for (auto const& side : products->at("sides").elements())
        result.products->sides.push_back(side.string());
    result.products->stated_rows = by_name(products->at("rows"), count);
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
    read_subject(root, result);
    read_verdict(root, result);
    for (auto const& a : root.at("assumptions").elements())
        result.assumptions.push_back(a.any_string());
    if (auto const* files = root.find("files"))
        result.stated_files = by_name(*files, &json_value::string);
    read_hulls(root, result);
    read_volumes(root, result);
    if (auto const& w = root.at("witness"); w.type() != json_value::kind::null)
        result.witness = read_witness(w);
    read_outliers(root.at("outliers"), result);
    if (auto const* rows = root.find("rows")) result.stated_rows = by_name(*rows, count);
    if (auto const* told = root.find("identifiability"))
        result.identifiability = read_claims(*told);
    if (auto const* outputs = root.find("outputs")) result.shown = read_shown(*outputs);
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
        for (std::size_t j = 0; j < next.set.size(); ++j) {
            std::array<interval, 2> ends;
            for (std::size_t end = 0; end < 2; ++end) {
                auto const column = 1 + 2 * j + end;
                auto const value = parse_decimal(row.cells[column]);
                if (!value)
                    table.fail(row.line, column, in_quotes(row.cells[column]) + " is no number",
                               "write a decimal");
                ends[end] = *value;
            }
            if (ends[0].lower() > ends[1].upper())
                table.fail(row.line, 1 + 2 * j, "lower is above upper", "correct the row");
            next.set[j] = interval_traits<interval>::bounds(ends[0].lower(), ends[1].upper());
        }
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
    result.files["boxes.csv"] = sha256(read_text(folder / "boxes.csv"));
    if (result.products) {
        result.files["products.csv"] = sha256(read_text(folder / "products.csv"));
        result.products->rows =
            io_detail::read_rows(csv_table::read(folder / "products.csv"), result.products->sides);
    }
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
