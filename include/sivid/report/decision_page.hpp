// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DECISION_PAGE_HPP
#define SIVID_REPORT_DECISION_PAGE_HPP

#include <sivid/compiled.hpp>
#include <sivid/decision/prediction.hpp>
#include <sivid/decision/verification.hpp>
#include <sivid/io/result/stored_prediction.hpp>
#include <sivid/report/page.hpp>
#include <sivid/report/page/decision_page_options.hpp>

#include <string>
#include <vector>

namespace sivid::report {

/// The answer in a sentence.
[[nodiscard]] SIVID_DECL std::string answer_sentence(stored_prediction const& about,
                                                     verification const& found);
/// What an answer rests on, in sentences.
[[nodiscard]] SIVID_DECL std::vector<std::string> decision_assumptions(stored_prediction const& s);

/// A page with the tubes of all channels.
[[nodiscard]] SIVID_DECL page prediction_page(stored_prediction const& about,
                                              prediction const& found,
                                              decision_page_options const& options);

/// A page with the answer, the margins of all comparisons against zero, and the tubes.
/// @param tubes  of the same prediction, followed with `asked.margins`
[[nodiscard]] SIVID_DECL page verification_page(stored_prediction const& about,
                                                requirement const& asked, verification const& found,
                                                prediction const& tubes,
                                                decision_page_options const& options);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/decision_page.ipp>
#endif

#endif
