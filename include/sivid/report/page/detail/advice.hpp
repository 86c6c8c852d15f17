// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_DETAIL_ADVICE_HPP
#define SIVID_REPORT_PAGE_DETAIL_ADVICE_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/diagnosis_view.hpp>
#include <sivid/report/page.hpp>
#include <sivid/report/table.hpp>

#include <string>
#include <vector>

namespace sivid::report {

/// The parameters of the answer by the symbols of its formulas, with what is proved of them.
[[nodiscard]] SIVID_DECL table change_table(diagnosis_view const& v);

/// What the model as it is misses most in each scenario, and what the answer leaves there; of best
/// fits.
[[nodiscard]] SIVID_DECL table cost_table(diagnosis_view const& v);

/// What to do where no effect is the answer, or beside it; each a sentence.
[[nodiscard]] SIVID_DECL std::vector<std::string> advice_lines(diagnosis_view const& v);

/// "What to do now": what to add to a simulator, what it costs to leave it out, what to look at or
/// to measure next.
SIVID_DECL void add_advice(page& out, diagnosis_view const& v);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/page/impl/advice.ipp>
#endif

#endif
