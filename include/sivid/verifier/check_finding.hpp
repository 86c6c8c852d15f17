// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CHECK_FINDING_HPP
#define SIVID_VERIFIER_CHECK_FINDING_HPP

#include <sivid/enclosure/options.hpp>
#include <sivid/paving/run_options.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
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

/// How hard claims about boxes are tried.
struct certificate_options : enclosure_options {
    certificate_options()
        : enclosure_options{.order = 10,
                            .tolerance = 1e-9,
                            .relative_tolerance = 1e-3,
                            .minimum_step = 1e-5,
                            .maximum_steps = 4000,
                            .widest = 1.0} {}

    double seconds = 10;
    /// Validated runs for one claim before it is left open.
    std::size_t runs_per_claim = 200;
    /// Regions wider than this share of the prior are split without a run.
    double widest_region = 1.0 / 16;
};

/// How much of a stored identification is proved anew.
struct identification_check_options {
    std::size_t sample =
        24; ///< number of inside boxes and of excluded boxes in the sample, or parts of them
    bool all = false; ///< every box instead
    std::uint64_t seed = 1;
    double seconds = 20; ///< for everything; what is not proved by then is not decided
    /// What the program that wrote the result assumes beside what the problem says.
    std::vector<std::string> further_assumptions = {};
    certificate_options certificate;
    run_options run{}; ///< of the Taylor models by which excluded boxes are proved
};

} // namespace sivid

#endif
