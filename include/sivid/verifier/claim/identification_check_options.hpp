// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_IDENTIFICATION_CHECK_OPTIONS_HPP
#define SIVID_VERIFIER_CLAIM_IDENTIFICATION_CHECK_OPTIONS_HPP

#include <sivid/paving/run_options.hpp>
#include <sivid/verifier/proof/detail/certificate_options.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sivid {

/// How much of a stored identification is proved anew.
struct identification_check_options {
    std::size_t sample =
        24; ///< number of inside boxes and of excluded boxes in the sample, or parts of them
    bool all = false; ///< every box instead
    std::uint64_t seed = 1;
    double seconds = 20; ///< for everything; what is not proved by then is not decided
    /// Share of the prior's sides next to a box that is not excluded of which the check may say
    /// nothing.
    double rim = 1e-6;
    /// What the program that wrote the result assumes beside what the problem says.
    std::vector<std::string> further_assumptions = {};
    certificate_options certificate;
    run_options run{}; ///< of the Taylor models by which excluded boxes are proved
};

} // namespace sivid

#endif
