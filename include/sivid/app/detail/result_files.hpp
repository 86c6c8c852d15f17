// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_DETAIL_RESULT_FILES_HPP
#define SIVID_APP_DETAIL_RESULT_FILES_HPP

#include <sivid/io/file_set.hpp>
#include <sivid/io/identification_csv.hpp>
#include <sivid/io/result/certificates_csv.hpp>
#include <sivid/io/text/printable_text.hpp>
#include <sivid/report/identification_view.hpp>

#include <filesystem>
#include <iostream>
#include <string>
#include <system_error>
#include <vector>

namespace sivid::app {

/// The way from one folder to another, if there is one that may stand in a file.
inline std::string seen_from(std::filesystem::path const& here,
                             std::filesystem::path const& there) {
    std::error_code fault;
    auto const way = std::filesystem::relative(there, here, fault);
    auto const text = fault ? std::string{} : way.generic_string();
    return unprintable_in(text).empty() ? text : std::string{};
}

/// What was tried before a search, a line each.
inline void print_tried(std::vector<report::tried_view> const& tried) {
    for (auto const& r : tried) {
        std::cout << "  " << r.by << ": " << r.outcome;
        if (!r.effort.empty()) std::cout << " (" << r.effort << ")";
        std::cout << "; " << r.why << "\n";
    }
}

/// The tables that make an identification a result that others can read (check, predict, verify):
/// boxes.csv, products.csv and certificates.csv; result.json is for the caller to add last.
inline void add_result_tables(file_set& files, identification_problem const& problem,
                              identification const& found) {
    files.add("boxes.csv", boxes_csv(problem, found));
    if (found.products) {
        files.add("products.csv", products_csv(found));
    } else {
        files.drop("products.csv"); // of an earlier result
    }
    if (found.proof.empty()) {
        files.drop("certificates.csv");
    } else {
        files.add("certificates.csv", certificates_csv(found.proof));
    }
}

} // namespace sivid::app

#endif
