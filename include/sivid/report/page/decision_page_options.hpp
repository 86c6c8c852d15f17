// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_DECISION_PAGE_OPTIONS_HPP
#define SIVID_REPORT_PAGE_DECISION_PAGE_OPTIONS_HPP

#include <string>
#include <vector>

namespace sivid::report {

/// One simulated motion, not validated: what it is, and its values over time.
struct simulated_line {
    std::vector<double> times{};
    std::vector<std::vector<double>> states{};   ///< [time][state]
    std::vector<std::vector<double>> channels{}; ///< [time][channel]
    std::vector<std::vector<double>> further{};  ///< [time][expression]
};

/// What pages of decisions say besides.
struct decision_page_options {
    std::string dataset{}, scenario{}, about{};
    std::string law{};              ///< "" for none
    std::vector<std::string> set{}; ///< "Ff in [0.286, 0.777] N"
    simulated_line least_squares{}, single{};
    std::string single_is = "witness, not validated";
    std::vector<std::string> footer{};
};

} // namespace sivid::report

#endif
