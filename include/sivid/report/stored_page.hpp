// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_STORED_PAGE_HPP
#define SIVID_REPORT_STORED_PAGE_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/report/decision_page.hpp>
#include <sivid/report/diagnosis_page.hpp>
#include <sivid/report/identification_view.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace sivid::report {

/// A page of a command, and what it was made of: numbers, names and points of its lines, from
/// which the same version of the library makes the same page, byte for byte (`read_page`).
struct stored_page {
    std::string name; ///< of its file: "report.html"
    std::string html;
    std::string data; ///< JSON (sivid-page-1): a number for each number, to the last bit

    /// "report.page.json"
    [[nodiscard]] std::string data_name() const {
        return name.substr(0, name.rfind('.')) + ".page.json";
    }
    void add_to(file_set& files) const {
        files.add(name, html);
        files.add(data_name(), data);
    }
};

// The pages of decision_page.hpp, identification_page.hpp and diagnosis_page.hpp, with their data.

[[nodiscard]] SIVID_DECL stored_page stored(identification_view const& v);
[[nodiscard]] SIVID_DECL stored_page stored(diagnosis_view const& v);
[[nodiscard]] SIVID_DECL stored_page stored_prediction_page(stored_prediction const& about,
                                                            prediction const& found,
                                                            decision_page_options const& o);
[[nodiscard]] SIVID_DECL stored_page stored_verification_page(stored_prediction const& about,
                                                              requirement const& asked,
                                                              verification const& found,
                                                              prediction const& tubes,
                                                              decision_page_options const& o);
[[nodiscard]] SIVID_DECL stored_page stored_control_page(stored_prediction const& about,
                                                         requirement const& asked,
                                                         gain_set const& found,
                                                         std::optional<verification> const& proof,
                                                         std::optional<prediction> const& tubes,
                                                         decision_page_options const& o);
[[nodiscard]] SIVID_DECL stored_page stored_design_page(stored_prediction const& about,
                                                        design_answer const& a,
                                                        std::optional<prediction> const& tubes,
                                                        decision_page_options const& o);
[[nodiscard]] SIVID_DECL stored_page stored_ranking_page(
    identification_problem const& about, ranking const& found, decision_page_options const& o,
    std::optional<measurement_ranking> const& measurements);

/// Makes a page of its data anew. It says what the data say: nothing is proved.
/// @throws input_error  where the file is not there, or its data are none of a page
[[nodiscard]] SIVID_DECL stored_page read_page(std::filesystem::path const& file);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/stored_page.ipp>
#endif

#endif
