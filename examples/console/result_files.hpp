// SPDX-License-Identifier: MIT
// The tables that make an identification a result that others can read: check, predict, verify.
#ifndef EXAMPLES_CONSOLE_RESULT_FILES_HPP
#define EXAMPLES_CONSOLE_RESULT_FILES_HPP

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

namespace console {

/// The way from one folder to another, if there is one that may stand in a file.
inline std::string seen_from(std::filesystem::path const& here,
                             std::filesystem::path const& there) {
    std::error_code fault;
    auto const way = std::filesystem::relative(there, here, fault);
    auto const text = fault ? std::string{} : way.generic_string();
    return sivid::unprintable_in(text).empty() ? text : std::string{};
}

/// What was tried before a search, a line each.
inline void print_tried(std::vector<sivid::report::tried_view> const& tried) {
    for (auto const& r : tried) {
        std::cout << "  " << r.by << ": " << r.outcome;
        if (!r.effort.empty()) std::cout << " (" << r.effort << ")";
        std::cout << "; " << r.why << "\n";
    }
}

/// boxes.csv, products.csv and certificates.csv; result.json is for the caller to add last.
inline void add_result_tables(sivid::file_set& files, sivid::identification_problem const& problem,
                              sivid::identification const& found) {
    files.add("boxes.csv", sivid::boxes_csv(problem, found));
    if (found.products) {
        files.add("products.csv", sivid::products_csv(found));
    } else {
        files.drop("products.csv"); // of an earlier result
    }
    if (found.proof.empty()) {
        files.drop("certificates.csv");
    } else {
        files.add("certificates.csv", sivid::certificates_csv(found.proof));
    }
}

} // namespace console

#endif
