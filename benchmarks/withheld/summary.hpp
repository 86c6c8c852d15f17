// SPDX-License-Identifier: MIT
// Many judgements as tables.
#ifndef WITHHELD_SUMMARY_HPP
#define WITHHELD_SUMMARY_HPP

#include "judge.hpp"

#include <string>
#include <vector>

namespace withheld {

/// By family, with a row for all; `baseline` may be empty, else one for each of `all`.
std::string family_table(std::vector<judgement> const& all, std::vector<judgement> const& baseline);
/// True effects against answers, as far as they occur.
std::string confusion(std::vector<judgement> const& all);
/// False proofs, troubles and wrong answers, one line each.
std::string complaints(std::vector<judgement> const& all);
/// Inflation, shrink and times.
std::string measures(std::vector<judgement> const& all);
std::string csv(std::vector<judgement> const& all);

} // namespace withheld

#endif
