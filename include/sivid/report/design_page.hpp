// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DESIGN_PAGE_HPP
#define SIVID_REPORT_DESIGN_PAGE_HPP

#include <sivid/compiled.hpp>
#include <sivid/decision/experiment_design.hpp>
#include <sivid/report/decision_page.hpp>

#include <string>
#include <vector>

namespace sivid::report {

/// The answer in a few words, and in a sentence.
[[nodiscard]] SIVID_DECL std::string design_headline(design_answer const& a);
[[nodiscard]] SIVID_DECL std::string design_sentence(design_answer const& a);

/// A page with the manoeuvre, its promise, the motion it brings about, and what else was tried.
/// @param tubes  of the manoeuvre; may be null
[[nodiscard]] SIVID_DECL page design_page(stored_prediction const& about, design_answer const& a,
                                          prediction const* tubes,
                                          decision_page_options const& options);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/design_page.ipp>
#endif

#endif
