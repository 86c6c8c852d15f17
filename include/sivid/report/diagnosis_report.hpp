// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DIAGNOSIS_REPORT_HPP
#define SIVID_REPORT_DIAGNOSIS_REPORT_HPP

#include <sivid/compiled.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/report/diagnosis_page.hpp>
#include <sivid/report/diagnosis_view.hpp>
#include <sivid/report/fill/detail/diagnosis_plot_data.hpp>
#include <sivid/version.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid::report {

struct diagnosis_report_options {
    std::string dataset{};
    std::string model{};
    std::map<std::string, std::string>
        meanings{};                           ///< of effects: "a first-order lag of the rudder"
    std::map<std::string, interval> priors{}; ///< of effect parameters, by name as in `causes`
    std::vector<std::string> absorbed{};      ///< effects that the priors take up
    double base_fitted = 0; ///< inflation of the best fit of the model as it is; 0: not known
    std::string after{};    ///< what the plots' second model is; empty: with the answer
    std::vector<std::string> warnings{};
    std::string date{}, machine{}, command{};
};

/// Takes the meanings and priors of a catalogue of effects into the options.
SIVID_DECL void describe(std::vector<effect> const& catalogue, diagnosis_report_options& options);

/// What the page of a diagnosis shows.
/// @cost  O(size of the plot data)
[[nodiscard]] SIVID_DECL diagnosis_view view_of(diagnosis const& d,
                                                diagnosis_plot_data const& plots = {},
                                                diagnosis_report_options const& options = {});

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/diagnosis_report.ipp>
#endif

#endif
