// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_CONTROL_PAGE_HPP
#define SIVID_REPORT_CONTROL_PAGE_HPP

#include <sivid/compiled.hpp>
#include <sivid/decision/gain_search.hpp>
#include <sivid/report/decision_page.hpp>

#include <string>

namespace sivid::report {

/// What is known of the gains, in a sentence.
[[nodiscard]] SIVID_DECL std::string gain_sentence(gain_set const& found);

/// A page with the set of gains, and what the suggested ones do.
/// @param about  `with_gains`, if some are suggested
/// @param proof  of the suggested gains, and the tubes with them, followed with `asked.margins`;
///               may be null
[[nodiscard]] SIVID_DECL page control_page(stored_prediction const& about, requirement const& asked,
                                           gain_set const& found, verification const* proof,
                                           prediction const* tubes,
                                           decision_page_options const& options);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/control_page.ipp>
#endif

#endif
