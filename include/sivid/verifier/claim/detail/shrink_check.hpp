// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_SHRINK_CHECK_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_SHRINK_CHECK_HPP

#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/verifier/claim/detail/finding_of_all.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace sivid::io_detail {

/// Shares of the gap follow from the inflations.
/// @param c  the answer; null: the closest cause is meant
[[nodiscard]] inline check_finding check_shrinks(diagnosis const& d, cause const* c) {
    using outcome = check_finding::outcome;
    finding_of_all all;
    // What reading rounded outward is the larger the smaller the gap.
    auto const follows = [&](std::optional<interval> const& stated,
                             std::optional<interval> const& again, interval const& before,
                             char const* which) {
        if (!stated) return;
        double const gap = before.lower() > 1 ? before.lower() - 1 : before.upper() - 1;
        double const slack = 1e-12 * (1 + 1 / std::max(1e-12, gap));
        auto const outside = [slack](double a, double b) { // a must not be below b
            return std::isfinite(a) && std::isfinite(b) ? a < b - slack * std::max(1.0, std::abs(b))
                                                        : a < b;
        };
        bool const holds = again && !is_empty(*stated) &&
                           !outside(again->lower(), stated->lower()) &&
                           !outside(stated->upper(), again->upper());
        all.note(holds ? outcome::verified : outcome::refuted,
                 std::string{"the share of "} + which + " does not follow from the inflations");
    };
    if (c == nullptr && !d.causes.empty()) c = &d.causes.front();
    std::optional<interval> fit, held, over;
    if (c != nullptr) fit = shrink(d.inflation, c->inflation);
    if (c != nullptr && c->holdout) {
        auto const& h = *c->holdout;
        held = shrink(h.inflation_before, h.inflation_after);
        if (h.over_fits_after) over = shrink(h.inflation_before, *h.over_fits_after);
    }
    auto const held_gap = c != nullptr && c->holdout ? c->holdout->inflation_before : d.inflation;
    follows(d.shrink_fit, fit, d.inflation, "the fit");
    follows(d.shrink_holdout, held, held_gap, "the held-out data");
    follows(d.shrink_over_fits, over, held_gap, "all fits");
    return all.finding("shrink", "follows from the inflations");
}

} // namespace sivid::io_detail

#endif
