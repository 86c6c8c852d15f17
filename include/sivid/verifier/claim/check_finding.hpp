// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_CHECK_FINDING_HPP
#define SIVID_VERIFIER_CLAIM_CHECK_FINDING_HPP

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace sivid {

/// What became of one statement of a stored result.
struct check_finding {
    enum class outcome {
        verified,  ///< all of it is proved
        refuted,   ///< the contrary is proved
        undecided, ///< not all of what was tried is proved
        sampled,   ///< a sample of it is proved; of the rest nothing is known
        nothing    ///< the result states nothing of the kind
    };
    std::string what;
    outcome found = outcome::nothing;
    std::string detail;
    double seconds = 0;
};

[[nodiscard]] constexpr std::string_view to_string(check_finding::outcome o) {
    using outcome = check_finding::outcome;
    return o == outcome::verified    ? "verified"
           : o == outcome::refuted   ? "REFUTED"
           : o == outcome::undecided ? "not decided"
           : o == outcome::sampled   ? "by sample"
                                     : "not checked";
}

/// The verdict on a whole result: refuted, undecided or sampled when anything is, in this order;
/// verified when all that it states is proved.
[[nodiscard]] inline check_finding::outcome overall(std::vector<check_finding> const& findings) {
    using outcome = check_finding::outcome;
    auto const any = [&](outcome o) {
        return std::any_of(findings.begin(), findings.end(),
                           [o](check_finding const& f) { return f.found == o; });
    };
    return any(outcome::refuted)     ? outcome::refuted
           : any(outcome::undecided) ? outcome::undecided
           : any(outcome::sampled)   ? outcome::sampled
                                     : outcome::verified;
}

} // namespace sivid

#endif
