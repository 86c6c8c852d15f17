// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_REACH_WORDS_HPP
#define SIVID_REPORT_REACH_WORDS_HPP

#include <sivid/compiled.hpp>
#include <sivid/paving/run_reach.hpp>

#include <string>
#include <vector>

namespace sivid::report {

/// Why little was excluded, a sentence for each experiment that says something, and what to change:
/// from what runs over all that is left measured.
[[nodiscard]] SIVID_DECL std::vector<std::string> reach_words(std::vector<run_reach> const& reach);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/reach_words.ipp>
#endif

#endif
