// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IDENTIFIABILITY_CHECK_HPP
#define SIVID_IO_IDENTIFIABILITY_CHECK_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/detail/check_finding.hpp>
#include <sivid/io/detail/stored_identification.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identifiability.hpp>

#include <functional>
#include <map>
#include <string>

namespace sivid {

namespace io_detail {

/// "scaling L 1, Sg -1"
[[nodiscard]] inline std::string motion_claim(std::string const& kind,
                                              std::map<std::string, long> const& weights) {
    std::string text = kind;
    for (auto const& [name, w] : weights) text += " " + name + " " + std::to_string(w);
    return text;
}

} // namespace io_detail

/// What of it is called proved.
[[nodiscard]] SIVID_DECL stored_identification::identifiability_claims
claims_of(identifiability const& found);

/// Ranks, motions and formulas that a result calls proved, computed anew from the equations.
/// @param keep_going  once false, what is not computed by then is not decided
[[nodiscard]] SIVID_DECL check_finding
check_identifiability(identification_problem const& problem, stored_identification const& stored,
                      std::function<bool()> const& keep_going = nullptr);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/impl/identifiability_check.ipp>
#endif

#endif
