// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_PROOF_DETAIL_CERTIFICATE_OPTIONS_HPP
#define SIVID_VERIFIER_PROOF_DETAIL_CERTIFICATE_OPTIONS_HPP

#include <sivid/enclosure/options.hpp>

#include <cstddef>

namespace sivid {

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

} // namespace sivid

#endif
